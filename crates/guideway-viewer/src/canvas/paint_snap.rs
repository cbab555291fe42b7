//! Paints the place to which the pointer snaps: a marker, and its name.

use eframe::egui::{FontId, Painter, Pos2, Shape, Stroke, StrokeKind, Vec2, vec2};
use guideway_document::{SnapTarget, Snapped};
use guideway_scene::View;

use super::paint_draw_list::{TextBox, color32};
use super::paint_gesture::HOVER_COLOR;
use super::screen::Screen;
use crate::display_settings::DisplaySettings;
use crate::language::t;

/// Half the size of a marker, in points.
const RADIUS: f32 = 6.0;
const TEXT_POINTS: f32 = 12.0;
/// Place of the name beside the marker, below that of dimensions.
const NAME_OFFSET: Vec2 = vec2(12.0, 14.0);

/// Paints the marker and the name of a snapped position.
pub(super) fn paint_snap(
    painter: &Painter,
    screen: Screen,
    view: &View,
    settings: &DisplaySettings,
    snapped: &Snapped,
) {
    let Some(target) = snapped.to else { return };
    let at = screen.point(view.pixel_from_world(snapped.at_m));
    painter.extend(marker(target, at));
    let name = TextBox {
        text: t(target.name()),
        font: FontId::proportional(TEXT_POINTS),
        color: color32(settings.decoration_style(1.0).ink),
        background: color32(settings.background()).gamma_multiply(0.75),
        offset: NAME_OFFSET,
    };
    name.paint(painter, at);
}

/// The marks of CAD: a circle at a node, a square at an end, a triangle at a middle, a cross at a
/// crossing.
fn marker(target: SnapTarget, at: Pos2) -> Vec<Shape> {
    let stroke = Stroke::new(2.0, HOVER_COLOR);
    let line = |from: (f32, f32), to: (f32, f32)| {
        let place = |(x, y): (f32, f32)| at + vec2(x, y) * RADIUS;
        Shape::line_segment([place(from), place(to)], stroke)
    };
    match target {
        SnapTarget::Node(_) => vec![Shape::circle_stroke(at, RADIUS, stroke)],
        SnapTarget::End => {
            let square = eframe::egui::Rect::from_center_size(at, Vec2::splat(2.0 * RADIUS));
            vec![Shape::rect_stroke(square, 0.0, stroke, StrokeKind::Middle)]
        }
        SnapTarget::Middle => {
            let corners = [(0.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let corners = corners.map(|(x, y)| at + vec2(x, y) * RADIUS);
            vec![Shape::closed_line(corners.into(), stroke)]
        }
        SnapTarget::Crossing => vec![
            line((-1.0, -1.0), (1.0, 1.0)),
            line((-1.0, 1.0), (1.0, -1.0)),
        ],
        SnapTarget::Perpendicular => vec![
            line((-1.0, -1.0), (-1.0, 1.0)),
            line((-1.0, 1.0), (1.0, 1.0)),
            line((-1.0, 0.0), (0.0, 0.0)),
            line((0.0, 0.0), (0.0, 1.0)),
        ],
        SnapTarget::Tangent => vec![
            Shape::circle_stroke(at, 0.7 * RADIUS, stroke),
            line((-1.0, -0.7), (1.0, -0.7)),
        ],
        SnapTarget::Direction | SnapTarget::Grid => {
            vec![line((-1.0, 0.0), (1.0, 0.0)), line((0.0, -1.0), (0.0, 1.0))]
        }
    }
}
