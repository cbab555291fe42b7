//! Typed texts as values of properties.

use guideway_layout::Value;

use super::field::FieldKind;
use crate::language::{say, t};
use crate::units::{decimal, shown_unit, typed_number};

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

/// A finite number in `unit`, which may be typed behind it, as may a unit that converts to it. A
/// comma may stand for the decimal point.
fn number(text: &str, unit: Option<&str>) -> Option<f64> {
    typed_number(text, unit, decimal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::{LengthUnit, SpeedUnit, Units, set_units};

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
        for text in ["3 mph", "4.4 ft/s", "264 ft/min"] {
            let number = speed(text).unwrap().unwrap().as_value().number().unwrap();
            assert!((number - 1.341_12).abs() < 1e-12, "{text}: {number}");
        }
        let length = |text| TypedValue::parse(text, FieldKind::Number, Some("m"));
        assert_eq!(length("5 ft"), Ok(Some(TypedValue::Number(1.524))));
        assert!(length("5 ft/s").is_err());
        for text in ["fast", "1.5 kg", "1,500.5,5", "1e999", "inf"] {
            assert!(speed(text).is_err(), "{text}");
        }
        assert_eq!(speed("abc").unwrap_err(), "abc is no number in m/s");
    }

    #[test]
    fn numbers_without_a_unit_have_that_of_the_settings() {
        set_units(Units {
            speed: SpeedUnit::KilometersPerHour,
            length: LengthUnit::Feet,
        });
        for text in ["5.4", "5.4 km/h", "1.5 m/s"] {
            let Ok(Some(TypedValue::Number(number))) = speed(text) else {
                panic!("{text}");
            };
            assert!((number - 1.5).abs() < 1e-12, "{text}: {number}");
        }
        assert_eq!(speed("abc").unwrap_err(), "abc is no number in km/h");
        let length = TypedValue::parse("5", FieldKind::Number, Some("m"));
        assert_eq!(length, Ok(Some(TypedValue::Number(1.524))));
        set_units(Units::default());
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
