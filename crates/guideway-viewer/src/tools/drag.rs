//! Drags: selection boxes, moves of the selection, of nodes and of control points.

use eframe::egui::Modifiers;
use guideway_document::{Document, Neighbors};
use guideway_spline::{Affine, Bounds, Point};

use super::gesture::{DragProgress, Gesture};
use super::hit_test::{hit_end, hit_handle};
use super::select_tool::select_mode;
use super::snapping::{snap_move, snap_point, snap_to_node};
use super::tool::Tool;
use super::tool_context::ToolContext;
use super::tool_set::{ToolEffect, Tools};
use crate::editing::EditTask;

impl Tools {
    pub(super) fn begin_drag(
        &mut self,
        at_px: Point<f64>,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        if self.tool.adds_points() {
            return None;
        }
        let Some(document) = context.document else {
            self.gesture = Gesture::Idle;
            return None;
        };
        let at_m = context.world(at_px);
        let selection_box = Gesture::Box {
            from_m: at_m,
            to_m: at_m,
        };
        let selected = document.selected();
        let is_selected = |symbol| selected.contains(symbol);
        self.gesture = match self.tool {
            Tool::Select if context.pick_symbol(at_px).is_some_and(is_selected) => Gesture::Move {
                from_m: at_m,
                by_m: Point::new(0.0, 0.0),
                by_end: false,
            },
            Tool::Select => match context.pick(at_px, usize::MAX) {
                Some(hit) if document.selection().contains(hit.path) => {
                    let end = hit_end(document, &hit, context.hit_radius_m());
                    Gesture::Move {
                        from_m: end.unwrap_or(hit.point_m),
                        by_m: Point::new(0.0, 0.0),
                        by_end: end.is_some(),
                    }
                }
                _ => selection_box,
            },
            _ => {
                let handle = hit_handle(document, &context.view, at_px);
                let node = document.node_near(at_m, context.hit_radius_m());
                match (handle, node) {
                    (Some(handle), _) => Gesture::Handle {
                        point: handle.point,
                        from_m: context.world(handle.at_px),
                        progress: DragProgress::begin(document),
                    },
                    (None, Some(node)) => Gesture::Node {
                        node,
                        from_m: document.node_position_m(node),
                        progress: DragProgress::begin(document),
                    },
                    (None, None) => selection_box,
                }
            }
        };
        let edits = !matches!(self.gesture, Gesture::Box { .. });
        edits.then_some(ToolEffect::ExpectEdit)
    }

    pub(super) fn drag(
        &mut self,
        at_px: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        let (has_document, at_m) = (context.document.is_some(), context.world(at_px));
        match &mut self.gesture {
            Gesture::Box { to_m, .. } => {
                *to_m = at_m;
                return None;
            }
            Gesture::Move {
                from_m,
                by_end,
                by_m,
            } => {
                let snaps = self.snaps;
                let node_m = match *by_end {
                    true => snap_to_node(context, at_m, modifiers),
                    false => None,
                };
                *by_m = match node_m {
                    Some(node_m) => node_m - *from_m,
                    None => snap_move(context, snaps, at_m - *from_m, modifiers),
                };
                return None;
            }
            Gesture::Node { progress, .. } | Gesture::Handle { progress, .. } if !has_document => {
                // The last edit is in progress; what is missed now the next movement makes up for.
                progress.missed = Some((at_m, modifiers));
                return None;
            }
            _ => {}
        }
        self.edit_at(at_m, modifiers, context)
    }

    /// The edit of a drag that the layout follows at once; `None` for other gestures.
    fn edit_at(
        &mut self,
        at_m: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        let before = self.gesture.clone();
        let (Gesture::Node { progress, .. } | Gesture::Handle { progress, .. }) = &mut self.gesture
        else {
            return None;
        };
        progress.missed = None;
        let progress = *progress;
        let (context, snaps) = (context.detached(), self.snaps);
        Some(ToolEffect::Edit(EditTask::edit(
            move |document: &mut Document| {
                progress.take_back(document);
                let context = context.of(document);
                let to_m = snap_point(&context, &before, snaps, at_m, modifiers).at_m;
                match before {
                    Gesture::Node { node, .. } => document.move_node(node, to_m),
                    Gesture::Handle { point, .. } => document.move_point(point, to_m),
                    _ => Ok(()),
                }
            },
        )))
    }

    pub(super) fn end_drag(
        &mut self,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        if let Gesture::Node { progress, .. } | Gesture::Handle { progress, .. } = self.gesture
            && let Some((at_m, modifiers)) = progress.missed
        {
            let edit = self.edit_at(at_m, modifiers, context);
            self.gesture = Gesture::None;
            return edit;
        }
        match std::mem::take(&mut self.gesture) {
            Gesture::Box { from_m, to_m } => {
                // The CAD convention: a box from right to left selects all paths that it crosses,
                // one from left to right only those inside.
                let crosses = to_m.x < from_m.x;
                let (bounds, mode) = (Bounds::of_points([from_m, to_m])?, select_mode(modifiers));
                Some(ToolEffect::Edit(EditTask::view_change(move |document| {
                    document.select_in(bounds, crosses, mode);
                })))
            }
            Gesture::Move { by_m, .. } if by_m.norm() > 0.0 => {
                let by = Affine::translation(by_m);
                let neighbors = match modifiers.command {
                    true => Neighbors::Detach,
                    false => Neighbors::Follow,
                };
                Some(ToolEffect::Edit(EditTask::edit(
                    move |document: &mut Document| {
                        let selected = document.selected().clone();
                        document.transform("move", &selected, by, neighbors)
                    },
                )))
            }
            // A path that is being drawn outlasts the drag.
            gesture @ Gesture::Points(_) => {
                self.gesture = gesture;
                None
            }
            _ => None,
        }
    }
}
