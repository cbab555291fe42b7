//! [`Scale`]: the extent of a layout, the typical size of its paths, and doubts about its unit.

use guideway_spline::{Bounds, uniform};

use super::options::CheckOptions;
use crate::{Code, Layout, PathRef};

/// Fastest plausible speed: no road vehicle exceeds it.
pub(super) const LARGEST_SPEED_M_PER_S: f64 = 100.0;

/// A path smaller than this is a point, whatever the layout.
const LEAST_SIZE_M: f64 = 1e-12;

/// From this extent on, a layout of long paths is in doubt: no hall reaches it.
const LARGE_EXTENT_M: f64 = 3e3;
/// Longest typical distance of the nodes of a network, by whether its unit is stated. A hall in
/// centimeters that is read as meters has nodes every few hundred meters, one in millimeters every
/// few kilometers. Measured: 22 m in the public networks of known unit.
const LARGE_NODE_DISTANCE_M: [f64; 2] = [250.0, 100.0];
/// Longest typical size of paths without nodes, by whether the unit is stated: a motorway has no
/// junction for kilometers. Measured: 152 m in public maps of roads that do not state it.
const LARGE_PATH_M: [f64; 2] = [1e4, 200.0];
/// Longest typical time to drive along a path at its greatest permitted speed.
const LARGE_TIME_S: f64 = 120.0;
/// Up to this typical time, long paths are those of fast vehicles.
const ORDINARY_TIME_S: f64 = 60.0;

/// Up to this extent, a layout of short paths is in doubt: it is smaller than a vehicle.
const SMALL_EXTENT_M: f64 = 1.0;
/// Shortest typical size of paths in such a layout.
const SMALL_PATH_M: f64 = 0.01;

/// Size of a layout. The size of a path is the diagonal of its box.
#[derive(Clone, Debug)]
pub(super) struct Scale {
    /// Range of x and of y.
    pub(super) axes: [Axis; 2],
    /// Median size of the paths that are no points.
    pub(super) median_size_m: Option<f64>,
    /// Median time to drive along a path with a greatest permitted speed, and that speed.
    median_time: Option<DriveTime>,
    has_nodes: bool,
    /// True if the positions were degrees.
    is_surveyed: bool,
    /// True if the file does not state its unit.
    is_assumed: bool,
}

/// Time to drive along one path.
#[derive(Clone, Copy, Debug)]
pub(super) struct DriveTime {
    pub(super) time_s: f64,
    pub(super) speed_m_per_s: f64,
}

/// The least and the greatest coordinate on one axis, and the rows of their paths.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) least: (f64, usize),
    pub(super) greatest: (f64, usize),
}

/// A size that suggests another unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SizeDoubt {
    /// Smaller than a vehicle.
    Small,
    /// Larger than any site.
    Large,
}

impl Scale {
    pub(super) fn of(layout: &Layout) -> Self {
        let mut axes = [Axis::EMPTY; 2];
        let (mut sizes_m, mut times) = (Vec::new(), Vec::new());
        let mut has_nodes = false;
        for path in layout.paths.iter() {
            has_nodes |= path.start_node().is_some() && path.end_node().is_some();
            let Some(Bounds { min, max }) = bounds(path) else {
                continue;
            };
            axes[0].add(path.row(), min.x, max.x);
            axes[1].add(path.row(), min.y, max.y);
            let size_m = min.distance(max);
            if size_m > LEAST_SIZE_M {
                sizes_m.push(size_m);
                times.extend(drive_time(layout, path.row(), size_m));
            }
        }
        Self {
            axes,
            median_size_m: median(&mut sizes_m, |size_m| *size_m),
            median_time: median(&mut times, |time| time.time_s),
            has_nodes,
            is_surveyed: layout.geo_origin.is_some(),
            is_assumed: layout.diagnostics.count(Code::AssumedUnit) > 0,
        }
    }

    /// Width or height, whichever is greater; negative without paths.
    pub(super) fn extent_m(&self) -> f64 {
        self.axes[0].extent_m().max(self.axes[1].extent_m())
    }

