//! VDA 5050 mapping: adds the header, levels, nodes and edges of an order to the layout.

use guideway_layout::{Code, Layout, Level, Place, Severity, Value};
use guideway_spline::Point;

use super::mapper::{Mapper, TrajectoryEnds, whole};
use super::members::{DERIVED, PASSES};
use super::model::{Edge, Node, Position, Root, WithText};
use super::places::Places;
use super::version::Version;
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Field, OtherMembers, Tree, field_place, items};

/// Place of a node in the layout.
struct NodePlace {
    point: Point<f64>,
    level: Option<u32>,
    is_derived: bool,
}

/// Version by the keys of the edges, or by the stated version if there are no edges.
pub(super) fn version_of(root: &Root<'_>) -> Version {
    let stated = root.attributes.text("version").unwrap_or_default();
    match names_nodes(root) {
        Some(true) => Version::V2,
        Some(false) => Version::V3,
        None if stated.starts_with('3') => Version::V3,
        None => Version::V2,
    }
}

/// Tells if edges name their nodes; `None` without edges.
fn names_nodes(root: &Root<'_>) -> Option<bool> {
    let mut edges = items(&root.edges)
        .filter_map(|(_, edge)| edge.get())
        .peekable();
    edges.peek()?;
    Some(edges.any(|e| !e.start.is_absent() || !e.end.is_absent()))
}

