//! Blocks that several sections use: the pictures of a figure, and the warning about compute
//! devices.

use super::section::Block;
use crate::reproduce::Run;
use crate::reproduce::names::TESSELLATION;

/// The pictures of a figure with a caption.
pub(super) fn pictures(run: &Run, figure: &str, caption: &str) -> Block {
    let own = run.results.pictures.iter().filter(|p| p.figure == figure);
    Block::Pictures(caption.to_owned(), own.cloned().collect())
}

/// A warning about tessellation on compute devices: an H100 or H200 has 66 or more texture
/// processing clusters, but only two of them rasterize.
pub(super) fn compute_device_warning(run: &Run) -> Option<Block> {
    let devices = run.methods.iter().filter_map(|method| {
        let is_raster = method.method.starts_with(TESSELLATION);
        method.device.as_deref().filter(|_| is_raster)
    });
    let mut odd = devices.filter(|device| device.contains("H100") || device.contains("H200"));
    odd.next().map(|device| {
        Block::Text(format!(
            "Mind the device: {device} is a compute device, and only two of its clusters rasterize \
             triangles and lines. Do not compare its tessellation with its compute methods."
        ))
    })
}
