//! Pictures with known full pixels equal fresh ones.

use std::sync::Arc;

use guideway_layout::Layout;
use guideway_scene::{
    Budget, Edit, Frame, Gesture, LineRule, PathState, Prepared, Scene, Style, View,
};
use guideway_spline::{Affine, Point};

use crate::cpu::Cpu;
use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::testing::*;

/// Draws the next frame; returns the number of pixels that are known to be full.
fn draw_again(prepared: &mut CpuPrepared, view: &View, style: &Style) -> (Frame, u32) {
    let (frame, _) = draw_with(prepared, view, style);
    (frame, prepared.known_pixels(view, style))
}

/// Draws views, each a scale and a center: every picture equals a fresh one. Returns the number of
/// known pixels after each.
#[track_caller]
fn draw_views(scene: &Arc<Scene>, style: &Style, places: &[(f64, Point<f64>)]) -> Vec<u32> {
    let mut prepared = CpuPrepared::new(Arc::clone(scene), &Budget::default()).unwrap();
    let known = places.iter().map(|&(px_per_m, center)| {
        let view = view(center, px_per_m);
        let (again, known) = draw_again(&mut prepared, &view, style);
        let (fresh, _) = draw(&Cpu, scene, &view, style, &Budget::default());
        let differ = again.pixels().iter().zip(fresh.pixels());
        let differ = differ.filter(|(a, b)| a != b).count();
        assert_eq!(differ, 0, "{px_per_m} {center:?}: {known} known");
        known
    });
    known.collect()
}

/// Strokes of 3 px fill most of it at 1 px per meter.
fn crowded() -> Layout {
    wandering(6000, 11, 3.0, ORIGIN)
}

/// Strokes of 1.5 px fill most of it.
fn more_crowded() -> Layout {
    wandering(16_000, 11, 3.0, ORIGIN)
}

/// Zooms in frame by frame, and out again, beside the center.
fn zooms(px_per_m: f64, speed: f64) -> Vec<(f64, Point<f64>)> {
    let steps = (0..14).chain((0..10).rev());
    let place = |step: i32| {
        let px_per_m = px_per_m * speed.powi(step);
        (px_per_m, Point::new(2.5, -1.25) * (1.0 / px_per_m))
    };
    steps.map(place).collect()
}

#[test]
fn known_pixels_change_no_bit() {
    let widths = (0..16_000).map(|i| [0.5, 2.0, 4.0][i % 3]).collect();
    let mut of_widths = more_crowded();
    of_widths.paths.set_width_m(widths);
    let world = LineRule::World {
        width_m: 2.0,
        min_px: 1.5,
        max_px: 3.5,
    };
    let world = Style {
        line_rule: world,
        ..Style::default()
    };
    for (layout, style) in [
        (crowded(), wide_px(3.0)),
        (more_crowded(), wide_px(1.5)),
        (more_crowded(), world),
        (of_widths, world),
    ] {
        let scene = scene(layout);
        // Both pass a scale at which lines are flattened again.
        for (px_per_m, speed) in [(0.41, 1.02), (0.93, 1.013)] {
            let known = draw_views(&scene, &style, &zooms(px_per_m, speed));
            let most = known.iter().max().unwrap();
            assert!(*most > 1000, "{known:?}");
        }
    }
}

#[test]
fn full_pixels_are_found_while_the_view_stays() {
    let known = draw_views(&scene(crowded()), &wide_px(3.0), &[(0.5, ORIGIN); 6]);
    assert!(
        known[0] == 0 && known.is_sorted() && known[5] > 5000,
        "{known:?}"
    );
}

#[test]
fn a_view_that_comes_back_finds_its_full_pixels() {
    let there_and_back = zooms(0.55, 1.01);
    let known = draw_views(
        &scene(crowded()),
        &wide_px(3.0),
        &[&there_and_back[..], &there_and_back].concat(),
    );
    let [first, again] = [0, there_and_back.len()].map(|start| known[start]);
    // The first frame knows nothing; the second round begins with all that was found.
    assert!(first == 0 && again > 5000, "{known:?}");
}

