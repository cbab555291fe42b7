//! Paints a draw list with egui.

use std::sync::Arc;

use eframe::egui::emath::Rot2;
use eframe::egui::epaint::TextShape;
use eframe::egui::{Color32, FontId, Mesh, Painter, Pos2, Rect, Vec2, pos2};
use guideway_scene::{DrawList, Rgba, TextLine};
use guideway_spline::Point;

use super::screen::Screen;

/// Distance of the copies of a text that are its halo along each axis, per unit of its width.
/// Derived: four copies toward the corners reach as far as the halo.
const HALO_PART: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// Paints all fills as one mesh, then the texts.
pub(super) fn paint_draw_list(painter: &Painter, screen: Screen, list: &DrawList) {
    let mut mesh = Mesh::default();
    for fill in &list.fills {
        let color = color32(fill.color);
        for corners in &fill.polygons {
            add_polygon(&mut mesh, color, screen, corners);
        }
    }
    painter.add(mesh);
    for text in &list.texts {
        paint_text(painter, screen, text);
    }
}

/// Adds a convex polygon as a fan of triangles.
fn add_polygon(mesh: &mut Mesh, color: Color32, screen: Screen, corners: &[Point<f64>]) {
    let first = mesh.vertices.len() as u32;
    for &corner in corners {
        let at = screen.point(corner);
        mesh.colored_vertex(pos2(at.x, at.y), color);
    }
    for next in 1..(corners.len() as u32).saturating_sub(1) {
        mesh.add_triangle(first, first + next, first + next + 1);
    }
}

fn paint_text(painter: &Painter, screen: Screen, text: &TextLine) {
    let font = FontId::monospace(text.height_px() as f32 / screen.px_per_point);
    let color = color32(text.color);
    let galley = painter.layout_no_wrap(text.text.clone(), font, color);
    let angle = text.angle_rad as f32;
    let corner = Vec2::new(0.0, -galley.size().y / 2.0);
    let corner = screen.point(text.left_middle_px) + Rot2::from_angle(angle) * corner;
    let copy = |by: Vec2, color: Color32| {
        let shape = TextShape::new(corner + by, Arc::clone(&galley), color);
        shape.with_angle(angle).with_override_text_color(color)
    };
    if text.halo.a > 0 {
        let reach = HALO_PART * text.halo_px() as f32 / screen.px_per_point;
        let halo = color32(text.halo);
        let corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)];
        painter.extend(corners.map(|(x, y)| copy(Vec2::new(x, y) * reach, halo).into()));
    }
    painter.add(copy(Vec2::ZERO, color));
}

/// Paints a text over a filled box; `left_middle` is the middle of its left edge.
pub(super) fn paint_text_box(
    painter: &Painter,
    left_middle: Pos2,
    text: &str,
    font: FontId,
    color: Color32,
    background: Color32,
) {
    let galley = painter.layout_no_wrap(text.to_owned(), font, color);
    let corner = left_middle - Vec2::new(0.0, galley.size().y / 2.0);
    let rect = Rect::from_min_size(corner, galley.size());
    painter.rect_filled(rect, 2.0, background);
    painter.galley(corner, galley, color);
}

/// Straight alpha to the premultiplied alpha of egui.
pub(super) fn color32(rgba: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(rgba.r, rgba.g, rgba.b, rgba.a)
}
