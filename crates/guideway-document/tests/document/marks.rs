//! Marks and outlines.

use std::sync::Arc;

use guideway_document::decorations::{
    LabelSize, MAX_MARKED, MarkOptions, MarkedKinds, Outline, marks, outline,
};
use guideway_document::{Document, PathSet, ReversePairs, SelectMode};
use guideway_layout::{Layout, Level, NewPath, Value};
use guideway_scene::{LineRule, SceneOptions, View};
use guideway_spline::{Point, Runs};

use crate::site::{document_of, lanes, p, square, view};

const ALL: MarkOptions = MarkOptions {
    px_per_point: 1.0,
    line_rule: LineRule::World {
        width_m: 0.1,
        min_px: 1.5,
        max_px: 12.0,
    },
    arrows: true,
    symbols: true,
    labels: Some(LabelSize {
        char_px: 7.0,
        line_px: 14.0,
    }),
    of: MarkedKinds {
        paths: true,
        nodes: true,
        stations: true,
    },
};

fn marks_of(layout: Layout, view: &View) -> guideway_document::decorations::Marks {
    marks(&document_of(layout), view, &ALL)
}

#[test]
fn arrows_lie_on_their_paths_and_point_along_them() {
    let view = view(p(5.0, 1.0), 40.0);
    let marks = marks_of(lanes(3), &view);
    // 10 m are 400 px, so three arrows: 2.5 rounded.
    assert_eq!(marks.arrows.len(), 3 * 3, "{marks:?}");
    for arrow in &marks.arrows {
        let at = view.world_from_pixel(arrow.at_px);
        assert!((at.y - at.y.round()).abs() < 1e-6);
        assert!(arrow.direction.distance(p(1.0, 0.0)) < 1e-9);
        assert_eq!(arrow.is_two_way, at.y.round() == 0.0);
    }
    assert_eq!(marks.nodes.len(), 3);
    assert!(!marks.left_out);
}

#[test]
fn marks_of_other_levels_are_hidden() {
    let mut layout = Layout::default();
    for (level, id) in ["ground", "roof"].into_iter().enumerate() {
        layout.levels.push(Level {
            id: id.into(),
            name: None,
            elevation_m: None,
            ..Level::default()
        });
        let node = layout
            .nodes
            .push(id, p(level as f64, 0.0), Some(level as u32));
        let here = Some(p(level as f64, 1.0));
        layout
            .stations
            .push(id, here, vec![node], Some(level as u32));
    }
    let options = SceneOptions {
        level: Some("roof".into()),
        ..SceneOptions::default()
    };
    let document = Document::new(Arc::new(layout), &options).unwrap();
    let marks = marks(&document, &view(p(0.5, 0.5), 40.0), &ALL);
    assert_eq!((marks.nodes.len(), marks.stations.len()), (1, 1));
    assert!(marks.labels.iter().all(|label| label.text == "roof"));
}

/// Three lanes with a return path each: the reversed curve, other control points on the same line,
/// and another line between the same ends.
fn pairs() -> Layout {
    let mut layout = Layout::default();
    let mut push = |points: &[[Point<f64>; 4]]| {
        let mut runs = Runs::default();
        points.iter().for_each(|bezier| runs.push_bezier(bezier));
        let path = NewPath {
            runs: &runs,
            ..NewPath::default()
        };
        layout.paths.push(&path);
    };
    for (row, bend) in [(0.0, 1.0), (4.0, 0.0), (8.0, 1.0)] {
        let there = [p(0.0, row), p(3.0, row + bend), p(7.0, row), p(10.0, row)];
        let mut back = there;
        back.reverse();
        push(&[there]);
        match row as i32 {
            // The same line in two pieces, with another parameterization.
            4 => push(&[
                [p(10.0, row), p(9.0, row), p(8.0, row), p(6.0, row)],
                [p(6.0, row), p(4.0, row), p(1.0, row), p(0.0, row)],
            ]),
            // Another line between the same ends.
            8 => push(&[[p(10.0, row), p(7.0, row - 1.0), p(3.0, row), p(0.0, row)]]),
            _ => push(&[back]),
        }
    }
    layout
}

