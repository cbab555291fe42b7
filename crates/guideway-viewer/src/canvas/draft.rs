//! Paints the path that is drawn, or the polyline that is measured, with its dimensions.

use eframe::egui::{FontId, Painter, Pos2, Stroke, Vec2};
use guideway_document::decorations::path_outline;
use guideway_document::measure::bends;
use guideway_document::text_format;
use guideway_layout::Layout;
use guideway_scene::View;
use guideway_spline::Point;

use super::paint_draw_list::{TextBox, color32};
use super::paint_gesture::{HOVER_COLOR, MIN_OUTLINE_WIDTH, paint_outline};
use super::screen::Screen;
use super::shape_text::{is_bent, shape_text};
use crate::display_settings::DisplaySettings;
use crate::language::say;

const TEXT_POINTS: f32 = 13.0;
/// Opacity of the box behind the dimensions.
const BACKGROUND_OPACITY: f32 = 0.75;

/// A path being drawn, or a polyline being measured.
pub(super) struct Draft<'a> {
    /// The points so far and the one at the pointer, in meters.
    pub(super) points_m: &'a [Point<f64>],
    /// The paths through them; `None` for a measured polyline, or if there are no such paths.
    pub(super) paths: Option<&'a Layout>,
    /// True if some points are control points, which lines join with the ends.
    pub(super) has_handles: bool,
}

impl Draft<'_> {
    /// Paints points, lines between them, paths and dimensions.
    pub(super) fn paint(
        &self,
        painter: &Painter,
        screen: Screen,
        view: &View,
        settings: &DisplaySettings,
    ) {
        let place = |&at_m| screen.point(view.pixel_from_world(at_m));
        let corners: Vec<Pos2> = self.points_m.iter().map(place).collect();
        for at in &corners {
            painter.circle_filled(*at, 3.0, HOVER_COLOR);
        }
        let Some(&last) = corners.last() else {
            return;
        };
        let is_single = |layout: &&Layout| layout.paths.len() == 1;
        let text = match self.paths.filter(is_single) {
            Some(layout) => {
                let path = layout.paths.get(0);
                let bends = bends(path);
                match self.points_m.len() > 2 || is_bent(&bends) {
                    true => shape_text(path, &bends),
                    false => dimensions(self.points_m),
                }
            }
            None => dimensions(self.points_m),
        };
        match self.paths {
            Some(layout) => {
                if self.has_handles {
                    painter.line(corners, Stroke::new(1.0, HOVER_COLOR.gamma_multiply(0.5)));
                }
                let stroke = Stroke::new(MIN_OUTLINE_WIDTH, HOVER_COLOR);
                for path in layout.paths.iter() {
                    let outline = path_outline(path, view);
                    paint_outline(painter, &outline, stroke, |pixel| screen.point(pixel));
                }
            }
            None => {
                painter.line(corners, Stroke::new(1.5, HOVER_COLOR));
            }
        }
        let background = color32(settings.background()).gamma_multiply(BACKGROUND_OPACITY);
        let text_box = TextBox {
            text: &text,
            font: FontId::proportional(TEXT_POINTS),
            color: color32(settings.decoration_style(1.0).ink),
            background,
            offset: Vec2::new(12.0, -12.0),
        };
        text_box.paint(painter, last);
    }
}

/// Length and angle of the last line, and the total length of several lines.
fn dimensions(points: &[Point<f64>]) -> String {
    let lengths = points.array_windows().map(|[a, b]| a.distance(*b));
    let (last_m, total_m) = lengths.fold((0.0, 0.0), |(_, sum), length| (length, sum + length));
    let Some([a, b]) = points.last_chunk() else {
        return String::new();
    };
    let along = *b - *a;
    let angle = along.y.atan2(along.x).to_degrees();
    let last = say!(
        "{length} at {angle}°",
        length = text_format::length(last_m),
        angle = format!("{angle:.1}")
    );
    if points.len() > 2 {
        say!(
            "{last}, {total} in total",
            last,
            total = text_format::length(total_m)
        )
    } else {
        last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dimensions_give_the_last_line_and_the_total() {
        let points = [(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)].map(|(x, y)| Point::new(x, y));
        assert_eq!(dimensions(&points[..1]), "");
        assert_eq!(dimensions(&points[..2]), "3 m at 0.0°");
        assert_eq!(dimensions(&points), "4 m at 90.0°, 7 m in total");
    }
}
