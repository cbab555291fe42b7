//! Draws, checks, edits and converts the path layouts of automated guided vehicles.
//!
//! A layout is a set of curves that vehicles follow, with nodes, stations and levels. This crate
//! reads it from LIF, VDA 5050, openTCS, DXF, SVG, GeoJSON, YAML or Arrow files, and puts the parts
//! of the project within reach:
//!
//! | module | purpose |
//! |---|---|
//! | [`formats`] | reads and writes files |
//! | [`layout`] | the model, its checks, merging of files |
//! | [`spline`] | the mathematics of curves |
//! | [`network`] | networks from drawings, their faults, and routes |
//! | [`envelope`] | the areas that vehicles sweep, and their distances |
//! | [`scene`] | colors, widths and draw order; edits; the contract of all render methods |
//! | [`document`] | a layout under edit: selection, search, undo, journal |
//! | [`compose`] | the finished picture as PNG or SVG, with backdrop, labels, legend and title |
//! | [`methods`], [`method`] | the render methods of this build |
//!
//! The command `guideway` calls the same functions.
//!
//! # Open
//!
//! The content of a file decides its format. Paths that cannot be drawn are in `refused`, with a
//! reason; nothing is dropped silently.
//!
//! ```
//! let layout = guideway::open("examples/site.lif.json")?;
//! assert_eq!(layout.provenance.format, "LIF");
//! assert_eq!(layout.refused.len(), 0);
//! println!("{} paths, {} stations", layout.paths.len(), layout.stations.len());
//! # Ok::<(), guideway::formats::ReadError>(())
//! ```
//!
//! # Check
//!
//! A finding has a stable code, a severity, a place and a remedy. Findings of the reader are in
//! `layout.diagnostics`; [`layout::check`] examines the geometry.
//!
//! ```
//! use guideway::layout::{CheckOptions, Severity, check};
//!
//! let layout = guideway::open("examples/site.lif.json")?;
//! let options = CheckOptions {
//!     min_radius_m: Some(1.5),
//!     ..CheckOptions::default()
//! };
//! let findings = check(&layout, &options);
//! for finding in findings.iter() {
//!     println!("{}: {}. {}", finding.place, finding.message, finding.remedy);
//! }
//! assert_eq!(findings.count_at_least(Severity::Error), 0);
//! # Ok::<(), guideway::formats::ReadError>(())
//! ```
//!
//! # Render
//!
//! A [`Scene`](scene::Scene) resolves colors, widths and draw order once. A [method()]
//! prepares the scene and then renders any view of it; the report accounts for every path.
//!
//! ```
//! use std::sync::Arc;
//!
//! use guideway::scene::{
//!     Budget, Cancel, ColorBy, Frame, FrameSize, Scene, SceneOptions, Style, View,
//! };
//!
//! let layout = guideway::open("examples/site.lif.json")?;
//! let options = SceneOptions {
//!     color_by: Some(ColorBy { column: "maxSpeed".into() }),
//!     ..SceneOptions::default()
//! };
//! let scene = Arc::new(Scene::new(Arc::new(layout), &options)?);
//!
//! let view = View::fit(FrameSize::new(640, 360)?, scene.bounds())?;
//! let mut prepared = guideway::method("auto")?.prepare(scene, &Budget::default())?;
//! let mut frame = Frame::new(view.size());
//! let report = prepared.render(&view, &Style::default(), &Cancel::default(), &mut frame)?;
//!
//! assert!(report.accounts_for_all());
//! # let folder = tempfile::tempdir()?;
//! guideway::save_png(&frame, folder.path().join("site.png"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Edit
//!
//! A [`Document`](document::Document) records every change, so that it can be undone.
//!
//! ```
//! use std::sync::Arc;
//!
//! use guideway::document::Document;
//! use guideway::scene::SceneOptions;
//! use guideway::spline::{Affine, Point};
//!
//! let layout = guideway::open("examples/site.lif.json")?;
//! let mut document = Document::new(Arc::new(layout), &SceneOptions::default())?;
//! let left = |document: &Document| document.bounds().map(|bounds| bounds.min.x);
//! let before = left(&document);
//!
//! document.select_all();
//! document.transform_selection("move", Affine::translation(Point::new(5.0, 0.0)))?;
//! assert!(left(&document) > before);
//! assert_eq!(document.undo(), Some("move"));
//! assert_eq!(left(&document), before);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Convert
//!
//! Each writer returns what its format cannot hold. [`replace_file`] makes the file appear whole or
//! not at all.
//!
//! ```
//! use guideway::formats::dxf;
//!
//! let layout = guideway::open("examples/site.lif.json")?;
//! # let folder = tempfile::tempdir()?;
//! # let target = folder.path().join("site.dxf");
//! let losses = guideway::replace_file(&target, |file| {
//!     let written = dxf::write_layout(&layout, file);
//!     written.map_err(|problem| guideway::SaveError { path: target.clone(), problem })
//! })?;
//! for loss in losses.iter() {
//!     println!("not in the drawing: {loss}");
//! }
//! assert_eq!(guideway::open(&target)?.provenance.format, "DXF");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Compose
//!
//! A [`Picture`](compose::Picture) adds what a plan needs: a floor plan below the paths, arrows,
//! nodes, stations, labels, a grid, a scale bar, a legend and a title.
//!
//! ```
//! use std::sync::Arc;
//!
//! use guideway::compose::{Decorations, NoProgress, Picture};
//! use guideway::scene::{FrameSize, Scene, SceneOptions};
//!
//! let layout = guideway::open("examples/site.lif.json")?;
//! let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default())?);
//! let mut picture = Picture::new(scene, FrameSize::new(640, 360)?);
//! picture.decorations = Decorations::site("Hall 3");
//!
//! # let folder = tempfile::tempdir()?;
//! let method = guideway::method("cpu")?;
//! picture.save_png(&*method, folder.path().join("site.png"), &NoProgress)?;
//! picture.save_svg(folder.path().join("site.svg"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod methods;

use std::path::Path;

pub use guideway_compose as compose;
pub use guideway_cpu as cpu;
pub use guideway_document as document;
pub use guideway_envelope as envelope;
pub use guideway_formats as formats;
pub use guideway_layout as layout;
pub use guideway_network as network;
pub use guideway_scene as scene;
pub use guideway_spline as spline;

pub use guideway_compose::{save_png, save_png_by, write_png_by};
pub use guideway_formats::{
    NewFile, SaveError, remove_unfinished, replace_file, try_remove_unfinished,
};
pub use methods::{
    AUTO, Available, MethodError, MethodOption, live_method, method, method_names, methods,
};

/// Reads a layout file with the default limits. The content decides the format.
///
/// # Errors
/// See [`formats::read_file`], which also takes limits and reports progress.
pub fn open(path: impl AsRef<Path>) -> Result<layout::Layout, formats::ReadError> {
    formats::read_file(path.as_ref(), &formats::ReadOptions::default())
}
