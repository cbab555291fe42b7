//! Names in a view: clear of lines, and in their order of priority.

use guideway_document::decorations::{Label, LabelSize, MarkOptions, MarkedKinds, marks};
use guideway_layout::{Layout, NewPath};
use guideway_scene::LineRule;
use guideway_spline::{Point, Runs};

use crate::site::{document_of, p, view};

const SIZE: LabelSize = LabelSize {
    char_px: 7.0,
    line_px: 14.0,
};
/// Pixels per meter: a centimeter is a pixel.
const PX_PER_M: f64 = 100.0;
/// Half the length of lines that leave the view, in meters.
const FAR_M: f64 = 20.0;

/// A straight path; without nodes it has no symbols.
fn push_line(layout: &mut Layout, id: &str, ends: [Point<f64>; 2]) {
    let mut runs = Runs::default();
    runs.push_line(ends[0], ends[1]);
    layout.paths.push(&NewPath {
        id,
        runs: &runs,
        ..NewPath::default()
    });
}

/// Level lines without names, 5 pixels apart, without those of a stripe, in pixels above the middle
/// of the view.
fn hatched(stripe: std::ops::Range<f64>) -> Layout {
    let mut layout = Layout::default();
    for line in -60..=60 {
        let up_px = 5.0 * f64::from(line);
        if !stripe.contains(&up_px) {
            let y = up_px / PX_PER_M;
            push_line(&mut layout, "", [p(-FAR_M, y), p(FAR_M, y)]);
        }
    }
    layout
}

fn labels(layout: &Layout) -> Vec<Label> {
    let options = MarkOptions {
        px_per_point: 1.0,
        line_rule: LineRule::default(),
        arrows: false,
        symbols: true,
        labels: Some(SIZE),
        of: MarkedKinds::default(),
    };
    let view = view(p(0.0, 0.0), PX_PER_M);
    marks(&document_of(layout.clone()), &view, &options).labels
}

fn names(layout: &Layout) -> Vec<String> {
    labels(layout).into_iter().map(|label| label.text).collect()
}

/// Adds a station, a node and a path with names, these pixels right of the middle of the view.
fn add(layout: &mut Layout, [station, node, path]: [Option<f64>; 3]) {
    let at = |right_px: f64| p(right_px / PX_PER_M, 0.0);
    if let Some(right_px) = station {
        let place = Some(at(right_px));
        layout.stations.push("station", place, Vec::new(), None);
    }
    if let Some(right_px) = node {
        layout.nodes.push("node", at(right_px), None);
    }
    if let Some(right_px) = path {
        let side = p(FAR_M, 0.0);
        push_line(layout, "way", [at(right_px) - side, at(right_px) + side]);
    }
}

#[test]
fn no_name_is_struck_through_by_the_lines_around_it() {
    for only in 0..3 {
        let mut layout = hatched(0.0..0.0);
        let mut places = [None; 3];
        places[only] = Some(0.0);
        add(&mut layout, places);
        assert_eq!(names(&layout), [""; 0], "{places:?}");
        // The same name shows where there are no lines.
        let mut free = Layout::default();
        add(&mut free, places);
        assert_eq!(names(&free).len(), 1, "{places:?}");
    }
}

/// Length of the part of a segment within a label, in pixels.
fn length_within(label: &Label, [from, to]: [Point<f64>; 2]) -> f64 {
    const STEPS: u32 = 4_000;
    let boxes = SIZE.label_boxes(label);
    let at = |step: u32| from + (to - from) * (f64::from(step) / f64::from(STEPS));
    let is_within = |step: &u32| boxes.iter().any(|of| of.contains(at(*step)));
    let within = (0..STEPS).filter(is_within).count() as f64;
    from.distance(to) * within / f64::from(STEPS)
}

#[test]
fn names_at_a_crossing_lie_between_its_paths() {
    let view = view(p(0.0, 0.0), PX_PER_M);
    for kind in 0..2 {
        for turn_deg in [0.0f64, 20.0, 45.0, 70.0] {
            let mut layout = Layout::default();
            let mut places = [None; 3];
            places[kind] = Some(0.0);
            add(&mut layout, places);
            let arms = (0..4).map(|quarter| {
                let angle = (turn_deg + 90.0 * f64::from(quarter)).to_radians();
                [p(0.0, 0.0), p(3.0 * angle.cos(), 3.0 * angle.sin())]
            });
            let arms: Vec<_> = arms.collect();
            for ends in &arms {
                push_line(&mut layout, "", *ends);
            }
            let labels = labels(&layout);
            assert_eq!(labels.len(), 1, "{kind} {turn_deg}");
            for ends in &arms {
                let crossed_px =
                    length_within(&labels[0], ends.map(|at| view.pixel_from_world(at)));
                // Not even the height of a letter.
                assert!(
                    crossed_px < 8.0,
                    "{kind} {turn_deg}: {crossed_px} px of {labels:?}"
                );
            }
        }
    }
}

#[test]
fn station_wins_the_only_free_place_then_the_node_then_the_path() {
    for (places, expected) in [
        ([Some(0.0), Some(20.0), Some(0.0)], "station"),
        ([Some(0.0), None, Some(0.0)], "station"),
        ([Some(0.0), Some(20.0), None], "station"),
        ([None, Some(0.0), Some(0.0)], "node"),
        ([None, None, Some(0.0)], "way"),
    ] {
        // One name is as high as the stripe.
        let mut layout = hatched(3.0..28.0);
        add(&mut layout, places);
        assert_eq!(names(&layout), [expected], "{places:?}");
    }
}
