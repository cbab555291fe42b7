//! Counts the memory traffic and the atomic operations of a frame.

use guideway_scene::Work;

use super::chunk::VisibleCounts;
use super::shared::{DrawElements, PATCH_VERTICES, PathRecord};
use crate::options::Commands;

/// The work of one frame: the culling pass over `paths`, and per tile the commands and vertices of
/// the visible paths. It excludes the writes of the rasterizer, which depend on the device.
pub(super) fn work(commands: Commands, paths: u64, visible: VisibleCounts, tiles: u32) -> Work {
    let index = size_of::<u32>() as u64;
    let vertices = visible.segments * u64::from(PATCH_VERTICES);
    // Each vertex reads an index (or a patch) and a control point.
    let drawn_vertices = vertices * (index + size_of::<[f32; 2]>() as u64);
    let (written, culled, drawn, atomics) = match commands {
        Commands::PerPath => {
            let written = visible.paths * size_of::<DrawElements>() as u64;
            (written, 0, written + drawn_vertices, visible.paths)
        }
        Commands::Compact => {
            let written = visible.segments * index;
            (written, written, drawn_vertices, 2 * visible.paths)
        }
    };
    Work {
        tests: None,
        atomics: Some(atomics),
        bytes_read: Some(
            paths * size_of::<PathRecord>() as u64 + culled + u64::from(tiles) * drawn,
        ),
        bytes_written: Some(written),
    }
}
