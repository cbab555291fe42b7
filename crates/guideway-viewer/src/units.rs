//! The units in which the window shows and reads speeds and lengths. Layouts have m/s and m.
//!
//! Each thread has some, as it has a language; the window sets those of its own thread.

use std::cell::Cell;
use std::f64::consts::PI;

use guideway_layout::Value;
use serde::{Deserialize, Serialize};

/// The units of speeds and lengths in layouts.
const LAYOUT_SPEED: &str = "m/s";
const LAYOUT_LENGTH: &str = "m";

/// A unit of speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum SpeedUnit {
    #[default]
    #[serde(rename = "m/s")]
    MetersPerSecond,
    #[serde(rename = "km/h")]
    KilometersPerHour,
    #[serde(rename = "m/min")]
    MetersPerMinute,
    #[serde(rename = "mph")]
    MilesPerHour,
    #[serde(rename = "ft/s")]
    FeetPerSecond,
    #[serde(rename = "ft/min")]
    FeetPerMinute,
}

impl SpeedUnit {
    pub(crate) const ALL: [Self; 6] = [
        Self::MetersPerSecond,
        Self::KilometersPerHour,
        Self::MetersPerMinute,
        Self::MilesPerHour,
        Self::FeetPerSecond,
        Self::FeetPerMinute,
    ];

    /// Its name, which may be typed behind a number.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::MetersPerSecond => LAYOUT_SPEED,
            Self::KilometersPerHour => "km/h",
            Self::MetersPerMinute => "m/min",
            Self::MilesPerHour => "mph",
            Self::FeetPerSecond => "ft/s",
            Self::FeetPerMinute => "ft/min",
        }
    }

    /// The speed of one unit, in m/s. The international mile has 1609.344 m, the foot 0.3048 m.
    fn m_s(self) -> f64 {
        match self {
            Self::MetersPerSecond => 1.0,
            Self::KilometersPerHour => 1.0 / 3.6,
            Self::MetersPerMinute => 1.0 / 60.0,
            Self::MilesPerHour => 0.447_04,
            Self::FeetPerSecond => 0.304_8,
            Self::FeetPerMinute => 0.005_08,
        }
    }

    /// A number of this unit in m/s.
    pub(crate) fn to_m_s(self, speed: f64) -> f64 {
        speed * self.m_s()
    }

    /// A speed in m/s as a number of this unit, without the rounding errors of the conversion.
    pub(crate) fn of_m_s(self, speed_m_s: f64) -> f64 {
        in_units(speed_m_s, self.m_s())
    }
}

/// A unit of the lengths among the properties.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum LengthUnit {
    #[default]
    #[serde(rename = "m")]
    Meters,
    #[serde(rename = "mm")]
    Millimeters,
    #[serde(rename = "ft")]
    Feet,
    #[serde(rename = "in")]
    Inches,
}

impl LengthUnit {
    pub(crate) const ALL: [Self; 4] = [Self::Meters, Self::Millimeters, Self::Feet, Self::Inches];

    /// Its name, which may be typed behind a number.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Meters => LAYOUT_LENGTH,
            Self::Millimeters => "mm",
            Self::Feet => "ft",
            Self::Inches => "in",
        }
    }

    /// Its length in meters.
    fn m(self) -> f64 {
        match self {
            Self::Meters => 1.0,
            Self::Millimeters => 1e-3,
            Self::Feet => 0.304_8,
            Self::Inches => 0.025_4,
        }
    }
}

/// A number of SI units in units of this size, without the rounding errors of the conversion.
fn in_units(value: f64, unit: f64) -> f64 {
    let converted = value / unit;
    let rounded = || format!("{converted:.12e}").parse().ok();
    let exact = (unit == 1.0).then_some(value);
    exact.or_else(rounded).unwrap_or(converted)
}

/// The units that are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Units {
    pub(crate) speed: SpeedUnit,
    pub(crate) length: LengthUnit,
}

impl Units {
    /// Name and size of the unit in which values of a unit of the layout are shown; `None` for
    /// other quantities than speeds and lengths.
    fn of(self, unit: &str) -> Option<(&'static str, f64)> {
        match unit {
            LAYOUT_SPEED => Some((self.speed.name(), self.speed.m_s())),
            LAYOUT_LENGTH => Some((self.length.name(), self.length.m())),
            _ => None,
        }
    }
}

thread_local! {
    static UNITS: Cell<Units> = const { Cell::new(Units {
        speed: SpeedUnit::MetersPerSecond,
        length: LengthUnit::Meters,
    }) };
}

/// The units of this thread.
pub(crate) fn units() -> Units {
    UNITS.get()
}

/// Sets the units of this thread.
pub(crate) fn set_units(units: Units) {
    UNITS.set(units);
}

