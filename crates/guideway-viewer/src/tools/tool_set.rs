//! The selected tool and its gesture: turns pointer events into edits.

use eframe::egui::Modifiers;
use guideway_document::{Document, Hit, PathSet, SelectMode};
use guideway_spline::{Affine, Bounds, Point};

use super::gesture::Gesture;
use super::hit_test::{MAX_HOVER_CANDIDATES, hit_end, hit_handle};
use super::pointer_event::PointerEvent;
use super::snapping::{snap_move, snap_point, snap_to_node};
use super::tool::Tool;
use super::tool_context::ToolContext;
use crate::editing::EditTask;

/// The selected tool, the gesture in progress, and the path under the pointer.
#[derive(Default)]
pub(crate) struct Tools {
    tool: Tool,
    gesture: Gesture,
    hover: Option<Hit>,
    /// True if moves and new points snap to the grid.
    pub(crate) snaps_to_grid: bool,
}

/// The effect of a pointer event on the document.
pub(crate) enum ToolEffect {
    /// A gesture began that may edit the document.
    ExpectEdit,
    Edit(EditTask),
}

impl Tools {
    pub(crate) fn tool(&self) -> Tool {
        self.tool
    }

    pub(crate) fn gesture(&self) -> &Gesture {
        &self.gesture
    }

    /// Selects a tool and aborts the gesture in progress.
    pub(crate) fn select(&mut self, tool: Tool) {
        self.gesture = Gesture::None;
        self.tool = tool;
    }

    /// Aborts the gesture in progress.
    pub(crate) fn abort_gesture(&mut self) {
        self.gesture = Gesture::None;
    }

    /// Aborts the gesture, or else returns to the select tool. Returns whether there was either.
    pub(crate) fn cancel(&mut self) -> bool {
        let has_gesture = !matches!(self.gesture, Gesture::None);
        let has_tool = self.tool != Tool::Select;
        self.gesture = Gesture::None;
        if !has_gesture {
            self.tool = Tool::Select;
        }
        has_gesture || has_tool
    }

    /// The path under the pointer. `None` if the document was replaced by a shorter one.
    pub(crate) fn hovered(&self, document: Option<&Document>) -> Option<&Hit> {
        let rows = document?.scene().row_count();
        self.hover.as_ref().filter(|hit| (hit.path as usize) < rows)
    }

    /// Forgets the path under the pointer.
    pub(crate) fn clear_hover(&mut self) {
        self.hover = None;
    }

    /// The position meant by a click at `at_m`.
    pub(crate) fn snapped(
        &self,
        context: &ToolContext<'_>,
        at_m: Point<f64>,
        modifiers: Modifiers,
    ) -> Point<f64> {
        snap_point(context, &self.gesture, self.snaps_to_grid, at_m, modifiers)
    }

    /// Handles a pointer event.
    pub(crate) fn handle(
        &mut self,
        event: PointerEvent,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        match event {
            PointerEvent::Hover(at_px) => {
                if matches!(self.gesture, Gesture::None | Gesture::Points(_)) {
                    let pick = |at_px| context.pick(at_px, MAX_HOVER_CANDIDATES);
                    self.hover = at_px.and_then(pick);
                }
                None
            }
            PointerEvent::DragStarted(at_px) => self.begin_drag(at_px, context),
            PointerEvent::Dragged(at_px, modifiers) => self.drag(at_px, modifiers, context),
            PointerEvent::DragEnded(modifiers) => self.end_drag(modifiers, context),
            PointerEvent::Clicked(at_px, modifiers) => self.click(at_px, modifiers, context),
            PointerEvent::DoubleClicked => self.double_click(context),
            PointerEvent::InsertPoint(at_px) => self.change_points(at_px, true, context),
            PointerEvent::RemovePoint(at_px) => self.change_points(at_px, false, context),
        }
    }

    fn begin_drag(&mut self, at_px: Point<f64>, context: &ToolContext<'_>) -> Option<ToolEffect> {
        let Some(document) = context.document else {
            self.gesture = Gesture::Idle;
            return None;
        };
        let selection_box = Gesture::Box {
            from_px: at_px,
            to_px: at_px,
        };
        self.gesture = match self.tool {
            Tool::Draw | Tool::Measure => return None,
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
            Tool::Points => {
                let handle = hit_handle(document, &context.view, at_px);
                let at_m = context.world(at_px);
                let node = document.node_near(at_m, context.hit_radius_m());
                match (handle, node) {
                    (Some(handle), _) => Gesture::Handle {
                        point: handle.point,
                        from_m: context.world(handle.at_px),
                        has_moved: false,
                    },
                    (None, Some(node)) => Gesture::Node {
                        node,
                        from_m: document.node_position_m(node),
                        has_moved: false,
                    },
                    (None, None) => selection_box,
                }
            }
        };
        let edits = !matches!(self.gesture, Gesture::Box { .. });
        edits.then_some(ToolEffect::ExpectEdit)
    }

