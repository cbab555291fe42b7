//! The selected tool and its gesture: turns pointer events into edits.

use eframe::egui::Modifiers;
use guideway_document::{Document, Element, Elements, Hit, SelectMode};
use guideway_spline::{Affine, Bounds, Point};

use super::gesture::{DragProgress, Gesture};
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

    /// Ends the drag in progress; what it has done so far stays.
    pub(crate) fn abort_drag(&mut self) {
        if !matches!(self.gesture, Gesture::Points(_)) {
            self.gesture = Gesture::None;
        }
    }

    /// Removes the last point of the path that is drawn or measured. Returns `false` if there is
    /// none.
    pub(crate) fn remove_last_point(&mut self) -> bool {
        let Gesture::Points(points) = &mut self.gesture else {
            return false;
        };
        points.pop();
        if points.is_empty() {
            self.gesture = Gesture::None;
        }
        true
    }

    /// Returns `true` while a gesture is in progress.
    pub(crate) fn has_gesture(&self) -> bool {
        !matches!(self.gesture, Gesture::None | Gesture::Idle)
    }

    /// Ends the gesture in progress and takes back what it did to the document.
    pub(crate) fn cancel_gesture(&mut self) -> Option<ToolEffect> {
        let gesture = std::mem::take(&mut self.gesture);
        let (Gesture::Node { progress, .. } | Gesture::Handle { progress, .. }) = gesture else {
            return None;
        };
        let undo = EditTask::view_change(move |document| progress.take_back(document));
        Some(ToolEffect::Edit(undo))
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
            PointerEvent::Cancelled => self.cancel_gesture(),
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
        let selected = document.selected();
        let is_selected = |symbol| match symbol {
            Element::Path(row) => selected.paths.contains(row),
            Element::Node(row) => selected.nodes.contains(row),
            Element::Station(row) => selected.stations.contains(row),
        };
        self.gesture = match self.tool {
            Tool::Draw | Tool::Measure => return None,
            Tool::Select if context.pick_symbol(at_px).is_some_and(is_selected) => Gesture::Move {
                from_m: context.world(at_px),
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
            Tool::Points => {
                let handle = hit_handle(document, &context.view, at_px);
                let at_m = context.world(at_px);
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

    fn drag(
        &mut self,
        at_px: Point<f64>,
        modifiers: Modifiers,
        context: &ToolContext<'_>,
    ) -> Option<ToolEffect> {
        let has_document = context.document.is_some();
        match &mut self.gesture {
            Gesture::Box { to_px, .. } => {
                *to_px = at_px;
                return None;
            }
            Gesture::Move {
                from_m,
                by_end,
                by_m,
            } => {
                let (at_m, to_grid) = (context.world(at_px), self.snaps_to_grid);
                let node_m = match *by_end {
                    true => snap_to_node(context, at_m, modifiers),
                    false => None,
                };
                *by_m = match node_m {
                    Some(node_m) => node_m - *from_m,
                    None => snap_move(context, to_grid, at_m - *from_m, modifiers),
                };
                return None;
            }
            Gesture::Node { progress, .. } | Gesture::Handle { progress, .. } if !has_document => {
                // The last edit is in progress; what is missed now the next movement makes up for.
                progress.missed = Some((at_px, modifiers));
                return None;
            }
            _ => {}
        }
        self.edit_at(at_px, modifiers, context)
    }

    /// The edit of a drag that the layout follows at once; `None` for other gestures.
    fn edit_at(
        &mut self,
        at_px: Point<f64>,
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
        let (view, line_rule, to_grid) = (context.view, context.line_rule, self.snaps_to_grid);
        Some(ToolEffect::Edit(EditTask::edit(
            move |document: &mut Document| {
                progress.take_back(document);
                let context = ToolContext {
                    view,
                    document: Some(document),
                    line_rule,
                    picks_symbols: false,
                };
                let at_m = context.world(at_px);
                let to_m = snap_point(&context, &before, to_grid, at_m, modifiers);
                match before {
                    Gesture::Node { node, .. } => document.move_node(node, to_m),
                    Gesture::Handle { point, .. } => document.move_point(point, to_m),
                    _ => Ok(()),
                }
            },
        )))
    }

    fn end_drag(&mut self, modifiers: Modifiers, context: &ToolContext<'_>) -> Option<ToolEffect> {
        if let Gesture::Node { progress, .. } | Gesture::Handle { progress, .. } = self.gesture
            && let Some((at_px, modifiers)) = progress.missed
        {
            let edit = self.edit_at(at_px, modifiers, context);
            self.gesture = Gesture::None;
            return edit;
        }
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
        // The path is looked for when the document is back from the edits in progress.
        let (view, line_rule, mode) = (context.view, context.line_rule, select_mode(modifiers));
        let picks_symbols = context.picks_symbols && self.tool == Tool::Select;
        Some(ToolEffect::Edit(EditTask::view_change(move |document| {
            let context = ToolContext {
                view,
                document: Some(document),
                line_rule,
                picks_symbols,
            };
            let elements = match context.pick_symbol(at_px) {
                Some(symbol) => Elements::of(symbol),
                None => {
                    let hit = context.pick(at_px, usize::MAX);
                    let hit = hit.map(|hit| alternate_in_pair(hit, &context));
                    Elements::of_paths(hit.iter().map(|hit| hit.path))
                }
            };
            document.select_elements(&elements, mode);
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
