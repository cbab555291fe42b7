use guideway_scene::Work;

use super::chunk::Seen;
use super::shared::{CORNERS, DrawElements, PathRecord};
use crate::options::Commands;

/// What one frame asks of memory: the pre-pass over `paths`, and in each tile the commands and the vertices
/// of what is seen. What rasterizing writes depends on the device and is left out.
pub(super) fn work(commands: Commands, paths: u64, seen: Seen, tiles: u32) -> Work {
    let index = size_of::<u32>() as u64;
    let vertices = seen.segments * u64::from(CORNERS);
    // Each vertex is an index, or a patch, and a control point.
    let drawn_vertices = vertices * (index + size_of::<[f32; 2]>() as u64);
    let (written, culled, drawn, atomics) = match commands {
        Commands::PerPath => {
            let written = seen.paths * size_of::<DrawElements>() as u64;
            (written, 0, written + drawn_vertices, seen.paths)
        }
        Commands::Compact => {
            let written = seen.segments * index;
            (written, written, drawn_vertices, 2 * seen.paths)
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