/// The unit in which values of a unit of the layout are shown.
pub(crate) fn shown_unit(unit: &'static str) -> &'static str {
    units().of(unit).map_or(unit, |(name, _)| name)
}

/// A value of a column with this unit, as it is shown.
pub(crate) fn shown_value(value: Value<'_>, unit: Option<&str>) -> String {
    let shown = unit.and_then(|unit| units().of(unit));
    match (value.number(), shown) {
        (Some(number), Some((_, size))) if size != 1.0 => in_units(number, size).to_string(),
        _ => value.to_string(),
    }
}

/// Other units that are understood behind a number: unit typed, unit of the layout, factor.
const CONVERSIONS: &[(&str, &str, f64)] = &[
    ("mm/s", LAYOUT_SPEED, 1e-3),
    ("cm", LAYOUT_LENGTH, 1e-2),
    ("km", LAYOUT_LENGTH, 1e3),
    ("°", "rad", PI / 180.0),
    ("deg", "rad", PI / 180.0),
    ("°/s", "rad/s", PI / 180.0),
    ("deg/s", "rad/s", PI / 180.0),
    ("t", "kg", 1e3),
    ("min", "s", 60.0),
    ("ms", "s", 1e-3),
];

/// Factor of a number with `typed` behind it, in a field whose unit in the layout is `unit`; `None`
/// if the two do not fit. Nothing typed means the unit that is shown.
pub(crate) fn typed_factor(typed: &str, unit: Option<&str>) -> Option<f64> {
    let Some(unit) = unit else {
        return typed.is_empty().then_some(1.0);
    };
    let speeds = SpeedUnit::ALL.map(|known| (known.name(), LAYOUT_SPEED, known.m_s()));
    let lengths = LengthUnit::ALL.map(|known| (known.name(), LAYOUT_LENGTH, known.m()));
    let mut known = speeds.iter().chain(&lengths).chain(CONVERSIONS);
    match typed {
        "" => Some(units().of(unit).map_or(1.0, |(_, size)| size)),
        typed if typed == unit => Some(1.0),
        typed => known
            .find(|(from, to, _)| (*from, *to) == (typed, unit))
            .map(|(_, _, factor)| *factor),
    }
}

/// A number in whose text a comma may stand for the decimal point.
pub(crate) fn decimal(text: &str) -> Option<f64> {
    let is_decimal_comma = text.matches(',').count() == 1 && !text.contains('.');
    match is_decimal_comma {
        true => text.replace(',', ".").parse().ok(),
        false => text.parse().ok(),
    }
}

/// A finite number that is written with a unit behind it or without one. See [`typed_factor`].
pub(crate) fn typed_number(
    text: &str,
    unit: Option<&str>,
    parse: impl Fn(&str) -> Option<f64>,
) -> Option<f64> {
    let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.' || c == ',')? + 1;
    let (digits, typed) = (text[..end].trim(), text[end..].trim());
    let number = parse(digits)? * typed_factor(typed, unit)?;
    Some(number).filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_shown_without_rounding_errors_and_come_back() {
        let (m_s, m) = (SpeedUnit::MetersPerSecond, LengthUnit::Meters);
        for (speed, length, unit, value, shown) in [
            (SpeedUnit::KilometersPerHour, m, "m/s", 0.8, "2.88"),
            (SpeedUnit::KilometersPerHour, m, "m/s", 1.5, "5.4"),
            (SpeedUnit::MetersPerMinute, m, "m/s", 1.2, "72"),
            (SpeedUnit::MilesPerHour, m, "m/s", 0.447_04, "1"),
            (SpeedUnit::FeetPerSecond, m, "m/s", 1.524, "5"),
            (SpeedUnit::FeetPerMinute, m, "m/s", 0.508, "100"),
            (m_s, m, "m/s", 0.1, "0.1"),
            (SpeedUnit::MilesPerHour, m, "m", 0.1, "0.1"),
            (m_s, LengthUnit::Feet, "m", 1.524, "5"),
            (m_s, LengthUnit::Millimeters, "m", 0.8, "800"),
            (m_s, LengthUnit::Inches, "m", 0.254, "10"),
            (m_s, LengthUnit::Feet, "rad", 0.254, "0.254"),
        ] {
            set_units(Units { speed, length });
            let value_shown = shown_value(Value::Float(value), Some(unit));
            assert_eq!(value_shown, shown, "{speed:?} {length:?}");
            for behind in ["", shown_unit(unit)] {
                let factor = typed_factor(behind, Some(unit)).unwrap();
                let back = shown.parse::<f64>().unwrap() * factor;
                assert!((back - value).abs() < 1e-12, "{speed:?} {length:?}: {back}");
            }
        }
        set_units(Units::default());
    }
}
