//! The tools that create nodes and stations, one per click.

use guideway_document::{Document, Element, Elements, SelectMode, ShapeError, SnapTarget, Snapped};
use guideway_layout::UserError;

use super::tool::Tool;
use super::tool_context::{ON_NODE_M, ToolContext};
use super::tool_set::{ToolEffect, Tools};
use crate::editing::EditTask;

/// Distance of the pointer within which a node is meant to be on a path, in pixels.
const ON_PATH_PX: f64 = 4.0;

impl Tools {
    /// Creates a node or a station at a place, and selects it.
    pub(super) fn create_at(&self, place: Snapped, context: &ToolContext<'_>) -> ToolEffect {
        let (is_station, context) = (self.tool == Tool::Station, context.detached());
        ToolEffect::Edit(EditTask::edit(move |document: &mut Document| {
            let elements = match is_station {
                true => create_station(document, place)?,
                false => create_node(document, place, &context)?,
            };
            document.select_elements(&elements, SelectMode::Replace);
            Ok::<(), UserError>(())
        }))
    }
}

/// The node of a place, which may be a typed one.
fn node_at(document: &Document, place: Snapped) -> Option<u32> {
    match place.to {
        Some(SnapTarget::Node(node)) => Some(node),
        _ => document.node_near(place.at_m, ON_NODE_M),
    }
}

/// A station at the node of the place, or a free one.
fn create_station(document: &mut Document, place: Snapped) -> Result<Elements, UserError> {
    let station = match node_at(document, place) {
        Some(node) => document.create_station(None, &[node], None, None),
        None => {
            let level = document.drawing_level(None);
            document.create_station(None, &[], Some(place.at_m), level)
        }
    };
    let station = station.map_err(ShapeError::from)?;
    Ok(Elements::of(Element::Station(station)))
}

/// The node of the place, a new one at which the paths there are split, or a free one.
fn create_node(
    document: &mut Document,
    place: Snapped,
    context: &ToolContext<'_>,
) -> Result<Elements, UserError> {
    if let Some(node) = node_at(document, place) {
        return Ok(Elements::of(Element::Node(node)));
    }
    let (rule, px_per_m) = (context.line_rule, context.view.px_per_m());
    let hit = document.pick(rule, px_per_m, place.at_m, ON_PATH_PX, usize::MAX);
    let Some(hit) = hit else {
        let level = document.drawing_level(None);
        let node = document.create_node(None, place.at_m, level);
        let node = node.map_err(ShapeError::from)?;
        return Ok(Elements::of(Element::Node(node)));
    };
    let node = document.split_shown_at(hit.point_m)?;
    Ok(node.map_or_else(Elements::default, |node| Elements::of(Element::Node(node))))
}
