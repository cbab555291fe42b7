//! Gestures show what their edits would leave, within rounding, and end without a trace.

use guideway_scene::{Edit, Gesture};
use guideway_spline::Affine;

use super::exact_points::{dense, difference, exact_clusters, scene};
use super::*;

fn near() -> View {
    view([50.0, 30.0], 60.0)
}

/// Turns about the center, mirrors, scales, moves, and back; by small and by large amounts.
fn maps() -> Vec<Affine> {
    let center = Point::new(50.0, 30.0);
    vec![
        Affine::IDENTITY,
        Affine::translation(Point::new(0.35, -0.2)),
        Affine::rotation(0.7, center),
        Affine::translation(Point::new(-31.0, 12.0)),
        Affine::scale(1.9, 0.6, center),
        Affine::mirror(center, Point::new(1.0, 2.0)),
        Affine::scale(0.2, 0.2, center).then(Affine::rotation(-2.0, center)),
    ]
}

/// All paths, some of each cluster, and neighbors: whole clusters and parts of others.
fn selections(scene: &Scene) -> [Arc<[u32]>; 3] {
    let rows = 0..scene.row_count() as u32;
    let geometry = scene.layout().paths.geometry();
    let is_left = |row: &u32| {
        let hull = geometry.hull_bounds([*row as usize]);
        hull.is_some_and(|hull| hull.center().x < 52.0)
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

fn edited(tiles: &Tiles, scene: &Arc<Scene>, edit: &Edit) -> PreparedTiles {
    let mut edited = Scene::clone(scene);
    edited.edit(edit).unwrap();
    prepared(tiles, &Arc::new(edited))
}

#[test]
fn gesture_shows_what_its_edit_leaves() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    let scenes = [plain(700, 3.0), mixed(700, 3.0), scene(dense(700, 1.0))];
    for (scene, shift) in scenes.into_iter().zip(0..) {
        for (paths, shift) in selections(&scene).into_iter().zip(shift..) {
            let (mut cached, mut uncached) = (prepared(&tiles, &scene), prepared(&tiles, &scene));
            uncached.target.reuses_frames = false;
            let views = [all(), near()];
            let before = views.map(|view| picture(&mut cached, &view, &style).0);
            // Each map once per scene and once per selection.
            for by in maps().into_iter().skip(shift % 3).step_by(3) {
                let gesture = gesture(&paths, by);
                let mut reference = edited(&tiles, &scene, &gesture.edit());
                for shown in [&mut cached, &mut uncached] {
                    shown.show_gesture(Some(&gesture)).unwrap();
                }
                for view in views {
                    let (drawn, report) = picture(&mut cached, &view, &style);
                    let (again, _) = picture(&mut uncached, &view, &style);
                    assert!(drawn == again, "caches change the picture by {by:?}");
                    let (expected, of_expected) = picture(&mut reference, &view, &style);
                    let (mean, worst) = difference(&drawn, &expected);
                    assert!(mean < 0.15 && worst <= 40, "{mean} {worst} by {by:?}");
                    // Whole clusters count as drawn.
                    let is_wrong = report.drawn.abs_diff(of_expected.drawn) > 200;
                    assert!(!is_wrong, "{} {}", report.drawn, of_expected.drawn);
                }
            }
            for shown in [&mut cached, &mut uncached] {
                shown.show_gesture(None).unwrap();
                let after = views.map(|view| picture(shown, &view, &style).0);
                assert!(after == before);
            }
        }
    }
}

#[test]
fn edit_after_a_gesture_leaves_what_it_leaves_without_one() {
    let Some(tiles) = tiles() else { return };
    let style = Style::default();
    let scene = scene(dense(3000, 1.0));
    for paths in selections(&scene) {
        let (mut dragged, mut edited) = (prepared(&tiles, &scene), prepared(&tiles, &scene));
        for by in maps() {
            let gesture = gesture(&paths, by);
            dragged.show_gesture(Some(&gesture)).unwrap();
            picture(&mut dragged, &near(), &style);
        }
        let edit = gesture(&paths, maps()[1]).edit();
        for prepared in [&mut dragged, &mut edited] {
            prepared.edit(&edit).unwrap();
        }
        for view in [all(), near(), all()] {
            let (drawn, _) = picture(&mut dragged, &view, &style);
            assert!(drawn == picture(&mut edited, &view, &style).0);
        }
    }
}

#[test]
fn frames_of_a_gesture_upload_only_its_clusters() {
    let Some(tiles) = tiles() else { return };
    let scene = plain(6400, 1.0);
    let mut shown = prepared(&tiles, &scene);
    let bytes = |outcome| match outcome {
        EditOutcome::InPlace { moved_bytes } => moved_bytes,
        EditOutcome::NotInPlace => panic!("not in place"),
    };
    for (step, clusters) in [(100, 1), (10, 10), (1, 100)] {
        let paths: Arc<[u32]> = (0..6400).step_by(step).collect();
        let first = gesture(&paths, Affine::IDENTITY);
        shown.show_gesture(Some(&first)).unwrap();
        for by in maps() {
            let gesture = gesture(&paths, by);
            let moved = bytes(shown.show_gesture(Some(&gesture)).unwrap());
            assert_eq!(moved, clusters * size_of::<layouts::Cluster>() as u64);
        }
    }
}

#[test]
fn next_gesture_keeps_the_cached_lines_of_others() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (plain(6400, 2.0), Style::default());
    let (mut cached, mut uncached) = (prepared(&tiles, &scene), prepared(&tiles, &scene));
    uncached.target.reuses_frames = false;
    let mut sent = Vec::new();
    for (first, by) in maps().into_iter().enumerate().skip(1) {
        let paths: Arc<[u32]> = (first as u32..6400).step_by(400).collect();
        let gesture = gesture(&paths, by);
        for gesture in [Some(&gesture), None] {
            let outcome = cached.show_gesture(gesture).unwrap();
            sent.extend(gesture.map(|_| outcome));
            uncached.show_gesture(gesture).unwrap();
            let (drawn, _) = picture(&mut cached, &all(), &style);
            assert!(drawn == picture(&mut uncached, &all(), &style).0, "{by:?}");
        }
    }
    // Lists grow on the device: only what is new is sent.
    let most = sent.iter().map(|outcome| match outcome {
        EditOutcome::InPlace { moved_bytes } => *moved_bytes,
        EditOutcome::NotInPlace => u64::MAX,
    });
    assert!(most.max().unwrap() < 4000, "{sent:?}");
}

