//! Pictures of edited scenes, and which clusters an edit makes the next frame flatten.

use std::sync::Arc;

use guideway_layout::{Geometry, Layout, OwnStyle, Paths, TextColumn};
use guideway_scene::{
    Budget, Edit, EditOutcome, Frame, Insertion, Method, PathState, Prepared, Scene, Style, View,
};
use guideway_spline::{Affine, Point, Runs};

use crate::cpu::Cpu;
use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::testing::*;

#[test]
fn an_edited_scene_matches_the_oracle() {
    let before = colored(wandering(500, 11, 3.0, ORIGIN), |i| [255, 120][i % 2]);
    let moved: Arc<[u32]> = (0..500).step_by(7).collect();
    let hidden: Arc<[_]> = (0..500)
        .step_by(11)
        .map(|i| (i, PathState::Hidden))
        .collect();
    let mut runs = Runs::default();
    runs.push_line(Point::new(-80.0, -3.0), Point::new(70.0, 5.0));
    let own = OwnStyle {
        width_m: Some(9.0),
        color_rgba: Some(0xff00_40ff),
    };
    let inserted = Insertion {
        runs,
        ..Insertion::default()
    };
    let mapped = |paths: &Arc<[u32]>, by| Edit::Transform {
        paths: Arc::clone(paths),
        by,
    };
    let all: Arc<[u32]> = (0..500).collect();
    let edits = [
        mapped(&moved, Affine::translation(Point::new(4.0, -30.0))),
        mapped(&all, Affine::translation(Point::new(-9.0, 7.0))),
        mapped(&all, Affine::rotation(0.05, ORIGIN)),
        mapped(&all, Affine::rotation(1.5, Point::new(20.0, 3.0))),
        Edit::SetStates(hidden),
        Edit::Insert(Arc::new([inserted])),
        Edit::Restyle(Arc::new([(3, own), (4, own)])),
    ];
    let mut prepared = Cpu
        .prepare(Arc::clone(&before), &Budget::default())
        .unwrap();
    let mut scene = Scene::clone(&before);
    let (view, style) = (view(ORIGIN, 0.8), Style::default());
    draw_with(&mut *prepared, &view, &style);
    for edit in edits {
        scene.edit(&edit).unwrap();
        assert_eq!(
            prepared.edit(&edit),
            Ok(EditOutcome::InPlace { moved_bytes: 0 })
        );
        let (frame, _) = draw_with(&mut *prepared, &view, &style);
        check_frame(&frame, &Arc::new(scene.clone()), &view, &style);
    }
}

/// The same curves in `f32`.
fn narrow(layout: &Layout) -> Layout {
    let (mut ids, mut points, mut ends) = (TextColumn::default(), Vec::new(), Vec::new());
    for path in layout.paths.iter() {
        points.extend(path.runs().flat_map(|run| run.iter().map(Point::to_f32)));
        ids.push(path.id());
        ends.push(points.len() as u32);
    }
    Layout {
        paths: Paths::from_columns(ids, Geometry::from_f32(points, ends)),
        ..Layout::default()
    }
}

fn all_paths(scene: &Scene) -> Arc<[u32]> {
    (0..scene.row_count() as u32).collect()
}

/// Draws after an edit; returns the frame and the number of clusters that were flattened.
fn draw_edited(
    prepared: &mut CpuPrepared,
    edit: &Edit,
    (view, style): (&View, &Style),
) -> (Frame, usize) {
    prepared.edit(edit).unwrap();
    let (frame, _) = draw_with(prepared, view, style);
    (frame, prepared.flattened_clusters())
}

/// Mean and largest difference from a picture whose lines are all flattened anew, and so rounded
/// differently.
fn off_fresh(frame: &Frame, scene: &Scene, (view, style): (&View, &Style)) -> (f64, u8) {
    let scene = Arc::new(scene.clone());
    let (fresh, _) = draw(&Cpu, &scene, view, style, &Budget::default());
    let (errors, mean) = errors(frame, &fresh);
    (mean, errors.into_iter().max().unwrap())
}

