use eframe::egui::{
    Align2, Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, TextureHandle,
    Ui, Vec2, pos2,
};
use guideway_document::decorations::{Marks, Outline, handles, outline};
use guideway_document::{PathSet, grid_lines_px};
use guideway_scene::Rgba;
use guideway_scene::View;
use guideway_spline::Point;

use super::canvas::Screen;
use crate::app::sheets::{
    GRID_LEAST_PX, GRID_OPACITY, LABEL_PAPER_OPACITY, LABEL_POINTS, SCALE_END, SCALE_LEFT,
    SCALE_TEXT, scale_bar,
};
use crate::app::{App, Gesture, Look, Tool};

const SELECTED: Color32 = Color32::from_rgb(30, 120, 255);
pub(super) const HOVERED: Color32 = Color32::from_rgb(255, 140, 0);
/// Least width of an outline, in points.
pub(super) const OUTLINE: f32 = 2.5;

impl App {
    pub(super) fn paint(&mut self, ui: &Ui, screen: Screen, view: &View) {
        let painter = ui.painter_at(screen.rect);
        painter.rect_filled(screen.rect, 0.0, color(self.look.paper()));
        // What was last drawn, where it is now: at once, and sharp when the new picture comes.
        let lay = |(texture, of): (&TextureHandle, &View)| {
            let place = mapped(screen, of, view);
            let all = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            painter.image(texture.id(), place, all, Color32::WHITE);
        };
        self.floor.drawn.shown().into_iter().for_each(lay);
        if self.look.has_grid {
            self.paint_grid(&painter, screen, view);
        }
        self.swept.drawn.shown().into_iter().for_each(lay);
        let pictures = self.seen_layers().filter_map(|layer| layer.shown.as_ref());
        pictures.for_each(|shown| lay((&shown.texture, &shown.view)));
        self.paint_overlay(&painter, screen, view);
        self.paint_gesture(&painter, screen, view);
        self.paint_scale(&painter, screen, view);
        self.paint_legend(&painter, screen);
        self.paint_troubles(&painter, screen);
    }

    fn ink(&self) -> Color32 {
        color(self.look.mark_ink())
    }

    fn paint_grid(&self, painter: &Painter, screen: Screen, view: &View) {
        let stroke = Stroke::new(1.0, self.ink().gamma_multiply(GRID_OPACITY));
        let [x_px, y_px] = grid_lines_px(view, GRID_LEAST_PX);
        for x in x_px {
            let at = screen.point(Point::new(x, 0.0));
            painter.vline(at.x, screen.rect.y_range(), stroke);
        }
        for y in y_px {
            let at = screen.point(Point::new(0.0, y));
            painter.hline(screen.rect.x_range(), at.y, stroke);
        }
    }

    fn paint_overlay(&mut self, painter: &Painter, screen: Screen, view: &View) {
        let scale = f64::from(screen.px_per_point);
        let options = self.mark_options();
        let hovered = self.hovered().copied();
        let (patience, wake) = (self.patience, &self.wake);
        let Some(layer) = self.layers.get_mut(self.active) else {
            return;
        };
        if !layer.is_visible {
            return;
        }
        if let Some(document) = &layer.document {
            let overlay = &mut layer.overlay;
            overlay.ask(document, view, &options, patience, wake);
        }
        let document = layer.document.as_deref();
        let Some(made) = layer.overlay.last() else {
            return;
        };
        let now = |pixel: Point<f64>| {
            if made.view == *view {
                return screen.point(pixel);
            }
            screen.point(view.pixel_from_world(made.view.world_from_pixel(pixel)))
        };
        // Half as wide as lines are, so that it shows on wide ones too.
        let rule = self.look.line_rule();
        let line_width = 2.0 * rule.radius_px(None, view.px_per_m()) / scale;
        let outlined = |color| Stroke::new(OUTLINE.max(line_width as f32 / 2.0), color);
        paint_outline(painter, &made.selection, outlined(SELECTED), now);
        if let Gesture::Move { by_m, .. } = self.gesture {
            let by_px = Vec2::new(by_m.x as f32, -by_m.y as f32) * (view.px_per_m() / scale) as f32;
            paint_outline(painter, &made.selection, outlined(HOVERED), |pixel| {
                now(pixel) + by_px
            });
        }
        if let (Some(hit), Some(document)) = (hovered, document) {
            let lines = outline(document, &PathSet::from_iter([hit.path]), view);
            paint_outline(painter, &lines, outlined(HOVERED), |pixel| {
                screen.point(pixel)
            });
        }
        paint_marks(painter, &made.marks, &self.look, now);
        if let (Tool::Points, Some(document)) = (self.tool, document) {
            paint_handles(painter, screen, &handles(document, view));
        }
    }