impl Mapper<'_> {
    /// Maps orders to a layout. The header of one order is properties of the layout; those of
    /// several are columns of their paths.
    pub(super) fn map(
        mut self,
        orders: &[Root<'_>],
        places: &[Places],
    ) -> Result<Layout, ReadError> {
        for (i, (root, places)) in orders.iter().zip(places).enumerate() {
            self.begin_order();
            let prefix = match orders.len() {
                1 => String::new(),
                _ => format!("orders[{i}]."),
            };
            let first_path = self.builder.layout.paths.len();
            self.map_order(root, places, &prefix)?;
            let rows = match orders.len() {
                1 => 0..1,
                _ => first_path..self.builder.layout.paths.len(),
            };
            let table = if orders.len() == 1 {
                Table::Layout
            } else {
                Table::Paths
            };
            for row in rows {
                let mut other = OtherMembers::default();
                let at: PlaceFn<'_> = &|| Place::element(format!("{prefix}the root"));
                self.set_members(table, row, &root.attributes, &mut other, at)?;
                if orders.len() == 1 {
                    self.set_other(table, row, other)?;
                }
            }
        }
        self.map_version(&orders[0]);
        let nodes: usize = orders.iter().map(|root| items(&root.nodes).count()).sum();
        let edges = || orders.iter().flat_map(|root| items(&root.edges));
        let has_curve = |edge: &&Field<Edge<'_>>| {
            let edge = edge.get();
            edge.is_some_and(|edge| edge.trajectory.get().is_some())
        };
        let curves = edges().filter(|(_, edge)| has_curve(edge)).count();
        let counts = [
            ("nodes", nodes),
            ("edges", edges().count()),
            ("trajectories", curves),
        ];
        self.builder.layout.provenance.counts =
            counts.map(|(name, n)| (name.to_owned(), n as u64)).to_vec();
        Ok(self.builder.layout)
    }

    fn map_order(
        &mut self,
        root: &Root<'_>,
        places: &Places,
        prefix: &str,
    ) -> Result<(), ReadError> {
        let at_root: PlaceFn<'_> = &|| Place::element(format!("{prefix}the root"));
        self.builder.check_repeated(root.repeated, at_root);
        let ends = trajectory_ends(root);
        for (i, node) in items(&root.nodes) {
            self.builder.element_byte = places.nodes.get(i).copied();
            self.map_node(node, &ends, &|| {
                Place::element(format!("{prefix}nodes[{i}]"))
            })?;
        }
        self.builder.element_byte = None;
        self.set_passes()?;
        for (i, edge) in items(&root.edges) {
            self.builder.element_byte = places.edges.get(i).copied();
            self.map_edge(edge, &|| Place::element(format!("{prefix}edges[{i}]")))?;
        }
        self.builder.element_byte = None;
        Ok(())
    }

    /// Sets the version: the stated one, unless the keys of the edges contradict it.
    fn map_version(&mut self, root: &Root<'_>) {
        let at: PlaceFn<'_> = &|| Place::element("version");
        let stated = root.attributes.text("version").unwrap_or_default();
        let (majors, found): (&[&str], _) = match names_nodes(root) {
            Some(true) => (&["1", "2"], "1.1 to 2.1"),
            Some(false) => (&["3"], "3.0"),
            None => (&["1", "2", "3"], "1.1 to 3.0"),
        };
        let fits = majors.contains(&stated.split('.').next().unwrap_or_default());
        if !fits && !stated.is_empty() {
            let message =
                || format!("the order states version `{stated}`, but its structure is {found}");
            let remedy = "None needed: the structure decides the version";
            self.builder.report(Code::Version, at, message, remedy);
        }
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::Vda5050
            .name()
            .clone_into(&mut provenance.format);
        let version = if fits { stated } else { found };
        version.clone_into(&mut provenance.format_version);
    }

    fn map_node(
        &mut self,
        field: &Field<WithText<'_, Node<'_>>>,
        ends: &TrajectoryEnds<'_>,
        at: PlaceFn<'_>,
    ) -> Result<(), ReadError> {
        let Some(WithText { record: node, text }) = self.builder.record(field, at) else {
            return Ok(());
        };
        self.builder.check_repeated(node.repeated, at);
        let id = self.builder.id(&node.id, at, "nodeId")?;
        let sequence = self.sequence(&node.sequence, at);
        let known = self.nodes.get(&self.builder.layout.nodes, &id);
        if let (Some(row), true) = (known, node.position.is_absent()) {
            return self.pass_again(row, sequence, text);
        }
        let Some(place) = self.place(node, &id, sequence, ends, at)? else {
            self.unplaced.sequence.extend(sequence);
            self.unplaced.ids.insert(id.into_owned());
            return Ok(());
        };
        let nodes = &self.builder.layout.nodes;
        if let Some(row) = known {
            if (nodes.position_m(row), nodes.level(row)) == (place.point, place.level) {
                return self.pass_again(row, sequence, text);
            }
            self.ambiguous.insert(id.as_ref().to_owned());
        } else if let Some(row) = self.earlier(&id, &place) {
            self.nodes.insert(&self.builder.layout.nodes, row);
            if let Some(sequence) = sequence {
                self.sequence.entry(sequence).or_insert(row);
            }
            return Ok(());
        }
        let row = self.builder.push_node(&id, place.point, place.level)?;
        self.nodes.insert(&self.builder.layout.nodes, row);
        if let Some(sequence) = sequence {
            self.sequence.entry(sequence).or_insert(row);
        }
        let table_row = row as usize;
        self.set_sequence(Table::Nodes, table_row, sequence)?;
        if place.is_derived {
            self.derived.insert(row);
            let value = Value::Bool(true);
            self.builder.set(Table::Nodes, table_row, DERIVED, value)?;
        }
        let mut other = OtherMembers::default();
        self.set_members(Table::Nodes, table_row, &node.attributes, &mut other, at)?;
        if let Some(position) = node.position.get() {
            let at: PlaceFn<'_> = &|| field_place(at, "nodePosition");
            let mut nested = OtherMembers::default();
            let attributes = &position.attributes;
            self.set_members(Table::Nodes, table_row, attributes, &mut nested, at)?;
            if let Some(text) = nested.into_text() {
                other.add(None, "nodePosition", &text);
            }
        }
        self.set_other(Table::Nodes, table_row, other)
    }

    /// Returns the row of a node of an earlier order with this identifier and place.
    fn earlier(&self, id: &str, place: &NodePlace) -> Option<u32> {
        let nodes = &self.builder.layout.nodes;
        let row = self.earlier.get(nodes, id)?;
        let is_same = (nodes.position_m(row), nodes.level(row)) == (place.point, place.level);
        is_same.then_some(row)
    }

    /// Returns the place of a node: its position, else the end of a trajectory.
    fn place(
        &mut self,
        node: &Node<'_>,
        id: &str,
        sequence: Option<u64>,
        ends: &TrajectoryEnds<'_>,
        at: PlaceFn<'_>,
    ) -> Result<Option<NodePlace>, ReadError> {
        let at_position: PlaceFn<'_> = &|| field_place(at, "nodePosition");
        if node.position.is_absent() {
            let by_sequence = sequence.and_then(|number| ends.by_sequence.get(&number));
            let end = by_sequence.or_else(|| ends.by_id.get(id)).copied();
            let end = end.filter(|&end| self.builder.check_point(end, at));
            let (message, remedy) = match end {
                Some(_) => (
                    "the node has no position: it is drawn at the end of a trajectory",
                    "None needed: the format allows it",
                ),
                None => (
                    "the node has no position, and no trajectory leads to it: it is not drawn",
                    "The format allows it; give the node a position to draw it",
                ),
            };
            let message = || message.to_owned();
            let builder = &mut self.builder;
            builder.report_as(Severity::Info, Code::NotDrawn, at, message, remedy);
            return Ok(end.map(|point| NodePlace {
                point,
                level: None,
                is_derived: true,
            }));
        }
        let Some(position) = self.builder.record(&node.position, at_position) else {
            return Ok(None);
        };
        self.builder.check_repeated(position.repeated, at_position);
        let Some(point) = self.builder.point(&position.x, &position.y, at_position) else {
            return Ok(None);
        };
        let level = self.level(position, at_position)?;
        Ok(Some(NodePlace {
            point,
            level,
            is_derived: false,
        }))
    }

    /// Adds a pass of a node that the order passed before.
    fn pass_again(&mut self, row: u32, sequence: Option<u64>, text: &str) -> Result<(), ReadError> {
        self.builder.check_text(text)?;
        if let Some(sequence) = sequence {
            self.sequence.entry(sequence).or_insert(row);
        }
        self.passes.entry(row).or_default().push(pass_text(text));
        Ok(())
    }

    /// Sets the column of the further passes of nodes.
    fn set_passes(&mut self) -> Result<(), ReadError> {
        let mut passes: Vec<_> = std::mem::take(&mut self.passes).into_iter().collect();
        passes.sort_unstable();
        for (row, passes) in passes {
            let text = format!("[{}]", passes.join(","));
            let value = Value::Json(&text);
            self.builder
                .set(Table::Nodes, row as usize, PASSES, value)?;
        }
        Ok(())
    }

    fn level(
        &mut self,
        position: &Position<'_>,
        at: PlaceFn<'_>,
    ) -> Result<Option<u32>, ReadError> {
        let id = self
            .builder
            .text(&position.map_id, &|| field_place(at, "mapId"))?;
        let Some(id) = id else { return Ok(None) };
        if let Some(&level) = self.maps.get(id) {
            return Ok(Some(level));
        }
        let levels = &mut self.builder.layout.levels;
        let level = levels.len() as u32;
        levels.push(Level {
            id: id.to_owned(),
            ..Level::default()
        });
        self.maps.insert(id.to_owned(), level);
        Ok(Some(level))
    }
}

