//! Draws, checks, edits and converts the path layouts of automated guided vehicles.
//!
//! A layout is a set of curves that vehicles follow, with nodes, stations and levels. This crate
//! reads it from LIF, VDA 5050, openTCS, DXF, SVG, GeoJSON, YAML or Arrow files, and puts the parts
//! of the project within reach:
//!
//! | module | purpose |
//! |---|---|
//! | [`formats`] | reads and writes files |
//! | [`arrow`] | tables in memory, for data frames and databases, and back |
//! | [`layout`] | the model, its checks, merging of files |
//! | [`spline`] | the mathematics of curves |
//! | [`network`] | networks from drawings, their faults, and routes |
//! | `envelope` | the areas that vehicles sweep, and their distances, with the feature `envelope` |
//! | [`scene`] | colors, widths and draw order; edits; the contract of all render methods |
//! | `document` | a layout under edit: selection, search, undo, journal, with the feature `document` |
//! | `script` | edits by a list of steps in JSON, with the feature `script` |
//! | `compose` | the finished picture with all its layers, as PNG, SVG or PDF; feature `compose` |
//! | `json` | facts and routes for programs in other languages, with the feature `json` |
//! | [`methods`], [`method`] | the render methods of this build |
//!
//! The command `guideway` calls the same functions; it is the module `cli`, with the feature `cli`.
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
//! Elements have names, values and lengths:
//!
//! ```
//! # use guideway::layout::Value;
//! let layout = guideway::open("examples/site.lif.json")?;
//! let dock = layout.edge("dock-1-002--dock-1-003").expect("the site has this edge");
//! assert_eq!(dock.attribute("maxSpeed"), Some(Value::Float(0.3)));
//! assert_eq!(dock.length_m(), 4.0);
//! let middle = dock.point_at(2.0).expect("it has a curve");
//! assert_eq!((middle.x, middle.y), (36.0, 4.0));
//! # Ok::<(), guideway::formats::ReadError>(())
//! ```
//!
//! # Check
//!
//! A finding has a stable code, a severity, a place and a remedy. [`check()`] collects those of the
//! reader, of the geometry and of the network; [`layout::check`] and [`network::analyze`] take
//! options.
//!
//! ```
//! use guideway::layout::Severity;
//!
//! let layout = guideway::open("examples/site.lif.json")?;
//! let findings = guideway::check(&layout);
//! for finding in findings.iter() {
//!     println!("{}: {}. {}", finding.place, finding.message, finding.remedy);
//! }
//! assert_eq!(findings.count_at_least(Severity::Warning), 0);
//! # Ok::<(), guideway::formats::ReadError>(())
//! ```
//!
//! # Render
//!
//! [`render`] draws a layout as PNG or SVG:
//!
//! ```
//! let layout = guideway::open("examples/site.lif.json")?;
//! # let folder = tempfile::tempdir()?;
//! # let picture = folder.path().join("site.png");
//! let rendered = guideway::render(layout, &picture)?;
//! assert_eq!(rendered.report.drawn, 326);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! To draw many views, prepare a [`Scene`](scene::Scene) once: it resolves colors, widths and draw
//! order. A [method()] renders any view of it; the report accounts for every path.
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
//! A [`Document`](document::Document) records every change, so that it can be undone. What belongs
//! together follows: paths their nodes, stations their places, stated lengths their curves.
//!
//! ```
//! use std::sync::Arc;
//!
//! use guideway::document::Document;
//! use guideway::scene::SceneOptions;
//! use guideway::spline::Point;
//!
//! let layout = Arc::new(guideway::open("examples/site.lif.json")?);
//! let dock = layout.edge("dock-1-002--dock-1-003").expect("the site has this edge");
//! let node = dock.end_node().expect("it ends at a node");
//! let mut document = Document::new(Arc::clone(&layout), &SceneOptions::default())?;
//! let length_m = |of: &Document| of.layout().edge(dock.id()).map(|edge| edge.length_m());
//!
//! document.move_node(node, layout.nodes.position_m(node) + Point::new(0.5, 0.0))?;
//! assert!(length_m(&document) > Some(4.0));
//! document.undo();
//! assert_eq!(length_m(&document), Some(4.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Convert
//!
//! [`save`] writes the format of the extension, whole or not at all, and returns what the format
//! cannot hold.
//!
//! ```
//! let layout = guideway::open("examples/site.lif.json")?;
//! # let folder = tempfile::tempdir()?;
//! # let target = folder.path().join("site.dxf");
//! for loss in guideway::save(&layout, &target)?.iter() {
//!     println!("not in the drawing: {loss}");
//! }
//! assert_eq!(guideway::open(&target)?.provenance.format, "DXF");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`write()`] writes a given format to a stream. [`arrow::batches`] gives the tables in memory
//! that data frames and databases take, and [`arrow::read_batches`] makes a layout of them again.
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

// The command names the library as other programs do.
#[cfg(feature = "cli")]
extern crate self as guideway;

#[cfg(feature = "cli")]
pub mod cli;
mod files;
#[cfg(feature = "json")]
pub mod json;
mod methods;
#[cfg(feature = "cli")]
mod out_of_memory;
#[cfg(feature = "compose")]
mod render;
#[cfg(feature = "script")]
pub mod script;

#[cfg(feature = "compose")]
pub use guideway_compose as compose;
pub use guideway_cpu as cpu;
#[cfg(feature = "document")]
pub use guideway_document as document;
#[cfg(feature = "envelope")]
pub use guideway_envelope as envelope;
pub use guideway_formats as formats;
#[cfg(feature = "arrow")]
pub use guideway_formats::arrow;
#[cfg(feature = "gpu")]
pub use guideway_gpu::Gpu;
pub use guideway_layout as layout;
pub use guideway_network as network;
pub use guideway_scene as scene;
pub use guideway_spline as spline;
#[cfg(feature = "tiles")]
pub use guideway_tiles as tiles;

pub use files::{SaveAsError, check, open, save, write};
pub use guideway_formats::{
    NewFile, SaveError, remove_unfinished, replace_file, try_remove_unfinished,
};
pub use guideway_png::{PngHeader, save_png, save_png_by, world_file, write_png_by};
#[cfg(feature = "gpu")]
pub use methods::share_device;
pub use methods::{
    AUTO, Available, MethodError, MethodOption, device_limits, graphics_adapters, live_method,
    method, method_names, methods,
};
#[cfg(feature = "compose")]
pub use render::render;
