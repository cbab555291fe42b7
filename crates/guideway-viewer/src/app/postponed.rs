//! Keeps input that needs the document while an edit has it: commands and clicks act in the order
//! in which they came, and where they were made, although the view may have moved since.

use super::state::App;
use super::waiting::Input;
use crate::command::Command;
use crate::files::Layer;
use crate::tools::PointerEvent;

impl App {
    /// Keeps a command that needs to read the document while an edit has it, and those behind it.
    /// Returns `true` if the command is not to run now. Escape takes back what waits.
    pub(super) fn postpone(&mut self, command: Command) -> bool {
        let waits = !self.waiting.is_empty();
        if command == Command::Cancel {
            self.waiting.clear();
            return waits;
        }
        let editing = self.files.active().filter(|layer| layer.slot.is_editing());
        let Some(layer) = editing.filter(|layer| waits || self.reads_document(command, layer))
        else {
            return false;
        };
        let place = self.canvas.place();
        self.waiting
            .push(layer.path(), Input::Command(command), place);
        true
    }

    /// Keeps a click or drag behind a command that waits. Returns `true` if it is not to run now.
    pub(super) fn postpone_pointer(&mut self, event: PointerEvent) -> bool {
        let is_hover = matches!(event, PointerEvent::Hover(_));
        let Some(layer) = self
            .files
            .active()
            .filter(|_| !is_hover && !self.waiting.is_empty())
        else {
            return false;
        };
        let place = self.canvas.place();
        self.waiting
            .push(layer.path(), Input::Pointer(event), place);
        true
    }

    /// Returns `true` if a command acts on what it reads in the document.
    fn reads_document(&self, command: Command, layer: &Layer) -> bool {
        match command {
            Command::Delete
            | Command::Cut
            | Command::Copy
            | Command::Rename
            | Command::Array
            | Command::MoveToLevel
            | Command::Fillet
            | Command::Weld
            | Command::Distribute
            | Command::NewLevel
            | Command::NewVehicleType => true,
            // Arrow keys move the selection, if there is one.
            Command::PanLeft | Command::PanRight | Command::PanUp | Command::PanDown => {
                !self.tools.tool().adds_points() && layer.slot.had_elements_selected()
            }
            _ => false,
        }
    }
}
