//! What lies below and over the paths of a picture, for its export: the same as on the screen.

use guideway_document::decorations::{LabelSize, MarkOptions, Marks, marks};
use guideway_document::{grid_lines_px, round_step};
use guideway_scene::Rgba;
use guideway_scene::{DrawList, TextLine, View};
use guideway_spline::Point;

use super::App;
use crate::ui::length_text;

/// Size of the names in the picture, in points.
pub(crate) const LABEL_POINTS: f32 = 11.0;
/// Least distance of the lines of the grid, in pixels.
pub(crate) const GRID_LEAST_PX: f64 = 96.0;
/// Least length of the scale bar, in pixels.
const SCALE_LEAST_PX: f64 = 80.0;

/// How opaque are lines of the grid, and what is behind names.
pub(crate) const GRID_OPACITY: f32 = 0.12;
pub(crate) const LABEL_PAPER_OPACITY: f32 = 0.75;

impl App {
    /// How large names are in the picture.
    fn label_size(&self) -> LabelSize {
        let points = f64::from(LABEL_POINTS) * self.px_per_point;
        LabelSize {
            char_px: points * TextLine::CHAR_ASPECT,
            line_px: points * 1.2,
        }
    }

    /// What is drawn over paths.
    pub(crate) fn mark_options(&self) -> MarkOptions {
        let look = &self.look;
        MarkOptions {
            px_per_point: self.px_per_point,
            arrows: look.has_arrows.then(|| look.line_rule()),
            symbols: look.has_symbols,
            labels: look.has_labels.then(|| self.label_size()),
        }
    }

    /// The grid of a view, if it is shown.
    pub(super) fn grid_sheet(&self, view: &View) -> DrawList {
        let mut sheet = DrawList::default();
        if !self.look.has_grid {
            return sheet;
        }
        let ink = faded(self.look.mark_ink(), GRID_OPACITY);
        let (width_px, size) = (self.px_per_point, view.size());
        let end = Point::new(f64::from(size.width()), f64::from(size.height()));
        let [x_px, y_px] = grid_lines_px(view, GRID_LEAST_PX);
        for x in x_px {
            let (left, right) = (x - width_px / 2.0, x + width_px / 2.0);
            sheet.fill_rectangle(ink, Point::new(left, 0.0), Point::new(right, end.y));
        }
        for y in y_px {
            let (top, bottom) = (y - width_px / 2.0, y + width_px / 2.0);
            sheet.fill_rectangle(ink, Point::new(0.0, top), Point::new(end.x, bottom));
        }
        sheet
    }

    /// Arrows, symbols, names and the scale bar of a view.
    pub(super) fn marks_sheet(&self, view: &View) -> DrawList {
        let mut sheet = DrawList::default();
        let options = self.mark_options();
        let layer = self.layers.get(self.active).filter(|l| l.is_visible);
        if let Some(document) = layer.and_then(|layer| layer.document.as_ref()) {
            self.add_marks(&mut sheet, &marks(document, view, &options));
        }
        self.add_scale(&mut sheet, view);
        sheet
    }

    fn add_marks(&self, sheet: &mut DrawList, marks: &Marks) {
        let add =
            |kind, corners: &[Point<f64>]| sheet.fill_polygon(self.look.mark_color(kind), corners);
        marks.draw_shapes(self.px_per_point, |at| at, add);
        for label in &marks.labels {
            sheet.texts.push(TextLine {
                text: label.text.clone(),
                left_middle_px: label.at_px,
                char_width_px: self.label_size().char_px,
                color: self.look.mark_ink(),
                background: faded(self.look.paper(), LABEL_PAPER_OPACITY),
            });
        }
    }

    fn add_scale(&self, sheet: &mut DrawList, view: &View) {
        let (point_px, ink) = (self.px_per_point, self.look.mark_ink());
        let bar = scale_bar(view);
        let left = Point::new(0.0, f64::from(view.size().height())) + SCALE_LEFT * point_px;
        let right = left + Point::new(bar.length_px, 0.0);
        let thick = Point::new(point_px, point_px);
        sheet.fill_rectangle(ink, left - thick, right + thick);
        for end in [left, right] {
            let top = Point::new(0.0, SCALE_END * point_px);
            sheet.fill_rectangle(ink, end - thick - top, end + thick);
        }
        sheet.texts.push(TextLine {
            text: length_text(bar.length_m),
            left_middle_px: left + SCALE_TEXT * point_px,
            char_width_px: self.label_size().char_px,
            color: ink,
            background: faded(self.look.paper(), 0.0),
        });
    }
}

/// From the lower left corner of the picture to the bar, from there to its text, and how high its ends are: in points.
pub(crate) const SCALE_LEFT: Point<f64> = Point { x: 16.0, y: -16.0 };
pub(crate) const SCALE_TEXT: Point<f64> = Point { x: 4.0, y: -12.0 };
pub(crate) const SCALE_END: f64 = 6.0;

/// A bar of a round length.
pub(crate) struct ScaleBar {
    pub(crate) length_m: f64,
    pub(crate) length_px: f64,
}

pub(crate) fn scale_bar(view: &View) -> ScaleBar {
    let length_m = round_step(SCALE_LEAST_PX / view.px_per_m());
    ScaleBar {
        length_m,
        length_px: length_m * view.px_per_m(),
    }
}

fn faded(color: Rgba, opacity: f32) -> Rgba {
    Rgba {
        a: (255.0 * opacity).round() as u8,
        ..color
    }
}
