//! Floor plans of the tests: a drawing in memory, and images on disk.

use std::fs;

use guideway_compose::{FloorPlan, Image, ImagePlacement};
use guideway_formats::raster;
use guideway_layout::{Layout, NewPath};
use guideway_spline::{Point, Runs};

use crate::backdrop::{PlanPlacement, PlanSize};

/// The plan of a file and its placement: `hall.png` anywhere, or a JPEG file on disk.
pub(super) fn read_plan(text: &str) -> Option<FloorPlan> {
    if text.contains("hall.png@px-per-m=") {
        return Some(hall());
    }
    let placement = PlanPlacement::parse(text)?;
    let PlanSize::PxPerM(px_per_m) = placement.size else {
        return None;
    };
    if !placement.file.ends_with(".jpg") {
        return None;
    }
    let bytes = fs::read(&placement.file).ok()?;
    let image = raster::read_bytes(bytes, &placement.file).ok()?;
    let placement = ImagePlacement {
        px_per_m,
        rotate_deg: placement.rotate_deg,
        offset_m: placement.offset_m,
    };
    Some(FloorPlan::from_image(Image::new(image, &placement)))
}

/// A floor plan of two walls, 40 m x 30 m.
fn hall() -> FloorPlan {
    let mut layout = Layout::default();
    for side in [-1.0, 1.0] {
        let mut runs = Runs::default();
        let [from, to] = [-20.0, 20.0].map(|x| Point::new(x, 15.0 * side));
        runs.push_line(from, to);
        layout.paths.push(&NewPath {
            id: "wall",
            runs: &runs,
            ..NewPath::default()
        });
    }
    FloorPlan::from_layout(layout).expect("the hall has no levels")
}