fn is_near((mean, most): (f64, u8)) -> bool {
    mean <= 0.4 && most <= 32
}

#[test]
fn lines_are_kept_only_if_all_paths_of_their_cluster_are_moved() {
    let (view, style) = (view(ORIGIN, 0.8), wide_px(2.5));
    for before in [
        scene(wandering(260, 11, 3.0, ORIGIN)),
        scene(narrow(&wandering(260, 11, 3.0, ORIGIN))),
        colored(wandering(260, 11, 3.0, ORIGIN), |i| [255, 120][i % 2]),
    ] {
        let mut now = Scene::clone(&before);
        let mut prepared = CpuPrepared::new(before, &Budget::default()).unwrap();
        let (mut last, _) = draw_with(&mut prepared, &view, &style);
        let all = all_paths(&now);
        let clusters = prepared.flattened_clusters();
        for (paths, by, made) in [
            (Arc::clone(&all), Point::new(0.3, -0.7), 0),
            (Arc::clone(&all), Point::new(-41.7, 23.1), 0),
            (all[1..].into(), Point::new(3.3, 0.1), 1),
            (all, Point::new(20.2, -11.3), 0),
        ] {
            let by = Affine::translation(by);
            let edit = Edit::Transform { paths, by };
            now.edit(&edit).unwrap();
            let (frame, made_now) = draw_edited(&mut prepared, &edit, (&view, &style));
            let off = off_fresh(&frame, &now, (&view, &style));
            assert!(is_near(off), "{by:?}: {off:?}");
            // The last picture would fail the comparison.
            assert!(!is_near(off_fresh(&last, &now, (&view, &style))));
            assert_eq!(made_now, made, "of {clusters}: {by:?}");
            last = frame;
        }
    }
}

#[test]
fn lines_are_flattened_again_before_drift_shows() {
    let center = Point::new(10_000.0, -5000.0);
    let before = scene(narrow(&wandering(260, 11, 3.0, center)));
    let (view, style) = (view(center, 0.8), wide_px(2.5));
    let mut now = Scene::clone(&before);
    let mut prepared = CpuPrepared::new(before, &Budget::default()).unwrap();
    draw_with(&mut prepared, &view, &style);
    let clusters = prepared.flattened_clusters();
    let mut frames_that_made = 0;
    for step in 0..40 {
        let by_m = Point::new(0.123_456, -0.076_543) * if step < 20 { 1.0 } else { -1.0 };
        let by = Affine::translation(by_m);
        let edit = Edit::Transform {
            paths: all_paths(&now),
            by,
        };
        now.edit(&edit).unwrap();
        let (frame, made) = draw_edited(&mut prepared, &edit, (&view, &style));
        frames_that_made += usize::from(made == clusters);
        assert!(made == 0 || made == clusters);
        if step % 13 == 12 {
            let off = off_fresh(&frame, &now, (&view, &style));
            assert!(is_near(off), "{step}: {off:?}");
        }
    }
    assert!((2..20).contains(&frames_that_made), "{frames_that_made}");
}

#[test]
fn an_undone_edit_restores_every_bit() {
    let before = scene(narrow(&wandering(260, 11, 3.0, ORIGIN)));
    let (view, style) = (view(ORIGIN, 0.8), wide_px(2.5));
    let all = all_paths(&before);
    let curves = Arc::new(before.layout().paths.geometry().clone());
    let mut prepared = CpuPrepared::new(before, &Budget::default()).unwrap();
    let (at_first, _) = draw_with(&mut prepared, &view, &style);
    let there = Edit::Transform {
        paths: Arc::clone(&all),
        by: Affine::translation(Point::new(0.123, 1.456)),
    };
    let back = Edit::Reshape {
        paths: all,
        curves,
        written: Arc::default(),
    };
    let (moved, _) = draw_edited(&mut prepared, &there, (&view, &style));
    assert!(moved != at_first);
    let (again, _) = draw_edited(&mut prepared, &back, (&view, &style));
    assert!(again == at_first);
}
