//! Opens the native window and runs the application in it.

use std::sync::{Arc, OnceLock};

use eframe::egui::{Context, Ui, ViewportBuilder};
use guideway_layout::UserError;

use crate::app::{App, FIRST_PICTURE_WAIT};
use crate::background::RepaintHandle;
use crate::launch_options::LaunchOptions;
use crate::services::{AppServices, WINDOW_ERROR};

/// Opens the window and returns when it is closed. Must be called from the main thread.
///
/// # Errors
/// When there is no desktop to open a window on, or no graphics adapter that can draw it.
pub fn run(services: Arc<dyn AppServices>, launch: LaunchOptions) -> Result<(), UserError> {
    let options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([320.0, 240.0])
            .with_drag_and_drop(true),
        // The window has no gradients, and dithering slows down software renderers.
        dithering: false,
        ..eframe::NativeOptions::default()
    };
    let window = Arc::<OnceLock<Context>>::default();
    // The files load while the window opens.
    let mut app = App::new(repaint_handle(&window), services, launch);
    app.first_picture_wait = FIRST_PICTURE_WAIT;
    let create: eframe::AppCreator<'_> = Box::new(move |creation| {
        app.apply_theme(&creation.egui_ctx);
        // eframe calls this once, so the lock is empty.
        let _ = window.set(creation.egui_ctx.clone());
        Ok(Box::new(Window(app)))
    });
    eframe::run_native("Guideway", options, create).map_err(|error| {
        UserError::new(
            WINDOW_ERROR,
            format!(
                "cannot open a window: {}",
                without_source_path(&error.to_string())
            ),
            "A window needs a desktop (X11 or Wayland on Linux) and a graphics adapter. On Debian \
             or Ubuntu install `libvulkan1` and `mesa-vulkan-drivers`, which need no hardware. \
             `guideway render` needs neither",
        )
    })
}

/// Removes the source file and line that winit puts before its reason: they name folders of the
/// computer that built the program.
fn without_source_path(error: &str) -> String {
    let parts = error.split(' ');
    let kept = parts.filter(|part| !(part.contains('/') && part.contains(".rs:")));
    kept.collect::<Vec<_>>()
        .join(" ")
        .replace("os error at ", "")
}

/// Repaints the window once it is open. Earlier calls have no effect: the first frame takes all
/// results.
fn repaint_handle(window: &Arc<OnceLock<Context>>) -> RepaintHandle {
    let window = Arc::clone(window);
    Arc::new(move || {
        if let Some(window) = window.get() {
            window.request_repaint();
        }
    })
}

/// Connects the application to eframe.
struct Window(App);

impl eframe::App for Window {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.0.show(ui);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn error_names_no_folder_of_the_builder() {
        let error = "winit EventLoopError: os error at /root/.cargo/registry/src/x/linux/mod.rs:765: \
                     neither WAYLAND_DISPLAY nor DISPLAY is set";
        assert_eq!(
            without_source_path(error),
            "winit EventLoopError: neither WAYLAND_DISPLAY nor DISPLAY is set"
        );
    }
}
