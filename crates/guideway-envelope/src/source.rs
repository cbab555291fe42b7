use std::fmt;

use guideway_layout::{Layout, Value};

use crate::area::area;
use crate::{Body, Heading, Sweep, headings};

/// What the envelopes of paths are made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EnvelopeSource {
    /// One vehicle on all paths, at the headings that the file gives ([`headings`]).
    Vehicle(Body),
    /// Of each path what the file gives: the corridor of LIF 2.0 and VDA 5050, if it is one of the contour, or the
    /// polygons of openTCS.
    File,
}

/// Why a path has no envelope.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NoEnvelope {
    /// It is too short to have a direction.
    Direction,
    /// The file gives none for it.
    NotInFile,
    /// The file gives a corridor for the middle of the vehicle, whose size it does not give.
    CenterOnly,
    /// The file gives something else than the polygons of an area.
    Unreadable,
}

impl NoEnvelope {
    /// Every reason there is.
    pub const ALL: [Self; 4] = [
        Self::Direction,
        Self::NotInFile,
        Self::CenterOnly,
        Self::Unreadable,
    ];
}

impl fmt::Display for NoEnvelope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Direction => "the path is too short to have a direction",
            Self::NotInFile => "the file gives none",
            Self::CenterOnly => {
                "the file gives a corridor for the middle of the vehicle, but not its size"
            }
            Self::Unreadable => "the file gives an area that is no list of polygons",
        })
    }
}

/// Left and right of the way, VDA 5050 and LIF 2.0.
const CORRIDOR: [[&str; 2]; 2] = [
    ["corridor.leftWidth", "corridor.rightWidth"],
    ["corridor.maximumLeftWidth", "corridor.maximumRightWidth"],
];
const CORRIDOR_OF: [&str; 2] = [
    "corridor.corridorRefPoint",
    "corridor.corridorReferencePoint",
];

impl EnvelopeSource {
    /// The area swept along a path.
    ///
    /// # Errors
    /// When it has none.
    ///
    /// # Panics
    /// When there is no such path.
    pub fn sweep(self, layout: &Layout, path: usize) -> Result<Sweep, NoEnvelope> {
        let (body, headings) = match self {
            Self::Vehicle(body) => (body, headings(layout, path, &body)),
            Self::File => match corridor(layout, path) {
                // A corridor is what a line across the way sweeps.
                Ok(line) => (line, vec![Heading::Tangential(0.0)]),
                Err(NoEnvelope::NotInFile) => return area(layout, path),
                Err(why) => return Err(why),
            },
        };
        Sweep::new(layout.paths.get(path), body, &headings).ok_or(NoEnvelope::Direction)
    }
}

fn corridor(layout: &Layout, path: usize) -> Result<Body, NoEnvelope> {
    let value = |name: &str| layout.paths.attributes.get(name)?.values.get(path);
    let width_m = |name: &str| match value(name)? {
        Value::Float(width_m) => Some(width_m),
        Value::Int(width_m) => Some(width_m as f64),
        _ => None,
    };
    let is_width = |width_m: &f64| width_m.is_finite() && *width_m >= 0.0;
    let widths = CORRIDOR.into_iter().find_map(|[left, right]| {
        let (left, right) = (width_m(left)?, width_m(right)?);
        (is_width(&left) && is_width(&right)).then_some((left, right))
    });
    let (left_m, right_m) = widths.ok_or(NoEnvelope::NotInFile)?;
    // Both formats take a corridor for one of the middle unless it says otherwise.
    let is_of_contour = CORRIDOR_OF
        .into_iter()
        .find_map(value)
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
