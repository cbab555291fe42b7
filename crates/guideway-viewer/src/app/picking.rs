//! Picks in every visible file: the active one first, then the others from the top.

use guideway_document::{Document, Element};
use guideway_spline::Point;

use super::basics::tool_context_of;
use super::state::App;
use crate::compare::Changed;
use crate::files::Layer;
use crate::language::t;
use crate::network_draft::Drafted;
use crate::panels::BottomView;
use crate::route::{FoundRoute, place_of};
use crate::tools::{HoverTarget, MAX_HOVER_CANDIDATES, OtherHit, PointerEvent, Tool};

/// Most stations that are searched on each movement of the pointer: one after the other.
const MAX_SEARCHED_STATIONS: usize = 20_000;

/// Returns `true` if nodes and stations of a file are drawn in the view: where there are too many
/// to draw them, they are also too many to search on each movement of the pointer.
fn draws_symbols(layer: &Layer) -> bool {
    let has_few = |document: &Document| document.layout().stations.len() <= MAX_SEARCHED_STATIONS;
    let overlay = layer.slot.overlay().last();
    overlay.is_some_and(|overlay| !overlay.marks.left_out) && layer.document().is_some_and(has_few)
}

impl App {
    /// Looks under the pointer in the other files where the active one has nothing, and makes the
    /// file that was clicked the active one.
    pub(super) fn pick_in_others(&mut self, event: &PointerEvent) {
        let picks = matches!(self.tools.tool(), Tool::Select | Tool::Points);
        match *event {
            PointerEvent::Hover(at_px) => {
                let at_px = at_px.filter(|_| picks && !self.tools.has_gesture());
                self.other_hit = at_px.and_then(|at_px| {
                    let hit = self.hit_in_others(at_px, MAX_HOVER_CANDIDATES)?;
                    Some(hit).filter(|_| self.files.document().is_some())
                });
            }
            PointerEvent::Clicked(at_px, modifiers) if picks && modifiers.is_none() => {
                self.other_hit = None;
                if let Some(file) = self.file_clicked(at_px) {
                    self.files.activate(file);
                    self.tools.clear_hover();
                }
            }
            _ => {}
        }
    }

    /// Tells the tools which station or node is under the pointer, where such symbols are drawn.
    pub(super) fn hover_symbol(&mut self, event: &PointerEvent) {
        let PointerEvent::Hover(at_px) = *event else {
            return;
        };
        let layer = self.files.active().filter(|layer| layer.is_visible);
        let is_drawn = layer.is_some_and(draws_symbols);
        let at_px = at_px.filter(|_| is_drawn && !self.tools.has_gesture());
        let context = tool_context_of(layer, &self.canvas, &self.settings);
        let symbol = at_px
            .zip(context)
            .and_then(|(at_px, context)| context.pick_symbol(at_px));
        self.tools.hover_symbol(symbol);
    }

    /// Takes the station, node or end of a path at a pixel as a place of the route.
    pub(super) fn pick_place(&mut self, at_px: Point<f64>) {
        let layer = self.files.active();
        let context = layer.and_then(|l| tool_context_of(Some(l), &self.canvas, &self.settings));
        let place = context.and_then(|context| {
            let document = context.document?;
            let on_path = || {
                let hit = context.pick(at_px, usize::MAX)?;
                Some(Element::Path(hit.path))
            };
            let element = context.pick_symbol(at_px).or_else(on_path)?;
            place_of(document, element, context.view.world_from_pixel(at_px))
        });
        match place {
            Some(place) => self.bottom.route.choose(place),
            None => self.dialogs.notices.inform(t(
                "Nothing is there; click a station, a node or the end of a path",
            )),
        }
    }

    /// Searches the route, compares the files, or builds the network of the open panel after a
    /// change.
    pub(super) fn update_tools(&mut self) {
        let repaint = &self.context.repaint;
        let files = &self.files;
        if self.bottom.view != Some(BottomView::Network) {
            self.bottom.network.forget();
        }
        match self.bottom.view {
            Some(BottomView::Route) => {
                let vehicle = self.swept_areas.vehicle().ok();
                let (file, document) = (files.active_index(), files.document());
                self.bottom.route.update(file, document, vehicle, repaint);
            }
            Some(BottomView::Compare) => self.bottom.comparison.update(files, repaint),
            Some(BottomView::Network) => self.bottom.network.update(files, repaint),
            Some(BottomView::Table) | None => {}
        }
    }