#[test]
fn reverse_pairs_share_two_way_arrows() {
    let layout = pairs();
    let view = view(p(5.0, 4.0), 40.0);
    let alone: usize = [0, 2, 4, 5]
        .map(|row| {
            let mut document = document_of(layout.clone());
            document.select(PathSet::from_iter([row]), SelectMode::Replace);
            document.isolate_selection();
            marks(&document, &view, &ALL).arrows.len()
        })
        .iter()
        .sum();
    let document = document_of(layout);
    let marks = marks(&document, &view, &ALL);
    assert_eq!(marks.arrows.len(), alone);
    for arrow in &marks.arrows {
        let is_pair = view.world_from_pixel(arrow.at_px).y < 6.0;
        assert_eq!(arrow.is_two_way, is_pair, "{arrow:?}");
    }
    let pairs = ReversePairs::among(&document, &[0, 1, 2, 3, 4, 5]);
    let of_each = [0, 1, 2, 3, 4, 5].map(|row| pairs.of(row));
    assert_eq!(of_each, [Some(1), Some(0), Some(3), Some(2), None, None]);
    let hit = guideway_document::nearest(document.layout(), 3, p(5.0, 4.0), 1e-6).unwrap();
    assert_eq!(document.reverse_path_at(&hit, 100), Some(2));
}

#[test]
fn labels_do_not_overlap() {
    let without_arrows = MarkOptions {
        arrows: false,
        ..ALL
    };
    let view = view(p(5.0, 50.0), 24.0);
    let marks = marks(&document_of(lanes(100)), &view, &without_arrows);
    assert!(marks.labels.len() > 5, "{:?}", marks.labels);
    for (i, a) in marks.labels.iter().enumerate() {
        for b in &marks.labels[..i] {
            let apart =
                (a.at_px.y - b.at_px.y).abs() >= 14.0 || (a.at_px.x - b.at_px.x).abs() >= 7.0 * 6.0;
            assert!(apart, "{a:?} {b:?}");
        }
    }
}

#[test]
fn labels_of_level_paths_are_above_them_and_hide_no_arrow() {
    let view = view(p(5.0, 1.0), 40.0);
    let marks = marks_of(lanes(3), &view);
    let at = |text: &str| marks.labels.iter().find(|label| label.text == text);
    let label = at("path-1").unwrap_or_else(|| panic!("{:?}", marks.labels));
    let path_px = view.pixel_from_world(p(5.0, 1.0));
    assert_eq!(label.at_px.y, path_px.y - 14.0 - marks.line_radius_px);
    // The arrow in the middle of the path stays.
    assert!(marks.arrows.iter().any(|arrow| arrow.at_px == path_px));
}

#[test]
fn a_crowded_view_has_no_marks_and_sets_left_out() {
    let layout = lanes(MAX_MARKED + 1);
    let far = marks_of(layout.clone(), &view(p(5.0, 1000.0), 0.2));
    assert!(far.left_out && far.arrows.is_empty() && far.labels.is_empty());
    let near = marks_of(layout, &view(p(5.0, 1000.0), 20.0));
    assert!(!near.left_out && !near.arrows.is_empty());
}

#[test]
fn a_long_path_zoomed_in_has_few_arrows_and_a_short_outline() {
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    runs.push_bezier(&[p(0.0, 0.0), p(3e5, 1e5), p(6e5, -1e5), p(1e6, 0.0)]);
    layout.paths.push(&NewPath {
        runs: &runs,
        ..NewPath::default()
    });
    let on_curve = guideway_document::nearest(&layout, 0, p(4e5, 0.0), 1e-6).unwrap();
    let view = view(on_curve.point_m, 1000.0);
    let marks = marks_of(layout.clone(), &view);
    assert!(
        (1..100).contains(&marks.arrows.len()),
        "{}",
        marks.arrows.len()
    );
    let Outline::Lines(lines) = outline(&document_of(layout), &PathSet::from_iter([0]), &view)
    else {
        panic!("one path has lines");
    };
    let points: usize = lines.iter().map(Vec::len).sum();
    assert!((2..100).contains(&points), "{points}");
    let middle = p(400.0, 300.0);
    let off = lines
        .iter()
        .flat_map(|line| line.windows(2).map(|w| distance(w, middle)));
    assert!(off.fold(f64::INFINITY, f64::min) < 0.5);
}

fn distance(line: &[Point<f64>], to: Point<f64>) -> f64 {
    let along = line[1] - line[0];
    let t = ((to - line[0]).dot(along) / along.dot(along)).clamp(0.0, 1.0);
    line[0].lerp(line[1], t).distance(to)
}

