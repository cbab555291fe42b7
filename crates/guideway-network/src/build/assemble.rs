//! Assembles the layout: nodes, edges with the properties of their lines and rules, stations and
//! groups.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Block, Direction, Layout, Member, NewPath, Provenance, Quantity, Value};
use guideway_spline::bezier::{Bezier, reversed};
use guideway_spline::{Runs, uniform};

use super::drawn::Drawn;
use super::names::Named;
use super::pieces::Piece;
use super::weld::Nodes;
use super::{BuildError, BuildOptions, BuildReport, DirectionRule, LayerRule};

/// A row that no table has: its cells are empty.
const NO_ROW: usize = usize::MAX;

pub(super) fn assemble(
    drawing: &Layout,
    drawn: &Drawn,
    nodes: &Nodes,
    pieces: &[Piece],
    named: &Named,
    options: &BuildOptions,
    report: &mut BuildReport,
) -> Result<Layout, BuildError> {
    let mut layout = Layout {
        provenance: Provenance {
            source: drawing.provenance.source.clone(),
            format: "network".to_owned(),
            ..Provenance::default()
        },
        levels: drawn.levels.clone(),
        vehicle_types: drawing.vehicle_types.clone(),
        zones: drawing.zones.clone(),
        attributes: drawing.attributes.clone(),
        geo_origin: drawing.geo_origin,
        ..Layout::default()
    };
    let old_nodes = old_nodes(drawing, drawn, nodes);
    let rows = add_nodes(&mut layout, drawing, nodes, pieces, named, &old_nodes);
    add_edges(&mut layout, drawing, drawn, (nodes, pieces), &rows, options);
    let of_old: HashMap<u32, u32> = old_nodes
        .iter()
        .filter_map(|(&node, &old)| Some((old, rows[node as usize]?)))
        .collect();
    add_stations(&mut layout, drawing, named, &rows, &of_old)?;
    add_blocks(&mut layout, drawing, drawn, pieces, &of_old);
    report.leave_nodes(drawing, |row| of_old.contains_key(&row));
    report.nodes = layout.nodes.len() as u64;
    report.edges = layout.paths.len() as u64;
    let two_way = layout
        .paths
        .iter()
        .filter(|p| p.direction() == Direction::Both);
    report.two_way = two_way.count() as u64;
    report.stations = layout.stations.len() as u64;
    Ok(layout)
}

/// The node of the drawing at each new node, if there is one.
fn old_nodes(drawing: &Layout, drawn: &Drawn, nodes: &Nodes) -> HashMap<u32, u32> {
    let mut old_nodes = HashMap::new();
    for (row, curve) in drawn.curves.iter().enumerate() {
        let path = drawing.paths.get(curve.source as usize);
        let ends = path.ends();
        for (side, old) in [path.start_node(), path.end_node()].into_iter().enumerate() {
            // Parts of a broken path begin and end elsewhere.
            let at = ends.map(|(start, end)| if side == 0 { start } else { end });
            if let Some(old) = old
                && at == Some(curve.end(side as u32))
            {
                let node = nodes.of_end[2 * row + side];
                old_nodes.entry(node).or_insert(old);
            }
        }
    }
    old_nodes
}

/// Adds the nodes of the pieces, and returns the row of each.
fn add_nodes(
    layout: &mut Layout,
    drawing: &Layout,
    nodes: &Nodes,
    pieces: &[Piece],
    named: &Named,
    old_nodes: &HashMap<u32, u32>,
) -> Vec<Option<u32>> {
    let mut is_used = vec![false; nodes.positions_m.len()];
    for piece in pieces {
        is_used[piece.start as usize] = true;
        is_used[piece.end as usize] = true;
    }
    let given = named.nodes.values().map(String::as_str);
    let kept = old_nodes.values().map(|&old| drawing.nodes.id(old));
    let taken: HashSet<&str> = given.chain(kept).collect();
    let mut rows = vec![None; is_used.len()];
    let (mut sources, mut entries, mut number) = (Vec::new(), Vec::new(), 0);
    for (node, row) in rows
        .iter_mut()
        .enumerate()
        .filter(|(node, _)| is_used[*node])
    {
        let old = old_nodes.get(&(node as u32)).copied();
        let name = named.nodes.get(&(node as u32)).map(String::as_str);
        let mut own = String::new();
        let id = name
            .or(old.map(|old| drawing.nodes.id(old)))
            .unwrap_or_else(|| {
                while own.is_empty() || taken.contains(own.as_str()) {
                    number += 1;
                    own = format!("N{number}");
                }
                &own
            });
        let types = drawing.nodes.vehicle_types();
        let names: Vec<&str> = old.map_or_else(Vec::new, |old| types.of(old as usize).collect());
        let (position_m, level) = (nodes.positions_m[node], nodes.levels[node]);
        *row = Some(layout.nodes.push_for_types(id, position_m, level, &names));
        sources.push(old.map_or(NO_ROW, |old| old as usize));
        entries.extend(old.map_or(0..0, |old| types.entries(old as usize)));
    }
    layout.nodes.attributes = drawing.nodes.attributes.select(&sources);
    let types = layout.nodes.vehicle_types_mut();
    types.attributes = drawing.nodes.vehicle_types().attributes.select(&entries);
    rows
}

