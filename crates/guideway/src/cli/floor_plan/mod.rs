//! Reads the file of `--floor-plan`: a layout, a drawing, an image or a page of a PDF with its
//! scale, or a ROS map.
//!
//! | module | purpose |
//! |---|---|
//! | `packed` | the bytes and the placement of a floor plan, for a page |
//! | `pdf_page` | draws a page of a PDF by Poppler |

mod packed;
mod pdf_page;

pub(crate) use packed::{PackedPlan, pack};

use std::path::Path;

use guideway::compose::{FloorPlan, FloorPlanKind, Image, ImagePlacement};
use guideway::formats::ros_map::{self, OccupancyGrid};
use guideway::layout::{Layout, UserError, shown_path};

use super::error::usage_error;
use super::image_name;
use super::input::{self, Input};
use super::limits;
use super::output::Output;

/// Reads a floor plan. Its content decides between an image, a map and a layout. The picture in
/// `output`, if any, must not replace the image of a map.
pub(crate) fn read(
    input: &Input,
    output: Option<&Path>,
    out: &Output,
) -> Result<FloorPlan, UserError> {
    match FloorPlanKind::of_file(&input.path) {
        FloorPlanKind::Image => {
            let image = Image::read(&input.path, &placement(input)?)?;
            Ok(FloorPlan::from_image(image))
        }
        FloorPlanKind::PdfPage => {
            let placement = placement(input)?;
            let page = pdf_page::read(&input.path, input.page.unwrap_or(1))?;
            Ok(FloorPlan::from_image(Image::new(page, &placement)))
        }
        FloorPlanKind::RosMap => {
            let grid = read_map(input, out)?;
            if let Some(output) = output {
                input::check_output([&*grid.image], output)?;
            }
            Ok(FloorPlan::from_map(&grid))
        }
        FloorPlanKind::Layout => Ok(FloorPlan::from_layout(read_layout(input, out)?)?),
    }
}

/// Reads the walls of a floor plan as paths: all paths of a layout or drawing, or the outlines of
/// the occupied cells of a map.
pub(crate) fn read_walls(input: &Input, out: &Output) -> Result<Layout, UserError> {
    match FloorPlanKind::of_file(&input.path) {
        FloorPlanKind::Image | FloorPlanKind::PdfPage => Err(usage_error(
            format!(
                "{}: an image does not say where its walls are",
                shown_path(&input.path)
            ),
            "Give a drawing, a layout, or the `map.yaml` of a ROS map",
        )),
        FloorPlanKind::RosMap => Ok(read_map(input, out)?.walls()?),
        FloorPlanKind::Layout => read_layout(input, out),
    }
}

fn read_layout(input: &Input, out: &Output) -> Result<Layout, UserError> {
    let read = input::read_all(std::slice::from_ref(input), out);
    let (layout, _) = read.map_err(|error| image_name::explain(&input.path, error))?;
    Ok(layout)
}

/// Reads a map, which has a placement of its own. One after the file name moves the map as a whole.
fn read_map(input: &Input, out: &Output) -> Result<OccupancyGrid, UserError> {
    let name = shown_path(&input.path);
    if input.px_per_m.is_some() {
        return Err(usage_error(
            format!("{name}: `px-per-m` does not apply to a ROS map"),
            "Omit `px-per-m`; `resolution` in the map file sets the scale",
        ));
    }
    let progress = out.progress(format!("reading {name}"));
    let mut grid = ros_map::read_file(&input.path, &limits::read_options(None))?;
    grid.placement = grid.placement.transformed(
        input.scale.unwrap_or(1.0),
        input.rotate_deg.unwrap_or(0.0),
        input.offset_m.unwrap_or_default(),
    );
    progress.finish();
    Ok(grid)
}

/// The placement of an image, which needs `px-per-m` and cannot have `scale`.
fn placement(input: &Input) -> Result<ImagePlacement, UserError> {
    let name = shown_path(&input.path);
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
