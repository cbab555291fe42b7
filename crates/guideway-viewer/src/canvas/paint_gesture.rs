//! Paints outlines of paths, handles of control points, and selection boxes.

use eframe::egui::{Color32, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, Vec2};
use guideway_document::decorations::{Handle, Outline};
use guideway_spline::Point;

use super::screen::Screen;

pub(crate) const SELECTION_COLOR: Color32 = Color32::from_rgb(30, 120, 255);
pub(crate) const HOVER_COLOR: Color32 = Color32::from_rgb(255, 140, 0);
/// Least width of an outline, in points.
pub(super) const MIN_OUTLINE_WIDTH: f32 = 2.5;
/// Width of the glow of an outline on both sides together, in points.
const GLOW_WIDTH: f32 = 8.0;
const GLOW_OPACITY: f32 = 0.25;
/// Most lines that glow: more stand out by themselves, and each takes a second line.
const MAX_GLOWING: usize = 64;
/// Radius of the ring around a selected node or station, in points: outside of the largest symbol.
const RING_RADIUS: f32 = 11.0;
/// Side of the square of a handle, in points.
const HANDLE_SIZE: f32 = 7.0;

/// Paints the outline of paths; `to_screen` maps its pixels to points of the window.
pub(super) fn paint_outline(
    painter: &Painter,
    outline: &Outline,
    stroke: Stroke,
    to_screen: impl Fn(Point<f64>) -> Pos2,
) {
    painter.extend(outline_shapes(outline, stroke, to_screen));
}

/// The shapes of the outline of paths.
pub(super) fn outline_shapes(
    outline: &Outline,
    stroke: Stroke,
    to_screen: impl Fn(Point<f64>) -> Pos2,
) -> Vec<Shape> {
    match outline {
        Outline::Lines(lines) => {
            let shape = |line: &Vec<Point<f64>>| match line[..] {
                // Most lines of a whole site are this short, and need no list of points.
                [start, end] => Shape::line_segment([to_screen(start), to_screen(end)], stroke),
                _ => Shape::line(line.iter().map(|&p| to_screen(p)).collect(), stroke),
            };
            lines.iter().map(shape).collect()
        }
        Outline::Cells(cells, side) => {
            let mut mesh = Mesh::default();
            mesh.reserve_triangles(2 * cells.len());
            mesh.reserve_vertices(4 * cells.len());
            let far = Point::new(*side, *side);
            for &cell in cells {
                let rect = Rect::from_two_pos(to_screen(cell), to_screen(cell + far));
                mesh.add_colored_rect(rect, stroke.color.gamma_multiply(0.5));
            }
            vec![mesh.into()]
        }
    }
}

/// Paints the outline of paths with a glow, which stands out over lines and marks of any color.
/// Cells are areas, which stand out without.
pub(super) fn paint_glowing(
    painter: &Painter,
    outline: &Outline,
    stroke: Stroke,
    to_screen: impl Fn(Point<f64>) -> Pos2,
) {
    if let Outline::Lines(lines) = outline
        && lines.len() <= MAX_GLOWING
    {
        let glow = stroke.color.gamma_multiply(GLOW_OPACITY);
        let wide = Stroke::new(stroke.width + GLOW_WIDTH, glow);
        paint_outline(painter, outline, wide, &to_screen);
    }
    paint_outline(painter, outline, stroke, to_screen);
}

/// Paints rings around nodes and stations.
pub(super) fn paint_rings(
    painter: &Painter,
    at_px: &[Point<f64>],
    color: Color32,
    to_screen: impl Fn(Point<f64>) -> Pos2,
) {
    let stroke = Stroke::new(MIN_OUTLINE_WIDTH, color);
    for &at_px in at_px {
        painter.circle_stroke(to_screen(at_px), RING_RADIUS, stroke);
    }
}

/// Paints the control polygon of the selected paths and its handles.
pub(super) fn paint_handles(painter: &Painter, screen: Screen, handles: &[Handle]) {
    for [before, after] in handles.array_windows() {
        if after.follows {
            let ends = [before, after].map(|handle| screen.point(handle.at_px));
            painter.line_segment(ends, Stroke::new(1.0, SELECTION_COLOR.gamma_multiply(0.5)));
        }
    }
    for handle in handles {
        let rect = Rect::from_center_size(screen.point(handle.at_px), Vec2::splat(HANDLE_SIZE));
        let stroke = Stroke::new(1.5, SELECTION_COLOR);
        painter.rect(rect, 1.0, Color32::WHITE, stroke, StrokeKind::Middle);
    }
}

/// Paints a selection box between two opposite corners, in pixels.
pub(super) fn paint_box(painter: &Painter, screen: Screen, a: Point<f64>, b: Point<f64>) {
    let rect = Rect::from_two_pos(screen.point(a), screen.point(b));
    painter.rect_filled(rect, 0.0, SELECTION_COLOR.gamma_multiply(0.12));
    let stroke = Stroke::new(1.0, SELECTION_COLOR);
    painter.rect_stroke(rect, 0.0, stroke, StrokeKind::Middle);
}