    /// A doubt about the unit. Positions in degrees have no other unit, and drawings that state
    /// their unit may be small.
    pub(super) fn doubt(&self, options: &CheckOptions) -> Option<SizeDoubt> {
        let extent_m = self.extent_m();
        let median_m = self.median_size_m.unwrap_or(f64::NAN);
        let is_short = extent_m < SMALL_EXTENT_M && median_m < SMALL_PATH_M;
        let is_small = extent_m < options.smallest_extent_m
            || (is_short && (self.has_nodes || self.is_assumed));
        if extent_m >= 0.0 && is_small {
            return Some(SizeDoubt::Small);
        }
        let is_long = self.long_m().is_some() || self.slow().is_some();
        let is_large = extent_m > options.largest_extent_m
            || (extent_m > LARGE_EXTENT_M && is_long && !self.is_surveyed);
        is_large.then_some(SizeDoubt::Large)
    }

    /// The median size of the paths, if it is too large for them.
    pub(super) fn long_m(&self) -> Option<f64> {
        let by_unit = match self.has_nodes {
            true => LARGE_NODE_DISTANCE_M,
            false => LARGE_PATH_M,
        };
        let large_m = by_unit[usize::from(self.is_assumed)];
        let is_fast = self.median_time.is_some_and(|median| {
            median.time_s <= ORDINARY_TIME_S && median.speed_m_per_s <= LARGEST_SPEED_M_PER_S
        });
        self.median_size_m
            .filter(|median_m| !is_fast && *median_m > large_m)
    }

    /// The median time to drive along a path, if it is too long for one.
    pub(super) fn slow(&self) -> Option<DriveTime> {
        self.median_time
            .filter(|median| median.time_s > LARGE_TIME_S)
    }
}

impl Axis {
    const EMPTY: Self = Self {
        least: (f64::INFINITY, 0),
        greatest: (f64::NEG_INFINITY, 0),
    };

    fn add(&mut self, row: usize, least_m: f64, greatest_m: f64) {
        if least_m < self.least.0 {
            self.least = (least_m, row);
        }
        if greatest_m > self.greatest.0 {
            self.greatest = (greatest_m, row);
        }
    }

    /// Negative without coordinates.
    pub(super) fn extent_m(&self) -> f64 {
        self.greatest.0 - self.least.0
    }
}

/// Distances up to which a check sees no difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tolerances {
    /// Of the end of a path from its node, and between its runs.
    pub(super) gap_m: f64,
    /// Between two curves that are the same.
    pub(super) coincidence_m: f64,
    /// Size of a path without length.
    pub(super) dot_m: f64,
}

impl Tolerances {
    /// Fractions of the median size m of the paths, up to a bound for layouts of ordinary size.
    ///
    /// | tolerance | formula | bound |
    /// |---|---|---|
    /// | gap | m / 100 | 10 mm |
    /// | coincidence | m / 1000 | 1 mm |
    /// | path without length | m / 1,000,000 | 1 um |
    ///
    /// If the layout is so large that its millimeters were probably read as meters, the bound of
    /// the gap is 10 m. That of the coincidence stays: a wrong duplicate would cost a path. The gap
    /// is its bound in a drawing without nodes, whose shapes may have several parts.
    pub(super) fn of(scale: &Scale, options: &CheckOptions) -> Self {
        let is_large = scale.doubt(options) == Some(SizeDoubt::Large);
        let largest_gap_m = match is_large {
            true => 1e3 * CheckOptions::LARGEST_GAP_M,
            false => CheckOptions::LARGEST_GAP_M,
        };
        let relative = |fraction: f64, largest_m: f64| {
            let scaled = scale.median_size_m.map(|median_m| median_m * fraction);
            scaled.map_or(largest_m, |m| m.clamp(LEAST_SIZE_M, largest_m))
        };
        let gap_m = options.gap_tolerance_m;
        let coincidence_m = options.coincidence_tolerance_m;
        Self {
            gap_m: gap_m.unwrap_or_else(|| match scale.has_nodes {
                true => relative(1e-2, largest_gap_m),
                false => largest_gap_m,
            }),
            coincidence_m: coincidence_m
                .unwrap_or_else(|| relative(1e-3, CheckOptions::LARGEST_COINCIDENCE_M)),
            dot_m: relative(1e-6, 1e-6),
        }
    }
}

