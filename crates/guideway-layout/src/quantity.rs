//! [`Quantity`]: the physical quantity that a column of numbers measures.

/// A physical quantity. All numbers of a layout are in its SI unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Quantity {
    /// Lengths, widths, heights and distances, in meters.
    Length,
    /// Angles, in radians, counter-clockwise.
    Angle,
    /// Speeds, in meters per second.
    Speed,
    /// Rotation speeds, in radians per second.
    RotationSpeed,
    /// Loads, in kilograms.
    Mass,
    /// Durations, in seconds.
    Time,
}

impl Quantity {
    /// All quantities.
    pub const ALL: &[Self] = &[
        Self::Length,
        Self::Angle,
        Self::Speed,
        Self::RotationSpeed,
        Self::Mass,
        Self::Time,
    ];

    /// Symbol of the SI unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Angle => "rad",
            Self::Speed => "m/s",
            Self::RotationSpeed => "rad/s",
            Self::Mass => "kg",
            Self::Time => "s",
        }
    }

    /// The quantity with this SI unit, if any.
    pub fn of_unit(unit: &str) -> Option<Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|quantity| quantity.unit() == unit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_identify_quantities() {
        for &quantity in Quantity::ALL {
            assert_eq!(Quantity::of_unit(quantity.unit()), Some(quantity));
        }
        assert_eq!(Quantity::of_unit("mm/s"), None);
    }
}
