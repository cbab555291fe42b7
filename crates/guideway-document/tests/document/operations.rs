//! Edits of selected paths and control points.

use std::f64::consts::FRAC_PI_2;

use guideway_document::{Document, Elements, PointRef, SnapOptions, drawn_path};
use guideway_layout::{Layout, PathRef, Quantity, Value, WrittenCurve};
use guideway_spline::{Affine, Point, uniform};

use crate::site::{document, document_of, ends, is_near, p, select, two_joined};

#[test]
fn rotates_and_mirrors_about_the_given_points() {
    let mut document = document(1);
    select(&mut document, [0]);
    document
        .transform_selection("turn", Affine::rotation(FRAC_PI_2, p(0.0, 0.0)))
        .unwrap();
    assert!(is_near(ends(&document, 0).1, p(0.0, 10.0)));
    document
        .transform_selection("mirror", Affine::mirror(p(1.0, 0.0), p(0.0, 1.0)))
        .unwrap();
    assert!(is_near(ends(&document, 0).1, p(2.0, 10.0)));
    assert!((document.selection_bounds().unwrap().min.x - 2.0).abs() < 1e-9);
}

#[test]
fn copies_keep_attributes_and_are_evenly_spaced() {
    let mut document = document(3);
    select(&mut document, [2]);
    document.copy_selection(3, p(0.0, 100.0)).unwrap();
    assert_eq!(document.selection().iter().collect::<Vec<_>>(), [3, 4, 5]);
    for (row, y) in [(3, 102.0), (4, 202.0), (5, 302.0)] {
        assert!(is_near(ends(&document, row).0, p(0.0, y)));
    }
    assert_eq!(document.layout().paths.id(4), "path-4");
    // A copy of a copy has the attributes of the first.
    document.copy_selection(1, p(0.0, 1000.0)).unwrap();
    let saved = document.to_layout();
    let speed = &saved.paths.attributes.get("speed").unwrap().values;
    assert_eq!(saved.paths.len(), 9);
    assert!((2..9).all(|row| speed.get(row) == Some(Value::Float(1.0))));
}

/// Two lanes, the first one with a written curve, and that curve.
fn written_lane() -> (Layout, WrittenCurve) {
    let mut layout = document(2).to_layout();
    let written = WrittenCurve {
        degree: 2,
        knots: Vec::new(),
        points_m: vec![p(0.0, 0.0), p(5.0, 0.0), p(10.0, 0.0)],
        weights: Some(vec![1.0, 2.0, 1.0]),
    };
    layout.paths.set_written_curve(0, written.clone());
    (layout, written)
}

#[test]
fn written_curves_follow_every_affine_map_and_its_undo() {
    let (layout, written) = written_lane();
    let mut document = document_of(layout);
    let curve = |document: &Document, row| document.layout().paths.written_curve(row).cloned();
    select(&mut document, [0]);
    let turn = Affine::rotation(0.3, p(1.0, 2.0));
    let mirror = Affine::mirror(p(3.0, 0.0), p(1.0, 1.0));
    let stretch = Affine::scale(2.0, 0.5, p(1.0, 1.0));
    for by in [turn, mirror, stretch] {
        document.transform_selection("map", by).unwrap();
        assert_eq!(curve(&document, 0), Some(written.mapped(by)));
        document.undo().unwrap();
        assert_eq!(curve(&document, 0), Some(written.clone()));
        document.redo().unwrap();
        assert_eq!(curve(&document, 0), Some(written.mapped(by)));
        document.undo().unwrap();
    }
    // Pasted into the same document and into another one.
    let clip = document.clip(&Elements::of_paths([0])).unwrap();
    for mut target in [document, document_of(Layout::default())] {
        for by in [turn, mirror] {
            let pasted = target.paste(&clip, by, None).unwrap();
            let row = pasted.paths.min().unwrap() as usize;
            assert_eq!(curve(&target, row), Some(written.mapped(by)));
            target.undo().unwrap();
            target.redo().unwrap();
            assert_eq!(curve(&target, row), Some(written.mapped(by)));
        }
    }
}

#[test]
fn written_curves_are_reversed_but_not_bent() {
    let (layout, written) = written_lane();
    let mut document = document_of(layout);
    let curve = |document: &Document| document.layout().paths.written_curve(0).cloned();
    document.reverse(&[0].into_iter().collect()).unwrap();
    assert_eq!(curve(&document), Some(written.reversed()));
    let point = PointRef {
        path: 0,
        run: 0,
        point: 1,
    };
    document.move_point(point, p(0.0, 2.0)).unwrap();
    assert_eq!(curve(&document), None);
    document.undo().unwrap();
    assert_eq!(curve(&document), Some(written.reversed()));
    document.undo().unwrap();
    assert_eq!(curve(&document), Some(written));
}

