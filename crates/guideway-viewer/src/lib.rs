//! The window in which layouts are looked at and edited.
//!
//! It shows and asks, and holds no algorithm: what is edited is a
//! [`Document`](guideway_document::Document), what draws is a [`Method`](guideway_scene::Method), and files are
//! the business of its [`AppServices`]. Reading, drawing and saving happen beside the window: it shows the last picture
//! where it now belongs, until the next one is there.

mod app;
mod camera;
mod measure;
mod services;
#[cfg(test)]
mod tests;
mod ui;
mod work;

use std::path::PathBuf;
use std::sync::{Arc, OnceLock};

use eframe::egui::{Context, Ui, ViewportBuilder};

use guideway_layout::UserError;

use app::{App, FIRST_PATIENCE};
pub use measure::{Movement, measure};
use services::WINDOW_ERROR;
pub use services::{
    AppServices, FloorPlan, Job, LoadStage, MethodChoice, PictureRequest, SweptAreas,
};
use work::Wake;

/// What the window opens with.
#[derive(Clone, Debug, Default)]
pub struct LaunchOptions {
    /// Layout files.
    pub files: Vec<PathBuf>,
    /// What lies below them, as a person writes it; nothing if it is empty.
    pub floor_plan: String,
    /// Name of the method that draws; none for the best one that runs here.
    pub method: Option<String>,
}

/// Opens the window, and returns when it is closed. Must be called from the main thread.
///
/// # Errors
/// When there is no desktop to show a window on, or no graphics adapter that can fill it.
pub fn run(services: Arc<dyn AppServices>, opening: LaunchOptions) -> Result<(), UserError> {
    let options = eframe::NativeOptions {
        viewport: ViewportBuilder::default()
            .with_inner_size([1280.0, 800.0])
            .with_min_inner_size([320.0, 240.0])
            .with_drag_and_drop(true),
        // It shows no gradients, and a graphics driver in software would feel it.
        dithering: false,
        ..eframe::NativeOptions::default()
    };
    let window = Arc::<OnceLock<Context>>::default();
    // Files are read while the window comes up.
    let mut app = App::new(wake_of(&window), services, opening);
    app.first_patience = FIRST_PATIENCE;
    let create: eframe::AppCreator<'_> = Box::new(move |context| {
        app.apply_theme(&context.egui_ctx);
        // It is set once.
        let _ = window.set(context.egui_ctx.clone());
        Ok(Box::new(Shell(app)))
    });
    eframe::run_native("Guideway", options, create).map_err(|error| UserError {
        code: WINDOW_ERROR,
        message: format!("no window can be shown: {error}"),
        remedy: "A window needs a desktop (X11 or Wayland on Linux) and a graphics adapter for it; on Debian or \
                 Ubuntu `libvulkan1` and `mesa-vulkan-drivers` bring one that needs no hardware. \
                 `guideway render` needs neither"
            .into(),
    })
}

/// Wakes a window as soon as it is there: with its first frame it looks for all that came before.
fn wake_of(window: &Arc<OnceLock<Context>>) -> Wake {
    let window = Arc::clone(window);
    Arc::new(move || {
        if let Some(window) = window.get() {
            window.request_repaint();
        }
    })
}

/// What the window calls.
struct Shell(App);

impl eframe::App for Shell {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.0.show(ui);
    }
}
