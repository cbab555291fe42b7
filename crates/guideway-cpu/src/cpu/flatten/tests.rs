//! Pictures of curves that share end points.

use std::sync::Arc;

use guideway_layout::{Layout, NewPath};
use guideway_scene::{Budget, Edit, Frame, Prepared, Scene, Style, View};
use guideway_spline::{Affine, Point, Runs};

use crate::Oracle;
use crate::cpu::Cpu;
use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::testing::*;

/// Roads across a square of 200 m, each cut into pieces, in random order.
fn roads() -> Layout {
    let mut pieces = Vec::new();
    for road in 0..12 {
        let aside = f64::from(road) * 15.0 - 80.0;
        for piece in 0..40 {
            let from = f64::from(piece) * 5.0 - 100.0;
            let along = (-1..=9).map(|i| from + f64::from(i) * 5.0 / 8.0);
            // Half of them wind and cross the others.
            let point = |x: f64| match road % 2 {
                0 => Point::new(x, aside),
                _ => Point::new(aside + 4.0 * (x / 9.0).sin(), x),
            };
            pieces.push(along.map(point).collect::<Vec<_>>());
        }
    }
    let mut next = numbers(3);
    for i in 0..pieces.len() {
        let other = (next().abs() * pieces.len() as f64) as usize;
        pieces.swap(i, other);
    }
    let mut layout = Layout::default();
    for control in pieces {
        let mut runs = Runs::default();
        runs.push(&control);
        layout.paths.push(&NewPath {
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout
}

/// Compares with the oracle. Long borders err alike: more pixels differ a little than in other
/// scenes.
#[track_caller]
fn check_near(ours: &Frame, scene: &Arc<Scene>, view: &View, style: &Style) {
    let (exact, _) = draw(&Oracle, scene, view, style, &Budget::default());
    let (errors, mean) = errors(ours, &exact);
    let most = errors.iter().max().unwrap();
    assert!(mean <= 0.4 && *most <= 32, "mean {mean}, most {most}");
}

fn lines(scene: &Arc<Scene>, style: &Style) -> u64 {
    let (_, report) = draw(&Cpu, scene, &view(ORIGIN, 0.7), style, &Budget::default());
    assert_eq!(report.drawn, scene.row_count() as u64);
    report.lines
}

#[test]
fn chained_roads_have_fewer_lines_and_match_the_oracle() {
    let roads_of_one_color = scene(roads());
    for (px_per_m, width_px) in [(0.7, 3.0), (0.7, 0.4), (4.3, 2.0), (60.0, 9.0)] {
        let (view, style) = (view(ORIGIN, px_per_m), wide_px(width_px));
        let (ours, _) = draw(&Cpu, &roads_of_one_color, &view, &style, &Budget::default());
        check_near(&ours, &roads_of_one_color, &view, &style);
    }
    let joined = lines(&roads_of_one_color, &wide_px(3.0));
    // Curves of several colors or widths are not chained.
    let colored = lines(&colored(roads(), |_| 255), &wide_px(3.0));
    let mut of_widths = roads();
    let count = of_widths.paths.len();
    (of_widths.paths).set_width_m((0..count).map(|i| [0.5, 2.0][i % 2]).collect());
    let of_widths = lines(&scene(of_widths), &wide_px(3.0));
    assert!(
        3 * joined < 2 * colored.min(of_widths),
        "{joined} {colored} {of_widths}"
    );
}

#[test]
fn an_edit_splits_and_chains_roads() {
    let before = scene(roads());
    let (view, style) = (view(ORIGIN, 0.7), wide_px(3.0));
    let mut now = Scene::clone(&before);
    let mut prepared = CpuPrepared::new(before, &Budget::default()).unwrap();
    let (_, at_first) = draw_with(&mut prepared, &view, &style);
    let some: Arc<[u32]> = (0..now.row_count() as u32)
        .filter(|path| path % 5 == 0)
        .collect();
    for (by, parts) in [(Point::new(0.0, 2.0), true), (Point::new(0.0, -2.0), false)] {
        let paths = Arc::clone(&some);
        let edit = Edit::Transform {
            paths,
            by: Affine::translation(by),
        };
        now.edit(&edit).unwrap();
        prepared.edit(&edit).unwrap();
        let (frame, report) = draw_with(&mut prepared, &view, &style);
        check_near(&frame, &Arc::new(now.clone()), &view, &style);
        assert_eq!(
            report.lines > at_first.lines + 50,
            parts,
            "{report:?} {at_first:?}"
        );
    }
}
