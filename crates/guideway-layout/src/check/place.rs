use std::fmt;

use guideway_spline::Point;

use crate::Place;

/// Where a finding is: `path "A"`, or its number in the table where it has no name.
pub fn place(kind: &str, row: usize, id: &str) -> Place {
    Place::element(name(kind, row, id))
}

/// The element as text, for messages.
pub fn name(kind: &str, row: usize, id: &str) -> String {
    if id.is_empty() {
        format!("{kind} number {}", row + 1)
    } else {
        format!("{kind} \"{id}\"")
    }
}

/// A position in meters, to the millimeter.
#[derive(Clone, Copy, Debug)]
pub struct At(pub Point<f64>);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero takes the sign off a negative one.
        let [x, y] = [self.0.x, self.0.y].map(|v| (v * 1e3).round() / 1e3 + 0.0);
        write!(f, "({x:.3}, {y:.3}) m")
    }
}