    fn paint_gesture(&self, painter: &Painter, screen: Screen, view: &View) {
        match &self.gesture {
            Gesture::Box { from_px, to_px } => {
                let rect = Rect::from_two_pos(screen.point(*from_px), screen.point(*to_px));
                painter.rect_filled(rect, 0.0, SELECTED.gamma_multiply(0.12));
                painter.rect_stroke(rect, 0.0, Stroke::new(1.0, SELECTED), StrokeKind::Middle);
            }
            Gesture::Points(points) => self.paint_draft(painter, screen, view, points),
            _ => {}
        }
    }

    fn paint_scale(&self, painter: &Painter, screen: Screen, view: &View) {
        let by = |p: Point<f64>| Vec2::new(p.x as f32, p.y as f32);
        let bar = scale_bar(view);
        let length = bar.length_px as f32 / screen.px_per_point;
        let left = screen.rect.left_bottom() + by(SCALE_LEFT);
        let right = left + Vec2::new(length, 0.0);
        let stroke = Stroke::new(2.0, self.ink());
        painter.line_segment([left, right], stroke);
        for end in [left, right] {
            painter.line_segment([end, end - Vec2::new(0.0, SCALE_END as f32)], stroke);
        }
        self.write(painter, left + by(SCALE_TEXT), &length_text(bar.length_m));
    }

    fn paint_legend(&self, painter: &Painter, screen: Screen) {
        let Some(legend) = self
            .document()
            .and_then(|document| document.scene().legend())
        else {
            return;
        };
        let line = 18.0;
        let corner = screen.rect.min + Vec2::splat(12.0);
        let size = Vec2::new(220.0, line * (legend.entries.len() + 1) as f32 + 12.0);
        let paper = color(self.look.paper()).gamma_multiply(0.85);
        painter.rect_filled(Rect::from_min_size(corner, size), 4.0, paper);
        let mut at = corner + Vec2::new(8.0, 6.0 + line / 2.0);
        self.write(painter, at, &legend.column);
        for entry in &legend.entries {
            at.y += line;
            let swatch = Rect::from_center_size(at + Vec2::new(12.0, 0.0), Vec2::new(24.0, 8.0));
            painter.rect_filled(swatch, 1.0, color(entry.color));
            let label = match entry.paths {
                Some(paths) => format!("{} ({paths})", shortened(&entry.label)),
                None => shortened(&entry.label),
            };
            self.write(painter, at + Vec2::new(32.0, 0.0), &label);
        }
    }

    fn paint_troubles(&self, painter: &Painter, screen: Screen) {
        let troubles = self.layers.iter().filter_map(|layer| {
            let trouble = layer.trouble.as_ref()?;
            Some(format!("{}: {trouble}", layer.name()))
        });
        let greeting = "Drop a layout file here, or open one with Ctrl+O";
        let nothing = self.layers.is_empty().then(|| greeting.to_owned());
        let width = screen.rect.width() - 32.0;
        let mut at = screen.rect.center_top() + Vec2::new(0.0, 40.0);
        for text in nothing.into_iter().chain(troubles) {
            let font = FontId::proportional(15.0);
            let galley = painter.layout(text, font, self.ink(), width.max(50.0));
            let corner = at - Vec2::new(galley.size().x / 2.0, 0.0);
            let back = Rect::from_min_size(corner, galley.size()).expand(8.0);
            painter.rect_filled(back, 4.0, color(self.look.paper()));
            at.y += galley.size().y + 20.0;
            painter.galley(corner, galley, self.ink());
        }
    }

    fn write(&self, painter: &Painter, left_middle: Pos2, text: &str) {
        let font = FontId::proportional(13.0);
        painter.text(left_middle, Align2::LEFT_CENTER, text, font, self.ink());
    }
}

