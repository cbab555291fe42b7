//! Edits of a scene: their effect, their inverses and their errors.

use std::sync::Arc;

use guideway_layout::{Geometry, Layout, NewPath, OwnStyle};
use guideway_scene::{Edit, EditError, Insertion, PathState, Rgba, Scene, SceneOptions};
use guideway_spline::{Affine, Point, Runs};

fn line(x: f64) -> Runs {
    let mut runs = Runs::default();
    runs.push_line(Point::new(x, 0.0), Point::new(x, 1.0));
    runs
}

fn scene() -> Scene {
    let mut layout = Layout::default();
    for i in 0..4 {
        let (id, runs) = (format!("P{i}"), line(f64::from(i)));
        layout.paths.push(&NewPath {
            id: &id,
            runs: &runs,
            ..NewPath::default()
        });
    }
    Scene::new(Arc::new(layout), &SceneOptions::default()).expect("options that fit any layout")
}

/// The properties of a path that a renderer reads: row, control points, color and width.
type PathProperties = (u32, Vec<Point<f64>>, Rgba, Option<f32>);

fn properties(scene: &Scene) -> Vec<PathProperties> {
    let path = |&path: &u32| {
        let runs = scene.layout().paths.get(path as usize).runs();
        let points = runs.flat_map(|run| run.iter()).collect();
        (path, points, scene.color(path), scene.width_m(path))
    };
    scene.draw_order().iter().map(path).collect()
}

fn edits() -> Vec<Edit> {
    let mut long = line(9.0);
    long.push_line(Point::new(9.0, 1.0), Point::new(12.0, 5.0));
    let mut curves = Geometry::default();
    curves.push(&long);
    curves.push(&line(-3.0));
    let red = OwnStyle {
        width_m: Some(0.5),
        color_rgba: Some(0xff00_00ff),
    };
    vec![
        Edit::Transform {
            paths: [1, 3].into(),
            by: Affine::rotation(1.0, Point::new(2.0, 2.0)),
        },
        Edit::Reshape {
            paths: [2, 0].into(),
            curves: Arc::new(curves),
            written: Arc::default(),
        },
        Edit::Restyle([(1, red), (2, OwnStyle::default())].into()),
        Edit::SetStates([(0, PathState::Hidden), (2, PathState::Removed)].into()),
        Edit::Insert(
            [1.5, 2.5]
                .map(|x| Insertion {
                    runs: line(x),
                    style: if x > 2.0 { red } else { OwnStyle::default() },
                    ..Insertion::default()
                })
                .into(),
        ),
    ]
}

#[test]
fn inverse_restores_the_scene_after_every_edit() {
    for edit in edits() {
        let mut scene = scene();
        let (before, bounds) = (properties(&scene), scene.bounds());
        let undo = scene.edit_with_undo(&edit, |_| {}).unwrap();
        let after = properties(&scene);
        assert_ne!(before, after, "{edit:?}");
        let redo = scene.edit_with_undo(&undo, |_| {}).unwrap();
        assert_eq!(properties(&scene), before, "{edit:?}");
        assert_eq!(scene.bounds(), bounds);
        scene.edit(&redo).unwrap();
        assert_eq!(properties(&scene), after, "{edit:?}");
    }
}

#[test]
fn inverses_in_reverse_order_restore_the_scene() {
    let mut scene = scene();
    let before = properties(&scene);
    let mut undo = Vec::new();
    for edit in edits() {
        undo.push(scene.edit_with_undo(&edit, |_| {}).unwrap());
    }
    assert_eq!((scene.path_count(), scene.hidden_count()), (5, 1));
    assert_eq!(scene.draw_order(), [1, 3, 4, 5]);
    assert_eq!(scene.color(5), Rgba::opaque(255, 0, 0));
    assert_eq!(scene.color(4), Rgba::BLACK);
    for edit in undo.iter().rev() {
        scene.edit(edit).unwrap();
    }
    assert_eq!(properties(&scene), before);
}

#[test]
fn rejected_edits_change_nothing() {
    let far = Affine::translation(Point::new(1e300, 0.0));
    let wrong = [
        Edit::Transform {
            paths: [0, 4].into(),
            by: Affine::IDENTITY,
        },
        Edit::Transform {
            paths: [0].into(),
            by: far,
        },
        Edit::Transform {
            paths: [1, 0, 1].into(),
            by: Affine::IDENTITY,
        },
        Edit::Transform {
            paths: [0].into(),
            by: Affine::scale(f64::NAN, 1.0, Point::default()),
        },
        Edit::Reshape {
            paths: [0].into(),
            curves: Arc::default(),
            written: Arc::default(),
        },
        Edit::SetStates([9, 11].map(|path| (path, PathState::Hidden)).into()),
        Edit::Insert([Insertion::default()].into()),
        Edit::Insert(
            [Insertion {
                runs: line(0.0),
                level: Some(0),
                ..Insertion::default()
            }]
            .into(),
        ),
    ];
    let expected = [
        EditError::UnknownPath { path: 4, rows: 4 },
        EditError::OutOfBounds { path: Some(0) },
        EditError::DuplicatePath { path: 1 },
        EditError::OutOfBounds { path: Some(0) },
        EditError::CurveCountMismatch,
        EditError::UnknownPath { path: 9, rows: 4 },
        EditError::OutOfBounds { path: None },
        EditError::UnknownReference {
            what: "level",
            row: 0,
        },
    ];
    let mut scene = scene();
    let before = properties(&scene);
    for (edit, error) in wrong.iter().zip(expected) {
        assert_eq!(scene.edit(edit), Err(error.clone()));
        let result = scene.edit_with_undo(edit, |edit| panic!("accepted {edit:?}"));
        assert_eq!(result.unwrap_err(), error);
        assert_eq!(properties(&scene), before);
    }
}

#[test]
fn edit_leaves_a_shared_layout_unchanged() {
    let mut scene = scene();
    let other = scene.clone();
    scene.edit(&edits()[0]).unwrap();
    assert_ne!(properties(&scene), properties(&other));
}

#[test]
fn edit_copies_a_shared_layout_before_it_notifies() {
    for edit in edits() {
        let mut scene = scene();
        let other = scene.clone();
        let mut calls = 0;
        let on_accepted = |_: &Edit| {
            calls += 1;
            let layout = other.shared_layout();
            let is_shared = matches!(edit, Edit::SetStates(_));
            assert_eq!(Arc::strong_count(&layout), if is_shared { 3 } else { 2 });
        };
        scene.edit_with_undo(&edit, on_accepted).unwrap();
        assert_eq!(calls, 1, "{edit:?}");
    }
}
