//! The file dialogs of the desktop: by the XDG portal or zenity on Linux, by the system elsewhere.

use std::env;
use std::path::PathBuf;

use guideway_viewer::{FileAnswer, FileFormat, FileQuestion, PendingFileAnswer};
use rfd::{AsyncFileDialog, FileHandle};

/// Opens the dialog; `None` if the desktop has none. The answer comes on the thread that waits for
/// it; macOS wants the dialog itself on the main thread, on which the window calls this.
pub(crate) fn ask(question: &FileQuestion) -> Option<PendingFileAnswer> {
    if !has_desktop() {
        return None;
    }
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

/// Returns `true` if something may show dialogs: on Linux a session bus, or zenity.
fn has_desktop() -> bool {
    if !cfg!(target_os = "linux") {
        return true;
    }
    let is_set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    let socket = env::var_os("XDG_RUNTIME_DIR").map(|folder| PathBuf::from(folder).join("bus"));
    let path = env::var_os("PATH").unwrap_or_default();
    let has_zenity = || env::split_paths(&path).any(|folder| folder.join("zenity").is_file());
    is_set("DBUS_SESSION_BUS_ADDRESS") || socket.is_some_and(|bus| bus.exists()) || has_zenity()
}

fn answer(chosen: Option<FileHandle>) -> FileAnswer {
    // Nothing tells a cancelled dialog from a desktop without one; the window does by the time.
    chosen.map_or(FileAnswer::Cancelled, |file| {
        FileAnswer::Chosen(file.path().to_owned())
    })
}