#[test]
fn gesture_without_memory_shows_the_scene() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (scene(dense(3000, 1.0)), Style::default());
    let mut free = prepared(&tiles, &scene);
    let (expected, report) = picture(&mut free, &all(), &style);
    let gesture = gesture(&(0..3000).step_by(3).collect(), maps()[2]);
    free.show_gesture(Some(&gesture)).unwrap();
    let (of_gesture, _) = picture(&mut free, &all(), &style);
    let mut outcomes = [0; 2];
    // The last one has room for the buffers that send changes, too.
    let less_bytes = (2..=10).map(|part| report.peak_bytes * part / 10);
    for memory_bytes in less_bytes.chain([report.peak_bytes + (16 << 20)]) {
        let budget = Budget {
            memory_bytes,
            ..Budget::default()
        };
        let tight = PreparedTiles::new(Arc::clone(&tiles.0), Arc::clone(&scene), &budget);
        let Ok(mut tight) = tight else { continue };
        let is_shown = match tight.show_gesture(Some(&gesture)) {
            Ok(_) => true,
            Err(RenderError::Budget { .. }) => false,
            Err(other) => panic!("{other}"),
        };
        outcomes[usize::from(is_shown)] += 1;
        let mut frame = Frame::new(FrameSize::new(1, 1).unwrap());
        match tight.render(&all(), &style, &Cancel::default(), &mut frame) {
            Ok(_) if is_shown => assert!(frame == of_gesture),
            Ok(_) => assert!(frame == expected),
            Err(RenderError::Budget { .. }) => {}
            Err(other) => panic!("{other}"),
        }
    }
    assert!(outcomes.iter().all(|count| *count > 0), "{outcomes:?}");
}

#[test]
fn a_lost_upload_ends_the_gesture() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (plain(3000, 2.0), Style::default());
    let mut shown = prepared(&tiles, &scene);
    let (before, _) = picture(&mut shown, &all(), &style);
    let gesture = gesture(&(0..3000).step_by(5).collect(), maps()[3]);
    shown.show_gesture(Some(&gesture)).unwrap();
    shown.scene.is_incomplete = true;
    assert!(picture(&mut shown, &all(), &style).0 == before);
    shown.show_gesture(Some(&gesture)).unwrap();
    assert!(picture(&mut shown, &all(), &style).0 != before);
    assert!(exact_clusters(&shown).is_empty());
}

#[test]
fn rejects_unknown_double_and_far_paths_and_shows_the_scene() {
    let Some(tiles) = tiles() else { return };
    let (scene, style) = (plain(300, 2.0), Style::default());
    let mut shown = prepared(&tiles, &scene);
    let (before, _) = picture(&mut shown, &all(), &style);
    let (some, small) = ((0..9).collect(), maps()[1]);
    for (paths, by) in [
        ([300].into(), small),
        ([7, 7].into(), small),
        (Arc::clone(&some), Affine::translation(Point::new(2e9, 0.0))),
        (
            Arc::clone(&some),
            Affine::scale(f64::NAN, 1.0, Point::default()),
        ),
    ] {
        shown.show_gesture(Some(&gesture(&some, small))).unwrap();
        let rejected = shown.show_gesture(Some(&gesture(&paths, by)));
        assert!(
            matches!(rejected, Err(RenderError::Edit(_))),
            "{rejected:?}"
        );
        assert!(picture(&mut shown, &all(), &style).0 == before);
    }
}
