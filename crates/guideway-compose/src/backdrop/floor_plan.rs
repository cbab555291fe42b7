//! Floor plan at the bottom of a picture: the paths of a layout in a pale color, or an image; and
//! which of these a file is, by its first bytes.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use guideway_formats::raster::is_raster;
use guideway_formats::ros_map::{OccupancyGrid, is_ros_map};
use guideway_layout::Layout;
use guideway_scene::{
    Budget, Cancel, Frame, LineRule, Method, Prepared, Rgba, Scene, SceneError, SceneOptions,
    Strip, Style, View,
};
use guideway_spline::Bounds;

use super::image::Image;
use crate::page::Page;
use crate::vector::outline;
use crate::{ComposeError, KeptMethod};

/// Color of all paths of a floor plan: pale, so that the layout stands out.
const PATH_COLOR: Rgba = Rgba::opaque(0xC2, 0xCA, 0xD3);

/// Line width of a floor plan: walls and shelves are outlines, not lanes.
const LINES: LineRule = LineRule::World {
    width_m: 0.02,
    min_px: 1.0,
    max_px: 2.0,
};

/// The bottom layer of a picture. Clones share its content.
#[derive(Clone)]
pub enum FloorPlan {
    /// Paths, drawn as thin pale lines. The method keeps its preparation for the next picture.
    Paths(Arc<Scene>, KeptMethod),
    /// An image that lies on the floor.
    Image(Arc<Image>),
}

/// A floor plan, prepared for rendering.
pub enum PreparedFloorPlan {
    /// Paths, prepared by method `cpu`.
    Paths(Box<dyn Prepared>),
    /// An image.
    Image(Arc<Image>),
}

impl FloorPlan {
    /// A floor plan that shows the paths of a layout. Their own colors and widths do not apply.
    ///
    /// # Errors
    /// Never for a layout without levels; see [`Scene::new`].
    pub fn from_layout(mut layout: Layout) -> Result<Self, SceneError> {
        let rows = layout.paths.len();
        layout.paths.set_color_rgba(vec![PATH_COLOR.to_u32(); rows]);
        layout.paths.set_width_m(vec![f32::NAN; rows]);
        let scene = Scene::new(Arc::new(layout), &SceneOptions::default())?;
        Ok(Self::Paths(Arc::new(scene), KeptMethod::default()))
    }

    /// A floor plan that shows a map of ROS where the map lies.
    pub fn from_map(grid: &OccupancyGrid) -> Self {
        Self::from_image(Image::from_map(grid))
    }

    /// A floor plan that shows an image.
    pub fn from_image(image: Image) -> Self {
        Self::Image(Arc::new(image))
    }

    /// Bounding box in meters; `None` for a layout without paths.
    pub fn bounds(&self) -> Option<Bounds<f64>> {
        match self {
            Self::Paths(scene, _) => scene.bounds(),
            Self::Image(image) => Some(image.bounds()),
        }
    }

    /// Meters per unit of a drawing that does not state it, as its reader assumed.
    pub fn assumed_unit_m(&self) -> Option<f64> {
        match self {
            Self::Paths(scene, _) => scene.layout().provenance.assumed_unit_m,
            Self::Image(_) => None,
        }
    }

    /// The plan with light and dark exchanged if it is an image on paper; `None` for others. On a
    /// dark background paper would outshine all else.
    pub fn negative_of_paper(&self) -> Option<Self> {
        match self {
            Self::Image(image) if image.is_paper() => Some(Self::from_image(image.negative())),
            Self::Image(_) | Self::Paths(..) => None,
        }
    }

    /// Prepares the plan for rendering.
    ///
    /// # Errors
    /// When the paths exceed the memory budget.
    pub fn prepare(&self, budget: &Budget) -> Result<PreparedFloorPlan, ComposeError> {
        Ok(match self {
            Self::Paths(scene, method) => {
                PreparedFloorPlan::Paths(method.prepare(Arc::clone(scene), budget)?)
            }
            Self::Image(image) => PreparedFloorPlan::Image(Arc::clone(image)),
        })
    }

    /// Writes the plan as elements of a page.
    pub(super) fn write(&self, view: &View, page: &mut impl Page) -> io::Result<()> {
        match self {
            Self::Image(image) => image.write(view, page),
            Self::Paths(scene, _) => {
                for &path in scene.draw_order() {
                    let width_px = 2.0 * LINES.radius_px(None, view.px_per_m());
                    let outline = outline(scene, path, view, width_px);
                    page.path(None, &outline, PATH_COLOR, width_px)?;
                }
                Ok(())
            }
        }
    }
}

impl PreparedFloorPlan {
    /// Renders the plan over `background` into a frame of the strip's size.
    ///
    /// # Errors
    /// When the frame exceeds the memory budget.
    pub fn render(
        &mut self,
        strip: &Strip,
        background: Rgba,
        frame: &mut Frame,
    ) -> Result<(), ComposeError> {
        match self {
            Self::Paths(prepared) => {
                let style = Style {
                    line_rule: LINES,
                    background,
                    ..Style::default()
                };
                prepared.render_strip(strip, &style, &Cancel::default(), frame)?;
            }
            Self::Image(image) => image.draw(strip, background, frame),
        }
        Ok(())
    }
}

/// Bytes that are examined: a map file takes 200, and comments may precede its fields.
const EXAMINED: u64 = 1 << 16;

/// First bytes of a PDF.
const PDF: &[u8] = b"%PDF-";

/// The way in which a file becomes a floor plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FloorPlanKind {
    /// A PNG, JPEG, PBM, PGM or PPM image; needs an [`ImagePlacement`](crate::ImagePlacement).
    Image,
    /// A page of a PDF, to be drawn as an image.
    PdfPage,
    /// A `map.yaml` of ROS, which places its image itself.
    RosMap,
    /// Anything else: its reader tells whether it is a layout or a drawing.
    Layout,
}

impl FloorPlanKind {
    /// The kind of a file. A file that cannot be read is a layout, whose reader reports why.
    pub fn of_file(path: &Path) -> Self {
        let mut first = Vec::new();
        // Opening a pipe would wait for a writer.
        if path.is_file()
            && let Ok(file) = File::open(path)
        {
            // The bytes before an error still tell the kind.
            let _ = file.take(EXAMINED).read_to_end(&mut first);
        }
        match &*first {
            bytes if is_raster(bytes) => Self::Image,
            bytes if bytes.starts_with(PDF) => Self::PdfPage,
            bytes if is_ros_map(bytes) => Self::RosMap,
            _ => Self::Layout,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_bytes_tell_the_kind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        assert_eq!(FloorPlanKind::of_file(&path), FloorPlanKind::Layout);
        for (bytes, kind) in [
            (&b"P5 1 1 255\n\0"[..], FloorPlanKind::Image),
            (b"\x89PNG\r\n", FloorPlanKind::Image),
            (b"\xFF\xD8\xFF\xE0", FloorPlanKind::Image),
            (b"image: a.pgm\norigin: [0, 0, 0]\n", FloorPlanKind::RosMap),
            (b"%PDF-1.7\n", FloorPlanKind::PdfPage),
            (b"levels:\n", FloorPlanKind::Layout),
        ] {
            std::fs::write(&path, bytes).unwrap();
            assert_eq!(FloorPlanKind::of_file(&path), kind);
        }
    }
}
