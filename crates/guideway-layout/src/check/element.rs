//! Texts of findings: the name of an element, its place, and a position in meters.

use std::fmt;

use guideway_spline::Point;

use crate::{Member, Origin, Place};

/// Place of a finding at an element of a layout, whose line [`Layout::locate`] finds: see
/// [`element_name`].
///
/// [`Layout::locate`]: crate::Layout::locate
pub fn element_place(member: Member, id: &str) -> Place {
    let (kind, row) = match member {
        Member::Path(row) => ("path", row),
        Member::Node(row) => ("node", row),
        Member::Station(row) => ("station", row),
    };
    Place {
        origin: Some(Origin::Member(member)),
        ..Place::element(element_name(kind, row as usize, id))
    }
}

/// Name of an element: `path "A"`, or `path number 3` (counted from 1) if it has no identifier.
pub fn element_name(kind: &str, row: usize, id: &str) -> String {
    if id.is_empty() {
        format!("{kind} number {}", row + 1)
    } else {
        format!("{kind} \"{id}\"")
    }
}

/// Displays a position as `(x, y) m`, to the millimeter.
#[derive(Clone, Copy, Debug)]
pub struct DisplayPosition(pub Point<f64>);

impl fmt::Display for DisplayPosition {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero turns -0.0 into 0.0, which prints without a sign.
        let [x, y] = [self.0.x, self.0.y].map(|v| (v * 1e3).round() / 1e3 + 0.0);
        write!(f, "({x:.3}, {y:.3}) m")
    }
}