/// Adds an edge per piece.
fn add_edges(
    layout: &mut Layout,
    drawing: &Layout,
    drawn: &Drawn,
    (nodes, pieces): (&Nodes, &[Piece]),
    node_rows: &[Option<u32>],
    options: &BuildOptions,
) {
    // The edges of each line, and those named so far.
    let mut counts = vec![[0; 2]; drawing.paths.len()];
    for piece in pieces {
        counts[drawn.curves[piece.curve as usize].source as usize][0] += 1;
    }
    let ids = drawing.paths.iter().map(|path| path.id());
    let taken: HashSet<&str> = ids.filter(|id| is_numbered(id)).collect();
    let (mut sources, mut entries) = (Vec::with_capacity(pieces.len()), Vec::new());
    let (mut runs, mut beziers) = (Runs::default(), Vec::new());
    let ranks = drawing.paths.rank();
    let mut own_ranks = Vec::new();
    for piece in pieces {
        let curve = &drawn.curves[piece.curve as usize];
        let source = curve.source as usize;
        let old = drawing.paths.get(source);
        let rule = curve.rule.map(|rule| &options.layers[rule as usize]);
        let (direction, is_reversed) = direction(rule, old.direction(), options.two_way);
        let id = edge_id(old.id(), &mut counts[source], &taken);
        if piece.is_whole && !is_reversed && old.runs().len() == 1 {
            old.copy_runs(&mut runs);
        } else {
            piece.copy_beziers(drawn, nodes, &mut beziers);
            set_runs(&mut runs, &beziers, is_reversed);
        }
        let own: Vec<&str> = rule
            .map_or(&[][..], |rule| &rule.vehicle_types[..])
            .iter()
            .map(String::as_str)
            .collect();
        let old_types = drawing.paths.vehicle_types();
        let types = match own.is_empty() {
            true => old_types.of(source).collect(),
            false => own.clone(),
        };
        let ends = [piece.start, piece.end].map(|node| node_rows[node as usize]);
        let row = layout.paths.push(&NewPath {
            id: &id,
            runs: &runs,
            start_node: ends[usize::from(is_reversed)],
            end_node: ends[usize::from(!is_reversed)],
            direction,
            level: curve.level,
            vehicle_types: &types,
        });
        layout
            .paths
            .set_own_style(row, drawing.paths.own_style(source));
        if piece.is_whole
            && !is_reversed
            && counts[source][0] == 1
            && let Some(written) = drawing.paths.written_curve(source)
        {
            layout.paths.set_written_curve(row, written.clone());
        }
        own_ranks.extend(ranks.map(|ranks| ranks[source]));
        sources.push(source);
        match own.is_empty() {
            true => entries.extend(old_types.entries(source)),
            false => entries.extend(own.iter().map(|_| NO_ROW)),
        }
    }
    if ranks.is_some() {
        layout.paths.set_rank(own_ranks);
    }
    layout.paths.attributes = drawing.paths.attributes.select(&sources);
    let old_types = drawing.paths.vehicle_types();
    layout.paths.vehicle_types_mut().attributes = old_types.attributes.select(&entries);
    set_properties(layout, drawn, pieces, options);
}

/// Replaces runs by those of cubics.
fn set_runs(runs: &mut Runs, beziers: &[Bezier], is_reversed: bool) {
    runs.clear();
    if is_reversed {
        for bezier in beziers.iter().rev() {
            runs.push_segment(&uniform::from_bezier(&reversed(bezier)));
        }
    } else {
        for bezier in beziers {
            runs.push_segment(&uniform::from_bezier(bezier));
        }
    }
}

