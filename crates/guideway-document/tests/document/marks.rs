use guideway_document::Rows;
use guideway_document::marks::{LabelSize, MOST_MARKED, MarkOptions, Outline, marks, outline};
use guideway_layout::{Layout, NewPath};
use guideway_render::View;
use guideway_spline::{Point, Runs};

use crate::site::{document_of, lanes, p, view};

const ALL: MarkOptions = MarkOptions {
    arrows: true,
    symbols: true,
    labels: Some(LabelSize {
        char_px: 7.0,
        line_px: 14.0,
    }),
};

fn marks_of(layout: Layout, view: &View) -> guideway_document::marks::Marks {
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
fn names_do_not_lie_over_each_other() {
    let marks = marks_of(lanes(100), &view(p(5.0, 50.0), 5.0));
    assert!(marks.labels.len() > 10);
    for (i, a) in marks.labels.iter().enumerate() {
        for b in &marks.labels[..i] {
            let apart =
                (a.at_px.y - b.at_px.y).abs() >= 14.0 || (a.at_px.x - b.at_px.x).abs() >= 7.0 * 6.0;
            assert!(apart, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_view_of_too_much_has_no_marks_and_says_so() {
    let layout = lanes(MOST_MARKED + 1);
    let far = marks_of(layout.clone(), &view(p(5.0, 1000.0), 0.2));
    assert!(far.left_out && far.arrows.is_empty() && far.labels.is_empty());
    let near = marks_of(layout, &view(p(5.0, 1000.0), 20.0));
    assert!(!near.left_out && !near.arrows.is_empty());
}

#[test]
fn a_long_path_seen_close_has_few_arrows_and_a_short_outline() {
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
    let Outline::Lines(lines) = outline(&document_of(layout), &Rows::from_iter([0]), &view) else {
        panic!("one path is drawn as lines");
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
fn an_outline_of_very_many_paths_is_their_cells() {
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
