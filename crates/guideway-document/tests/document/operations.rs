use std::f64::consts::FRAC_PI_2;

use guideway_document::measure::length_m;
use guideway_document::{Change, Document, Index, PointRef, SelectMode, SnapOptions, drawn_path};
use guideway_layout::{Layout, NewPath, PathRef, Value};
use guideway_scene::{Edit, EditError, LayoutCopy};
use guideway_spline::{Affine, Bounds, Point, Runs};

use crate::site::{document, document_of, lanes, p};

fn ends(document: &Document, path: usize) -> (Point<f64>, Point<f64>) {
    document
        .layout()
        .paths
        .get(path)
        .ends()
        .expect("a path with a curve")
}

fn is_near(a: Point<f64>, b: Point<f64>) -> bool {
    a.distance(b) < 1e-9
}

fn select(document: &mut Document, rows: impl IntoIterator<Item = u32>) {
    document.select(rows.into_iter().collect(), SelectMode::Replace);
}

/// Two paths from a to b and b to c, the second one bent.
fn two_joined() -> Document {
    let mut layout = Layout::default();
    let [a, b, c] = [("a", 0.0), ("b", 10.0), ("c", 20.0)]
        .map(|(id, x)| layout.nodes.push(id, p(x, 0.0), None));
    let mut straight = Runs::default();
    straight.push_line(p(0.0, 0.0), p(10.0, 0.0));
    let mut bent = Runs::default();
    bent.push_bezier(&[p(10.0, 0.0), p(12.0, 5.0), p(18.0, 5.0), p(20.0, 0.0)]);
    for (id, runs, start, end) in [("ab", straight, a, b), ("bc", bent, b, c)] {
        layout.paths.push(&NewPath {
            id,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            ..NewPath::default()
        });
    }
    document_of(layout)
}

#[test]
fn ends_follow_their_node_and_straight_stays_straight() {
    let mut document = two_joined();
    document.move_node(1, p(11.0, 2.0)).unwrap();
    assert!(is_near(document.node_position_m(1), p(11.0, 2.0)));
    let (start, end) = ends(&document, 0);
    assert!(is_near(start, p(0.0, 0.0)) && is_near(end, p(11.0, 2.0)));
    assert!((length_m(document.layout().paths.get(0)) - 125f64.sqrt()).abs() < 1e-4);
    let (start, end) = ends(&document, 1);
    assert!(is_near(start, p(11.0, 2.0)) && is_near(end, p(20.0, 0.0)));
    assert_eq!(document.undo(), Some("move node"));
    assert_eq!(document.node_position_m(1), p(10.0, 0.0));
    assert_eq!(ends(&document, 0), ends(&two_joined(), 0));
    assert_eq!(
        document.move_node(9, p(0.0, 0.0)),
        Err(EditError::UnknownReference {
            what: "node",
            row: 9
        })
    );
}

#[test]
fn a_node_goes_with_its_paths_if_all_of_them_go() {
    let mut document = two_joined();
    select(&mut document, [0]);
    let by = Affine::translation(p(0.0, 3.0));
    document.transform_selection("move", by).unwrap();
    assert_eq!(document.node_position_m(0), p(0.0, 3.0));
    assert_eq!(
        document.node_position_m(1),
        p(10.0, 0.0),
        "bc is still there"
    );
    select(&mut document, [0, 1]);
    document.transform_selection("move", by).unwrap();
    assert_eq!(document.node_position_m(1), p(10.0, 3.0));
    assert_eq!(document.node_near(p(10.0, 3.1), 0.5), Some(1));
    assert_eq!(document.node_near(p(10.0, 0.0), 0.5), None);
}

#[test]
fn a_station_goes_with_its_nodes_if_all_of_them_go() {
    let mut layout = lanes(3);
    let stations = &mut layout.stations;
    stations.push("rack", Some(p(-1.0, 0.5)), vec![0, 1], None);
    stations.push("charger", Some(p(-2.0, 2.0)), vec![2], None);
    stations.push("dock", None, vec![2, 0], None);
    stations.push("sign", Some(p(5.0, 5.0)), vec![], None);
    let mut document = document_of(layout);
    let stations = |document: &Document| {
        let saved = document.to_layout().stations;
        assert_eq!(saved.position_m(2), None, "it has no place of its own");
        for station in [0, 1, 3] {
            let at = document.station_position_m(station);
            assert_eq!(saved.position_m(station), at);
        }
        [0, 1, 2, 3].map(|station| document.station_position_m(station).unwrap())
    };
    let before = stations(&document);
    assert_eq!(before[2], p(0.0, 2.0));
    document.move_node(0, p(0.0, -3.0)).unwrap();
    assert_eq!(stations(&document), before, "a rack has two nodes");
    document.move_node(1, p(0.0, 0.0)).unwrap();
    document.move_node(2, p(4.0, 2.0)).unwrap();
    let after = [p(-1.0, -1.5), p(2.0, 2.0), p(4.0, 2.0), p(5.0, 5.0)];
    assert_eq!(stations(&document), after);
    for _ in 0..3 {
        document.undo().unwrap();
    }
    assert_eq!(stations(&document), before);
    document.move_node(1, p(0.0, 0.0)).unwrap();
    assert_eq!(stations(&document), before, "the other is back");
}

