//! Clusters whose paths are all moved, and their lines with them.

use guideway_layout::{Geometry, Paths, TextColumn};

use super::*;

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

/// Draws after an edit; says for how many clusters lines were made.
fn draw_edited(
    prepared: &mut CpuPrepared,
    edit: &Edit,
    (view, style): (&View, &Style),
) -> (Frame, usize) {
    prepared.edit(edit).unwrap();
    let (frame, _) = draw_with(prepared, view, style);
    (frame, prepared.made_clusters())
}

/// How far a picture is from one whose lines are all made of the curves as they are, and so rounded otherwise: on the
/// mean, and at most.
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
fn lines_move_with_all_paths_of_a_cluster_and_with_no_fewer() {
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
        let clusters = prepared.made_clusters();
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
            // What was left behind would be seen.
            assert!(!is_near(off_fresh(&last, &now, (&view, &style))));
            assert_eq!(made_now, made, "of {clusters}: {by:?}");
            last = frame;
        }
    }
}

#[test]
fn lines_are_made_anew_before_rounding_shows() {
    let center = Point::new(10_000.0, -5000.0);
    let before = scene(narrow(&wandering(260, 11, 3.0, center)));
    let (view, style) = (view(center, 0.8), wide_px(2.5));
    let mut now = Scene::clone(&before);
    let mut prepared = CpuPrepared::new(before, &Budget::default()).unwrap();
    draw_with(&mut prepared, &view, &style);
    let clusters = prepared.made_clusters();
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
fn what_is_undone_looks_as_it_did_to_the_bit() {
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
    let back = Edit::Reshape { paths: all, curves };
    let (moved, _) = draw_edited(&mut prepared, &there, (&view, &style));
    assert!(moved != at_first);
    let (again, _) = draw_edited(&mut prepared, &back, (&view, &style));
    assert!(again == at_first);
}
