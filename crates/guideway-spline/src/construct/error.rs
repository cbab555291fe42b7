//! [`ConstructError`]: the reason why there is no such curve, with the limit.

use crate::Point;

/// Reason why points, directions or a radius give no curve.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ConstructError {
    /// A coordinate or a radius is infinite or not a number.
    #[error("a coordinate or a radius is not finite")]
    NotFinite,
    /// A curve needs more points.
    #[error("a curve needs at least 2 points, not {actual}")]
    TooFewPoints {
        /// Number of points.
        actual: usize,
    },
    /// A point equals the one before it.
    #[error("points {} and {} are the same, ({:.3}, {:.3})", .index, .index + 1, .at.x, .at.y)]
    EqualPoints {
        /// Number of the first one of the two, counted from 1.
        index: usize,
        /// Their position.
        at: Point<f64>,
    },
    /// A direction is a vector without length.
    #[error("a direction has no length")]
    NoDirection,
    /// The points lie on one line, but not in order.
    #[error(
        "no arc leads through ({:.3}, {:.3}): it lies on the line of the other two points, but not \
         between them", .through.x, .through.y
    )]
    NotBetween {
        /// The second of the three points.
        through: Point<f64>,
    },
    /// The end of an arc lies on the start tangent, behind the start.
    #[error(
        "no arc begins in this direction: its end ({:.3}, {:.3}) lies straight behind its start",
        .end.x, .end.y
    )]
    StraightBehind {
        /// The end.
        end: Point<f64>,
    },
    /// Two curves do not meet.
    #[error("the curves are {gap:.4} apart; at most {tolerance} is allowed")]
    Gap {
        /// Distance from the end of the first one to the start of the second one.
        gap: f64,
        /// Largest distance.
        tolerance: f64,
    },
    /// Two curves meet without a corner.
    #[error("there is no corner: the curves go on straight")]
    NoCorner,
    /// Two curves meet in a full turn.
    #[error("the second curve turns straight back, so that no arc touches both")]
    TurnsBack,
    /// A radius is zero or negative.
    #[error("the radius is {radius}; it must be above 0")]
    Radius {
        /// The radius.
        radius: f64,
    },
    /// No arc of the radius reaches from one point to the other.
    #[error("a radius of {radius} is too small; the least one is {:.3}", ceil(*.smallest))]
    TooSmall {
        /// The radius.
        radius: f64,
        /// Half the distance of the points.
        smallest: f64,
    },
    /// No arc of the radius touches both curves.
    #[error(
        "a radius of {radius} does not fit; the largest one that does is {:.3}",
        floor(*.largest)
    )]
    TooLarge {
        /// The radius.
        radius: f64,
        /// The largest radius that fits.
        largest: f64,
    },
}

/// Rounds down to three digits, so that the shown radius fits.
fn floor(value: f64) -> f64 {
    (value * 1e3).floor() / 1e3
}

/// Rounds up to three digits, so that the shown radius fits.
fn ceil(value: f64) -> f64 {
    (value * 1e3).ceil() / 1e3
}
