//! Selection, visibility and colors.

use guideway_document::{Document, Query, SelectMode};
use guideway_layout::Quantity;
use guideway_scene::{ColorBy, Coloring, PathState, SceneOptions};
use guideway_spline::{Affine, Bounds};

use crate::site::{document, lanes, p};

fn rows(document: &Document) -> Vec<u32> {
    document.selection().iter().collect()
}

#[test]
fn a_box_selects_paths_inside_or_crossing() {
    let mut document = document(5);
    let bounds = Bounds {
        min: p(-1.0, 0.5),
        max: p(9.0, 3.5),
    };
    document.select_in(bounds, false, SelectMode::Replace);
    assert_eq!(rows(&document), [], "all cross its border");
    document.select_in(bounds, true, SelectMode::Replace);
    assert_eq!(rows(&document), [1, 2, 3]);
    document.select_in(bounds.inflated(1.1), false, SelectMode::Remove);
    assert_eq!(rows(&document), []);
}

#[test]
fn queries_find_values_per_vehicle_type() {
    let mut layout = lanes(2);
    layout.paths.vehicle_types_mut().set(1, &["tug", "fork"]);
    let entries = &mut layout.paths.vehicle_types_mut().attributes;
    entries.set_quantity(0, "maxHeight", 2.5, Quantity::Length);
    let query = Query::parse("maxHeight > 2", &layout).unwrap();
    assert!(query.rows(&layout).iter().eq([1]));
}

#[test]
fn selections_combine_and_exclude_hidden_paths() {
    let mut document = document(6);
    let query = Query::parse("speed > 1", document.layout()).unwrap();
    document.select(query.rows(document.layout()), SelectMode::Replace);
    document.select([0].into_iter().collect(), SelectMode::Add);
    document.select([3, 4].into_iter().collect(), SelectMode::Remove);
    assert_eq!(rows(&document), [0, 5]);
    document.hide_selection();
    assert_eq!(rows(&document), []);
    document.select_all();
    assert_eq!(rows(&document), [1, 2, 3, 4]);
    document.select([0, 1, 99].into_iter().collect(), SelectMode::Replace);
    assert_eq!(rows(&document), [1]);
    document.isolate_selection();
    assert_eq!(document.scene().draw_order(), [1]);
    document.show_all();
    assert_eq!(document.scene().draw_order().len(), 6);
    assert!(!document.is_changed(), "hiding is no edit");
}

#[test]
fn other_colors_keep_hidden_and_removed_paths() {
    let mut document = document(6);
    document.select([2].into_iter().collect(), SelectMode::Replace);
    document.hide_selection();
    document.select([3].into_iter().collect(), SelectMode::Replace);
    document.delete_selection().unwrap();
    let by_speed = SceneOptions {
        color_by: Some(ColorBy {
            column: "speed".into(),
        }),
        ..SceneOptions::default()
    };
    let layout = document.scene().shared_layout();
    let by_speed = Coloring::new(&layout, &by_speed).unwrap();
    assert!(document.recolor(&layout, &by_speed));
    assert!(document.scene().legend().is_some());
    assert_eq!(document.scene().draw_order(), [0, 1, 4, 5]);
    assert_eq!(document.scene().state(3), PathState::Removed);
    document.undo();
    document.select_all();
    let up = Affine::translation(p(0.0, 1.0));
    document.transform_selection("move", up).unwrap();
    assert!(
        !document.recolor(&layout, &by_speed),
        "of the layout before that"
    );
}

#[test]
fn a_copy_has_the_attributes_and_color_of_its_original() {
    let mut document = document(12);
    let by_speed = SceneOptions {
        color_by: Some(ColorBy {
            column: "speed".into(),
        }),
        ..SceneOptions::default()
    };
    let layout = document.scene().shared_layout();
    let by_speed = Coloring::new(&layout, &by_speed).unwrap();
    document.recolor(&layout, &by_speed);
    document.select([9].into_iter().collect(), SelectMode::Replace);
    document.copy_selection(1, p(100.0, 0.0)).unwrap();
    assert_eq!(document.scene().color(12), document.scene().color(9));
    let query = Query::parse("speed = 4.5", document.layout()).unwrap();
    let found: Vec<u32> = query.rows(document.layout()).iter().collect();
    assert_eq!(found, [9, 12]);
}

#[test]
fn a_curve_around_a_box_does_not_cross_it() {
    let mut layout = lanes(0);
    let mut runs = guideway_spline::Runs::default();
    runs.push_bezier(&[p(0.0, 0.0), p(0.0, 10.0), p(10.0, 10.0), p(10.0, 0.0)]);
    layout.paths.push(&guideway_layout::NewPath {
        runs: &runs,
        ..Default::default()
    });
    let mut document = crate::site::document_of(layout);
    let inner = Bounds {
        min: p(3.0, 0.0),
        max: p(7.0, 5.0),
    };
    document.select_in(inner, true, SelectMode::Replace);
    assert_eq!(rows(&document), []);
    document.select_in(inner.inflated(3.0), true, SelectMode::Replace);
    assert_eq!(rows(&document), [0]);
}

#[test]
fn a_box_takes_nodes_only_with_all_their_paths_or_alone() {
    let mut document = crate::site::two_joined();
    let select = |document: &mut Document, from: f64, to: f64| {
        let bounds = Bounds {
            min: p(from, -1.0),
            max: p(to, 9.0),
        };
        document.select_in(bounds, false, SelectMode::Replace);
        let selected = document.selected();
        let rows = [&selected.paths, &selected.nodes];
        rows.map(|rows| rows.iter().collect::<Vec<u32>>())
    };
    // The second path ends at node 1 too, which deleting the first one must not take along.
    assert_eq!(select(&mut document, -1.0, 11.0), [vec![0], vec![0]]);
    assert_eq!(
        select(&mut document, -1.0, 21.0),
        [vec![0, 1], vec![0, 1, 2]]
    );
    assert_eq!(select(&mut document, 9.0, 11.0), [vec![], vec![1]]);
}
