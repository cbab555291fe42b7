//! The state outside the tools that a pointer event depends on.

use guideway_document::decorations::MarkedKinds;
use guideway_document::{Document, Element, Hit};
use guideway_scene::{LineRule, View};
use guideway_spline::Point;

use super::hit_test::{HIT_RADIUS_PX, MAX_HOVER_CANDIDATES};

/// Distance within which a given place is at a node, in meters.
pub(super) const ON_NODE_M: f64 = 1e-3;

/// View, document and settings at the time of a pointer event.
#[derive(Clone, Copy)]
pub(crate) struct ToolContext<'a> {
    pub(crate) view: View,
    /// The active document; `None` while it is loaded or an edit has it.
    pub(crate) document: Option<&'a Document>,
    pub(crate) line_rule: LineRule,
    /// The kinds of elements that are shown, and can be picked.
    pub(crate) picks: MarkedKinds,
    /// Distance of the lines of the grid, in meters; `None` while they are not shown.
    pub(crate) grid_step_m: Option<f64>,
}

impl<'a> ToolContext<'a> {
    /// The same view and settings with a document that an edit has.
    pub(super) fn of<'b>(&self, document: &'b Document) -> ToolContext<'b> {
        ToolContext {
            view: self.view,
            document: Some(document),
            line_rule: self.line_rule,
            picks: self.picks,
            grid_step_m: self.grid_step_m,
        }
    }

    /// The same view and settings without a document, to keep for an edit.
    pub(super) fn detached(&self) -> ToolContext<'static> {
        ToolContext {
            view: self.view,
            document: None,
            line_rule: self.line_rule,
            picks: self.picks,
            grid_step_m: self.grid_step_m,
        }
    }

    pub(super) fn world(&self, at_px: Point<f64>) -> Point<f64> {
        self.view.world_from_pixel(at_px)
    }

    /// The radius of hit tests in meters.
    pub(super) fn hit_radius_m(&self) -> f64 {
        HIT_RADIUS_PX / self.view.px_per_m()
    }

    /// The station, node or path under the pointer.
    pub(crate) fn element_at(&self, at_px: Point<f64>) -> Option<Element> {
        let path = || self.pick(at_px, MAX_HOVER_CANDIDATES);
        let symbol = self.pick_symbol(at_px);
        symbol.or_else(|| path().map(|hit| Element::Path(hit.path)))
    }

    /// The station or node under the pointer.
    pub(crate) fn pick_symbol(&self, at_px: Point<f64>) -> Option<Element> {
        let document: &'a Document = self.document?;
        let (at_m, radius_m) = (self.world(at_px), self.hit_radius_m());
        let station = || document.station_near(at_m, radius_m).map(Element::Station);
        let node = || document.node_near(at_m, radius_m).map(Element::Node);
        let station = self.picks.stations.then(station).flatten();
        station.or_else(|| self.picks.nodes.then(node).flatten())
    }

    /// The topmost path under the pointer; `None` if more than `max_candidates` are near it.
    pub(crate) fn pick(&self, at_px: Point<f64>, max_candidates: usize) -> Option<Hit> {
        let (px_per_m, at_m) = (self.view.px_per_m(), self.world(at_px));
        let document = self.document.filter(|_| self.picks.paths)?;
        document.pick(
            self.line_rule,
            px_per_m,
            at_m,
            HIT_RADIUS_PX,
            max_candidates,
        )
    }
}
