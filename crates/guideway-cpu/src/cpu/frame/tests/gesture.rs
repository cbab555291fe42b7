//! Gestures show what their edits would leave, and end without a trace.

use std::sync::Arc;

use guideway_scene::{Budget, Frame, Gesture, Prepared, RenderError, Scene, Style, View};
use guideway_spline::{Affine, Point};

use crate::Oracle;
use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::testing::*;

fn maps() -> [Affine; 6] {
    let center = Point::new(20.0, -10.0);
    [
        Affine::IDENTITY,
        Affine::translation(Point::new(4.0, -30.0)),
        Affine::translation(Point::new(-60.0, 7.0)),
        Affine::rotation(0.8, center),
        Affine::scale(2.0, 0.5, center),
        Affine::mirror(center, Point::new(1.0, 3.0)),
    ]
}

/// All paths, every seventh, and those of one half.
fn selections(scene: &Scene) -> [Arc<[u32]>; 3] {
    let rows = 0..scene.row_count() as u32;
    let is_left = |row: &u32| {
        let hull = scene.hulls().of([*row as usize]);
        hull.is_some_and(|hull| hull.center().x < 0.0)
    };
    [
        rows.clone().collect(),
        rows.clone().step_by(7).collect(),
        rows.filter(is_left).collect(),
    ]
}

fn gesture(paths: &Arc<[u32]>, by: Affine) -> Gesture {
    Gesture {
        paths: Arc::clone(paths),
        by,
    }
}

/// Asserts that a picture is as near to the oracle's as that of a fresh preparation.
fn check_as_fresh(frame: &Frame, scene: &Arc<Scene>, view: &View) {
    let (style, budget) = (Style::default(), Budget::default());
    let (exact, _) = draw(&Oracle, scene, view, &style, &budget);
    let mut fresh = CpuPrepared::new(Arc::clone(scene), &budget).unwrap();
    let fresh = draw_with(&mut fresh, view, &style).0;
    let [ours, of_fresh] = [frame, &fresh].map(|picture| errors(picture, &exact));
    assert!(ours.1 <= of_fresh.1 + 0.05, "{} {}", ours.1, of_fresh.1);
    assert!(ours.0.iter().all(|&error| error <= 64));
}

#[test]
fn a_gesture_shows_what_its_edit_leaves() {
    let solid = scene(wandering(350, 11, 3.0, ORIGIN));
    let mixed = colored(wandering(350, 11, 3.0, ORIGIN), |i| [255, 120][i % 2]);
    // Clusters too large for cached lines, and a view that cuts them.
    let large = scene(wandering(100, 60, 60.0, ORIGIN));
    let style = Style::default();
    for (scene, px_per_m) in [(solid, 0.8), (mixed, 0.8), (large, 25.0)] {
        for paths in selections(&scene) {
            let mut shown = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
            let views = [
                view(ORIGIN, px_per_m),
                view(Point::new(30.0, 5.0), px_per_m * 3.0),
            ];
            let draw_all =
                |shown: &mut CpuPrepared| views.map(|view| draw_with(shown, &view, &style).0);
            let before = draw_all(&mut shown);
            for (by, turn) in maps().into_iter().zip(0..) {
                let gesture = gesture(&paths, by);
                shown.show_gesture(Some(&gesture)).unwrap();
                let mut edited = Scene::clone(&scene);
                edited.edit(&gesture.edit()).unwrap();
                let edited = Arc::new(edited);
                let drawn = draw_all(&mut shown);
                // The oracle is slow: each map in one view, both views in turn.
                let checked = turn % views.len();
                check_as_fresh(&drawn[checked], &edited, &views[checked]);
                // The view of a change draws only a part of the picture.
                draw_with(&mut shown, &views[0], &style);
                draw_with(&mut shown, &views[0], &style);
                shown.forget_picture();
                assert!(drawn == draw_all(&mut shown), "{by:?}");
            }
            shown.show_gesture(None).unwrap();
            assert!(before == draw_all(&mut shown));
        }
    }
}

#[test]
fn moved_whole_clusters_keep_their_lines() {
    let scene = scene(wandering(640, 11, 3.0, ORIGIN));
    let mut shown = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
    let (view, style) = (view(ORIGIN, 0.8), Style::default());
    draw_with(&mut shown, &view, &style);
    let [all, some, _] = selections(&scene);
    let mut flattened = |paths, by| {
        shown.show_gesture(Some(&gesture(paths, by))).unwrap();
        draw_with(&mut shown, &view, &style);
        shown.flattened_clusters()
    };
    let [_, small, large, turn, ..] = maps();
    assert_eq!(flattened(&all, small), 0);
    assert_eq!(flattened(&all, large), 0);
    assert_eq!(flattened(&all, turn), 10);
    // Once without the others and once by themselves; then the latter move.
    assert_eq!(flattened(&some, small), 12);
    assert_eq!(flattened(&some, large), 0);
    assert_eq!(flattened(&some, turn), 2);
}