    fn drag(
        &mut self,
        at_px: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        // Without a document the last edit is in progress: the next movement counts.
        context.document?;
        let (at_m, to_grid) = (context.world(at_px), self.snaps_to_grid);
        let to_m = self.snapped(context, at_m, modifiers);
        match &mut self.gesture {
            Gesture::None | Gesture::Idle | Gesture::Points(_) => None,
            Gesture::Box { to_px, .. } => {
                *to_px = at_px;
                None
            }
            Gesture::Move {
                from_m,
                by_end,
                by_m,
            } => {
                let node_m = match *by_end {
                    true => snap_to_node(context, at_m, modifiers),
                    false => None,
                };
                *by_m = match node_m {
                    Some(node_m) => node_m - *from_m,
                    None => snap_move(context, to_grid, at_m - *from_m, modifiers),
                };
                None
            }
            Gesture::Node {
                node, has_moved, ..
            } => {
                let (node, undo_first) = (*node, std::mem::replace(has_moved, true));
                let edit = move |document: &mut Document| document.move_node(node, to_m);
                Some(ToolEffect::Edit(replacing_edit(undo_first, edit)))
            }
            Gesture::Handle {
                point, has_moved, ..
            } => {
                let (point, undo_first) = (*point, std::mem::replace(has_moved, true));
                let edit = move |document: &mut Document| document.move_point(point, to_m);
                Some(ToolEffect::Edit(replacing_edit(undo_first, edit)))
            }
        }
    }

    fn end_drag(&mut self, modifiers: Modifiers, context: &ToolContext<'_>) -> Option<ToolEffect> {
        match std::mem::take(&mut self.gesture) {
            Gesture::Box { from_px, to_px } => {
                let corners = [from_px, to_px].map(|pixel| context.world(pixel));
                // The CAD convention: a box from right to left selects all paths that it crosses,
                // one from left to right only those inside.
                let crosses = to_px.x < from_px.x;
                let (bounds, mode) = (Bounds::of_points(corners)?, select_mode(modifiers));
                Some(ToolEffect::Edit(EditTask::view_change(move |document| {
                    document.select_in(bounds, crosses, mode);
                })))
            }
            Gesture::Move { by_m, .. } if by_m.norm() > 0.0 => {
                let by = Affine::translation(by_m);
                Some(ToolEffect::Edit(EditTask::edit(
                    move |document: &mut Document| document.transform_selection("move", by),
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

    fn click(
        &mut self,
        at_px: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        if self.tool.adds_points() {
            let at_m = self.snapped(context, context.world(at_px), modifiers);
            match &mut self.gesture {
                Gesture::Points(points) => points.push(at_m),
                gesture => *gesture = Gesture::Points(vec![at_m]),
            }
            return None;
        }
        let hit = context.pick(at_px, usize::MAX);
        let hit = hit.map(|hit| alternate_in_pair(hit, context));
        let paths: PathSet = hit.iter().map(|hit| hit.path).collect();
        let mode = select_mode(modifiers);
        Some(ToolEffect::Edit(EditTask::view_change(move |document| {
            document.select(paths, mode);
        })))
    }

    fn double_click(&mut self, context: &ToolContext<'_>) -> Option<ToolEffect> {
        match self.tool {
            Tool::Draw => return self.finish_path(context),
            Tool::Measure => self.gesture = Gesture::None,
            Tool::Select if self.hovered(context.document).is_some() => self.select(Tool::Points),
            Tool::Select | Tool::Points => {}
        }
        None
    }

    /// Inserts a control point beside the one under the pointer, or removes that one.
    fn change_points(
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

    /// Adds the drawn path to the document.
    pub(crate) fn finish_path(&mut self, context: &ToolContext<'_>) -> Option<ToolEffect> {
        if self.tool != Tool::Draw {
            return None;
        }
        let Gesture::Points(mut points) = std::mem::take(&mut self.gesture) else {
            return None;
        };
        // A double click adds the last point twice.
        points.dedup();
        let radius_m = context.hit_radius_m();
        Some(ToolEffect::Edit(EditTask::edit(
            move |document: &mut Document| {
                let id = format!("drawn {}", document.scene().row_count() + 1);
                document.draw_path(id, &points, radius_m)
            },
        )))
    }
}

/// Of two paths on the same line, a click selects the topmost one and the next click the other.
fn alternate_in_pair(hit: Hit, context: &ToolContext<'_>) -> Hit {
    let other = || {
        let document = context.document?;
        let selected = document.selection();
        let is_only = selected.len() == 1 && selected.contains(hit.path);
        is_only.then(|| document.reverse_path_at(&hit, MAX_HOVER_CANDIDATES))?
    };
    let path = other().unwrap_or(hit.path);
    Hit { path, ..hit }
}

/// An edit that replaces the one before, so that a whole drag is one step to undo.
fn replacing_edit<E: ToString + 'static>(
    undo_first: bool,
    edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
) -> EditTask {
    EditTask::edit(move |document| {
        if undo_first {
            document.undo();
        }
        edit(document)
    })
}

fn select_mode(modifiers: Modifiers) -> SelectMode {
    if modifiers.shift {
        SelectMode::Add
    } else if modifiers.alt || modifiers.command {
        SelectMode::Remove
    } else {
        SelectMode::Replace
    }
}

#[cfg(test)]
mod tests;
