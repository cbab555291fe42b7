//! Typed texts as values of properties.

use guideway_layout::Value;

use super::field::FieldKind;
use crate::language::{say, t};
use crate::speed_unit::{SpeedUnit, shown_unit, typed_factor};

/// A value that a user entered.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::panels) enum TypedValue {
    Flag(bool),
    Integer(i64),
    Number(f64),
    Text(String),
    Json(String),
}

impl TypedValue {
    pub(in crate::panels) fn as_value(&self) -> Value<'_> {
        match self {
            Self::Flag(v) => Value::Bool(*v),
            Self::Integer(v) => Value::Int(*v),
            Self::Number(v) => Value::Float(*v),
            Self::Text(v) => Value::Text(v),
            Self::Json(v) => Value::Json(v),
        }
    }

    /// The value of a text in a field; `None` if the text is empty, which removes the property.
    ///
    /// # Errors
    /// The reason, which names the values that the field takes.
    pub(in crate::panels) fn parse(
        text: &str,
        kind: FieldKind,
        unit: Option<&'static str>,
    ) -> Result<Option<Self>, String> {
        let text = text.trim();
        if text.is_empty() {
            return Ok(None);
        }
        let value = match kind {
            FieldKind::Text => Self::Text(text.to_owned()),
            FieldKind::Choice(words) => match words.contains(&text) {
                true => Self::Text(text.to_owned()),
                false => return Err(say!("choose one of {words}", words = words.join(", "))),
            },
            FieldKind::Flag => match text {
                "true" => Self::Flag(true),
                "false" => Self::Flag(false),
                _ => return Err(t("type true or false").into()),
            },
            FieldKind::Integer => match text.parse() {
                Ok(number) => Self::Integer(number),
                Err(_) => return Err(say!("{text} is no whole number", text)),
            },
            FieldKind::Number => match number(text, unit) {
                Some(number) => Self::Number(number),
                None => {
                    let unit = unit.map_or(String::new(), |unit| {
                        say!(" in {unit}", unit = shown_unit(unit))
                    });
                    return Err(say!("{text} is no number{unit}", text, unit));
                }
            },
            // The document checks lists and objects.
            FieldKind::Json => Self::Json(text.to_owned()),
        };
        Ok(Some(value))
    }
}

/// Other units that a field understands: unit typed, unit of the field, factor.
const CONVERSIONS: &[(&str, &str, f64)] = &[
    ("mm/s", "m/s", 1e-3),
    ("mm", "m", 1e-3),
    ("cm", "m", 1e-2),
    ("km", "m", 1e3),
    ("°", "rad", std::f64::consts::PI / 180.0),
    ("deg", "rad", std::f64::consts::PI / 180.0),
    ("°/s", "rad/s", std::f64::consts::PI / 180.0),
    ("deg/s", "rad/s", std::f64::consts::PI / 180.0),
    ("t", "kg", 1e3),
    ("min", "s", 60.0),
    ("ms", "s", 1e-3),
];

/// A finite number in `unit`, which may be typed behind it, as may a unit that converts to it. A
/// comma may stand for the decimal point.
fn number(text: &str, unit: Option<&str>) -> Option<f64> {
    let end = text.rfind(|c: char| c.is_ascii_digit() || c == '.' || c == ',')? + 1;
    let (digits, typed) = (text[..end].trim(), text[end..].trim());
    let factor = match unit {
        _ if typed.is_empty() => typed_factor(unit),
        Some(unit) if typed == unit => 1.0,
        Some(unit) => {
            let speed = SpeedUnit::named(typed).filter(|_| unit == "m/s");
            let known = CONVERSIONS
                .iter()
                .find(|(from, to, _)| (*from, *to) == (typed, unit));
            speed
                .map(|speed| speed.to_m_s(1.0))
                .or(known.map(|known| known.2))?
        }
        None => return None,
    };
    let is_decimal_comma = digits.matches(',').count() == 1 && !digits.contains('.');
    let number: f64 = match is_decimal_comma {
        true => digits.replace(',', ".").parse().ok()?,
        false => digits.parse().ok()?,
    };
    Some(number * factor).filter(|number| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::speed_unit::set_speed_unit;

    fn speed(text: &str) -> Result<Option<TypedValue>, String> {
        TypedValue::parse(text, FieldKind::Number, Some("m/s"))
    }

    #[test]
    fn numbers_may_have_a_unit_and_a_comma() {
        for text in ["1.5", "1,5", " 1.5 m/s", "5.4 km/h", "1500mm/s", "15e-1"] {
            let Ok(Some(TypedValue::Number(number))) = speed(text) else {
                panic!("{text}");
            };
            assert!((number - 1.5).abs() < 1e-12, "{text}: {number}");
        }
        for text in ["fast", "1.5 kg", "1,500.5,5", "1e999", "inf"] {
            assert!(speed(text).is_err(), "{text}");
        }
        assert_eq!(speed("abc").unwrap_err(), "abc is no number in m/s");
    }

    #[test]
    fn numbers_without_a_unit_have_that_of_the_settings() {
        set_speed_unit(SpeedUnit::KilometersPerHour);
        for text in ["5.4", "5.4 km/h", "1.5 m/s"] {
            let Ok(Some(TypedValue::Number(number))) = speed(text) else {
                panic!("{text}");
            };
            assert!((number - 1.5).abs() < 1e-12, "{text}: {number}");
        }
        assert_eq!(speed("abc").unwrap_err(), "abc is no number in km/h");
        set_speed_unit(SpeedUnit::MetersPerSecond);
    }

    #[test]
    fn empty_text_removes_and_others_have_their_kind() {
        assert_eq!(speed("  "), Ok(None));
        let parse = |text, kind| TypedValue::parse(text, kind, None);
        assert_eq!(
            parse("7", FieldKind::Integer),
            Ok(Some(TypedValue::Integer(7)))
        );
        assert!(parse("7.5", FieldKind::Integer).is_err());
        assert_eq!(
            parse("true", FieldKind::Flag),
            Ok(Some(TypedValue::Flag(true)))
        );
        let choice = FieldKind::Choice(&["LEFT", "RIGHT"]);
        assert!(parse("LEFT", choice).is_ok());
        assert_eq!(
            parse("left", choice).unwrap_err(),
            "choose one of LEFT, RIGHT"
        );
    }
}
