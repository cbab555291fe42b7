//! Tells by its first bytes how a file becomes a floor plan.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use guideway_formats::raster::is_raster;
use guideway_formats::ros_map::is_ros_map;

/// Bytes that are examined: a map file takes 200, and comments may precede its fields.
const EXAMINED: u64 = 1 << 16;

/// The way in which a file becomes a floor plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FloorPlanKind {
    /// A PNG, JPEG or PGM image, which needs an [`ImagePlacement`](crate::ImagePlacement).
    Image,
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
            (b"levels:\n", FloorPlanKind::Layout),
        ] {
            std::fs::write(&path, bytes).unwrap();
            assert_eq!(FloorPlanKind::of_file(&path), kind);
        }
    }
}
