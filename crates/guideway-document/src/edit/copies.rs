//! Copies as rows: builds new rows that refer to each other as the originals do, and the edits that
//! insert them.

use guideway_layout::Layout;
use guideway_scene::{Edit, EditError, Insertion, NewNode, NewStation, Scene, Table, TableEdit};
use guideway_spline::Affine;

use super::curves::mapped_runs;
use super::names::Names;
use crate::PathSet;
use crate::change::CopiesOf;
use crate::document::Document;
use crate::elements::Elements;

/// Elements to copy.
pub(super) struct Source<'a> {
    pub(super) layout: &'a Layout,
    /// Paths, all of their end nodes, and stations.
    pub(super) elements: &'a Elements,
    /// True if the copies go into the same layout, and so take over properties by row.
    pub(super) is_own: bool,
    /// Number of the copy in its names; `None` keeps names that are free.
    pub(super) number: Option<u32>,
    /// Level of the target for each level of the source; `None` keeps levels.
    pub(super) levels: Option<&'a [Option<u32>]>,
}

/// New rows of a document.
pub(super) struct Copies<'a> {
    names: [Names<'a>; 3],
    first_rows: [u32; 3],
    nodes: Vec<NewNode>,
    paths: Vec<Insertion>,
    stations: Vec<NewStation>,
}

impl<'a> Copies<'a> {
    /// No copies yet, to be inserted into a scene.
    pub(super) fn into(scene: &'a Scene) -> Self {
        let tables = Table::ALL;
        Self {
            names: tables.map(|of| Names::of(of, scene)),
            first_rows: tables.map(|of| of.row_count(scene.layout()) as u32),
            nodes: Vec::new(),
            paths: Vec::new(),
            stations: Vec::new(),
        }
    }

    /// Adds a transformed copy.
    pub(super) fn add(&mut self, source: &Source<'_>, by: Affine) {
        let Source {
            layout, elements, ..
        } = source;
        let own = |row: u32| source.is_own.then_some(row);
        let level = |level: Option<u32>| match source.levels {
            Some(levels) => levels.get(level? as usize).copied().flatten(),
            None => level,
        };
        let first_node = self.first_rows[1] + self.nodes.len() as u32;
        let node = |row: u32| {
            let is_copied = elements.nodes.contains(row);
            // The rank counts the rows up to and with this one.
            is_copied.then(|| first_node + elements.nodes.rank(row) as u32 - 1)
        };
        let [path_names, node_names, station_names] = &mut self.names;
        let name = |names: &mut Names<'_>, id: &str| match source.number {
            Some(number) => names
                .next_number(id)
                .unwrap_or_else(|| names.unique(&format!("{id} copy {number}"))),
            None => names.unique(id),
        };
        for row in &elements.nodes {
            let nodes = &layout.nodes;
            self.nodes.push(NewNode {
                id: name(node_names, nodes.id(row)),
                position_m: by.apply(nodes.position_m(row)),
                level: level(nodes.level(row)),
                vehicle_types: nodes
                    .vehicle_types()
                    .of(row as usize)
                    .map(str::to_owned)
                    .collect(),
                attributes_of: own(row),
            });
        }
        for row in &elements.paths {
            let (paths, at) = (&layout.paths, row as usize);
            let path = paths.get(at);
            let ends = [path.start_node(), path.end_node()];
            let new_ends = ends.map(|end| end.and_then(node));
            // A path that is called after its ends is called after those of the copy.
            let by_ends = || {
                source.number?;
                let old = ends.map(|end| Some(layout.nodes.id(end?)));
                let new = new_ends.map(|end| {
                    let number = (end? - self.first_rows[1]) as usize;
                    Some(self.nodes[number].id.as_str())
                });
                let ([Some(from), Some(to)], [Some(start), Some(end)]) = (old, new) else {
                    return None;
                };
                let between = path.id().strip_prefix(from)?.strip_suffix(to)?;
                (!between.is_empty()).then(|| format!("{start}{between}{end}"))
            };
            let id = match by_ends() {
                Some(id) => path_names.unique(&id),
                None => name(path_names, path.id()),
            };
            self.paths.push(Insertion {
                id,
                runs: mapped_runs(path, by),
                start_node: new_ends[0],
                end_node: new_ends[1],
                direction: path.direction(),
                level: level(path.level()),
                vehicle_types: paths.vehicle_types().of(at).map(str::to_owned).collect(),
                style: paths.own_style(at),
                attributes_of: own(row),
                rank: paths
                    .rank()
                    .filter(|_| !source.is_own)
                    .map(|ranks| ranks[at]),
                written: paths.written_curve(at).map(|curve| curve.mapped(by).into()),
            });
        }
        for row in &elements.stations {
            let stations = &layout.stations;
            let nodes = stations.nodes(row).iter().filter_map(|&row| node(row));
            self.stations.push(NewStation {
                id: name(station_names, stations.id(row)),
                position_m: stations.position_m(row).map(|at_m| by.apply(at_m)),
                nodes: nodes.collect(),
                level: level(stations.level(row)),
                attributes_of: own(row),
            });
        }
    }

    /// The rows that the copies will have.
    pub(super) fn rows(&self) -> Elements {
        let rows =
            |first: u32, count: usize| -> PathSet { (first..first + count as u32).collect() };
        Elements {
            paths: rows(self.first_rows[0], self.paths.len()),
            nodes: rows(self.first_rows[1], self.nodes.len()),
            stations: rows(self.first_rows[2], self.stations.len()),
            ..Elements::default()
        }
    }

    /// The edits that insert the copies.
    pub(super) fn into_edits(self) -> Vec<Edit> {
        let mut edits = Vec::new();
        if !self.nodes.is_empty() {
            edits.push(Edit::Tables(TableEdit::InsertNodes(self.nodes.into())));
        }
        if !self.paths.is_empty() {
            edits.push(Edit::Insert(self.paths.into()));
        }
        if !self.stations.is_empty() {
            let stations = TableEdit::InsertStations(self.stations.into());
            edits.push(Edit::Tables(stations));
        }
        edits
    }
}

impl Document {
    /// Checks that copied elements exist and that the copies keep the limits. A journal may ask for
    /// anything.
    pub(super) fn check_copies(&self, of: &CopiesOf) -> Result<(), EditError> {
        let limits = |what, count: u64, limit: u64| match count > limit {
            true => Err(EditError::TooManyCopies { what, count, limit }),
            false => Ok(()),
        };
        limits("copies", of.count.into(), CopiesOf::MAX_COUNT.into())?;
        self.check_exist(&of.elements)?;
        let layout = self.layout();
        let points = |row: u32| {
            let runs = layout.paths.get(row as usize).runs();
            runs.map(|run| run.len() as u64).sum::<u64>()
        };
        let copied = of.elements.paths.iter().map(points).sum::<u64>() + of.elements.len();
        let rows = Table::ALL.map(|table| table.row_count(layout) as u64);
        let present = layout.paths.geometry().point_count() as u64 + rows.iter().sum::<u64>();
        let size = present.saturating_add(copied.saturating_mul(of.count.into()));
        limits("control points and elements", size, CopiesOf::MAX_SIZE)
    }

    /// The new rows of copies.
    pub(super) fn copies_of(&self, of: &CopiesOf) -> Copies<'_> {
        let mut copies = Copies::into(&self.scene);
        for number in 1..=of.count {
            let source = Source {
                layout: self.layout(),
                elements: &of.elements,
                is_own: true,
                number: Some(number),
                levels: None,
            };
            let by = Affine::translation(of.step_m * f64::from(number));
            copies.add(&source, by);
        }
        copies
    }
}
