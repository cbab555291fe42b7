//! Paints draw lists: polygons as one mesh, texts in the monospaced font of the window.

use eframe::egui::{Color32, FontId, Mesh, Painter, Rect, Vec2};
use guideway_scene::{DrawList, Fill, Rgba, TextLine};

use super::canvas::Screen;

/// Paints a draw list, whose coordinates are pixels of the picture.
pub(super) fn paint_draw_list(painter: &Painter, screen: Screen, list: &DrawList) {
    let mut mesh = Mesh::default();
    for fill in &list.fills {
        add_fill(&mut mesh, screen, fill);
    }
    painter.add(mesh);
    for text in &list.texts {
        paint_text(painter, screen, text);
    }
}

/// Adds each polygon as a fan of triangles.
fn add_fill(mesh: &mut Mesh, screen: Screen, fill: &Fill) {
    for corners in &fill.polygons {
        let first = mesh.vertices.len() as u32;
        for &corner in corners {
            mesh.colored_vertex(screen.point(corner), color(fill.color));
        }
        for next in 1..(corners.len() as u32).saturating_sub(1) {
            mesh.add_triangle(first, first + next, first + next + 1);
        }
    }
}

fn paint_text(painter: &Painter, screen: Screen, text: &TextLine) {
    let height_px = text.char_width_px / TextLine::CHAR_ASPECT;
    let font = FontId::monospace(height_px as f32 / screen.px_per_point);
    let galley = painter.layout_no_wrap(text.text.clone(), font, color(text.color));
    let corner = screen.point(text.left_middle_px) - Vec2::new(0.0, galley.size().y / 2.0);
    if text.background.a > 0 {
        let bounds = Rect::from_min_size(corner, galley.size());
        painter.rect_filled(bounds, 2.0, color(text.background));
    }
    painter.galley(corner, galley, color(text.color));
}

pub(super) fn color(rgba: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(rgba.r, rgba.g, rgba.b, rgba.a)
}
