//! Marks: arrows, nodes, stations and labels as shapes and texts.

use guideway_document::decorations::Marks;
use guideway_scene::{DrawList, TextLine};
use guideway_spline::Point;

use super::options::DecorationStyle;

/// Opacity of the paper behind labels: the paths below stay visible.
const LABEL_PAPER_OPACITY: f64 = 0.75;

/// The marks of a view as a draw list.
pub fn marks_list(marks: &Marks, style: &DecorationStyle) -> DrawList {
    let mut list = DrawList::default();
    marks.draw_shapes(
        style.px_per_point,
        |at| at,
        |kind, corners: &[Point<f64>]| list.fill_polygon(style.mark_color(kind), corners),
    );
    let labels = marks.labels.iter().map(|label| TextLine {
        text: label.text.clone(),
        left_middle_px: label.at_px,
        char_width_px: style.label_size().char_px,
        color: style.ink,
        background: DecorationStyle::faded(style.paper, LABEL_PAPER_OPACITY),
    });
    list.texts.extend(labels);
    list
}

#[cfg(test)]
mod tests {
    use guideway_document::decorations::Label;
    use guideway_scene::Rgba;

    use super::*;

    #[test]
    fn nodes_are_shapes_and_labels_are_texts() {
        let at_px = Point::new(10.0, 20.0);
        let marks = Marks {
            nodes: vec![at_px],
            labels: vec![Label {
                text: "dock 1".into(),
                at_px,
            }],
            ..Marks::default()
        };
        let style = DecorationStyle::new(Rgba::WHITE, 1.0);
        let list = marks_list(&marks, &style);
        assert_eq!(list.fills[0].color, style.node);
        assert_eq!(list.texts[0].text, "dock 1");
    }
}
