//! Reads the headings of a vehicle on a path from the columns of LIF and VDA 5050.

use std::f64::consts::PI;

use guideway_layout::{Direction, Layout, Value, largest_angle_rad};

use crate::Body;

/// The heading of a vehicle on a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Heading {
    /// A constant angle to the tangent of the path, counter-clockwise, in radians: 0 is forwards,
    /// pi is backwards, anything else is crab steering. After a cusp, the vehicle continues in
    /// reverse.
    Tangential(f64),
    /// A constant angle to the x axis, in radians.
    Fixed(f64),
}

impl Heading {
    pub(crate) fn is_tangential(self) -> bool {
        matches!(self, Self::Tangential(_))
    }
}

/// Columns with headings, in radians: one, or a list.
const ORIENTATION: [&str; 2] = ["vehicleOrientation", "vehicleOrientations"];
const ORIENTATION_TYPE: &str = "orientationType";

/// The headings of a path in a file, from `orientationType` and the orientation of LIF and VDA
/// 5050; forwards by default. Of vehicle types that differ, the first one counts. A two-way path
/// has each heading in both directions, unless `body` is symmetric.
pub fn headings(layout: &Layout, path: usize, body: &Body) -> Vec<Heading> {
    let value = |name: &str| layout.paths.value(path, name);
    let angles = ORIENTATION.into_iter().find_map(value).map(angles);
    let mut angles = angles
        .filter(|a| !a.is_empty())
        .unwrap_or_else(|| vec![0.0]);
    let is_fixed = match value(ORIENTATION_TYPE) {
        Some(Value::Text(text)) => text.eq_ignore_ascii_case("GLOBAL"),
        // VDA 5050 1.1 has global orientations only.
        _ => {
            let provenance = &layout.provenance;
            provenance.format == "VDA 5050"
                && provenance.format_version.starts_with("1.")
                && value(ORIENTATION[0]).is_some()
        }
    };
    if is_fixed {
        return angles.into_iter().map(Heading::Fixed).collect();
    }
    if layout.paths.get(path).direction() == Direction::Both {
        angles = angles.iter().flat_map(|&a| [a, a + PI]).collect();
    }
    let mut headings: Vec<Heading> = Vec::new();
    for angle in angles {
        let is_same = |known: &Heading| {
            let &(Heading::Tangential(other) | Heading::Fixed(other)) = known;
            let period = if body.is_symmetric() { PI } else { 2.0 * PI };
            let turns = (angle - other) / period;
            (turns - turns.round()).abs() < 1e-9
        };
        if !headings.iter().any(is_same) {
            headings.push(Heading::Tangential(angle));
        }
    }
    headings
}

/// Returns the number of paths whose orientation is larger than their format allows: probably
/// degrees, so that the areas that a vehicle sweeps there are in doubt.
pub fn doubtful_headings(layout: &Layout) -> u64 {
    let largest_rad = largest_angle_rad(layout);
    let is_doubtful = |path: &usize| {
        let value = |name: &str| layout.paths.value(*path, name);
        let angles = ORIENTATION.into_iter().find_map(value).map(angles);
        angles.is_some_and(|angles| angles.iter().any(|angle| angle.abs() > largest_rad))
    };
    (0..layout.paths.len()).filter(is_doubtful).count() as u64
}

/// Parses a number, or a list of numbers: JSON, or a text with commas.
fn angles(value: Value<'_>) -> Vec<f64> {
    let text = value.to_string();
    let list = text.trim_start_matches('[').trim_end_matches(']');
    let numbers = list.split(',').filter_map(|part| part.trim().parse().ok());
    numbers.filter(|angle: &f64| angle.is_finite()).collect()
}
