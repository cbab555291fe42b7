//! The program of the window, which `guideway view` starts.
//!
//! | module | purpose |
//! |---|---|
//! | `file_dialog` | the file dialogs of the desktop |
//! | `project_file` | reads the text of a project |
//! | `save` | saves a layout, unless that loses too much |
//! | `services` | files, pictures and methods for the window |
//! | `measure` | `--measure`: frame times without a window |
// A console would open behind a window that the desktop starts.
#![cfg_attr(windows, windows_subsystem = "windows")]

mod file_dialog;
mod measure;
mod project_file;
mod save;
mod services;

use std::process::ExitCode;
use std::sync::Arc;

use guideway::cli::window::{self, Measured, Request};
use guideway::layout::UserError;
use guideway_viewer::LaunchOptions;

use services::FileServices;

#[global_allocator]
static ALLOCATOR: guideway::cli::Allocator = guideway::cli::Allocator;

/// The window by egui.
struct Window;

impl window::Window for Window {
    fn open(&self, request: Request) -> Result<(), UserError> {
        let services = FileServices::for_window(request.prints_timings);
        let launch = LaunchOptions {
            files: request.files,
            floor_plan: request.floor_plan.unwrap_or_default(),
            method: request.method,
        };
        let opened = guideway_viewer::run(Arc::new(services), launch);
        #[cfg(windows)]
        if let Err(error) = &opened {
            show_without_terminal(error);
        }
        opened
    }

    fn measure(&self, request: Request) -> Result<Measured, UserError> {
        measure::measure(request)
    }
}

/// Shows an error in a dialog when nobody sees what is printed: programs that the desktop of
/// Windows starts have no terminal.
#[cfg(windows)]
fn show_without_terminal(error: &UserError) {
    use std::os::windows::io::AsRawHandle;
    if std::io::stderr().as_raw_handle().is_null() {
        rfd::MessageDialog::new()
            .set_level(rfd::MessageLevel::Error)
            .set_title("Guideway")
            .set_description(error.to_string())
            .show();
    }
}

fn main() -> ExitCode {
    window::main(&Window)
}
