//! [`OccupancyGrid`]: the cells of a map, from its image.

use std::path::{Path, PathBuf};

use guideway_layout::Place;
use guideway_spline::Point;

use super::map_file::{MapFile, MapMode};
use crate::raster::{self, ImagePlacement, Raster};
use crate::read::read_file_bytes;
use crate::source::Source;
use crate::{Problem, ReadError, ReadOptions};

/// Largest map file, in bytes: its image is a file of its own.
const MAX_FILE_BYTES: u64 = 1 << 20;

/// The occupancy of an occupied cell.
pub const OCCUPIED: u8 = 100;

/// The value of a cell whose occupancy is unknown.
pub const UNKNOWN: u8 = 255;

/// The cells of a map and their place on the floor.
#[derive(Clone, Debug, PartialEq)]
pub struct OccupancyGrid {
    /// Name of the map file, for errors.
    pub name: String,
    /// The image file.
    pub image: PathBuf,
    /// Columns of cells, at least 1.
    pub width: usize,
    /// Rows of cells, at least 1.
    pub height: usize,
    /// Occupancy from 0 (free) to [`OCCUPIED`], or [`UNKNOWN`]; the top row first.
    pub cells: Vec<u8>,
    /// Place of the cells on the floor: one per pixel of the image.
    pub placement: ImagePlacement,
}

/// Reads a map file and its image.
///
/// # Errors
/// When a file cannot be read, a field is missing, unknown or wrong, or a limit is exceeded: 1 MiB
/// for the map file, [`raster::MAX_PIXELS`], [`Limits::coordinate_m`](guideway_layout::Limits).
pub fn read_file(path: &Path, options: &ReadOptions<'_>) -> Result<OccupancyGrid, ReadError> {
    let bytes = read_file_bytes(path, options, MAX_FILE_BYTES)?;
    let name = path.to_string_lossy().into_owned();
    let source = Source {
        name: &name,
        options,
    };
    let map = MapFile::parse(&source, path, &bytes)?;
    let image = raster::read_file(&map.image, options).map_err(|error| match error.problem {
        Problem::NotFound => source.fail(missing_image(&map.image)),
        _ => error,
    })?;
    map.check_reach(&image, options.limits.coordinate_m)
        .map_err(|problem| source.fail(problem))?;
    Ok(OccupancyGrid {
        width: image.width,
        height: image.height,
        cells: map.cells(&image),
        placement: map.placement,
        image: map.image,
        name,
    })
}

fn missing_image(image: &Path) -> Problem {
    Problem::InvalidValue {
        place: Place::element("image"),
        detail: format!("there is no file {}", guideway_layout::shown_path(image)),
        remedy: "Put the image beside the map file and name it there, such as `image: hall.pgm`"
            .into(),
    }
}

impl MapFile {
    /// Checks that all cells are within the coordinate limit.
    fn check_reach(&self, image: &Raster, limit_m: f64) -> Result<(), Problem> {
        let world = self.placement.world_from_image(image.height);
        let (width, height) = (image.width as f64, image.height as f64);
        for corner in [(0.0, 0.0), (width, 0.0), (0.0, height), (width, height)] {
            let Point { x, y } = world.apply(Point::new(corner.0, corner.1));
            // `!` also catches a position that is not a number.
            if !(x.abs() <= limit_m && y.abs() <= limit_m) {
                return Err(Problem::InvalidValue {
                    place: Place::element("origin"),
                    detail: format!(
                        "a corner of the map lies at ({x:.0}, {y:.0}) m, beyond the limit of \
                         {limit_m:.0} m"
                    ),
                    remedy: "Correct `origin` or `resolution`; both are in meters".into(),
                });
            }
        }
        Ok(())
    }

    fn cells(&self, image: &Raster) -> Vec<u8> {
        let pixels = image.pixels.iter();
        pixels
            .map(|&pixel| self.cell(pixel, image.has_alpha))
            .collect()
    }

    /// The occupancy of a pixel, as the map server of Nav2 has it.
    fn cell(&self, [r, g, b, alpha]: [u8; 4], has_alpha: bool) -> u8 {
        let color = f64::from(r) + f64::from(g) + f64::from(b);
        // Trinary maps with an opacity take its mean with the colors, which map servers keep from
        // their first version.
        let lightness = match has_alpha && self.mode == MapMode::Trinary {
            true => (color + f64::from(alpha)) / (4.0 * 255.0),
            false => color / (3.0 * 255.0),
        };
        let occupancy = match self.negate {
            true => lightness,
            false => 1.0 - lightness,
        };
        let (free, occupied) = (self.free_thresh, self.occupied_thresh);
        match self.mode {
            MapMode::Raw => match (lightness * 255.0).round() as u8 {
                percent @ 0..=OCCUPIED => percent,
                _ => UNKNOWN,
            },
            MapMode::Scale if alpha < 255 => UNKNOWN,
            _ if occupancy > occupied => OCCUPIED,
            _ if occupancy < free => 0,
            MapMode::Trinary => UNKNOWN,
            MapMode::Scale => {
                let share = (occupancy - free) / (occupied - free).max(f64::MIN_POSITIVE);
                (share * f64::from(OCCUPIED)).round() as u8
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(mode: MapMode, negate: bool) -> MapFile {
        MapFile {
            image: "a.pgm".into(),
            placement: ImagePlacement {
                px_per_m: 20.0,
                rotate_deg: 0.0,
                offset_m: Point::default(),
            },
            negate,
            occupied_thresh: 0.65,
            free_thresh: 0.25,
            mode,
        }
    }

    fn cells<const N: usize>(map: &MapFile, levels: [u8; N]) -> [u8; N] {
        levels.map(|v| map.cell([v, v, v, 255], false))
    }

    #[test]
    fn trinary_cells_are_free_occupied_or_unknown() {
        let levels = [254, 205, 192, 191, 90, 89, 0];
        let expected = [0, 0, 0, UNKNOWN, UNKNOWN, OCCUPIED, OCCUPIED];
        assert_eq!(cells(&map(MapMode::Trinary, false), levels), expected);
        let negated = cells(&map(MapMode::Trinary, true), levels.map(|v| 255 - v));
        assert_eq!(negated, expected);
    }

    #[test]
    fn scale_is_proportional_between_the_thresholds() {
        let map = map(MapMode::Scale, false);
        assert_eq!(cells(&map, [255, 140, 0]), [0, 50, OCCUPIED]);
        assert_eq!(map.cell([0, 0, 0, 254], true), UNKNOWN);
        let equal = MapFile {
            free_thresh: 0.0,
            occupied_thresh: 0.0,
            ..map
        };
        assert_eq!(cells(&equal, [255, 0]), [0, OCCUPIED]);
    }

    #[test]
    fn raw_values_are_percent() {
        for negate in [false, true] {
            let cells = cells(&map(MapMode::Raw, negate), [0, 60, 100, 101, 255]);
            assert_eq!(cells, [0, 60, 100, UNKNOWN, UNKNOWN]);
        }
    }

    #[test]
    fn colors_and_in_trinary_mode_opacity_are_averaged() {
        let map = map(MapMode::Trinary, false);
        assert_eq!(map.cell([255, 0, 0, 255], false), OCCUPIED);
        assert_eq!(map.cell([255, 0, 0, 255], true), UNKNOWN);
    }
}
