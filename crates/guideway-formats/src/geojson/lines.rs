//! Lines: flattens the curve of a path to the lines that GeoJSON holds.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{Point, flatten_run, uniform};

use crate::clamped::{POSITION_STEP_M, is_straight};

/// Flattens a path to lines, one per connected part.
pub(super) fn lines(path: PathRef<'_>, tolerance_m: f64) -> Vec<Vec<Point<f64>>> {
    let mut lines: Vec<Vec<Point<f64>>> = Vec::new();
    for run in path.runs() {
        let mut line = Vec::new();
        if is_of_straight_segments(run) {
            let first = run.segments().take(1).map(|s| uniform::start(&s));
            line.extend(first.chain(run.segments().map(|s| uniform::end(&s))));
        } else {
            let points: Vec<_> = run.iter().collect();
            flatten_run(&points, tolerance_m, &mut |point| line.push(point));
        }
        let end = lines.last().and_then(|line| line.last());
        match end {
            Some(end) if end.distance(line[0]) <= POSITION_STEP_M => {
                let last = lines.len() - 1;
                lines[last].extend_from_slice(&line[1..]);
            }
            _ => lines.push(line),
        }
    }
    lines
}

/// Returns whether a path consists of lines, so that its lines say it all.
pub(super) fn is_of_lines(path: PathRef<'_>) -> bool {
    path.runs().all(is_of_straight_segments)
}

fn is_of_straight_segments(run: RunPoints<'_>) -> bool {
    let mut segments = run.segments();
    segments.all(|segment| is_straight(&uniform::to_bezier(&segment), POSITION_STEP_M))
}
