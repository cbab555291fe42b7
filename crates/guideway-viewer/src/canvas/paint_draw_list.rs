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

/// Greatest height of a [`TextBox`] above or below its point, in points.
const BOX_REACH: f32 = 24.0;

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
    let color = color32(text.color);
    let [width, size] =
        [text.width_px(), text.height_px()].map(|px| px as f32 / screen.px_per_point);
    let layout =
        |size| painter.layout_no_wrap(text.text.clone(), FontId::proportional(size), color);
    let mut galley = layout(size);
    // Names are placed by the width that they have in pictures, whose font is monospaced: few are
    // wider in the font of the window.
    if galley.size().x > width && width > 0.0 {
        galley = layout(size * width / galley.size().x);
    }
    let spare = width - galley.size().x;
    let angle = text.angle_rad as f32;
    let corner = Vec2::new(text.anchor as f32 * spare, -galley.size().y / 2.0);
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

/// A text over a filled box beside a point.
pub(super) struct TextBox<'a> {
    pub(super) text: &'a str,
    pub(super) font: FontId,
    pub(super) color: Color32,
    pub(super) background: Color32,
    /// From the point to the middle of the left edge of the box.
    pub(super) offset: Vec2,
}

impl TextBox<'_> {
    /// Paints the box inside of the clip rectangle: on the other side of the point where it would
    /// exceed the right edge, and higher or lower near the other edges.
    pub(super) fn paint(&self, painter: &Painter, at: Pos2) {
        let font = self.font.clone();
        let galley = painter.layout_no_wrap(self.text.to_owned(), font, self.color);
        let rect = self.place(galley.size(), painter.clip_rect(), at);
        painter.rect_filled(rect, 2.0, self.background);
        painter.galley(rect.min, galley, self.color);
    }

    /// The place of a box of this size.
    fn place(&self, size: Vec2, clip: Rect, at: Pos2) -> Rect {
        let (left, most) = (at.x + self.offset.x, clip.right() - size.x);
        let left = match left <= most {
            true => left,
            // The point itself may be outside.
            false => most.min(at.x - self.offset.x - size.x),
        };
        // Boxes at one point keep their distance.
        let (top, bottom) = (clip.top() + BOX_REACH, clip.bottom() - BOX_REACH);
        let middle = at.y.min(bottom).max(top) + self.offset.y;
        let corner = pos2(left.max(clip.left()), middle - size.y / 2.0);
        Rect::from_min_size(corner, size)
    }
}

/// Straight alpha to the premultiplied alpha of egui.
pub(super) fn color32(rgba: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(rgba.r, rgba.g, rgba.b, rgba.a)
}

#[cfg(test)]
mod tests {
    use eframe::egui::{Context, RawInput, Shape};

    use super::*;

    #[test]
    fn letters_keep_to_the_end_of_their_space_that_the_anchor_names() {
        let ctx = Context::default();
        let screen = Screen {
            rect: Rect::from_min_size(pos2(10.0, 20.0), Vec2::splat(400.0)),
            px_per_point: 2.0,
        };
        // A space of five columns, from 60 to 93 points.
        let (left, right) = (60.0, 93.0);
        for (anchor, place) in [(0.0, left), (0.5, (left + right) / 2.0), (1.0, right)] {
            let list = DrawList {
                texts: vec![TextLine {
                    text: "n12 4".into(),
                    left_middle_px: Point::new(100.0, 50.0),
                    angle_rad: 0.0,
                    anchor,
                    char_width_px: 13.2,
                    color: Rgba::BLACK,
                    halo: Rgba::from_u32(0),
                }],
                ..DrawList::default()
            };
            let mut output = ctx.run_ui(RawInput::default(), |ui| {
                paint_draw_list(ui.painter(), screen, &list);
            });
            output.textures_delta.clear();
            let mut texts = output.shapes.iter().filter_map(|shape| match &shape.shape {
                Shape::Text(text) => Some(text),
                _ => None,
            });
            let text = texts.next().expect("it is painted");
            let width = text.galley.size().x;
            assert!(width > 20.0 && width < right - left, "{width}");
            let at = text.pos.x + anchor as f32 * width;
            assert!((at - place).abs() < 0.01, "{anchor}: {at}");
        }
    }

    #[test]
    fn boxes_stay_inside_and_apart_at_every_edge() {
        let clip = Rect::from_min_size(pos2(10.0, 20.0), Vec2::new(300.0, 200.0));
        let size = Vec2::new(120.0, 16.0);
        let place = |offset: f32, at: Pos2| {
            let text_box = TextBox {
                text: "",
                font: FontId::default(),
                color: Color32::BLACK,
                background: Color32::WHITE,
                offset: Vec2::new(12.0, offset),
            };
            text_box.place(size, clip, at)
        };
        for x in [-50.0, 10.0, 100.0, 250.0, 310.0, 400.0] {
            for y in [-50.0, 20.0, 30.0, 120.0, 210.0, 220.0, 400.0] {
                let at = pos2(x, y);
                let [above, below] = [-12.0, 14.0].map(|offset| place(offset, at));
                for rect in [above, below] {
                    assert!(clip.contains_rect(rect), "{at:?} {rect:?}");
                    assert!(!rect.x_range().contains(x), "{at:?} {rect:?}");
                }
                assert!(above.bottom() < below.top(), "{at:?}");
            }
        }
        assert_eq!(place(-12.0, pos2(100.0, 120.0)).min, pos2(112.0, 100.0));
    }
}