    /// The route to draw, and the part of it that the vehicle has driven.
    pub(super) fn shown_route(&self) -> Option<(&FoundRoute, f32)> {
        let is_open = self.bottom.view == Some(BottomView::Route);
        let route = &self.bottom.route;
        let found = route
            .result(self.files.active_index())
            .filter(|_| is_open)?;
        Some((found.ok()?, route.driven))
    }

    /// Keeps the vehicle in sight that the slider has moved along the route.
    pub(super) fn follow_vehicle(&mut self) {
        let pose = self.shown_route().and_then(|(route, driven)| {
            let along_m = f64::from(driven) * route.track.length_m();
            route.track.pose(along_m)
        });
        if let Some((at_m, _)) = pose {
            self.canvas.camera.bring_into_view(at_m);
        }
    }

    /// The other document of the comparison, and the changes to draw.
    pub(super) fn shown_changes(&self) -> Option<(&Document, &Changed)> {
        let is_open = self.bottom.view == Some(BottomView::Compare);
        let comparison = &self.bottom.comparison;
        let (_, other) = comparison.other(&self.files).filter(|_| is_open)?;
        let changed = comparison.changed(&self.files)?.ok()?;
        Some((other.document()?, changed))
    }

    /// The network to show before it is made.
    pub(super) fn shown_network(&self) -> Option<&Drafted> {
        let is_open = self.bottom.view == Some(BottomView::Network);
        let network = self.bottom.network.network(&self.files);
        network.filter(|_| is_open)?.ok()
    }

    /// Indices of the other visible files, from the top.
    fn others(&self) -> impl Iterator<Item = (usize, &Layer)> {
        let active = self.files.active_index();
        let all = self.files.layers().iter().enumerate();
        all.filter(move |(index, layer)| *index != active && layer.is_visible)
    }

    /// Returns `true` if something of the active file is at a pixel, or may be.
    fn is_active_hit(&self, at_px: Point<f64>, max_candidates: usize) -> bool {
        let Some(layer) = self.files.active().filter(|layer| layer.is_visible) else {
            return false;
        };
        let Some(context) = tool_context_of(Some(layer), &self.canvas, &self.settings) else {
            return false;
        };
        context.document.is_none()
            || context.pick_symbol(at_px).is_some()
            || context.pick(at_px, max_candidates).is_some()
    }

    fn hit_in_others(&self, at_px: Point<f64>, max_candidates: usize) -> Option<OtherHit> {
        let mut others = self.others().peekable();
        others.peek()?;
        if self.is_active_hit(at_px, max_candidates) {
            return None;
        }
        let hovers_symbols = self.tools.tool() == Tool::Select;
        others.find_map(|(file, layer)| {
            let context = tool_context_of(Some(layer), &self.canvas, &self.settings)?;
            let symbol =
                (hovers_symbols && draws_symbols(layer)).then(|| context.pick_symbol(at_px));
            let target = match symbol.flatten() {
                Some(symbol) => HoverTarget::Symbol(symbol),
                None => HoverTarget::Path(context.pick(at_px, max_candidates)?),
            };
            Some(OtherHit { file, target })
        })
    }

    /// The other file that a click at a pixel hits.
    fn file_clicked(&self, at_px: Point<f64>) -> Option<usize> {
        let mut others = self.others().peekable();
        others.peek()?;
        if self.is_active_hit(at_px, usize::MAX) {
            return None;
        }
        let is_hit = |layer: &Layer| {
            let context = tool_context_of(Some(layer), &self.canvas, &self.settings);
            context.is_some_and(|context| {
                context.pick_symbol(at_px).is_some() || context.pick(at_px, usize::MAX).is_some()
            })
        };
        others
            .find(|(_, layer)| is_hit(layer))
            .map(|(file, _)| file)
    }
}
