//! Check: finds defects of the geometry and topology of a layout, whatever format it came from.
//!
//! | module | finds |
//! |---|---|
//! | `ids` | identifiers that occur more than once |
//! | `endpoints` | paths that miss their nodes, nodes without paths, paths between levels |
//! | `shape` | gaps, kinks, tight bends, paths without length; by `cubic`, `turns_in_place` |
//! | `pairs` | paths on the same curve; by `same_curve` and `curve`, and by `differences` |
//! | `lengths` | stated lengths that differ from those of the curves |
//! | `units` | sizes, speeds and angles that suggest a wrong unit |
//!
//! `options` holds the thresholds, `scale` derives tolerances from the size of the layout,
//! `element` formats places and positions for the messages.

mod cubic;
mod curve;
mod differences;
mod element;
mod endpoints;
mod ids;
mod lengths;
mod options;
mod pairs;
mod same_curve;
mod scale;
mod shape;
mod turns_in_place;
mod units;
mod worst;

pub use element::{DisplayPosition, element_name, element_place};
pub use ids::check_across;
pub use options::CheckOptions;
pub use same_curve::same_curves;
pub use units::largest_angle_rad;

use self::scale::{Scale, Tolerances};
use crate::{Diagnostics, Layout};

/// Checks the geometry and the topology of a layout.
///
/// Findings about the file, such as a bad knot vector, are in [`Layout::diagnostics`]; this
/// function does not repeat them. A doubt about the unit comes first; findings of one kind come in
/// the order of the paths.
///
/// Cost: linear in the size of the layout. Of the curves between the same two ends, it compares a
/// path with the first few dozen distinct ones only.
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
    check_watched(layout, options, &|_| ())
}

/// Checks as [`check`] does, and tells `done` what share of the work is done, from 0 to 1.
pub fn check_watched(layout: &Layout, options: &CheckOptions, done: &dyn Fn(f64)) -> Diagnostics {
    /// Shares of the work after each step. Measured: a million paths of D1.
    const UNITS_AND_IDS: f64 = 0.1;
    const ENDPOINTS: f64 = 0.15;
    const SHAPE: f64 = 0.6;
    let mut found = Diagnostics::with_limit(options.diagnostics_per_code);
    let scale = Scale::of(layout);
    let tolerances = Tolerances::of(&scale, options);
    units::check(layout, options, &scale, &mut found);
    lengths::check(layout, &tolerances, &mut found);
    ids::check(layout, &mut found);
    done(UNITS_AND_IDS);
    endpoints::check(layout, &tolerances, &mut found);
    done(ENDPOINTS);
    let of_shape = |share: f64| done(ENDPOINTS + (SHAPE - ENDPOINTS) * share);
    shape::check(layout, options, &tolerances, &of_shape, &mut found);
    done(SHAPE);
    pairs::check(layout, &tolerances, &mut found);
    layout.locate(&mut found);
    done(1.0);
    found
}