#[test]
fn turning_and_mirroring_go_about_their_places() {
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
fn copies_keep_attributes_and_an_array_is_evenly_spaced() {
    let mut document = document(3);
    select(&mut document, [2]);
    document.copy_selection(3, p(0.0, 100.0)).unwrap();
    assert_eq!(document.selection().iter().collect::<Vec<_>>(), [3, 4, 5]);
    for (row, y) in [(3, 102.0), (4, 202.0), (5, 302.0)] {
        assert!(is_near(ends(&document, row).0, p(0.0, y)));
    }
    assert_eq!(document.layout().paths.id(4), "path-2 copy 2");
    // A copy of a copy has the attributes of the first.
    document.copy_selection(1, p(0.0, 1000.0)).unwrap();
    let saved = document.to_layout();
    let speed = &saved.paths.attributes.get("speed").unwrap().values;
    assert_eq!(saved.paths.len(), 9);
    assert!((2..9).all(|row| speed.get(row) == Some(Value::Float(1.0))));
}

#[test]
fn what_is_deleted_is_not_saved_and_comes_back_by_undo() {
    let mut document = document(4);
    select(&mut document, [1, 2]);
    document.delete_selection().unwrap();
    assert!(document.selection().is_empty());
    let saved = document.to_layout();
    let ids: Vec<&str> = saved.paths.iter().map(|path| path.id()).collect();
    assert_eq!(ids, ["path-0", "path-3"]);
    let attributes = &saved.paths.attributes;
    assert_eq!(
        attributes.get("speed").unwrap().values.get(1),
        Some(Value::Float(1.5))
    );
    assert_eq!(attributes.get("zone").unwrap().values.get(1), None);
    assert!(document.is_changed());
    document.mark_saved();
    assert!(!document.is_changed());
    assert_eq!(document.undo(), Some("delete"));
    assert!(document.is_changed());
    assert_eq!(document.selection().len(), 2, "selected as before");
    assert_eq!(document.to_layout().paths.len(), 4);
    assert_eq!(document.redo(), Some("delete"));
    assert!(!document.is_changed(), "just as it was saved");
}

#[test]
fn control_points_are_moved_inserted_and_removed() {
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
    document.move_point(point, p(0.0, 2.0)).unwrap();
    assert_eq!(points(&document)[1], p(0.0, 2.0));
    document.insert_point(point).unwrap();
    assert_eq!(points(&document).len(), 5);
    assert_eq!(points(&document)[2], p(5.0, 1.0));
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
fn refining_leaves_the_curve_where_it_is() {
    let mut document = two_joined();
    let before = document.layout().paths.clone();
    document.select_all();
    document.refine_selection().unwrap();
    for row in 0..2 {
        let (old, new) = (before.get(row), document.layout().paths.get(row));
        assert_eq!(new.runs().next().unwrap().len(), 5);
        for segment in new.runs().flat_map(|run| run.segments()) {
            for t in [0.0, 0.3, 0.8, 1.0] {
                let at = guideway_spline::uniform::point(&segment, t);
                let layout = two_joined().to_layout();
                let off = guideway_document::nearest(&layout, row as u32, at, 1e-9).unwrap();
                assert!(off.distance_m < 1e-7, "{off:?}");
            }
        }
        assert!((length_m(old) - length_m(new)).abs() < 1e-3);
    }
}

#[test]
fn a_drawn_path_begins_and_ends_where_it_was_drawn() {
    let mut document = two_joined();
    let points = [p(0.1, 0.0), p(5.0, 8.0), p(20.0, 0.1)];
    document.draw_path("new".into(), &points, 0.5).unwrap();
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
fn places_snap_to_nodes_first_then_directions_then_the_grid() {
    let document = two_joined();
    let snap = SnapOptions {
        node_reach_m: Some(1.0),
        grid_m: Some(0.5),
        directions: Some(8),
        ..SnapOptions::default()
    };
    assert_eq!(document.snap(&snap, p(10.4, 0.4), None), p(10.0, 0.0));
    let moving = SnapOptions {
        moving_node: Some(1),
        ..snap
    };
    assert_eq!(document.snap(&moving, p(10.4, 0.4), None), p(10.5, 0.5));
    let to = document.snap(&snap, p(5.0, 6.0), Some(p(0.0, 0.0)));
    assert!(is_near(to, p(5.5, 5.5)), "{to:?}");
    assert_eq!(document.snap(&snap, p(5.1, 6.3), None), p(5.0, 6.5));
    assert_eq!(
        document.snap(&SnapOptions::default(), p(5.1, 6.3), None),
        p(5.1, 6.3)
    );
}

#[test]
fn an_edit_that_cannot_be_done_changes_nothing() {
    let mut document = document(3);
    document.select_all();
    let far = Affine::translation(p(1e12, 0.0));
    assert!(document.transform_selection("move", far).is_err());
    let changes = vec![
        Change::Scene(Edit::Transform {
            paths: [0].into(),
            by: Affine::translation(p(1.0, 0.0)),
        }),
        Change::MoveNodes([(99, p(0.0, 0.0))].into()),
    ];
    assert!(document.perform("both", changes).is_err());
    assert!(is_near(ends(&document, 0).0, p(0.0, 0.0)));
    assert!(!document.is_changed());
    assert_eq!(document.undo_redo_names(), (None, None));
}

#[test]
fn what_undo_takes_goes_with_the_change_and_not_with_the_layout() {
    let bytes_after = |paths: usize, moved: u32, steps: usize| {
        let mut document = document(paths);
        document.select_all();
        let all_selected = document.history_bytes();
        for step in 0..steps {
            let point = PointRef {
                path: step as u32 % moved,
                run: 0,
                point: 0,
            };
            document.move_point(point, p(step as f64, 0.0)).unwrap();
        }
        assert_eq!(all_selected, 0);
        document.history_bytes()
    };
    let small = bytes_after(100, 1, 1_000);
    // The selection is of every path, and kept once.
    let large = bytes_after(20_000, 1, 1_000);
    assert!(large < small + 10_000, "{small} and {large} bytes");
    let twice = bytes_after(100, 1, 2_000);
    assert!((1.9..2.1).contains(&(twice as f64 / small as f64)));
    let mut document = document(5_000);
    select(&mut document, 0..1);
    let by = Affine::translation(p(1.0, 0.0));
    document.transform_selection("move", by).unwrap();
    let one = document.history_bytes();
    document.select_all();
    document.transform_selection("move", by).unwrap();
    let all = document.history_bytes() - one;
    assert!(
        all > 1_000 * one / 2,
        "{one} for one, {all} for 5,000: it counts"
    );
    document.undo();
    assert!(document.history_bytes() > all / 2, "it can be done again");
}

#[test]
fn many_paths_take_other_numbers_of_points_at_once() {
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

#[test]
fn paths_that_come_later_follow_their_nodes_and_removed_ones_do_not() {
    let mut document = two_joined();
    let points = [p(0.0, 0.0), p(5.0, 8.0), p(20.0, 0.0)];
    document.draw_path("new".into(), &points, 0.5).unwrap();
    select(&mut document, [0]);
    document.delete_selection().unwrap();
    document.move_node(0, p(-3.0, 1.0)).unwrap();
    assert!(is_near(ends(&document, 2).0, p(-3.0, 1.0)));
    assert!(is_near(ends(&document, 0).0, p(0.0, 0.0)), "it is removed");
    let mut at: Vec<u32> = document.index().paths_at(2).collect();
    at.sort_unstable();
    assert_eq!(at, [1, 2]);
}

#[test]
fn the_index_follows_edits() {
    let mut document = document(40);
    select(&mut document, 0..3);
    let up = Affine::translation(p(0.0, 1000.0));
    document.transform_selection("move", up).unwrap();
    document.copy_selection(1, p(0.0, 1000.0)).unwrap();
    select(&mut document, 20..40);
    document.transform_selection("move", up).unwrap();
    document.undo();
    let everywhere = Bounds {
        min: p(-1e6, -1e6),
        max: p(1e6, 1e6),
    };
    let fresh = Index::new(document.layout());
    for y in [0.0, 10.0, 30.0, 1001.0, 2001.0, 1030.0] {
        let bounds = Bounds {
            min: p(0.0, y),
            max: p(1.0, y + 3.0),
        };
        let found = |index: &Index, bounds| {
            let mut rows: Vec<u32> = index.paths_in(bounds).collect();
            rows.sort_unstable();
            rows
        };
        assert_eq!(
            found(document.index(), bounds),
            found(&fresh, bounds),
            "{y}"
        );
        assert_eq!(found(document.index(), everywhere).len(), 43);
    }
}

#[test]
fn an_edit_takes_the_copy_that_was_made_for_it_and_no_other() {
    let mut document = document(3);
    let renderer = document.scene().clone();
    assert!(document.scene().is_layout_shared());
    document.adopt_copy(LayoutCopy::new(document.scene().shared_layout()));
    assert!(!document.scene().is_layout_shared());
    let held: *const Layout = document.layout();
    let stale = LayoutCopy::new(document.scene().shared_layout());
    document.adopt_copy(LayoutCopy::new(renderer.shared_layout()));
    assert!(std::ptr::eq(held, document.layout()), "that of another");
    document.select_all();
    let by = Affine::translation(p(0.0, 5.0));
    document.transform_selection("move", by).unwrap();
    document.adopt_copy(stale);
    let start = |layout: &Layout| layout.paths.get(0).ends().map(|(start, _)| start);
    assert_eq!(start(document.layout()), Some(p(0.0, 5.0)));
    assert_eq!(start(renderer.layout()), Some(p(0.0, 0.0)));
}
