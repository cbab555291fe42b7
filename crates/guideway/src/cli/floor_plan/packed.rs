//! [`PackedPlan`]: a floor plan as bytes, which a page reads again.

use std::path::Path;

use guideway::SaveError;
use guideway::compose::{FloorPlanKind, Image, ImagePlacement};
use guideway::formats::raster;
use guideway::layout::UserError;

use super::{pdf_page, placement, read_layout, read_map};
use crate::cli::input::{Input, read_bytes};
use crate::cli::layout_output::exact_arrow;
use crate::cli::output::Output;

/// A floor plan as bytes: an image with its placement, or a layout as Arrow.
pub(crate) struct PackedPlan {
    /// Name of the file, for errors.
    pub(crate) name: String,
    pub(crate) bytes: Vec<u8>,
    pub(crate) placement: Option<ImagePlacement>,
}

/// Reads a floor plan and packs it.
///
/// # Errors
/// When the file cannot be read or is damaged, or its placement is missing.
pub(crate) fn pack(input: &Input, out: &Output) -> Result<PackedPlan, UserError> {
    let path = &input.path;
    let (bytes, placement) = match FloorPlanKind::of_file(path) {
        FloorPlanKind::Image => {
            let placement = placement(input)?;
            let bytes = read_bytes(path)?;
            // Whoever opens the page cannot mend a damaged image.
            raster::read_bytes(bytes.clone(), &path.to_string_lossy())?;
            (bytes, Some(placement))
        }
        FloorPlanKind::PdfPage => {
            let placement = placement(input)?;
            let page = pdf_page::read(path, input.page.unwrap_or(1))?;
            (png(&Image::new(page, &placement), path)?, Some(placement))
        }
        FloorPlanKind::RosMap => {
            let grid = read_map(input, out)?;
            (png(&Image::from_map(&grid), path)?, Some(grid.placement))
        }
        FloorPlanKind::Layout => {
            let layout = read_layout(input, out)?;
            (exact_arrow(&layout, path)?, None)
        }
    };
    let name = path.file_name().unwrap_or_default();
    Ok(PackedPlan {
        name: name.to_string_lossy().into_owned(),
        bytes,
        placement,
    })
}

fn png(image: &Image, path: &Path) -> Result<Vec<u8>, UserError> {
    let png = image.png().map_err(|problem| SaveError {
        path: path.to_owned(),
        problem,
    });
    Ok(png?.into_owned())
}
