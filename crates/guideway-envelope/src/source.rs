//! Makes the envelope of a path: from a vehicle body, or from the corridors and areas of a file.

use guideway_layout::{Layout, Value};

use crate::file_area::file_area;
use crate::{Body, Heading, NoEnvelope, Sweep, doubtful_headings, headings};

/// The source of the envelopes of paths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnvelopeSource {
    /// One vehicle on all paths, at the headings in the file ([`headings`]).
    Vehicle(Body),
    /// The file: the corridors of LIF 2.0 and VDA 5050 for the contour, or the polygons of openTCS.
    File,
}

/// Columns with the left and the right width of corridors.
const CORRIDOR: [&str; 2] = ["corridor.leftWidth", "corridor.rightWidth"];
/// Column with the reference of corridors, the contour or the center.
const CORRIDOR_REFERENCE: &str = "corridor.referencePoint";

impl EnvelopeSource {
    /// Returns the number of paths whose area is in doubt, because the file probably states their
    /// orientation in degrees. A given area needs no orientation.
    pub fn doubtful(self, layout: &Layout) -> u64 {
        match self {
            Self::Vehicle(_) => doubtful_headings(layout),
            Self::File => 0,
        }
    }

    /// Succeeds if at least one path has an envelope.
    ///
    /// # Errors
    /// When none has; the most frequent reason. A layout without paths has nothing to miss.
    pub fn require_any(self, layout: &Layout) -> Result<(), NoEnvelope> {
        let mut without = [0_u64; NoEnvelope::ALL.len()];
        for path in 0..layout.paths.len() {
            match self.sweep(layout, path) {
                Ok(_) => return Ok(()),
                Err(reason) => without[reason as usize] += 1,
            }
        }
        NoEnvelope::most_frequent(&without).map_or(Ok(()), Err)
    }

    /// The area swept along a path.
    ///
    /// # Errors
    /// When the path has no envelope.
    ///
    /// # Panics
    /// When the layout has no such path.
    pub fn sweep(self, layout: &Layout, path: usize) -> Result<Sweep, NoEnvelope> {
        let (body, headings) = match self {
            Self::Vehicle(body) => (body, headings(layout, path, &body)),
            Self::File => match corridor(layout, path) {
                // A corridor is the area swept by a line across the path.
                Ok(line) => (line, vec![Heading::Tangential(0.0)]),
                Err(NoEnvelope::NotInFile) => return file_area(layout, path),
                Err(reason) => return Err(reason),
            },
        };
        Sweep::new(layout.paths.get(path), body, &headings).ok_or(NoEnvelope::Direction)
    }
}

/// The corridor of a path, as a body of length 0.
fn corridor(layout: &Layout, path: usize) -> Result<Body, NoEnvelope> {
    let value = |name: &str| layout.paths.value(path, name);
    let width_m = |name: &str| value(name)?.number();
    let is_width = |width_m: &f64| width_m.is_finite() && *width_m >= 0.0;
    let [left, right] = CORRIDOR.map(|name| width_m(name).filter(is_width));
    let (left_m, right_m) = left.zip(right).ok_or(NoEnvelope::NotInFile)?;
    // In both formats, a corridor without a reference is for the center of the vehicle.
    let is_of_contour = value(CORRIDOR_REFERENCE)
        .is_some_and(|of| matches!(of, Value::Text(text) if text.eq_ignore_ascii_case("CONTOUR")));
    if !is_of_contour {
        return Err(NoEnvelope::CenterOnly);
    }
    Ok(Body {
        front_m: 0.0,
        rear_m: 0.0,
        left_m,
        right_m,
    })
}
