//! The window in which layouts are viewed and edited.
//!
//! The window holds no algorithms: a [`Document`](guideway_document::Document) edits, a
//! [`Method`](guideway_scene::Method) renders, and [`AppServices`] reads and writes files. Loading,
//! rendering, long edits and saving run on other threads; until a new picture is complete the
//! window shows the last one at its place in the new view.
//!
//! | part | owns | folder |
//! |---|---|---|
//! | services | the interface to files and methods | `services` |
//! | background | one task on another thread | `background` |
//! | render queue | render threads, pictures, method | `render_queue` |
//! | editing | document, queued edits, journal, overlay | `editing` |
//! | files | open files, loading, saving, watching | `files` |
//! | backdrop | floor plan, swept areas | `backdrop` |
//! | tools | pointer tools and gestures | `tools` |
//! | selection | search, exact edits, selection commands | `selection` |
//! | canvas | camera, input, painting, decorations | `canvas` |
//! | export | pictures for files and clipboard | `export` |
//! | panels | menu bar, side panel, dialogs | `panels` |
//! | app | all parts, and the routes between them | `app` |

mod action;
mod app;
mod backdrop;
mod background;
mod canvas;
mod command;
mod display_settings;
mod editing;
mod export;
mod files;
mod measure;
mod panels;
mod render_queue;
mod selection;
mod services;
#[cfg(test)]
mod tests;
mod tools;

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use eframe::egui::{Context, Ui, ViewportBuilder};
use guideway_layout::UserError;

use app::{App, FIRST_PICTURE_WAIT};
use background::RepaintHandle;
pub use measure::{Movement, measure};
use services::WINDOW_ERROR;
pub use services::{
    AppServices, FloorPlan, Job, LoadStage, MethodChoice, PictureRequest, SweptAreas,
};

/// Content and render method of a new window.
#[derive(Clone, Debug, Default)]
pub struct LaunchOptions {
    /// Layout files to open.
    pub files: Vec<PathBuf>,
    /// Floor plan: see [`AppServices::read_floor_plan`]. Empty for none.
    pub floor_plan: String,
    /// Name of the render method; `None` selects the best one that runs here.
    pub method: Option<String>,
}

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
            format!("cannot open a window: {error}"),
            "A window needs a desktop (X11 or Wayland on Linux) and a graphics adapter. On Debian \
             or Ubuntu install `libvulkan1` and `mesa-vulkan-drivers`, which need no hardware. \
             `guideway render` needs neither",
        )
    })
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