#[test]
fn full_pixels_stay_known_while_the_view_zooms_out_or_pans() {
    let scene = scene(crowded());
    let places = [1.0, 1.0, 1.0, 1.0, 1.0, 0.8, 0.7, 0.6].map(|s| (s * 0.9, ORIGIN));
    let known = draw_views(&scene, &wide_px(3.0), &places);
    assert!(known.iter().skip(2).all(|&known| known > 2000), "{known:?}");
    // By parts of a pixel, so that no picture is reused.
    let aside = [0.0, 0.0, 0.0, 0.0, 0.0, 3.3, 7.7, -20.1].map(|x| (0.9, Point::new(x, x / 2.0)));
    let known = draw_views(&scene, &wide_px(3.0), &aside);
    assert!(known.iter().skip(2).all(|&known| known > 2000), "{known:?}");
}

#[test]
fn probes_stop_where_they_do_not_pay() {
    let still = |scene: &Arc<Scene>, style: &Style, px_per_m: f64, speed: f64| {
        let places: Vec<_> = (0..8).map(|i| (px_per_m * speed.powi(i), ORIGIN)).collect();
        draw_views(scene, style, &places)
    };
    let none = |known: Vec<u32>| assert!(known.iter().all(|&known| known == 0), "{known:?}");
    // Too fast a zoom, too thin strokes, several colors, too few paths.
    none(still(&scene(crowded()), &wide_px(3.0), 0.3, 1.06));
    none(still(&scene(crowded()), &wide_px(0.6), 0.5, 1.0));
    none(still(&colored(crowded(), |_| 255), &wide_px(3.0), 0.5, 1.0));
    none(still(
        &scene(wandering(20, 11, 3.0, ORIGIN)),
        &wide_px(1.5),
        0.5,
        1.0,
    ));
}

#[test]
fn an_edit_shows_where_pixels_were_known() {
    let scene = scene(crowded());
    let (view, style) = (view(ORIGIN, 0.5), wide_px(3.0));
    let mut prepared = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
    let mut anew = CpuPrepared::new(scene, &Budget::default()).unwrap();
    let mut known = 0;
    for _ in 0..6 {
        known = draw_again(&mut prepared, &view, &style).1;
    }
    assert!(known > 5000);
    let hidden: Vec<_> = (0..5500).map(|path| (path, PathState::Hidden)).collect();
    let edit = Edit::SetStates(hidden.into());
    let zoomed = self::view(ORIGIN, 0.501);
    let [again, fresh] = [&mut prepared, &mut anew].map(|prepared| {
        prepared.edit(&edit).unwrap();
        draw_again(prepared, &zoomed, &style).0
    });
    assert!(again == fresh);
}

#[test]
fn full_pixels_stay_known_while_all_paths_are_dragged() {
    let scene = scene(crowded());
    let (view, style) = (view(ORIGIN, 0.5), wide_px(3.0));
    let paths: Arc<[u32]> = (0..scene.row_count() as u32).collect();
    let drag = |step: f64| Affine::translation(Point::new(1.3, -0.4) * step);
    let turn = |step: f64| Affine::rotation(0.01 * step, ORIGIN);
    for (by, most_known) in [(&drag as &dyn Fn(f64) -> Affine, u32::MAX), (&turn, 0)] {
        let prepare = || CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
        let mut dragged = prepare();
        let mut known = 0;
        for step in 1..9 {
            let mut fresh = prepare();
            let gesture = Gesture {
                paths: Arc::clone(&paths),
                by: by(f64::from(step)),
            };
            for prepared in [&mut dragged, &mut fresh] {
                prepared.show_gesture(Some(&gesture)).unwrap();
            }
            let (frame, now_known) = draw_again(&mut dragged, &view, &style);
            assert!(frame == draw_again(&mut fresh, &view, &style).0);
            known = now_known;
        }
        assert!(
            known >= most_known.min(5000) && known <= most_known,
            "{known}"
        );
    }
}

#[test]
fn a_tight_budget_draws_the_same_without_known_pixels() {
    let scene = scene(crowded());
    let view = view(ORIGIN, 0.5);
    let mut budget = Budget {
        threads: 1,
        ..Budget::default()
    };
    let (fresh, report) = draw(&Cpu, &scene, &view, &wide_px(3.0), &budget);
    budget.memory_bytes = report.peak_bytes;
    let mut prepared = CpuPrepared::new(Arc::clone(&scene), &budget).unwrap();
    for _ in 0..4 {
        let (again, known) = draw_again(&mut prepared, &view, &wide_px(3.0));
        assert!(again == fresh && known == 0);
    }
}
