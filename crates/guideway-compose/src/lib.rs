//! Composes a finished picture of a layout and writes it as rows of pixels, PNG, SVG or PDF.
//!
//! A [`Picture`] lists the layers. [`Picture::render`] draws them strip by strip with any render
//! method, [`Picture::save_png`] writes the strips to a PNG file in memory that does not grow with
//! the picture, and [`Picture::save_vector`] writes the same layers as exact curves.
//!
//! | layer, bottom first | input | module |
//! |---|---|---|
//! | background | [`Style`](guideway_scene::Style) | `render`, `svg` |
//! | floor plan | a layout, an image or a ROS map ([`FloorPlan`]) | `backdrop` |
//! | grid, zones | scene, view, [`DecorationStyle`] | `decorations` |
//! | swept areas | paths, vehicle ([`SweptAreas`]) | `backdrop` |
//! | other scenes | [`Scene`](guideway_scene::Scene)s below the topmost one | `backdrop` |
//! | paths | the topmost scene | a render method, `vector`, `density_image` |
//! | route | paths in order ([`MarkedRoute`]) | `decorations` |
//! | arrows, nodes, stations, labels | scene, view | `decorations` |
//! | legend, title, scale bar | scene, view | `decorations` |
//!
//! Decorations become a [`DrawList`](guideway_scene::DrawList) of polygons and lines of text before
//! anything is drawn, so that all formats show the same shapes. `overlay` rasterizes a draw list,
//! `vector` writes it as elements of a `page`, SVG or `pdf`, and `text` shapes its lines with an
//! embedded font and, for letters that this font lacks, the fonts of the system.
//!
//! ```
//! use std::sync::Arc;
//!
//! use guideway_compose::{Decorations, NoProgress, Picture};
//! use guideway_cpu::Cpu;
//! use guideway_layout::{Layout, NewPath};
//! use guideway_scene::{FrameSize, Scene, SceneOptions};
//! use guideway_spline::{Point, Runs};
//!
//! let mut runs = Runs::default();
//! runs.push_line(Point::new(0.0, 0.0), Point::new(12.0, 0.0));
//! let mut layout = Layout::default();
//! layout.paths.push(&NewPath { id: "aisle-1", runs: &runs, ..NewPath::default() });
//!
//! let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default())?);
//! let mut picture = Picture::new(scene, FrameSize::new(1280, 720)?);
//! picture.decorations = Decorations::site("Aisle 1");
//! # let folder = tempfile::tempdir()?;
//! let rendered = picture.save_png(&Cpu, folder.path().join("aisle.png"), &NoProgress)?;
//! assert_eq!(rendered.report.drawn, 1);
//! picture.save_svg(folder.path().join("aisle.svg"))?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod backdrop;
mod blend;
mod center_lines;
mod crowd;
mod decorations;
mod density_image;
mod error;
mod kept_method;
mod levels;
mod overlay;
mod page;
mod pdf;
mod picture;
mod render;
#[cfg(test)]
mod test_layouts;
mod text;
mod vector;
mod vector_file;
mod widths;

pub use backdrop::{
    Backdrop, FloorPlan, FloorPlanKind, Image, OtherScene, PreparedFloorPlan, SweptAreas,
    SweptReport, draw_swept_areas,
};
pub use crowd::is_crowd;
pub use decorations::{Decorations, MarkedRoute};
pub use error::{ComposeError, ImageError};
pub use guideway_document::decorations::{Corner, DecorationStyle, grid, legend, scale_bar};
pub use guideway_document::text_format;
pub use guideway_formats::lock_regular_file;
pub use guideway_formats::raster::ImagePlacement;
pub use guideway_png::{PngHeader, save_png, save_png_by, world_file, write_png_by};
pub use kept_method::KeptMethod;
pub use picture::{LevelPart, Picture, Viewport};
pub use render::{NoProgress, Rendered, StripSink};
#[cfg(not(target_arch = "wasm32"))]
pub use text::PageFont;
pub use text::{SystemFont, add_font, has_missed_letters, system_font};
pub use vector_file::VectorFormat;
pub use widths::{suitable_widths, usual_widths};
