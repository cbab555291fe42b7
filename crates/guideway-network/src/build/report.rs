//! [`BuildReport`]: the account of a build, in numbers, places and words.

use std::collections::BTreeMap;

use guideway_layout::Layout;
use guideway_layout::text_format::{counted, length, single_line};
use guideway_spline::Point;

use super::{BuildOptions, NoteSource};

/// Notes that the words name.
const NAMED_NOTES: usize = 5;
/// Characters of a name in the words.
const NAME_CHARS: usize = 40;

/// A note that became neither a station nor a name.
#[derive(Clone, Debug, PartialEq)]
pub struct LeftNote {
    /// Its text, or what it is.
    pub name: String,
    /// Its position, in meters.
    pub position_m: Point<f64>,
}

/// Notes that the options name, and of which the drawing has none.
#[derive(Clone, Debug, PartialEq)]
pub struct UnmatchedSource {
    /// The notes that the options name.
    pub source: NoteSource,
    /// Layers or blocks with notes of that kind in the drawing, in order, up to five.
    pub present: Vec<String>,
}

/// The parts that a build joined, cut, named and left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BuildReport {
    /// Paths of the drawing.
    pub paths: u64,
    /// Paths of layers that the options leave out.
    pub paths_left: u64,
    /// Circles that mark stations, and so are no edges.
    pub circles: u64,
    /// Paths without length.
    pub dots: u64,
    /// Paths with a gap, whose parts became edges of their own.
    pub broken: u64,
    /// Short lines that became curves.
    pub smoothed_lines: u64,
    /// Curves that replace them, in cubic segments.
    pub smoothed_curves: u64,
    /// Nodes where ends with a gap between them were joined.
    pub gaps: u64,
    /// Positions of these nodes, in meters, up to 10,000 of them.
    pub gaps_m: Vec<Point<f64>>,
    /// Largest distance by which an end moved, in meters.
    pub largest_move_m: f64,
    /// Ends that meet the middle of a line.
    pub junctions: u64,
    /// Places where lines cross and are cut.
    pub crossings: u64,
    /// Junctions and crossings, in meters, up to 10,000 of them.
    pub cuts_m: Vec<Point<f64>>,
    /// Pairs of curves that lie on each other, which have no crossings.
    pub overlaps: u64,
    /// Paths that were cut.
    pub cut: u64,
    /// Pieces that were shorter than the weld distance, and vanished in their node.
    pub vanished: u64,
    /// Pieces that are drawn twice; one stays.
    pub repeated: u64,
    /// Nodes.
    pub nodes: u64,
    /// Edges.
    pub edges: u64,
    /// Edges on which vehicles drive in both directions.
    pub two_way: u64,
    /// Stations, those of the drawing included.
    pub stations: u64,
    /// Nodes of the drawing that are none of the network: welded to others, or at no edge.
    pub nodes_left: u64,
    /// Values that these nodes had, by property.
    pub values_left: BTreeMap<String, u64>,
    /// Nodes that a note names.
    pub named: u64,
    /// Notes that are farther from every line than the options allow, up to 100 of them.
    pub left_notes: Vec<LeftNote>,
    /// Number of such notes.
    pub left_note_count: u64,
    /// Sources of stations and names without a note.
    pub unmatched_sources: Vec<UnmatchedSource>,
}

impl UnmatchedSource {
    fn line(&self) -> String {
        let source = single_line(&self.source.to_string(), NAME_CHARS);
        let kind = self.source.kind;
        let present = self
            .present
            .iter()
            .map(|name| single_line(name, NAME_CHARS));
        let present = match present.collect::<Vec<_>>() {
            names if names.is_empty() => format!("the drawing has no {kind}"),
            names => format!("the drawing has them in {}", names.join(", ")),
        };
        format!("no note fits {source}: {present}")
    }
}

impl BuildReport {
    /// Most notes that are listed.
    const MAX_LEFT_NOTES: usize = 100;
    /// Most places of a kind that are listed.
    const MAX_PLACES: usize = 10_000;

    /// Records a node where ends with a gap between them were joined.
    pub(super) fn join(&mut self, position_m: Point<f64>) {
        self.gaps += 1;
        if self.gaps_m.len() < Self::MAX_PLACES {
            self.gaps_m.push(position_m);
        }
    }

    /// Records an end that meets the middle of a line.
    pub(super) fn cut_at_junction(&mut self, position_m: Point<f64>) {
        self.junctions += 1;
        self.list_cut(position_m);
    }

    /// Records a place where lines cross.
    pub(super) fn cut_at_crossing(&mut self, position_m: Point<f64>) {
        self.crossings += 1;
        self.list_cut(position_m);
    }

    fn list_cut(&mut self, position_m: Point<f64>) {
        if self.cuts_m.len() < Self::MAX_PLACES {
            self.cuts_m.push(position_m);
        }
    }

    /// Records a note that was left.
    pub(super) fn leave_note(&mut self, name: &str, position_m: Point<f64>) {
        self.left_note_count += 1;
        if self.left_notes.len() < Self::MAX_LEFT_NOTES {
            let name = name.to_owned();
            self.left_notes.push(LeftNote { name, position_m });
        }
    }

