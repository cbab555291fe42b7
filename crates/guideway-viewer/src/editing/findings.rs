//! The findings about a layout and its network, their places in the plane, and the document state
//! that they are about.

use std::time::{Duration, Instant};

use guideway_document::{Element, Snapshot, located};
use guideway_layout::{CheckOptions, Code, Diagnostic, Diagnostics, Layout, PathRef, Severity};
use guideway_network::{AnalyzeOptions, analyze};
use guideway_spline::{Point, uniform};

/// The severities that are shown, most severe first.
pub(crate) const SEVERITIES: [Severity; 3] = [Severity::Error, Severity::Warning, Severity::Info];

/// The severities whose findings are marked in the drawing, in the order of [`SEVERITIES`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct MarkedSeverities(pub(crate) [bool; 3]);

impl Default for MarkedSeverities {
    /// Notes would cover a site: each two-way road has one.
    fn default() -> Self {
        Self([true, true, false])
    }
}

impl MarkedSeverities {
    /// Returns `true` if findings of this severity are marked.
    pub(crate) fn has(self, severity: Severity) -> bool {
        let place = SEVERITIES.iter().position(|other| *other == severity);
        place.is_some_and(|place| self.0[place])
    }
}

/// Findings of one document state.
pub(crate) struct Findings {
    pub(crate) diagnostics: Diagnostics,
    /// The findings that have a place, most severe first.
    pub(crate) marks: Vec<FindingMark>,
    /// The same by x: the pointer asks at each movement.
    by_x: Vec<u32>,
    /// The checked state, to compare with [`Document::state`](guideway_document::Document::state).
    pub(crate) state: u64,
    pub(crate) options: CheckOptions,
    pub(crate) elapsed: Duration,
}

/// A finding with its place in the plane.
pub(crate) struct FindingMark {
    pub(crate) severity: Severity,
    pub(crate) at_m: Point<f64>,
    /// Its number among the stored findings.
    number: usize,
}

impl Findings {
    /// Checks a snapshot and its network; takes seconds for a million paths.
    pub(crate) fn of(snapshot: &Snapshot, options: &CheckOptions) -> Self {
        let started = Instant::now();
        let mut diagnostics = snapshot.findings(options);
        let network = AnalyzeOptions::default();
        diagnostics.append(snapshot.findings_of(|layout| analyze(layout, &network)));
        let marks = marks(snapshot.layout(), &diagnostics);
        let mut by_x: Vec<u32> = (0..marks.len() as u32).collect();
        by_x.sort_by(|&a, &b| {
            let x = |mark: u32| marks[mark as usize].at_m.x;
            x(a).total_cmp(&x(b))
        });
        Self {
            diagnostics,
            marks,
            by_x,
            state: snapshot.state(),
            options: options.clone(),
            elapsed: started.elapsed(),
        }
    }

    /// The most severe marked finding within a distance of a place.
    pub(crate) fn near(
        &self,
        at_m: Point<f64>,
        reach_m: f64,
        marked: MarkedSeverities,
    ) -> Option<&Diagnostic> {
        let mark = |index: u32| &self.marks[index as usize];
        let first = self
            .by_x
            .partition_point(|&index| mark(index).at_m.x < at_m.x - reach_m);
        let is_beside = |index: &u32| mark(*index).at_m.x <= at_m.x + reach_m;
        let beside = self.by_x[first..].iter().copied().take_while(is_beside);
        let near = beside.filter(|&index| mark(index).at_m.distance(at_m) <= reach_m);
        let shown = near.filter(|&index| marked.has(mark(index).severity));
        self.diagnostics.iter().nth(mark(shown.min()?).number)
    }
}

/// The marks of findings about elements.
fn marks(layout: &Layout, found: &Diagnostics) -> Vec<FindingMark> {
    let mark = |(number, finding): (usize, &Diagnostic)| {
        let at_m = match located(&finding.place)? {
            Element::Path(row) => place_on(layout, row, finding.code)?,
            Element::Node(row) => layout.nodes.position_m(row),
            Element::Station(row) => layout.station_position_m(row)?,
        };
        Some(FindingMark {
            severity: finding.severity,
            at_m,
            number,
        })
    };
    let mut marks: Vec<_> = found.iter().enumerate().filter_map(mark).collect();
    marks.sort_by_key(|mark| std::cmp::Reverse(mark.severity));
    marks
}

/// The end of a path that is away from its node, or the middle of the path.
fn place_on(layout: &Layout, row: u32, code: Code) -> Option<Point<f64>> {
    let path = layout.paths.get(row as usize);
    if code != Code::NodeGap {
        return middle_m(path);
    }
    let (start, end) = path.ends()?;
    let gap_m = |node: Option<u32>, end: Point<f64>| {
        node.map_or(0.0, |node| layout.nodes.position_m(node).distance(end))
    };
    let at_start = gap_m(path.start_node(), start) >= gap_m(path.end_node(), end);
    Some(if at_start { start } else { end })
}

/// A point in the middle of a path.
fn middle_m(path: PathRef<'_>) -> Option<Point<f64>> {
    let segments = || path.runs().flat_map(|run| run.segments());
    let count = segments().count();
    let t = if count.is_multiple_of(2) { 0.0 } else { 0.5 };
    let segment = segments().nth(count / 2)?;
    Some(uniform::point(&segment, t))
}

#[cfg(test)]
mod tests {
    use guideway_document::Document;

    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn findings_of_layout_and_network_have_places() {
        let mut layout = lanes(2);
        layout.nodes.set_position_m(3, Point::new(10.5, 2.0));
        let document = Document::new(layout.into(), &Default::default()).unwrap();
        let findings = Findings::of(&document.snapshot(), &CheckOptions::default());
        let count = |code| findings.diagnostics.count(code);
        assert_eq!(count(Code::NodeGap), 1);
        assert_eq!(count(Code::NotConnected), 1);
        let marked = MarkedSeverities::default();
        let gap = findings.near(Point::new(10.0, 2.0), 0.1, marked).unwrap();
        assert!(gap.place.element.contains("lane 1"), "{}", gap.place);
        assert!(findings.near(Point::new(5.0, 9.0), 1.0, marked).is_none());
        let severities = findings.marks.iter().map(|mark| mark.severity);
        assert!(severities.is_sorted_by(|a, b| a >= b));
    }
}