#[test]
fn all_paths_dragged_by_whole_pixels_scroll_the_picture() {
    let scene = scene(wandering(640, 11, 3.0, ORIGIN));
    let mut shown = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
    let (view, style) = (view(ORIGIN, 0.5), Style::default());
    for _ in 0..2 {
        draw_with(&mut shown, &view, &style);
    }
    let [all, some, _] = selections(&scene);
    let mut reuses = |paths, x: f64| {
        let by = Affine::translation(Point::new(x, -2.0 * x));
        shown.show_gesture(Some(&gesture(paths, by))).unwrap();
        draw_with(&mut shown, &view, &style);
        shown.has_reused()
    };
    assert!(reuses(&all, 8.0) && reuses(&all, -2.0));
    assert!(!reuses(&all, 0.7));
    assert!(!reuses(&some, 8.0));
}

#[test]
fn resting_paths_are_drawn_once_per_view_to_the_same_bits() {
    let scene = scene(wandering(6000, 11, 3.0, ORIGIN));
    let prepare = || CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
    let mut dragged = prepare();
    let here = (view(ORIGIN, 0.5), wide_px(3.0));
    let wider = (here.0, wide_px(4.0));
    let aside = (view(Point::new(40.0, 7.3), 0.5), here.1);
    let [all, some, left] = selections(&scene);
    let mut known = Vec::new();
    for (step, (paths, by, (view, style))) in [
        (&some, maps()[1], here),
        (&some, maps()[2], here),
        (&some, maps()[3], here),
        (&some, maps()[4], wider),
        (&some, maps()[1], aside),
        (&left, maps()[1], aside),
        (&left, maps()[5], aside),
        (&all, maps()[1], aside),
    ]
    .into_iter()
    .enumerate()
    {
        let gesture = gesture(paths, by);
        let mut fresh = prepare();
        for prepared in [&mut dragged, &mut fresh] {
            prepared.show_gesture(Some(&gesture)).unwrap();
        }
        let [again, expected] =
            [&mut dragged, &mut fresh].map(|prepared| draw_with(prepared, &view, &style).0);
        assert!(again == expected, "step {step}");
        known.push(dragged.known_resting_tiles());
    }
    // All paths leave none at rest.
    assert!(
        known[..7].iter().all(|known| *known > 0) && known[7] == 0,
        "{known:?}"
    );
    dragged.show_gesture(None).unwrap();
    let (view, style) = here;
    let [again, expected] = [&mut dragged, &mut prepare()].map(|p| draw_with(p, &view, &style).0);
    assert!(again == expected);
}

#[test]
fn an_edit_ends_the_gesture() {
    let scene = scene(wandering(300, 11, 3.0, ORIGIN));
    let (view, style) = (view(ORIGIN, 0.8), Style::default());
    for paths in selections(&scene) {
        let new = || CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
        let (mut dragged, mut edited) = (new(), new());
        for by in maps() {
            dragged.show_gesture(Some(&gesture(&paths, by))).unwrap();
            draw_with(&mut dragged, &view, &style);
        }
        let edit = gesture(&paths, maps()[1]).edit();
        for prepared in [&mut dragged, &mut edited] {
            prepared.edit(&edit).unwrap();
        }
        let [a, b] = [&mut dragged, &mut edited].map(|p| draw_with(p, &view, &style).0);
        assert!(a == b);
    }
}

#[test]
fn rejects_unknown_double_and_far_paths_and_shows_the_scene() {
    let scene = scene(wandering(300, 11, 3.0, ORIGIN));
    let (view, style) = (view(ORIGIN, 0.8), Style::default());
    let mut shown = CpuPrepared::new(Arc::clone(&scene), &Budget::default()).unwrap();
    let before = draw_with(&mut shown, &view, &style).0;
    let some: Arc<[u32]> = (0..9).collect();
    for (paths, by) in [
        ([300].into(), maps()[1]),
        ([7, 7].into(), maps()[1]),
        (Arc::clone(&some), Affine::translation(Point::new(2e9, 0.0))),
        (Arc::clone(&some), Affine::scale(f64::NAN, 1.0, ORIGIN)),
    ] {
        shown
            .show_gesture(Some(&gesture(&some, maps()[1])))
            .unwrap();
        let rejected = shown.show_gesture(Some(&gesture(&paths, by)));
        assert!(
            matches!(rejected, Err(RenderError::Edit(_))),
            "{rejected:?}"
        );
        assert!(draw_with(&mut shown, &view, &style).0 == before);
    }
    // Memory for the scene, and for no copy of its paths.
    let enough = Budget::default().memory_bytes;
    let least = (0..enough).step_by(1 << 12).find(|&memory_bytes| {
        let budget = Budget {
            memory_bytes,
            ..Budget::default()
        };
        CpuPrepared::new(Arc::clone(&scene), &budget).is_ok()
    });
    let budget = Budget {
        memory_bytes: least.unwrap(),
        ..Budget::default()
    };
    let mut tight = CpuPrepared::new(Arc::clone(&scene), &budget).unwrap();
    let all = selections(&scene)[0].clone();
    let rejected = tight.show_gesture(Some(&gesture(&all, maps()[1])));
    assert!(
        matches!(rejected, Err(RenderError::Budget { .. })),
        "{rejected:?}"
    );
}
