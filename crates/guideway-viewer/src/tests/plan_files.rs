//! Floor plans of the tests: a drawing in memory, and images on disk.

use std::fs;

use guideway_compose::{FloorPlan, Image, ImagePlacement};
use guideway_formats::raster;
use guideway_layout::{Layout, NewPath};
use guideway_spline::{Point, Runs};

use crate::backdrop::{PlanPlacement, PlanSize};

/// The plan of a file and its placement: `hall.png`, `hall.dxf`, which is a drawing without a unit
/// that is read as millimeters, or a JPEG file on disk.
pub(super) fn read_plan(text: &str) -> Option<FloorPlan> {
    let placement = PlanPlacement::parse(text)?;
    let is = |end: &str| placement.file.ends_with(end);
    match placement.size {
        PlanSize::PxPerM(_) if is("hall.png") => Some(hall(1.0, None)),
        PlanSize::Scale(scale) if is("hall.dxf") => Some(hall(1e-3 * scale, Some(1e-3))),
        PlanSize::PxPerM(px_per_m) if is(".jpg") => {
            let bytes = fs::read(&placement.file).ok()?;
            let image = raster::read_bytes(bytes, &placement.file).ok()?;
            let placement = ImagePlacement {
                px_per_m,
                rotate_deg: placement.rotate_deg,
                offset_m: placement.offset_m,
            };
            Some(FloorPlan::from_image(Image::new(image, &placement)))
        }
        _ => None,
    }
}

/// A floor plan of two walls, 40 m x 30 m at scale 1.
fn hall(scale: f64, assumed_unit_m: Option<f64>) -> FloorPlan {
    let mut layout = Layout::default();
    for side in [-1.0, 1.0] {
        let mut runs = Runs::default();
        let [from, to] = [-20.0, 20.0].map(|x| Point::new(x, 15.0 * side) * scale);
        runs.push_line(from, to);
        layout.paths.push(&NewPath {
            id: "wall",
            runs: &runs,
            ..NewPath::default()
        });
    }
    layout.provenance.assumed_unit_m = assumed_unit_m;
    FloorPlan::from_layout(layout).expect("the hall has no levels")
}