/// Sets speeds of rules, and removes lengths of lines that were cut.
fn set_properties(layout: &mut Layout, drawn: &Drawn, pieces: &[Piece], options: &BuildOptions) {
    const SPEED: &str = "maxSpeed";
    for (row, piece) in pieces.iter().enumerate() {
        let rule = drawn.curves[piece.curve as usize].rule;
        let speed = rule.and_then(|rule| options.layers[rule as usize].max_speed_m_s);
        if let Some(speed) = speed {
            let paths = &mut layout.paths;
            paths
                .attributes
                .set_quantity(row, SPEED, speed, Quantity::Speed);
            let entries = paths.vehicle_types().entries(row);
            let types = paths.vehicle_types_mut();
            entries.for_each(|entry| types.attributes.clear(entry, SPEED));
        }
        if !piece.is_whole {
            layout.paths.attributes.clear(row, "length");
        }
    }
}

/// Directions of an edge, and whether it runs against the drawing.
fn direction(rule: Option<&LayerRule>, old: Direction, two_way: bool) -> (Direction, bool) {
    match rule.and_then(|rule| rule.direction) {
        Some(DirectionRule::Both) => (Direction::Both, false),
        Some(DirectionRule::Forward) => (Direction::Forward, false),
        Some(DirectionRule::Backward) => (Direction::Forward, true),
        None if two_way => (Direction::Both, false),
        None => (old, false),
    }
}

/// Returns `true` if an identifier may be that of a line with a number.
fn is_numbered(id: &str) -> bool {
    let number = id.rsplit_once('.').map(|(_, number)| number);
    number.is_some_and(|number| number.bytes().all(|byte| byte.is_ascii_digit()))
}

/// The identifier of a line, with a number if it became several edges. `counts` holds the number of
/// its edges and of those named so far.
fn edge_id(id: &str, counts: &mut [u32; 2], taken: &HashSet<&str>) -> String {
    if counts[0] == 1 {
        return id.to_owned();
    }
    loop {
        counts[1] += 1;
        let numbered = format!("{id}.{}", counts[1]);
        if !taken.contains(numbered.as_str()) {
            return numbered;
        }
    }
}

/// Adds the stations of the drawing, then those of its notes.
fn add_stations(
    layout: &mut Layout,
    drawing: &Layout,
    named: &Named,
    nodes: &[Option<u32>],
    of_old: &HashMap<u32, u32>,
) -> Result<(), BuildError> {
    let old = &drawing.stations;
    let rows: Vec<usize> = (0..old.len()).collect();
    layout.stations = old.select(&rows, |node| of_old.get(&node).copied());
    let known: HashMap<&str, u32> = (0..old.len() as u32)
        .map(|row| (old.id(row), row))
        .collect();
    for station in &named.stations {
        if let Some(&row) = known.get(station.id.as_str()) {
            return Err(BuildError::Name {
                kind: "stations",
                name: station.id.clone(),
                first: old.position_m(row).unwrap_or_default(),
                second: station.position_m,
            });
        }
        let node = nodes[station.node as usize];
        let level = node.and_then(|node| layout.nodes.level(node));
        let at = Some(station.position_m);
        let row = layout
            .stations
            .push(&station.id, at, node.into_iter().collect(), level);
        if !station.layer.is_empty() {
            let layer = Value::Text(&station.layer);
            layout.stations.attributes.set(row as usize, "layer", layer);
        }
    }
    Ok(())
}

/// Adds the blocks of the drawing; all pieces of a member are members.
fn add_blocks(
    layout: &mut Layout,
    drawing: &Layout,
    drawn: &Drawn,
    pieces: &[Piece],
    of_old: &HashMap<u32, u32>,
) {
    if drawing.blocks.is_empty() {
        return;
    }
    let mut edges: HashMap<u32, Vec<u32>> = HashMap::new();
    for (row, piece) in pieces.iter().enumerate() {
        let source = drawn.curves[piece.curve as usize].source;
        edges.entry(source).or_default().push(row as u32);
    }
    let members = |member: Member| match member {
        Member::Path(path) => {
            let rows = edges.get(&path).map_or(&[][..], Vec::as_slice);
            rows.iter().map(|&row| Member::Path(row)).collect()
        }
        Member::Node(node) => of_old
            .get(&node)
            .map(|&node| Member::Node(node))
            .into_iter()
            .collect(),
        Member::Station(station) => vec![Member::Station(station)],
    };
    layout.blocks = drawing
        .blocks
        .iter()
        .map(|block| Block {
            id: block.id.clone(),
            members: block
                .members
                .iter()
                .flat_map(|&m: &Member| -> Vec<Member> { members(m) })
                .collect(),
            attributes: block.attributes.clone(),
        })
        .collect();
}