#[test]
fn stated_lengths_follow_the_curves() {
    fn length(document: &Document, row: usize) -> Option<Value<'_>> {
        document.layout().paths.attributes.value(row, "length")
    }
    let mut layout = two_joined().to_layout();
    let lengths = &mut layout.paths.attributes;
    // The drawing is to half the scale of the building; the second path states nothing.
    lengths.set_quantity(0, "length", 20.0, Quantity::Length);
    let mut document = document_of(layout);
    let meters = |length_m| Some(Value::Float(length_m));
    select(&mut document, [0]);
    let turn = Affine::rotation(FRAC_PI_2, p(3.0, 4.0));
    document.transform_selection("turn", turn).unwrap();
    document.refine_selection().unwrap();
    assert_eq!(length(&document, 0), meters(20.0));
    document.undo().unwrap();
    document.undo().unwrap();
    // From a at 0 to b at 12 instead of 10.
    document.move_node(1, p(12.0, 0.0)).unwrap();
    assert_eq!(length(&document, 0), meters(24.0));
    assert_eq!(length(&document, 1), None);
    let stretch = Affine::scale(0.5, 0.5, p(0.0, 0.0));
    document.transform_selection("scale", stretch).unwrap();
    assert_eq!(length(&document, 0), meters(12.0));
    let point = PointRef {
        path: 0,
        run: 0,
        point: 1,
    };
    document.insert_point(point).unwrap();
    let bent = PointRef { point: 2, ..point };
    document.move_point(bent, p(3.0, 3.0)).unwrap();
    assert!(matches!(length(&document, 0), Some(Value::Float(length_m)) if length_m > 12.1));
    while document.undo().is_some() {}
    assert_eq!(length(&document, 0), meters(20.0));
    assert_eq!(length(&document, 1), None);
}

#[test]
fn copies_keep_the_written_curve_and_the_draw_rank() {
    let (mut layout, written) = written_lane();
    layout.paths.set_rank(vec![7, 3]);
    let mut document = document_of(layout);
    select(&mut document, [0]);
    document.copy_selection(2, p(0.0, 100.0)).unwrap();
    let saved = document.to_layout();
    assert_eq!(saved.paths.rank(), Some(&[7, 3, 7, 7][..]));
    for (row, y) in [(2, 100.0), (3, 200.0)] {
        let points_m = written.points_m.iter().map(|&q| q + p(0.0, y)).collect();
        let expected = WrittenCurve {
            points_m,
            ..written.clone()
        };
        assert_eq!(saved.paths.written_curve(row), Some(&expected));
    }
}

#[test]
fn moves_inserts_and_removes_control_points() {
    let mut document = document(1);
    let point = PointRef {
        path: 0,
        run: 0,
        point: 1,
    };
    let points = |document: &Document| -> Vec<Point<f64>> {
        let mut runs = document.layout().paths.get(0).runs();
        runs.next().unwrap().iter().collect()
    };
    document.move_point(point, p(3.0, 2.0)).unwrap();
    let [start, second, third, end] = {
        let segment = points(&document).try_into().unwrap();
        uniform::to_bezier(&segment)
    };
    assert!(is_near(second, p(3.0, 2.0)));
    document.insert_point(point).unwrap();
    assert_eq!(points(&document).len(), 5);
    assert!(is_near(points(&document)[2], second.lerp(third, 0.5)));
    assert!(is_near(ends(&document, 0).0, start) && is_near(ends(&document, 0).1, end));
    document.remove_point(point).unwrap();
    assert_eq!(points(&document).len(), 4);
    document.remove_point(point).unwrap();
    assert_eq!(points(&document).len(), 4, "a run has at least four");
    let nowhere = PointRef { path: 7, ..point };
    assert!(document.move_point(nowhere, p(0.0, 0.0)).is_err());
    assert!(document.move_point(point, p(f64::NAN, 0.0)).is_err());
    let steps = std::iter::from_fn(|| document.undo()).count();
    assert_eq!(steps, 3, "what did nothing is no step");
}