/// Box of the Bezier points, which is tighter than that of the B-spline control points.
fn bounds(path: PathRef<'_>) -> Option<Bounds<f64>> {
    let segments = path.runs().flat_map(|run| run.segments());
    Bounds::of_points(segments.flat_map(|segment| uniform::to_bezier(&segment)))
}

fn drive_time(layout: &Layout, row: usize, size_m: f64) -> Option<DriveTime> {
    let speed_m_per_s = layout.paths.value(row, "maxSpeed")?.number()?;
    (speed_m_per_s > 0.0).then(|| DriveTime {
        time_s: size_m / speed_m_per_s,
        speed_m_per_s,
    })
}

/// The middle one of some items, the upper one of two.
fn median<T: Copy>(items: &mut [T], key: impl Fn(&T) -> f64) -> Option<T> {
    let middle = items.len() / 2;
    if items.is_empty() {
        return None;
    }
    let (_, median, _) = items.select_nth_unstable_by(middle, |a, b| key(a).total_cmp(&key(b)));
    Some(*median)
}

#[cfg(test)]
mod tests {
    use guideway_spline::{Point, Runs};

    use super::*;
    use crate::NewPath;

    /// Straight paths of these lengths, end to end.
    fn layout(lengths_m: &[f64]) -> Layout {
        let mut layout = Layout::default();
        let mut at = Point::new(0.0, 0.0);
        for &length_m in lengths_m {
            let end = at + Point::new(length_m, 0.0);
            let mut runs = Runs::default();
            runs.push_line(at, end);
            layout.paths.push(&NewPath {
                runs: &runs,
                ..NewPath::default()
            });
            at = end;
        }
        layout
    }

    fn tolerances(lengths_m: &[f64]) -> Tolerances {
        let scale = Scale {
            has_nodes: true,
            ..Scale::of(&layout(lengths_m))
        };
        Tolerances::of(&scale, &CheckOptions::default())
    }

    fn assert_near(found: Tolerances, expected: [f64; 3]) {
        let found = [found.gap_m, found.coincidence_m, found.dot_m];
        let is_near = |(a, b): (&f64, f64)| (a - b).abs() <= 1e-9 * b;
        assert!(found.iter().zip(expected).all(is_near), "{found:?}");
    }

    #[test]
    fn tolerances_are_fractions_of_the_median_size_within_bounds() {
        let ordinary = [0.01, 1e-3, 1e-6];
        assert_near(tolerances(&[]), ordinary);
        assert_near(tolerances(&[0.0, 0.0]), ordinary);
        assert_near(tolerances(&[0.001, 5.0, 700.0]), ordinary);
        assert_near(tolerances(&[1e-4, 0.02, 900.0]), [2e-4, 2e-5, 2e-8]);
        // Millimeters that were read as meters.
        assert_near(tolerances(&[2e4, 2e4, 3e4]), [10.0, 1e-3, 1e-6]);
    }

    #[test]
    fn gap_of_a_drawing_without_nodes_is_its_bound() {
        let options = CheckOptions::default();
        let tolerances = Tolerances::of(&Scale::of(&layout(&[0.02])), &options);
        assert_near(tolerances, [0.01, 2e-5, 2e-8]);
    }

    #[test]
    fn requested_tolerances_hold_whatever_the_size() {
        let options = CheckOptions {
            gap_tolerance_m: Some(0.5),
            coincidence_tolerance_m: Some(0.25),
            ..CheckOptions::default()
        };
        let tolerances = Tolerances::of(&Scale::of(&layout(&[0.02])), &options);
        assert_near(tolerances, [0.5, 0.25, 2e-8]);
    }
}
