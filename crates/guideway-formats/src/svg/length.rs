//! Parses lengths of SVG and CSS: text and the sizes that units refer to in, user units out.

use std::str::FromStr;

use svgtypes::{Length, LengthUnit};

/// The font size of a drawing that states none, in pixels: the default of browsers.
pub(super) const DEFAULT_FONT_PX: f64 = 16.0;

/// Sizes of fonts that lengths refer to, in user units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FontSizes {
    /// Size at the element: `em`.
    pub(super) own: f64,
    /// Size at the root element: `rem`.
    pub(super) root: f64,
}

impl FontSizes {
    pub(super) const INITIAL: Self = Self {
        own: DEFAULT_FONT_PX,
        root: DEFAULT_FONT_PX,
    };
}

/// Parses a length to user units. `reference` is 100 %.
pub(super) fn length(text: &str, fonts: FontSizes, reference: f64) -> Option<f64> {
    let (number, unit) = split(text.trim())?;
    let factor = match unit {
        Unit::Svg(LengthUnit::None | LengthUnit::Px) => 1.0,
        Unit::Svg(LengthUnit::In) => 96.0,
        Unit::Svg(LengthUnit::Cm) => 96.0 / 2.54,
        Unit::Svg(LengthUnit::Mm) => 96.0 / 25.4,
        Unit::QuarterMillimeter => 96.0 / 25.4 / 4.0,
        Unit::Svg(LengthUnit::Pt) => 96.0 / 72.0,
        Unit::Svg(LengthUnit::Pc) => 16.0,
        Unit::Svg(LengthUnit::Em) => fonts.own,
        // The usual height of an x and width of a 0 where the font is not known.
        Unit::Svg(LengthUnit::Ex) | Unit::Zero => fonts.own / 2.0,
        Unit::RootEm => fonts.root,
        Unit::Svg(LengthUnit::Percent) => reference / 100.0,
    };
    let length = number * factor;
    length.is_finite().then_some(length)
}

/// Returns whether a text is a length.
pub(super) fn is_length(text: &str) -> bool {
    length(text, FontSizes::INITIAL, 1.0).is_some()
}

/// Returns whether a length has a physical unit, such as mm or in.
pub(super) fn is_physical(text: &str) -> bool {
    use LengthUnit::{Cm, In, Mm, Pc, Pt};
    matches!(
        split(text.trim()),
        Some((
            _,
            Unit::Svg(In | Cm | Mm | Pt | Pc) | Unit::QuarterMillimeter
        ))
    )
}

/// The size that a keyword of `font-size` names: a factor of the default size, or of the size
/// around the element. Source: CSS Fonts 4, section 2.5.
pub(super) fn font_size_factor(keyword: &str) -> Option<(f64, bool)> {
    const SMALLER: f64 = 1.2;
    Some(match keyword {
        "xx-small" => (3.0 / 5.0, false),
        "x-small" => (3.0 / 4.0, false),
        "small" => (8.0 / 9.0, false),
        "medium" => (1.0, false),
        "large" => (6.0 / 5.0, false),
        "x-large" => (3.0 / 2.0, false),
        "xx-large" => (2.0, false),
        "smaller" => (1.0 / SMALLER, true),
        "larger" => (SMALLER, true),
        _ => return None,
    })
}

enum Unit {
    Svg(LengthUnit),
    RootEm,
    QuarterMillimeter,
    /// The width of a zero: `ch`.
    Zero,
}

fn split(text: &str) -> Option<(f64, Unit)> {
    if let Ok(length) = Length::from_str(text) {
        return Some((length.number, Unit::Svg(length.unit)));
    }
    let text = text.to_ascii_lowercase();
    if let Ok(length) = Length::from_str(&text) {
        return Some((length.number, Unit::Svg(length.unit)));
    }
    // `rem` ends as `em` does, but what precedes it is then no number.
    let units = [
        ("rem", Unit::RootEm),
        ("q", Unit::QuarterMillimeter),
        ("ch", Unit::Zero),
    ];
    let (number, unit) = units
        .into_iter()
        .find_map(|(name, unit)| Some((text.strip_suffix(name)?, unit)))?;
    Some((number.parse().ok()?, unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_have_their_size() {
        let fonts = FontSizes {
            own: 20.0,
            root: 10.0,
        };
        for (text, expected) in [
            ("1em", Some(20.0)),
            ("2EX", Some(20.0)),
            ("1.5rem", Some(15.0)),
            ("2ch", Some(20.0)),
            ("101.6Q", Some(96.0)),
            ("1IN", Some(96.0)),
            ("6pc", Some(96.0)),
            ("1e1px", Some(10.0)),
            (" 50% ", Some(100.0)),
            ("1furlong", None),
            ("nanrem", None),
            ("rem", None),
            ("", None),
        ] {
            let found = length(text, fonts, 200.0);
            let is_equal = match (found, expected) {
                (Some(a), Some(b)) => (a - b).abs() < 1e-9,
                (a, b) => a == b,
            };
            assert!(is_equal, "{text}: {found:?}");
        }
    }
}