#[test]
fn refining_preserves_the_curve() {
    let mut document = two_joined();
    let before = document.layout().paths.clone();
    document.select_all();
    document.refine_selection().unwrap();
    for row in 0..2 {
        let (old, new) = (before.get(row), document.layout().paths.get(row));
        assert_eq!(new.runs().next().unwrap().len(), 5);
        for segment in new.runs().flat_map(|run| run.segments()) {
            for t in [0.0, 0.3, 0.8, 1.0] {
                let at = uniform::point(&segment, t);
                let layout = two_joined().to_layout();
                let off = guideway_document::nearest(&layout, row as u32, at, 1e-9).unwrap();
                assert!(off.distance_m < 1e-7, "{off:?}");
            }
        }
        assert!((old.length_m() - new.length_m()).abs() < 1e-3);
    }
}

#[test]
fn a_drawn_path_connects_its_first_and_last_point() {
    let mut document = two_joined();
    let points = [p(0.0, 0.0), p(5.0, 8.0), p(20.0, 0.0)];
    let near = [p(0.1, 0.0), points[1], p(20.0, 0.1)];
    document.draw_path("new".into(), &near, 0.5).unwrap();
    let path = document.layout().paths.get(2);
    assert_eq!((path.start_node(), path.end_node()), (Some(0), Some(2)));
    let (start, end) = path.ends().unwrap();
    assert!(is_near(start, points[0]) && is_near(end, points[2]));
    let ahead = drawn_path(&points).unwrap();
    let points_of = |path: PathRef<'_>| {
        path.runs()
            .flat_map(|r| r.iter().collect::<Vec<_>>())
            .collect::<Vec<_>>()
    };
    assert_eq!(points_of(ahead.paths.get(0)), points_of(path));
    assert_eq!(document.selection().iter().collect::<Vec<_>>(), [2]);
    for nothing in [&[][..], &[p(1.0, 1.0)], &[p(1.0, 1.0), p(1.0, 1.0)]] {
        assert!(document.draw_path("none".into(), nothing, 0.5).is_err());
        assert!(drawn_path(nothing).is_none());
    }
}

#[test]
fn snaps_to_nodes_before_directions_before_the_grid() {
    let document = two_joined();
    let snap = SnapOptions {
        node_reach_m: Some(1.0),
        grid_m: Some(0.5),
        directions: Some(8),
        ..SnapOptions::default()
    };
    assert_eq!(document.snap(&snap, p(10.4, 0.4), None).at_m, p(10.0, 0.0));
    let moving = SnapOptions {
        moving_node: Some(1),
        ..snap
    };
    assert_eq!(
        document.snap(&moving, p(10.4, 0.4), None).at_m,
        p(10.5, 0.5)
    );
    let to = document.snap(&snap, p(5.0, 6.0), Some(p(0.0, 0.0))).at_m;
    assert!(is_near(to, p(5.5, 5.5)), "{to:?}");
    assert_eq!(document.snap(&snap, p(5.1, 6.3), None).at_m, p(5.0, 6.5));
    assert_eq!(
        document
            .snap(&SnapOptions::default(), p(5.1, 6.3), None)
            .at_m,
        p(5.1, 6.3)
    );
}

#[test]
fn refines_and_restores_thousands_of_paths() {
    let mut document = document(3_000);
    document.select_all();
    for _ in 0..4 {
        document.refine_selection().unwrap();
    }
    assert_eq!(document.layout().paths.geometry().point_count(), 3_000 * 19);
    for _ in 0..4 {
        document.undo();
    }
    assert_eq!(document.layout().paths.geometry().point_count(), 3_000 * 4);
}

/// A file may state a length per vehicle type; each follows the curve by its own ratio.
#[test]
fn stated_lengths_of_vehicle_types_follow_the_curves() {
    let mut layout = two_joined().to_layout();
    layout.paths.vehicle_types_mut().set(0, &["tug", "fork"]);
    let lengths = &mut layout.paths.vehicle_types_mut().attributes;
    lengths.set_quantity(0, "length", 20.0, Quantity::Length);
    let mut document = document_of(layout);
    let length = |document: &Document, row: usize, name: &str| {
        let value = document.layout().paths.value_for(row, name, "length");
        value.and_then(|value| value.number())
    };
    document.move_node(1, p(12.0, 0.0)).unwrap();
    assert_eq!(length(&document, 0, "tug"), Some(24.0));
    assert_eq!(length(&document, 0, "fork"), None);
    let path = [0].into_iter().collect();
    document.split_at(&path, p(6.0, 0.0), 0.1).unwrap();
    let halves = [0, 2].map(|row| length(&document, row, "tug"));
    assert!(
        halves
            .iter()
            .all(|half| half.is_some_and(|m| (m - 12.0).abs() < 1e-5)),
        "{halves:?}"
    );
    while document.undo().is_some() {}
    assert_eq!(length(&document, 0, "tug"), Some(20.0));
}
