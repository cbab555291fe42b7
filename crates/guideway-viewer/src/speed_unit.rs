//! [`SpeedUnit`]: the unit in which the window shows and reads speeds. Layouts have m/s.
//!
//! Each thread has one, as it has a language; the window sets that of its own thread.

use std::cell::Cell;

use guideway_layout::Value;
use serde::{Deserialize, Serialize};

/// The unit of speeds in layouts.
const LAYOUT_UNIT: &str = "m/s";

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
    #[serde(rename = "ft/min")]
    FeetPerMinute,
}

impl SpeedUnit {
    pub(crate) const ALL: [Self; 5] = [
        Self::MetersPerSecond,
        Self::KilometersPerHour,
        Self::MetersPerMinute,
        Self::MilesPerHour,
        Self::FeetPerMinute,
    ];

    /// Its name, which may be typed behind a number.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::MetersPerSecond => LAYOUT_UNIT,
            Self::KilometersPerHour => "km/h",
            Self::MetersPerMinute => "m/min",
            Self::MilesPerHour => "mph",
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
            Self::FeetPerMinute => 0.005_08,
        }
    }

    /// The unit of this name.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.name() == name)
    }

    /// A number of this unit in m/s.
    pub(crate) fn to_m_s(self, speed: f64) -> f64 {
        speed * self.m_s()
    }

    /// A speed in m/s as a number of this unit, without the rounding errors of the conversion.
    pub(crate) fn of_m_s(self, speed_m_s: f64) -> f64 {
        let speed = speed_m_s / self.m_s();
        let rounded = format!("{speed:.12e}").parse().unwrap_or(speed);
        match self {
            Self::MetersPerSecond => speed_m_s,
            _ => rounded,
        }
    }
}

thread_local! {
    static UNIT: Cell<SpeedUnit> = const { Cell::new(SpeedUnit::MetersPerSecond) };
}

/// The unit of this thread.
pub(crate) fn speed_unit() -> SpeedUnit {
    UNIT.get()
}

/// Sets the unit of this thread.
pub(crate) fn set_speed_unit(unit: SpeedUnit) {
    UNIT.set(unit);
}

/// The unit in which values of a unit of the layout are shown.
pub(crate) fn shown_unit(unit: &'static str) -> &'static str {
    match unit {
        LAYOUT_UNIT => speed_unit().name(),
        other => other,
    }
}

/// A value of a column with this unit, as it is shown.
pub(crate) fn shown_value(value: Value<'_>, unit: Option<&str>) -> String {
    match (value.number(), unit) {
        (Some(speed_m_s), Some(LAYOUT_UNIT)) => speed_unit().of_m_s(speed_m_s).to_string(),
        _ => value.to_string(),
    }
}

/// Factor of a number that is typed without a unit.
pub(crate) fn typed_factor(unit: Option<&str>) -> f64 {
    match unit {
        Some(LAYOUT_UNIT) => speed_unit().m_s(),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_shown_without_rounding_errors_and_come_back() {
        for (unit, speed_m_s, shown) in [
            (SpeedUnit::KilometersPerHour, 0.8, "2.88"),
            (SpeedUnit::KilometersPerHour, 1.5, "5.4"),
            (SpeedUnit::MetersPerMinute, 1.2, "72"),
            (SpeedUnit::MilesPerHour, 0.447_04, "1"),
            (SpeedUnit::FeetPerMinute, 0.508, "100"),
            (SpeedUnit::MetersPerSecond, 0.1, "0.1"),
        ] {
            set_speed_unit(unit);
            let value = Value::Float(speed_m_s);
            assert_eq!(shown_value(value, Some("m/s")), shown, "{unit:?}");
            assert_eq!(shown_value(value, Some("m")), speed_m_s.to_string());
            let back = shown.parse::<f64>().unwrap() * typed_factor(Some("m/s"));
            assert!((back - speed_m_s).abs() < 1e-12, "{unit:?}: {back}");
            assert_eq!(SpeedUnit::named(unit.name()), Some(unit));
        }
        set_speed_unit(SpeedUnit::MetersPerSecond);
    }
}