/// Returns a node without its identifier and place.
fn pass_text(text: &str) -> String {
    let is_place = |key: &str| matches!(key, "x" | "y" | "mapId");
    let Tree::Object(members) = Tree::opened(text) else {
        return "{}".to_owned();
    };
    let members = members.into_iter().filter_map(|(key, value)| {
        let value = match (key.as_ref(), value) {
            ("nodeId", _) => return None,
            ("nodePosition", Tree::Raw(text)) if text.starts_with('{') => {
                let Tree::Object(members) = Tree::opened(&text) else {
                    return None;
                };
                let rest = members.into_iter().filter(|(key, _)| !is_place(key));
                let rest: Vec<_> = rest.collect();
                if rest.is_empty() {
                    return None;
                }
                Tree::Raw(Tree::Object(rest).to_text().into())
            }
            ("nodePosition", _) => return None,
            (_, value) => value,
        };
        Some((key, value))
    });
    Tree::Object(members.collect()).to_text()
}

/// Collects the outer control points of all trajectories, if a node has no position.
fn trajectory_ends<'r>(root: &'r Root<'_>) -> TrajectoryEnds<'r> {
    let mut ends = TrajectoryEnds::default();
    let mut nodes = items(&root.nodes).filter_map(|(_, node)| node.get());
    if nodes.all(|node| !node.record.position.is_absent()) {
        return ends;
    }
    for (_, edge) in items(&root.edges) {
        let Some(edge) = edge.get() else { continue };
        let Some(trajectory) = edge.trajectory.get() else {
            continue;
        };
        let points = &trajectory.record.points;
        let points = items(points).filter_map(|(_, point)| {
            let point = point.get()?;
            Some(Point::new(*point.x.get()?, *point.y.get()?))
        });
        let points: Vec<Point<f64>> = points.collect();
        let [first, .., last] = points[..] else {
            continue;
        };
        let sequence = edge.sequence.get().and_then(|&number| whole(number));
        let before = sequence.and_then(|number| number.checked_sub(1));
        let after = sequence.map(|number| number + 1);
        for (number, name, point) in [(before, &edge.start, first), (after, &edge.end, last)] {
            if let Some(number) = number {
                ends.by_sequence.entry(number).or_insert(point);
            }
            if let Some(name) = name.get() {
                ends.by_id.entry(name.as_ref()).or_insert(point);
            }
        }
    }
    ends
}
