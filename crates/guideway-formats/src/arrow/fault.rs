//! Faults of rows: reasons why the curve of a row cannot be drawn, with diagnostic code and text.

use guideway_layout::{Code, Limits};

/// Reason why the curve of a row cannot be drawn. Numbers are indices of control points, or their
/// count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fault {
    NoPoints,
    NoCoordinate(usize),
    TooFew(usize),
    NonFinite(usize),
    OutOfRange(usize),
}

impl Fault {
    /// Returns the diagnostic code.
    pub(super) fn code(self) -> Code {
        match self {
            Self::NoPoints | Self::NoCoordinate(_) => Code::MissingField,
            Self::TooFew(_) => Code::TooFewPoints,
            Self::NonFinite(_) => Code::NonFinite,
            Self::OutOfRange(_) => Code::OutOfRange,
        }
    }

    /// Describes the fault.
    pub(super) fn detail(self, limits: &Limits) -> String {
        match self {
            Self::NoPoints => "control_points is null".into(),
            Self::NoCoordinate(at) => format!("control point {at} is null"),
            Self::TooFew(count) => format!("{count} control points; a curve needs 4"),
            Self::NonFinite(at) => format!("control point {at} is not finite"),
            Self::OutOfRange(at) => format!(
                "control point {at} exceeds the coordinate limit of {} m",
                limits.coordinate_m
            ),
        }
    }
}
