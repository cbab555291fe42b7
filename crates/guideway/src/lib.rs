//! Draws and checks the path layouts of automated guided vehicles.
//!
//! Open a layout file, show all of it, and save the picture:
//!
//! ```
//! use std::sync::Arc;
//!
//! use guideway::render::{Budget, Cancel, Frame, FrameSize, Style, View};
//! use guideway::scene::{Scene, SceneOptions};
//!
//! # let folder = tempfile::tempdir()?;
//! # let picture = folder.path().join("site.png");
//! let layout = guideway::open("examples/site.lif.json")?;
//! let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default())?);
//!
//! let view = View::fit(FrameSize::new(1280, 720)?, scene.bounds())?;
//! let mut drawing = guideway::method("auto")?.prepare(scene, &Budget::default())?;
//! let mut frame = Frame::new(view.size());
//! let report = drawing.render(&view, &Style::default(), &Cancel::default(), &mut frame)?;
//!
//! assert!(report.accounts_for_all());
//! guideway::save_png(&frame, &picture)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! This crate only puts the others within reach: [`layout`] is the model, [`formats`] reads and writes
//! files, [`envelope`] finds what vehicles sweep, [`scene`] decides colors and order, [`render`] is what every method agrees on, and
//! [`methods`] lists what can draw on this computer. The command `guideway` is built on the same calls.

mod files;
mod methods;
mod picture;

use std::path::Path;

pub use guideway_cpu as cpu;
pub use guideway_envelope as envelope;
pub use guideway_formats as formats;
pub use guideway_layout as layout;
pub use guideway_scene as render;
pub use guideway_scene as scene;
pub use guideway_spline as spline;

pub use files::{SaveError, remove_unfinished, replace_file};
pub use methods::{
    AUTO, Available, MethodError, MethodOption, live_method, method, method_names, methods,
};
pub use picture::{save_png, save_png_by, write_png_by};

/// Reads a layout file of any known format with the default limits.
///
/// # Errors
/// As [`formats::read_file`], which also takes limits and reports progress.
pub fn open(path: impl AsRef<Path>) -> Result<layout::Layout, formats::ReadError> {
    formats::read_file(path.as_ref(), &formats::ReadOptions::default())
}