    /// Records the nodes of the drawing that are none of the network, with their values.
    pub(super) fn leave_nodes(&mut self, drawing: &Layout, is_kept: impl Fn(u32) -> bool) {
        let (nodes, types) = (&drawing.nodes, drawing.nodes.vehicle_types());
        let left = (0..nodes.len() as u32).filter(|&row| !is_kept(row));
        for row in left.map(|row| row as usize) {
            self.nodes_left += 1;
            let own = nodes.attributes.iter();
            let own = own.map(|column| (column, usize::from(column.values.get(row).is_some())));
            let of_types = types.attributes.iter().map(|column| {
                let entries = types.entries(row);
                let values = entries.filter(|&entry| column.values.get(entry).is_some());
                (column, values.count())
            });
            for (column, count) in own.chain(of_types).filter(|(_, count)| *count > 0) {
                *self.values_left.entry(column.name.clone()).or_default() += count as u64;
            }
        }
    }

    /// Name and number of each thing that was done or left, in the order of the work.
    pub fn counts(&self) -> [(&'static str, u64); 19] {
        [
            ("paths", self.paths),
            ("paths_left", self.paths_left),
            ("circles", self.circles),
            ("dots", self.dots),
            ("broken", self.broken),
            ("smoothed_lines", self.smoothed_lines),
            ("smoothed_curves", self.smoothed_curves),
            ("gaps", self.gaps),
            ("junctions", self.junctions),
            ("crossings", self.crossings),
            ("overlaps", self.overlaps),
            ("cut", self.cut),
            ("vanished", self.vanished),
            ("repeated", self.repeated),
            ("nodes_left", self.nodes_left),
            ("nodes", self.nodes),
            ("edges", self.edges),
            ("two_way", self.two_way),
            ("stations", self.stations),
        ]
    }

    /// The report in words, a line for each thing that was done or left.
    pub fn lines(&self, options: &BuildOptions) -> Vec<String> {
        let mut lines = vec![
            format!(
                "{} between {}, {}",
                counted(self.edges, "edge"),
                counted(self.nodes, "node"),
                counted(self.stations, "station"),
            ),
            self.direction_line(options),
        ];
        let mut say = |count: u64, line: String| {
            if count > 0 {
                lines.push(line);
            }
        };
        let (gaps, farthest) = (counted(self.gaps, "gap"), length(self.largest_move_m));
        say(
            self.gaps,
            format!("joined: {gaps}; the farthest end moved by {farthest}"),
        );
        let junctions = counted(self.junctions, "junction");
        let crossings = counted(self.crossings, "crossing");
        let cut = counted(self.cut, "line");
        say(
            self.junctions + self.crossings,
            format!("cut: {cut} at {junctions} and {crossings}"),
        );
        let from = counted(self.smoothed_lines, "line");
        let to = counted(self.smoothed_curves, "curve");
        say(self.smoothed_lines, format!("smoothed: {from} to {to}"));
        say(
            self.named,
            format!("named: {}", counted(self.named, "node")),
        );
        for (count, what) in [
            (self.paths_left, "of layers that are left out"),
            (self.circles, "that are circles of stations"),
            (self.dots, "without length"),
            (self.vanished, "shorter than the weld distance"),
            (self.repeated, "drawn twice"),
        ] {
            say(count, format!("left: {} {what}", counted(count, "line")));
        }
        let broken = counted(self.broken, "line");
        say(self.broken, format!("parted: {broken} with gaps"));
        let pairs = counted(self.overlaps, "pair");
        say(
            self.overlaps,
            format!("not cut: {pairs} of curves that lie on each other"),
        );
        say(self.nodes_left, self.left_nodes_line());
        say(self.left_note_count, self.left_notes_line());
        lines.extend(self.unmatched_sources.iter().map(UnmatchedSource::line));
        lines
    }

    fn direction_line(&self, options: &BuildOptions) -> String {
        let one_way = self.edges - self.two_way;
        match (options.two_way, one_way) {
            (true, 0) => "two-way: vehicles drive along every line in both directions".to_owned(),
            (true, _) => {
                let one_way = counted(one_way, "edge");
                format!("two-way, except {one_way} by the rules of layers")
            }
            (false, _) => "one-way: vehicles drive as the lines were drawn".to_owned(),
        }
    }

    fn left_nodes_line(&self) -> String {
        let values = self.values_left.iter().map(|(name, &count)| {
            let name = single_line(name, NAME_CHARS);
            format!("{} of {name}", counted(count, "value"))
        });
        let values: Vec<String> = values.collect();
        let values = match values.is_empty() {
            true => String::new(),
            false => format!(", and with them {}", values.join(", ")),
        };
        let nodes = counted(self.nodes_left, "node");
        format!("left: {nodes} of the drawing, welded to others or at no line{values}")
    }

    fn left_notes_line(&self) -> String {
        let names = self.left_notes.iter().take(NAMED_NOTES);
        let names: Vec<String> = names.map(|n| single_line(&n.name, NAME_CHARS)).collect();
        let (notes, names) = (counted(self.left_note_count, "note"), names.join(", "));
        format!("left: {notes} too far from every line, such as {names}; a longer reach takes them")
    }
}
