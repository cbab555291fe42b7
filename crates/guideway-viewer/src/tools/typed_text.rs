//! The text that is typed instead of a click: a length, an angle, coordinates or a radius.

use guideway_spline::Point;

use crate::language::{say, t};
use crate::units::typed_number;

/// The forms, for people.
pub(crate) const FORMS: &str = "length  |  length<angle  |  x,y  |  @dx,dy  |  r radius";

/// A text that is being typed, and what is wrong with it.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct TypedText {
    pub(crate) text: String,
    pub(crate) error: Option<String>,
}

/// The meaning of a text. Lengths are in meters, or in the unit behind them; angles in degrees
/// counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Typed {
    /// A length in the direction of the pointer.
    Length(f64),
    /// A length and an angle from the last point.
    Polar { length_m: f64, angle_deg: f64 },
    /// A position.
    Place(Point<f64>),
    /// An offset from the last point.
    Offset(Point<f64>),
    /// The radius of an arc.
    Radius(f64),
}

/// Reads a typed text.
///
/// # Errors
/// The mistake, and the forms that there are.
pub(super) fn parse(text: &str) -> Result<Typed, String> {
    let text = text.trim();
    if let Some(radius) = text.strip_prefix(['r', 'R']) {
        return Ok(Typed::Radius(positive(radius, t("radius"))?));
    }
    if let Some((length, angle)) = text.split_once('<') {
        return Ok(Typed::Polar {
            length_m: positive(length, t("length"))?,
            angle_deg: number(angle.trim().trim_end_matches('°'))?,
        });
    }
    let offset = text.strip_prefix('@');
    match (offset.unwrap_or(text).split_once([',', ';']), offset) {
        (Some((x, y)), offset) => {
            let point = Point::new(length_m(x)?, length_m(y)?);
            Ok(match offset {
                Some(_) => Typed::Offset(point),
                None => Typed::Place(point),
            })
        }
        (None, Some(_)) => Err(t("an offset needs two numbers, such as @2.5,0").to_owned()),
        (None, None) => Ok(Typed::Length(positive(text, t("length"))?)),
    }
}

fn number(text: &str) -> Result<f64, String> {
    let value = text.trim().parse::<f64>().ok();
    let value = value.filter(|value| value.is_finite());
    value.ok_or_else(|| {
        say!(
            "`{text}` is no number; type a length (5), a length and an angle (5<30), coordinates \
             (12.5,3) or a radius (r2)",
            text = text.trim()
        )
    })
}

/// A length in meters, or with one of the known units behind it.
fn length_m(text: &str) -> Result<f64, String> {
    let has_unit = text.trim().ends_with(char::is_alphabetic);
    let length_m = typed_number(text, Some("m"), |digits| digits.parse().ok());
    length_m
        .filter(|_| has_unit)
        .map_or_else(|| number(text), Ok)
}

fn positive(text: &str, name: &str) -> Result<f64, String> {
    let value = length_m(text)?;
    match value > 0.0 {
        true => Ok(value),
        false => Err(say!(
            "the {name} is {value} m; type a number above 0",
            name,
            value
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_form_is_read() {
        let forms = [
            ("5", Typed::Length(5.0)),
            (" 0.5 ", Typed::Length(0.5)),
            (
                "5<30",
                Typed::Polar {
                    length_m: 5.0,
                    angle_deg: 30.0,
                },
            ),
            (
                "5 < -30°",
                Typed::Polar {
                    length_m: 5.0,
                    angle_deg: -30.0,
                },
            ),
            ("12.5,3", Typed::Place(Point::new(12.5, 3.0))),
            ("-1; -2.5", Typed::Place(Point::new(-1.0, -2.5))),
            ("@2,-1", Typed::Offset(Point::new(2.0, -1.0))),
            ("r2", Typed::Radius(2.0)),
            ("5 ft", Typed::Length(1.524)),
            ("80cm", Typed::Length(0.8)),
            ("5ft,-2m", Typed::Place(Point::new(1.524, -2.0))),
        ];
        for (text, typed) in forms {
            assert_eq!(parse(text), Ok(typed), "{text}");
        }
    }

    #[test]
    fn wrong_texts_say_what_is_wrong() {
        for (text, part) in [
            ("", "is no number"),
            ("5s", "`5s` is no number"),
            ("5<", "is no number"),
            ("1,2,3", "`2,3` is no number"),
            ("nan", "is no number"),
            ("1e999", "is no number"),
            ("0", "the length is 0 m"),
            ("r-2", "the radius is -2 m"),
            ("@2", "an offset needs two numbers"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.contains(part), "{text}: {error}");
        }
    }
}
