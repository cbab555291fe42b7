//! Reads the file of `--floor-plan`: a layout, a drawing or a PNG image with its scale.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use guideway::compose::{FloorPlan, Image, ImagePlacement};
use guideway::layout::UserError;

use super::error::usage_error;
use super::input::{self, Input};
use super::output::Output;

/// First bytes of a PNG file.
const PNG: &[u8] = b"\x89PNG";

/// Reads a floor plan. Its content decides between an image and a layout.
pub(crate) fn read(input: &Input, out: &Output) -> Result<FloorPlan, UserError> {
    if is_png(&input.path) {
        let image = Image::read(&input.path, &placement(input)?)?;
        return Ok(FloorPlan::from_image(image));
    }
    let (layout, _) = input::read_all(std::slice::from_ref(input), out)?;
    Ok(FloorPlan::from_layout(layout)?)
}

/// The placement of an image, which needs `px-per-m` and cannot have `scale`.
fn placement(input: &Input) -> Result<ImagePlacement, UserError> {
    let name = input.path.display();
    let Some(px_per_m) = input.px_per_m else {
        return Err(usage_error(
            format!("{name}: the image has no scale"),
            "Give its pixels per meter and the position of its lower left corner, such as \
             `hall.png@px-per-m=20,offset=-3,-2`",
        ));
    };
    if input.scale.is_some() {
        return Err(usage_error(
            format!("{name}: `scale` does not apply to images"),
            "Omit `scale`; `px-per-m` sets the scale of an image",
        ));
    }
    Ok(ImagePlacement {
        px_per_m,
        rotate_deg: input.rotate_deg.unwrap_or(0.0),
        offset_m: input.offset_m.unwrap_or_default(),
    })
}

/// Returns `true` if a file begins as PNG. For a file that cannot be read, the reader reports the
/// error.
fn is_png(path: &Path) -> bool {
    let mut first = [0; PNG.len()];
    path.is_file()
        && File::open(path).is_ok_and(|mut file| file.read_exact(&mut first).is_ok())
        && first == PNG
}
