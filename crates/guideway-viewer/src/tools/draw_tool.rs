//! The tools that add points: lines, arcs, curves and measures.

use guideway_document::{Document, Drawing, Snapped};
use guideway_layout::UserError;
use guideway_spline::Point;

use super::gesture::Gesture;
use super::tool::Tool;
use super::tool_context::{ON_NODE_M, ToolContext};
use super::tool_set::{ToolEffect, Tools};
use crate::editing::EditTask;

/// Points of an arc: start, end, and one between.
const ARC_POINTS: usize = 3;

impl Tools {
    /// Adds the place of a click or a typed place: a point of a path, a node or a station.
    pub(super) fn add_point(
        &mut self,
        place: Snapped,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        self.typed = None;
        if matches!(self.tool, Tool::Node | Tool::Station) {
            return Some(self.create_at(place, context));
        }
        match &mut self.gesture {
            Gesture::Points(points) => points.push(place.at_m),
            gesture => *gesture = Gesture::Points(vec![place.at_m]),
        }
        let is_arc = self.tool == Tool::Arc && self.points().len() == ARC_POINTS;
        let effect = is_arc.then(|| self.finish_path(context))?;
        if matches!(effect, Some(ToolEffect::Refused(_))) {
            self.remove_last_point();
        }
        effect
    }

    /// The points so far.
    pub(super) fn points(&self) -> &[Point<f64>] {
        match &self.gesture {
            Gesture::Points(points) => points,
            _ => &[],
        }
    }

    /// The drawing so far, with the point at the pointer; `None` without a tool that draws.
    pub(crate) fn drawing(&self, next_m: Option<Point<f64>>) -> Option<Drawing> {
        Some(Drawing {
            points_m: self.points().iter().copied().chain(next_m).collect(),
            curve: self.tool.curve()?,
            template: self.template.clone(),
        })
    }

    /// Adds the drawn path to the document. If there is no such path, the points stay.
    pub(crate) fn finish_path(&mut self, context: &ToolContext<'_>) -> Option<ToolEffect> {
        let drawing = self.drawing(None)?;
        match drawing.points_m.is_empty() {
            true => None,
            false => Some(self.draw(drawing, context)),
        }
    }

    pub(super) fn draw(&mut self, drawing: Drawing, context: &ToolContext<'_>) -> ToolEffect {
        let preview = context.document.map(|document| document.preview(&drawing));
        if let Some(Err(error)) = preview {
            return ToolEffect::Refused(UserError::from(error).to_string());
        }
        (self.gesture, self.typed) = (Gesture::None, None);
        ToolEffect::Edit(EditTask::edit(move |document: &mut Document| {
            // A path that begins or ends on another one is connected to it.
            for end_m in drawing.ends_m() {
                if document.node_near(end_m, ON_NODE_M).is_none() {
                    document.split_shown_at(end_m)?;
                }
            }
            document.draw(&drawing).map(drop).map_err(UserError::from)
        }))
    }
}
