//! Paints the canvas from its parts, bottom first: background, floor plan, grid, swept areas,
//! layouts, marks, gesture, scale bar, legend, messages.

use eframe::egui::{
    Color32, FontId, Modifiers, Painter, Pos2, Rect, Stroke, TextureId, Vec2, pos2,
};
use guideway_document::decorations::{
    Corner, DecorationStyle, handles, hide_covered_texts, outline, scale_bar,
};
use guideway_document::{Document, Element, PathSet};
use guideway_scene::{DrawList, View};
use guideway_spline::Point;

use super::draft::Draft;
use super::paint_draw_list::{color32, paint_draw_list};
use super::paint_findings::paint_findings;
use super::paint_gesture::{
    HOVER_COLOR, MIN_OUTLINE_WIDTH, SELECTION_COLOR, paint_box, paint_glowing, paint_handles,
    paint_outline, paint_rings,
};
use super::paint_legends::{legends, shown_legends};
use super::paint_moving::paint_moving;
use super::paint_network::paint_network;
use super::paint_snap::paint_snap;
use super::paint_tools::ToolPainter;
use super::paint_typed::paint_typed;
use super::screen::Screen;
use crate::backdrop::{FloorPlanLayer, PlanEditor, PlanTask, SweptAreasLayer};
use crate::compare::Changed;
use crate::display_settings::DisplaySettings;
use crate::editing::MarkedSeverities;
use crate::files::{Layer, OpenFiles, layer_tool_context};
use crate::language::translated;
use crate::network_draft::Drafted;
use crate::route::FoundRoute;
use crate::tools::{Gesture, HoverTarget, OtherHit, Tool, Tools};

const MESSAGE_POINTS: f32 = 15.0;
/// Opacity of the lines of what belongs to a selected level or vehicle type.
const MEMBERS_OPACITY: f32 = 0.5;

/// Everything that the canvas shows, read only.
pub(crate) struct CanvasPainter<'a> {
    pub(crate) screen: Screen,
    pub(crate) view: View,
    pub(crate) pointer_px: Option<Point<f64>>,
    pub(crate) modifiers: Modifiers,
    pub(crate) settings: &'a DisplaySettings,
    pub(crate) files: &'a OpenFiles,
    pub(crate) floor_plan: &'a FloorPlanLayer,
    pub(crate) plan_editor: &'a PlanEditor,
    pub(crate) swept_areas: &'a SweptAreasLayer,
    pub(crate) tools: &'a Tools,
    pub(crate) other_hit: Option<&'a OtherHit>,
    pub(crate) marked_findings: MarkedSeverities,
    /// The route, and the part of it that the vehicle has driven.
    pub(crate) route: Option<(&'a FoundRoute, f32)>,
    /// The other document of a comparison, and the changes from it.
    pub(crate) changes: Option<(&'a Document, &'a Changed)>,
    /// The network that the active file would become.
    pub(crate) network: Option<&'a Drafted>,
}

