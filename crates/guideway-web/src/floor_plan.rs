//! Reads a floor plan from the bytes that the page holds.

use guideway::compose::{FloorPlan, Image, ImagePlacement};
use guideway::formats::{ReadOptions, raster, read_bytes};
use guideway::layout::UserError;
use guideway::spline::Point;
use serde::Deserialize;

use crate::look::usage;

/// Scale, rotation and position of an image, as the page gives them.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
struct Placement {
    px_per_m: f64,
    rotate_deg: f64,
    /// Lower left corner, in meters.
    offset: [f64; 2],
}

/// Reads an image with its placement in JSON, or a layout or a drawing with `null` in its place.
///
/// # Errors
/// When the bytes cannot be read, or the placement is none.
pub(crate) fn read(name: &str, bytes: Vec<u8>, placement: &str) -> Result<FloorPlan, UserError> {
    let placement: Option<Placement> = serde_json::from_str(placement)
        .map_err(|error| usage(format!("the placement of {name}: {error}")))?;
    let Some(placement) = placement else {
        let layout = read_bytes(name, &bytes, &ReadOptions::default())?;
        return Ok(FloorPlan::from_layout(layout)?);
    };
    let [x, y] = placement.offset;
    let placement = ImagePlacement {
        px_per_m: placement.px_per_m,
        rotate_deg: placement.rotate_deg,
        offset_m: Point::new(x, y),
    };
    let image = raster::read_bytes(bytes, name)?;
    Ok(FloorPlan::from_image(Image::new(image, &placement)))
}
