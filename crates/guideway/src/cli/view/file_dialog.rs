//! The file dialogs of the desktop: by the XDG portal or zenity on Linux, by the system elsewhere.

use guideway_viewer::{FileAnswer, FileFormat, FileQuestion, PendingFileAnswer};
use rfd::{AsyncFileDialog, FileHandle};

/// Opens the dialog. The answer comes on the thread that waits for it; macOS wants the dialog
/// itself on the main thread, on which the window calls this.
pub(super) fn ask(question: &FileQuestion) -> Option<PendingFileAnswer> {
    let mut dialog = AsyncFileDialog::new().set_title(&question.title);
    if let Some(folder) = &question.folder {
        // Portals do not take relative names.
        dialog = dialog.set_directory(std::path::absolute(folder).ok()?);
    }
    for FileFormat { name, extensions } in &question.formats {
        dialog = dialog.add_filter(name, extensions);
    }
    Some(match question.new_name.clone() {
        Some(name) => {
            let chosen = dialog.set_file_name(name).save_file();
            Box::new(move || answer(pollster::block_on(chosen)))
        }
        None => {
            let chosen = dialog.pick_file();
            Box::new(move || answer(pollster::block_on(chosen)))
        }
    })
}

fn answer(chosen: Option<FileHandle>) -> FileAnswer {
    // Nothing tells a cancelled dialog from a desktop without one; the window does by the time.
    chosen.map_or(FileAnswer::Cancelled, |file| {
        FileAnswer::Chosen(file.path().to_owned())
    })
}
