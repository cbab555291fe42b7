//! Routes keys and pointer events in the order in which they came: a click followed by Delete in
//! one slow frame deletes what was clicked.

use eframe::egui::{Context, Event, FocusDirection, Key, Modifiers, Popup};

use super::basics::{release_keyboard, tool_context};
use super::state::App;
use crate::backdrop::PlanTask;
use crate::background::changes_parts_late;
use crate::command::{Command, command_of};
use crate::tools::{KeyAnswer, PointerEvent};

impl App {
    /// Handles the keys and pointer events of a frame. Fields and dialogs get what is left.
    pub(super) fn take_input(&mut self, ctx: &Context) {
        let events = ctx.input(|input| input.events.clone());
        // A field has lost the focus already to an Escape of this frame.
        self.has_field_until_escape = self.had_field && events.iter().any(is_escape);
        let mut is_left = Vec::with_capacity(events.len());
        self.changes_late = false;
        for event in &events {
            self.has_field_until_escape &= !is_escape(event);
            let (view, is_calm) = (self.canvas.camera.view(), is_calm(ctx));
            let is_taken = self.take_key(event, ctx) || self.take_text(event, ctx);
            is_left.push(!is_taken);
            self.take_pointer(event, ctx);
            // All parts are shown after the camera has moved.
            let is_shown = match event {
                Event::Key { .. } => is_taken && self.canvas.camera.view() != view,
                Event::Text(_) => !is_taken,
                _ => false,
            };
            self.changes_late |= changes_parts_late(event) && !(is_calm && is_shown);
        }
        let mut is_left = is_left.into_iter();
        ctx.input_mut(|input| input.events.retain(|_| is_left.next().unwrap_or(true)));
    }

    /// Tells the tools what is under the pointer, before the panels that show it: so one frame per
    /// movement is enough.
    pub(super) fn take_hover(&mut self, ctx: &Context) {
        self.canvas.follow_pointer(ctx);
        if !self.canvas.is_pressed() {
            self.point(PointerEvent::Hover(self.canvas.pointer_px()));
        }
    }

    /// Performs the command of a pressed key. Returns `true` if there is one.
    fn take_key(&mut self, event: &Event, ctx: &Context) -> bool {
        let Event::Key {
            key,
            pressed: true,
            modifiers,
            ..
        } = *event
        else {
            return false;
        };
        let is_typing = self.is_typing(ctx);
        if !is_typing
            && !self.dialogs.is_modal(&self.files)
            && self.take_typed_key(key, modifiers, ctx)
        {
            return true;
        }
        let Some(command) = command_of(key, modifiers) else {
            if !is_typing && !self.dialogs.is_modal(&self.files) {
                self.take_point_key(key, ctx);
            }
            return false;
        };
        let is_for_field = is_typing && (!modifiers.command || is_text_command(command));
        let is_blocked = is_for_field || self.dialogs.is_modal(&self.files);
        let is_idle = command == Command::FinishPath && self.tools.tool().curve().is_none();
        if is_idle || (is_blocked && command != Command::Cancel) {
            return false;
        }
        self.perform(command, ctx);
        true
    }

    /// Returns `true` if keys belong to a text field.
    fn is_typing(&self, ctx: &Context) -> bool {
        self.has_field_until_escape || ctx.text_edit_focused()
    }

    /// Inserts or removes a control point under the pointer.
    fn take_point_key(&mut self, key: Key, ctx: &Context) {
        let Some(at_px) = self.canvas.event_px(ctx) else {
            return;
        };
        match key {
            Key::Insert => self.point(PointerEvent::InsertPoint(at_px)),
            Key::Backspace => self.point(PointerEvent::RemovePoint(at_px)),
            _ => {}
        }
    }

    /// Gives a key to the typed input of the tools. Returns `true` if they took it.
    fn take_typed_key(&mut self, key: Key, modifiers: Modifiers, ctx: &Context) -> bool {
        let Some(context) = tool_context(&self.files, &self.canvas, &self.settings) else {
            return false;
        };
        let at_px = self.canvas.event_px(ctx);
        match self.tools.type_key(key, modifiers, &context, at_px) {
            KeyAnswer::NotTaken => false,
            KeyAnswer::Taken(effect) => {
                // Tab does not go to a field then.
                ctx.memory_mut(|memory| memory.move_focus(FocusDirection::None));
                self.apply_effect(effect);
                true
            }
        }
    }

    /// Takes typed text, and the clipboard events by which the window system replaces Ctrl+C,
    /// Ctrl+X and Ctrl+V. Returns `true` if the event is no longer needed.
    fn take_text(&mut self, event: &Event, ctx: &Context) -> bool {
        if self.is_typing(ctx) || self.dialogs.is_modal(&self.files) {
            return false;
        }
        match event {
            Event::Text(text) => self.files.active().is_some() && self.tools.type_text(text),
            Event::Paste(text) if self.tools.typed().is_some() => self.tools.type_text(text),
            // Without selected elements, a text of a panel may be meant.
            Event::Copy if self.has_selection() => self.take_command(Command::Copy, ctx),
            Event::Cut if self.has_selection() => self.take_command(Command::Cut, ctx),
            // Cells of the table take it themselves.
            Event::Paste(_) if self.bottom.table.takes_paste() => false,
            Event::Paste(_) => self.take_command(Command::Paste, ctx),
            _ => false,
        }
    }

    fn take_command(&mut self, command: Command, ctx: &Context) -> bool {
        self.perform(command, ctx);
        true
    }

    fn take_pointer(&mut self, event: &Event, ctx: &Context) {
        // A dialog that a key of this frame opened covers the canvas from the next frame on.
        let begins = matches!(event, Event::PointerButton { pressed: true, .. });
        if begins && self.dialogs.is_modal(&self.files) {
            return;
        }
        if begins && self.canvas.is_over(event, ctx) {
            let typed = self.properties.commit();
            self.apply_all(typed, ctx);
        }
        let edits_plan = self.plan_editor.task != PlanTask::None;
        let primary_pans = self.tools.tool().adds_points() && !edits_plan;
        for event in self.canvas.pointer_events(event, ctx, primary_pans) {
            if self.point_at_plan(event) {
                continue;
            }
            self.point(event);
            if matches!(event, PointerEvent::Clicked(..)) {
                release_keyboard(ctx);
            }
        }
    }
}

/// Returns `true` if keys reach neither a widget nor a menu.
fn is_calm(ctx: &Context) -> bool {
    ctx.memory(|memory| memory.focused().is_none()) && !Popup::is_any_open(ctx)
}

fn is_escape(event: &Event) -> bool {
    matches!(
        event,
        Event::Key {
            key: Key::Escape,
            pressed: true,
            ..
        }
    )
}

/// Returns `true` if a text field handles the shortcut itself.
fn is_text_command(command: Command) -> bool {
    matches!(
        command,
        Command::Undo
            | Command::Redo
            | Command::Cut
            | Command::Copy
            | Command::Paste
            | Command::SelectAll
            | Command::CopyPicture
    )
}
