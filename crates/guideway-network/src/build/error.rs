//! [`BuildError`]: why `build` stopped, with place, limit and remedy.

use guideway_layout::{DisplayPosition, UserError};
use guideway_spline::Point;

/// Reason why a drawing becomes no network.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A file of options cannot be read.
    #[error("the mapping is not valid: {detail}")]
    Map {
        /// Message of the parser, with line and column.
        detail: String,
    },
    /// An option has a value that makes no sense.
    #[error("`{name}` is {value}; it must be a number from 0 to 1000000")]
    Value {
        /// Name of the option.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Ends of different levels lie within the weld distance.
    #[error(
        "{count} ends of different levels would become one node; the first are on {first} and \
         {second} at {}", DisplayPosition(*.at)
    )]
    Levels {
        /// Number of pairs of ends.
        count: u64,
        /// Level of one end.
        first: String,
        /// Level of the other end.
        second: String,
        /// Position of one end, in meters.
        at: Point<f64>,
    },
    /// Too many ends lie within the weld distance of one of them.
    #[error(
        "more than {limit} ends lie within the weld distance of {weld_m} m of the one at {}",
        DisplayPosition(*.at)
    )]
    Crowded {
        /// Most ends near one of them.
        limit: usize,
        /// The weld distance.
        weld_m: f64,
        /// Position of the end, in meters.
        at: Point<f64>,
    },
    /// The lines would be cut to too many pieces.
    #[error("the lines would be cut to more than {limit} pieces")]
    Pieces {
        /// Most pieces.
        limit: usize,
    },
    /// The boxes of too many pairs of lines overlap.
    #[error("more than {limit} pairs of lines are near each other")]
    Pairs {
        /// Most pairs.
        limit: u64,
    },
    /// Two elements would have one name.
    #[error(
        "two {kind} would be named \"{name}\": at {} and at {}",
        DisplayPosition(*.first), DisplayPosition(*.second)
    )]
    Name {
        /// `stations` or `nodes`.
        kind: &'static str,
        /// The name.
        name: String,
        /// Position of one of them, in meters.
        first: Point<f64>,
        /// Position of the other one, in meters.
        second: Point<f64>,
    },
}

impl From<BuildError> for UserError {
    fn from(error: BuildError) -> Self {
        let (code, remedy) = match &error {
            BuildError::Map { .. } => ("map", "Correct the file; docs/network.md lists its names"),
            BuildError::Value { .. } => ("map", "Correct the value"),
            BuildError::Levels { .. } => (
                "levels",
                "Correct the levels of the layers, or pass --levels-apart if the levels lie one \
                 over the other",
            ),
            BuildError::Crowded { .. } => (
                "weld",
                "Choose a smaller weld distance, or check the unit of the drawing",
            ),
            BuildError::Pieces { .. } | BuildError::Pairs { .. } => (
                "pieces",
                "Leave out layers that vehicles do not drive on, such as walls and hatches",
            ),
            BuildError::Name { .. } => ("names", "Rename one of them in the drawing"),
        };
        Self::new(code, error.to_string(), remedy)
    }
}