#[test]
fn an_outline_of_too_many_paths_is_grid_cells() {
    let mut document = document_of(lanes(100_000));
    document.select_all();
    let view = view(p(5.0, 50_000.0), 0.005);
    let Outline::Cells(cells, side) = outline(&document, document.selection(), &view) else {
        panic!("too many for lines");
    };
    assert!(
        side > 0.0 && (50..200).contains(&cells.len()),
        "{}",
        cells.len()
    );
}

#[test]
fn hidden_kinds_have_neither_symbols_nor_names() {
    let view = view(p(5.0, 1.0), 40.0);
    let document = document_of(lanes(3));
    let of = |of: MarkedKinds| marks(&document, &view, &MarkOptions { of, ..ALL });
    let all = of(MarkedKinds::default());
    let names = |marks: &guideway_document::decorations::Marks, prefix: &str| {
        marks
            .labels
            .iter()
            .filter(|label| label.text.starts_with(prefix))
            .count()
    };
    assert!(!all.nodes.is_empty() && !all.arrows.is_empty());
    let no_nodes = of(MarkedKinds {
        nodes: false,
        ..MarkedKinds::default()
    });
    assert!(no_nodes.nodes.is_empty() && no_nodes.arrows == all.arrows);
    assert_eq!(names(&no_nodes, "n"), 0);
    let no_paths = of(MarkedKinds {
        paths: false,
        ..MarkedKinds::default()
    });
    assert!(no_paths.arrows.is_empty() && no_paths.nodes == all.nodes);
}

#[test]
fn corners_of_walls_have_no_symbols() {
    let mut layout = Layout::default();
    let mut node = |id: &str, x, y| layout.nodes.push(id, p(x, y), None);
    let (corner, shared) = (node("corner", 2.0, 0.0), node("shared", 5.0, 0.0));
    let goal = node("goal", 8.0, 0.0);
    node("alone", 5.0, 2.0);
    for (row, (start, end)) in [(corner, shared), (shared, goal)].into_iter().enumerate() {
        let mut runs = Runs::default();
        runs.push_line(layout.nodes.position_m(start), layout.nodes.position_m(end));
        layout.paths.push(&NewPath {
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            ..NewPath::default()
        });
        let element = Value::Text(if row == 0 { "wall" } else { "lane" });
        layout.paths.attributes.set(row, "element", element);
    }
    let view = view(p(5.0, 1.0), 40.0);
    let mut marked: Vec<f64> = marks_of(layout, &view)
        .nodes
        .iter()
        .map(|at| at.x)
        .collect();
    marked.sort_by(f64::total_cmp);
    let expected = [p(5.0, 0.0), p(5.0, 2.0), p(8.0, 0.0)].map(|at| view.pixel_from_world(at).x);
    assert_eq!(marked, expected);
}

#[test]
fn walls_and_doors_have_no_arrows() {
    let view = view(p(5.0, 1.0), 40.0);
    let mut layout = lanes(3);
    let all = marks_of(layout.clone(), &view).arrows.len();
    for (row, element) in [(0, "wall"), (1, "door"), (2, "lane")] {
        layout
            .paths
            .attributes
            .set(row, "element", Value::Text(element));
    }
    assert_eq!(marks_of(layout, &view).arrows.len(), all / 3);
}

/// A location of openTCS stands beside its points; a dashed line says which they are.
#[test]
fn stations_apart_from_their_nodes_are_linked_to_them() {
    let near = view(p(5.0, 5.0), 40.0);
    let document = document_of(square());
    let found = marks(&document, &near, &ALL);
    let in_meters = |link: &[Point<f64>; 2]| link.map(|end| near.world_from_pixel(end));
    let links: Vec<[Point<f64>; 2]> = found.links.iter().map(in_meters).collect();
    let expected = [
        [p(0.0, -1.0), p(0.0, 0.0)],
        [p(11.0, 5.0), p(10.0, 0.0)],
        [p(11.0, 5.0), p(10.0, 10.0)],
    ];
    assert_eq!(links.len(), 3, "{links:?}");
    for (link, expected) in links.iter().zip(expected) {
        assert!(link.iter().zip(expected).all(|(a, b)| a.distance(b) < 1e-9));
    }
    // Far off, symbols touch and need no line.
    let far = view(p(5.0, 5.0), 1.0);
    let found = marks(&document, &far, &ALL);
    assert_eq!(found.links.len(), 0, "{:?}", found.links);
}
