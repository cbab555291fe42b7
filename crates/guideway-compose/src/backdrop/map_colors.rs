//! Colors the cells of a ROS map: walls dark, free cells white, unknown ones translucent.

use guideway_formats::raster::Raster;
use guideway_formats::ros_map::{OCCUPIED, OccupancyGrid, UNKNOWN};

/// Color of a free cell.
const FREE: [u8; 4] = [255, 255, 255, 255];

/// Color of an occupied cell: dark, and lighter than the black of paths without a color.
const WALL: [u8; 4] = [75, 85, 99, 255];

/// Color of an unknown cell: a shade of any background, darker than free cells on a white one.
const UNKNOWN_COLOR: [u8; 4] = [128, 128, 128, 64];

/// The image of a map, one pixel per cell.
pub(super) fn image_of(grid: &OccupancyGrid) -> Raster {
    Raster {
        width: grid.width,
        height: grid.height,
        pixels: grid.cells.iter().map(|&cell| color(cell)).collect(),
        has_alpha: true,
        png: None,
    }
}

/// The color of a cell: partly occupied ones lie between free and occupied.
fn color(cell: u8) -> [u8; 4] {
    if cell == UNKNOWN {
        return UNKNOWN_COLOR;
    }
    let mix = |free: u8, wall: u8| {
        let (free, wall) = (i32::from(free), i32::from(wall));
        (free + (wall - free) * i32::from(cell) / i32::from(OCCUPIED)) as u8
    };
    [0, 1, 2, 3].map(|i| mix(FREE[i], WALL[i]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_are_dark_and_free_cells_white() {
        assert_eq!(color(0), FREE);
        assert_eq!(color(OCCUPIED), WALL);
        assert_eq!(color(50), [165, 170, 177, 255]);
        assert_eq!(color(UNKNOWN), UNKNOWN_COLOR);
    }
}
