//! Findings about a layout as it is held, whatever file it came from.

mod cubic;
mod curve;
mod ends;
mod extent;
mod groups;
mod ids;
mod pairs;
mod place;
mod shape;
mod worst;

pub use place::{At, name, place};

use crate::{Diagnostics, Layout, Limits, Paths};

/// What counts as a finding.
#[derive(Clone, Debug, PartialEq)]
pub struct CheckOptions {
    /// Farthest that a path may begin or end from its node, and one run of a path from the next.
    pub gap_tolerance_m: f64,
    /// Greatest jump of direction that still counts as smooth.
    pub kink_angle_rad: f64,
    /// Two paths are the same curve if no point of one is farther than this from the other.
    pub coincidence_tolerance_m: f64,
    /// Tightest bend that is allowed; bends are not measured without it.
    pub min_radius_m: Option<f64>,
    /// A layout wider or higher than this is taken for one in another unit.
    pub largest_extent_m: f64,
    /// A layout neither as wide nor as high as this is taken for one in another unit.
    pub smallest_extent_m: f64,
    /// A coordinate beyond this is taken for one in another unit.
    pub largest_coordinate_m: f64,
    /// Findings kept whole for each code; beyond that they are counted.
    pub diagnostics_per_code: usize,
}

impl Default for CheckOptions {
    fn default() -> Self {
        Self {
            gap_tolerance_m: 0.01,
            kink_angle_rad: 5f64.to_radians(),
            coincidence_tolerance_m: 0.001,
            min_radius_m: None,
            largest_extent_m: 100_000.0,
            smallest_extent_m: 0.01,
            largest_coordinate_m: 1e7,
            diagnostics_per_code: Limits::default().diagnostics_per_code,
        }
    }
}

/// Looks for what is odd in the geometry and the topology of a layout.
///
/// What reading alone can see, such as a bad knot vector, is in [`Layout::diagnostics`] and is not
/// repeated here. Findings of one kind come in the order of the paths. The time grows with the size of
/// the layout, whatever is in it: of curves between the same two ends, a path is only compared with the
/// first few dozen that differ.
///
/// ```
/// use guideway_layout::{CheckOptions, Code, Layout, NewPath, check};
/// use guideway_spline::{Point, Runs};
///
/// let mut layout = Layout::default();
/// let start = layout.nodes.push("dock", Point::new(0.0, 0.5), None);
/// let mut runs = Runs::default();
/// runs.push_line(Point::new(0.0, 0.0), Point::new(12.0, 0.0));
/// layout.paths.push(&NewPath {
///     id: "aisle-1",
///     runs: &runs,
///     start_node: Some(start),
///     ..NewPath::default()
/// });
/// let found = check(&layout, &CheckOptions::default());
/// assert_eq!(found.count(Code::NodeGap), 1);
/// ```
pub fn check(layout: &Layout, options: &CheckOptions) -> Diagnostics {
    let mut found = Diagnostics::keeping(options.diagnostics_per_code);
    ids::check(layout, &mut found);
    ends::check(layout, options, &mut found);
    shape::check(layout, options, &mut found);
    pairs::check(layout, options, &mut found);
    extent::check(layout, options, &mut found);
    found
}

/// Looks for identifiers that several layouts have, which tools that read them together take for one thing.
/// Returns the findings of each: what an earlier one has too.
pub fn check_across(layouts: &[&Layout]) -> Vec<Diagnostics> {
    ids::check_across(layouts)
}

/// For each path the row of the first one with the same curve and level, whichever way it goes; its own if there is
/// none. Curves are the same if no point of one is farther than `tolerance_m` from the other.
pub fn same_curves(paths: &Paths, tolerance_m: f64) -> Vec<u32> {
    let mut first: Vec<u32> = (0..paths.len() as u32).collect();
    for member in groups::members(paths, tolerance_m) {
        first[member.row] = member.first as u32;
    }
    first
}