impl CanvasPainter<'_> {
    /// Paints all parts.
    pub(crate) fn paint(&self, painter: &Painter) {
        let px_per_point = f64::from(self.screen.px_per_point);
        let style = self.settings.decoration_style(px_per_point);
        let list = |list| paint_draw_list(painter, self.screen, &list);
        let background = color32(self.settings.background());
        painter.rect_filled(self.screen.rect, 0.0, background);
        self.paint_floor_plan(painter);
        list(self.settings.grid(&self.view, px_per_point));
        let swept_areas = self.swept_areas.shown();
        let swept_areas = swept_areas.map(|(texture, of)| (texture.id(), of));
        self.paint_picture(painter, swept_areas, 1.0);
        if let Some((route, _)) = self.route {
            self.tool_painter(painter).route_area(route, background);
        }
        for layer in self.files.visible() {
            let shown = layer.picture.shown().filter(|_| layer.look.has_paths);
            let shown = shown.map(|shown| (shown.texture_id(), &shown.view));
            self.paint_picture(painter, shown, layer.look.opacity);
        }
        for marks in self.marks(&style) {
            list(marks);
        }
        if let Some(layer) = self.files.active().filter(|layer| layer.is_visible) {
            self.paint_overlay(painter, layer);
        }
        self.paint_hits_in_others(painter);
        self.paint_tools(painter);
        self.paint_findings(painter);
        self.paint_gesture(painter);
        list(scale_bar(&self.view, &style, Corner::LowerLeft));
        let shown = shown_legends(self.files, self.settings);
        for colors in legends(&shown, self.view.size(), &style) {
            list(colors);
        }
        self.paint_plan_task(painter);
        self.paint_messages(painter);
    }

    /// Paints the floor plan, faded, and moved by a drag.
    fn paint_floor_plan(&self, painter: &Painter) {
        let Some((texture, of)) = self.floor_plan.shown() else {
            return;
        };
        let by = self.floor_plan.shift_m;
        let scale = self.view.px_per_m() / f64::from(self.screen.px_per_point);
        let by = Vec2::new((by.x * scale) as f32, (-by.y * scale) as f32);
        let rect = self.screen.picture_rect(of, &self.view).translate(by);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let opacity = self.floor_plan.drawn_opacity();
        let opacity = (opacity * 255.0).round() as u8;
        painter.image(
            texture.id(),
            rect,
            whole,
            Color32::from_white_alpha(opacity),
        );
    }

    /// Paints the points by which the floor plan is being scaled.
    fn paint_plan_task(&self, painter: &Painter) {
        let PlanTask::Calibrate(points) = &self.plan_editor.task else {
            return;
        };
        let points = points.iter();
        let points = points.map(|at_m| self.screen.point(self.view.pixel_from_world(*at_m)));
        let points: Vec<Pos2> = points.collect();
        let stroke = Stroke::new(2.0, HOVER_COLOR);
        if let [from, to] = points[..] {
            painter.line_segment([from, to], stroke);
        }
        for at in points {
            painter.circle_stroke(at, 5.0, stroke);
        }
    }

    /// Paints the last picture where it belongs in the present view, until the next one is
    /// complete.
    fn paint_picture(&self, painter: &Painter, picture: Option<(TextureId, &View)>, opacity: f32) {
        if let Some((texture, of)) = picture {
            let rect = self.screen.picture_rect(of, &self.view);
            let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
            let tint = Color32::WHITE.gamma_multiply(opacity);
            painter.image(texture, rect, whole, tint);
        }
    }

    /// The marks of the visible files, the active one last.
    fn marks(&self, style: &DecorationStyle) -> Vec<DrawList> {
        let of_layer = |layer: &Layer| {
            let overlay = layer.slot.overlay().last();
            overlay.map_or_else(DrawList::default, |overlay| {
                let place = |pixel| self.placed(&overlay.view, pixel);
                let marks = overlay.marks.draw(style, place);
                marks.faded(f64::from(layer.look.opacity))
            })
        };
        let mut marks: Vec<DrawList> = self.files.visible().map(of_layer).collect();
        hide_covered_texts(&mut marks);
        marks
    }

    /// Paints what the pointer means in a file that is not active, above the marks of all files.
    fn paint_hits_in_others(&self, painter: &Painter) {
        let stroke = Stroke::new(MIN_OUTLINE_WIDTH, HOVER_COLOR);
        let active = self.files.active().map(Layer::path);
        let others = self.files.visible().filter(|l| Some(l.path()) != active);
        for layer in others {
            if let Some(overlay) = layer.slot.overlay().last() {
                let place = |pixel| self.placed(&overlay.view, pixel);
                if let Some(members) = &overlay.highlighted {
                    let to_screen = |pixel| self.screen.point(place(pixel));
                    paint_glowing(painter, &members.paths, stroke, to_screen);
                    paint_rings(painter, &members.symbols, HOVER_COLOR, to_screen);
                }
            }
        }
        let hit = self.other_hit.and_then(|other| {
            let document = self.files.layers().get(other.file)?.document()?;
            Some((document, &other.target))
        });
        match hit {
            Some((document, HoverTarget::Path(hit))) => {
                let lines = outline(document, &PathSet::from_iter([hit.path]), &self.view);
                paint_glowing(painter, &lines, stroke, |pixel| self.screen.point(pixel));
            }
            Some((document, HoverTarget::Symbol(symbol))) => {
                self.paint_hovered_symbol(painter, document, *symbol);
            }
            None => {}
        }
    }

    /// The pixel of the present view at the place of a pixel of another view.
    fn placed(&self, of: &View, pixel: Point<f64>) -> Point<f64> {
        match *of == self.view {
            true => pixel,
            false => self.view.pixel_from_world(of.world_from_pixel(pixel)),
        }
    }

    /// Paints outlines of the active file: above the marks of all files, which would hide them.
    fn paint_overlay(&self, painter: &Painter, layer: &Layer) {
        let Some(overlay) = layer.slot.overlay().last() else {
            return;
        };
        let (view, screen) = (&self.view, self.screen);
        let place = |pixel: Point<f64>| self.placed(&overlay.view, pixel);
        let to_screen = |pixel| screen.point(place(pixel));
        let scale = f64::from(screen.px_per_point);
        // Half the width of the lines, so that the outline shows on wide lines too.
        let radius_px = self
            .settings
            .line_rule(layer.widths, scale)
            .radius_px(None, view.px_per_m());
        let stroke = |color| Stroke::new(MIN_OUTLINE_WIDTH.max((radius_px / scale) as f32), color);
        let (selected, hovered) = (stroke(SELECTION_COLOR), stroke(HOVER_COLOR));
        if let Gesture::Move { by_m, .. } = self.tools.gesture() {
            // A moving selection stands out by itself, without a glow.
            let by = Vec2::new(by_m.x as f32, -by_m.y as f32) * (view.px_per_m() / scale) as f32;
            let outline = &overlay.selection;
            let strokes = [selected, hovered];
            if overlay.view != *view || !paint_moving(painter, screen, overlay, strokes, by) {
                paint_outline(painter, outline, selected, to_screen);
                paint_outline(painter, outline, hovered, |pixel| to_screen(pixel) + by);
            }
        } else {
            paint_glowing(painter, &overlay.selection, selected, to_screen);
        }
        let document = layer.document();
        if let (Some(hit), Some(document)) = (self.tools.hovered(document), document) {
            let lines = outline(document, &PathSet::from_iter([hit.path]), view);
            paint_glowing(painter, &lines, hovered, |pixel| screen.point(pixel));
        }
        paint_rings(painter, &overlay.symbols, SELECTION_COLOR, to_screen);
        if let (Some(symbol), Some(document)) = (self.tools.hovered_symbol(document), document) {
            self.paint_hovered_symbol(painter, document, symbol);
        }
        if let Some(members) = &overlay.of_selected {
            let thin = stroke(SELECTION_COLOR.gamma_multiply(MEMBERS_OPACITY));
            paint_outline(painter, &members.paths, thin, to_screen);
        }
        if let Some(members) = &overlay.highlighted {
            paint_glowing(painter, &members.paths, hovered, to_screen);
            paint_rings(painter, &members.symbols, HOVER_COLOR, to_screen);
        }
        if let (Tool::Points, Some(document)) = (self.tools.tool(), document) {
            paint_handles(painter, screen, &handles(document, view));
        }
    }

    /// Paints a ring around the station or node under the pointer.
    fn paint_hovered_symbol(&self, painter: &Painter, document: &Document, symbol: Element) {
        if let Some(bounds) = document.bounds_of(symbol) {
            let at_px = self.view.pixel_from_world(bounds.center());
            let to_screen = |pixel| self.screen.point(pixel);
            paint_rings(painter, &[at_px], HOVER_COLOR, to_screen);
        }
    }

    fn tool_painter<'p>(&'p self, painter: &'p Painter) -> ToolPainter<'p> {
        ToolPainter {
            painter,
            screen: self.screen,
            view: &self.view,
        }
    }

    /// Paints the changes of a comparison, the route, and the network that would be made.
    fn paint_tools(&self, painter: &Painter) {
        if let Some(drafted) = self.network {
            let ink = color32(self.settings.decoration_style(1.0).ink);
            paint_network(painter, self.screen, &self.view, drafted, ink);
        }
        let Some(document) = self.files.document() else {
            return;
        };
        let tools = self.tool_painter(painter);
        if let Some((other, changed)) = self.changes {
            tools.changes(other, document, changed);
        }
        if let Some((route, driven)) = self.route {
            let vehicle = self.swept_areas.vehicle().ok();
            tools.route(document, route, driven, vehicle);
        }
    }

    fn paint_findings(&self, painter: &Painter) {
        let layer = self.files.active().filter(|layer| layer.is_visible);
        if let Some((layer, findings)) = layer.and_then(|l| Some((l, l.tasks.findings()?))) {
            let state = layer.document().map(Document::state);
            let is_old = state.is_some_and(|state| state != findings.state);
            let marked = self.marked_findings;
            paint_findings(painter, self.screen, &self.view, findings, marked, is_old);
        }
    }

    fn paint_gesture(&self, painter: &Painter) {
        let px_per_point = f64::from(self.screen.px_per_point);
        let active = self.files.active();
        let context = layer_tool_context(active, self.view, self.settings, px_per_point);
        let pointer_m = self
            .pointer_px
            .map(|at_px| self.view.world_from_pixel(at_px));
        if let Gesture::Box { from_m, to_m } = *self.tools.gesture() {
            let [from_px, to_px] = [from_m, to_m].map(|at_m| self.view.pixel_from_world(at_m));
            paint_box(painter, self.screen, from_px, to_px);
        }
        if let Some(sketch) = self.tools.sketch(&context, pointer_m, self.modifiers) {
            let paths = sketch
                .drawing
                .zip(context.document)
                .and_then(|(drawing, document)| document.preview(&drawing).ok());
            let draft = Draft {
                points_m: &sketch.points_m,
                paths: paths.as_ref(),
                has_handles: self.tools.tool() == Tool::Bezier,
            };
            draft.paint(painter, self.screen, &self.view, self.settings);
        }
        let target = |at_m| self.tools.snap_target(&context, at_m, self.modifiers);
        if let Some(snapped) = pointer_m.and_then(target) {
            paint_snap(painter, self.screen, &self.view, self.settings, &snapped);
        }
        if let Some(typed) = self.tools.typed() {
            paint_typed(painter, self.screen, self.settings, typed);
        }
    }

    /// Paints the errors of all files.
    fn paint_messages(&self, painter: &Painter) {
        let layers = self.files.layers();
        let errors = layers.iter().filter_map(|layer| {
            let error = layer.error()?;
            Some(format!("{}: {}", layer.name(), translated(error)))
        });
        let width = (self.screen.rect.width() - 32.0).max(50.0);
        let mut at: Pos2 = self.screen.rect.center_top() + Vec2::new(0.0, 40.0);
        let color = color32(self.settings.decoration_style(1.0).ink);
        for text in errors {
            let font = FontId::proportional(MESSAGE_POINTS);
            let galley = painter.layout(text, font, color, width);
            let corner = at - Vec2::new(galley.size().x / 2.0, 0.0);
            let back = Rect::from_min_size(corner, galley.size()).expand(8.0);
            painter.rect_filled(back, 4.0, color32(self.settings.background()));
            at.y += galley.size().y + 20.0;
            painter.galley(corner, galley, color);
        }
    }
}