/// Where a picture of one view lies on the screen that shows another.
fn mapped(screen: Screen, of: &View, on: &View) -> Rect {
    let bounds = of.world_bounds();
    let corner = |at| screen.point(on.pixel_from_world(at));
    Rect::from_two_pos(corner(bounds.min), corner(bounds.max))
}

pub(super) fn paint_outline(
    painter: &Painter,
    outline: &Outline,
    stroke: Stroke,
    to_screen: impl Fn(Point<f64>) -> Pos2,
) {
    match outline {
        Outline::Lines(lines) => {
            let shape = |line: &Vec<Point<f64>>| {
                let points: Vec<Pos2> = line.iter().map(|&p| to_screen(p)).collect();
                Shape::line(points, stroke)
            };
            painter.extend(lines.iter().map(shape));
        }
        Outline::Cells(cells, side) => {
            let mut mesh = Mesh::default();
            let far = Point::new(*side, *side);
            for &cell in cells {
                let rect = Rect::from_two_pos(to_screen(cell), to_screen(cell + far));
                mesh.add_colored_rect(rect, stroke.color.gamma_multiply(0.5));
            }
            painter.add(mesh);
        }
    }
}

/// All arrows and symbols in one mesh each.
fn paint_marks(
    painter: &Painter,
    marks: &Marks,
    look: &Look,
    to_screen: impl Fn(Point<f64>) -> Pos2,
) {
    let mut mesh = Mesh::default();
    let place = |pixel| {
        let at = to_screen(pixel);
        Point::new(f64::from(at.x), f64::from(at.y))
    };
    marks.draw_shapes(1.0, place, |kind, corners| {
        let first = mesh.vertices.len() as u32;
        for at in corners {
            mesh.colored_vertex(pos2(at.x as f32, at.y as f32), color(look.mark_color(kind)));
        }
        for next in 1..corners.len() as u32 - 1 {
            mesh.add_triangle(first, first + next, first + next + 1);
        }
    });
    painter.add(mesh);
    let font = FontId::monospace(LABEL_POINTS);
    for label in &marks.labels {
        write_on_paper(
            painter,
            look,
            to_screen(label.at_px),
            &label.text,
            font.clone(),
        );
    }
}

/// Writes over whatever is there, and keeps that from making it hard to read.
pub(super) fn write_on_paper(
    painter: &Painter,
    look: &Look,
    left_middle: Pos2,
    text: &str,
    font: FontId,
) {
    let ink = color(look.mark_ink());
    let galley = painter.layout_no_wrap(text.to_owned(), font, ink);
    let corner = left_middle - Vec2::new(0.0, galley.size().y / 2.0);
    let back = Rect::from_min_size(corner, galley.size());
    painter.rect_filled(
        back,
        2.0,
        color(look.paper()).gamma_multiply(LABEL_PAPER_OPACITY),
    );
    painter.galley(corner, galley, ink);
}

fn paint_handles(
    painter: &Painter,
    screen: Screen,
    handles: &[guideway_document::decorations::Handle],
) {
    for [before, after] in handles.array_windows() {
        if after.follows {
            let ends = [before, after].map(|handle| screen.point(handle.at_px));
            painter.line_segment(ends, Stroke::new(1.0, SELECTED.gamma_multiply(0.5)));
        }
    }
    for handle in handles {
        let rect = Rect::from_center_size(screen.point(handle.at_px), Vec2::splat(7.0));
        painter.rect(
            rect,
            1.0,
            Color32::WHITE,
            Stroke::new(1.5, SELECTED),
            StrokeKind::Middle,
        );
    }
}

pub(crate) fn length_text(length_m: f64) -> String {
    match length_m {
        m if m >= 10_000.0 => format!("{} km", rounded(m / 1000.0)),
        m if m >= 1.0 => format!("{} m", rounded(m)),
        m => format!("{} mm", rounded(m * 1000.0)),
    }
}

/// To a thousandth, without zeros at the end.
fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}

fn shortened(label: &str) -> String {
    label.chars().take(24).collect()
}

fn color(rgba: Rgba) -> Color32 {
    Color32::from_rgba_unmultiplied(rgba.r, rgba.g, rgba.b, rgba.a)
}
