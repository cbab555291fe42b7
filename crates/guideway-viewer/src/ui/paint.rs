use eframe::egui::{
    Color32, FontId, Mesh, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, TextureHandle, Ui, Vec2,
    pos2,
};
use guideway_document::PathSet;
use guideway_document::decorations::{Outline, handles, legend, outline, scale_bar};
use guideway_scene::View;
use guideway_spline::Point;

use super::canvas::Screen;
use super::draw_list::{color, paint_draw_list};
use crate::app::{App, Gesture, Look, Tool};

const SELECTED: Color32 = Color32::from_rgb(30, 120, 255);
pub(super) const HOVERED: Color32 = Color32::from_rgb(255, 140, 0);
/// Least width of an outline, in points.
pub(super) const OUTLINE: f32 = 2.5;
/// Opacity of the paper behind texts over the picture.
const LABEL_PAPER_OPACITY: f32 = 0.75;

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
        paint_draw_list(&painter, screen, &self.grid_list(view));
        self.swept.drawn.shown().into_iter().for_each(lay);
        let pictures = self.seen_layers().filter_map(|layer| layer.shown.as_ref());
        pictures.for_each(|shown| lay((&shown.texture, &shown.view)));
        self.paint_overlay(&painter, screen, view);
        self.paint_gesture(&painter, screen, view);
        let style = self.decoration_style();
        paint_draw_list(&painter, screen, &scale_bar(view, &style));
        let colors = self
            .document()
            .and_then(|document| document.scene().legend());
        if let Some((list, _)) = colors.and_then(|colors| legend(colors, view.size(), 0.0, &style))
        {
            paint_draw_list(&painter, screen, &list);
        }
        self.paint_troubles(&painter, screen);
    }

    fn ink(&self) -> Color32 {
        color(self.look.mark_ink())
    }

    fn paint_overlay(&mut self, painter: &Painter, screen: Screen, view: &View) {
        let scale = f64::from(screen.px_per_point);
        let options = self.mark_options();
        let style = self.decoration_style();
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
        let to_view = |pixel: Point<f64>| {
            if made.view == *view {
                return pixel;
            }
            view.pixel_from_world(made.view.world_from_pixel(pixel))
        };
        let now = |pixel: Point<f64>| screen.point(to_view(pixel));
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
        paint_draw_list(painter, screen, &made.marks.draw(&style, to_view));
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
