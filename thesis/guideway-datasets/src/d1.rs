//! Generates dataset D1, a site of halls: from a number of paths and a seed to the paths.

use guideway_spline::Point;

use crate::GeneratedPath;
use crate::hall::{Hall, most_size_m};
use crate::random::Random;

/// Approximate number of paths per hall.
const HALL_PATHS: usize = 1_000;
/// Aspect ratio of the whole site.
const SITE_ASPECT: f64 = 16.0 / 9.0;

/// A site of halls with about a thousand paths each, in rows that form about 16:9.
///
/// One hall is some 110 m wide: aisles 3 to 4 m apart, roads of two lanes that connect them, turns
/// with radii of 1.5 to 3 m, lane changes, and docks along two walls. Connected paths share
/// position and direction at their ends. Random dimensions make all halls different.
pub fn d1(paths: usize, seed: u64) -> impl Iterator<Item = GeneratedPath> {
    let halls = (paths.saturating_add(HALL_PATHS / 2) / HALL_PATHS).max(1);
    let site = Site::new(paths, halls);
    (0..halls).flat_map(move |hall| {
        // Integer shares that add up to `paths` exactly.
        let share = |hall: usize| (paths as u128 * hall as u128 / halls as u128) as usize;
        let wanted = share(hall + 1) - share(hall);
        let mut random = Random::new(seed, hall as u64);
        let plan = Hall::new(hall as u32, wanted, &mut random);
        let mut paths = plan.paths(site.center(hall));
        paths.truncate(wanted);
        paths
    })
}

/// Positions of the halls; the center of the site is the origin, where `f32` has the best
/// resolution.
struct Site {
    columns: usize,
    rows: usize,
    cell: Point<f64>,
}

impl Site {
    fn new(paths: usize, halls: usize) -> Self {
        let cell = most_size_m(paths.div_ceil(halls));
        let columns = libm::sqrt(halls as f64 * SITE_ASPECT * cell.y / cell.x);
        let columns = (libm::round(columns) as usize).clamp(1, halls);
        Self {
            columns,
            rows: halls.div_ceil(columns),
            cell,
        }
    }

    fn center(&self, hall: usize) -> Point<f64> {
        let (column, row) = (hall % self.columns, hall / self.columns);
        let from_middle = |index: usize, count: usize| index as f64 - (count - 1) as f64 / 2.0;
        Point::new(
            from_middle(column, self.columns) * self.cell.x,
            // Rows from top to bottom.
            -from_middle(row, self.rows) * self.cell.y,
        )
    }
}
