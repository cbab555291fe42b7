//! The tool for control points: inserts and removes them.

use guideway_document::Document;
use guideway_spline::Point;

use super::hit_test::hit_handle;
use super::tool::Tool;
use super::tool_context::ToolContext;
use super::tool_set::{ToolEffect, Tools};
use crate::editing::EditTask;

impl Tools {
    /// Inserts a control point beside the one under the pointer, or removes that one.
    pub(super) fn change_points(
        &mut self,
        at_px: Point<f64>,
        inserts: bool,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        if self.tool != Tool::Points {
            return None;
        }
        let handle = hit_handle(context.document?, &context.view, at_px)?;
        let edit = move |document: &mut Document| match inserts {
            true => document.insert_point(handle.point),
            false => document.remove_point(handle.point),
        };
        Some(ToolEffect::Edit(EditTask::edit(edit)))
    }
}
