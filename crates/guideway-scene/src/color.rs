//! sRGB colors with 8 bits per channel, and their hexadecimal notation.

use std::fmt;
use std::str::FromStr;

/// An sRGB color with 8 bits per channel and straight alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rgba {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Alpha: 0 is transparent, 255 opaque.
    pub a: u8,
}

impl Rgba {
    /// Opaque white.
    pub const WHITE: Self = Self::opaque(255, 255, 255);
    /// Opaque black.
    pub const BLACK: Self = Self::opaque(0, 0, 0);

    /// An opaque color.
    pub const fn opaque(r: u8, g: u8, b: u8) -> Self {
        Self { r, g, b, a: 255 }
    }

    /// From 0xRRGGBBAA.
    pub const fn from_u32(rgba: u32) -> Self {
        let [r, g, b, a] = rgba.to_be_bytes();
        Self { r, g, b, a }
    }

    /// As 0xRRGGBBAA.
    pub const fn to_u32(self) -> u32 {
        u32::from_be_bytes([self.r, self.g, self.b, self.a])
    }

    /// Returns `true` if alpha is 255.
    pub const fn is_opaque(self) -> bool {
        self.a == 255
    }

    /// The color with another opacity, 0 to 1.
    pub fn with_opacity(self, opacity: f64) -> Self {
        Self {
            a: (255.0 * opacity).round() as u8,
            ..self
        }
    }

    /// The color, more translucent: its alpha times an opacity of 0 to 1.
    pub fn faded(self, opacity: f64) -> Self {
        Self {
            a: (f64::from(self.a) * opacity.clamp(0.0, 1.0)).round() as u8,
            ..self
        }
    }

    /// Interpolates linearly per channel: `self` at `t` = 0, `other` at `t` = 1.
    pub fn lerp(self, other: Self, t: f64) -> Self {
        let mix = |a: u8, b: u8| (f64::from(a) + (f64::from(b) - f64::from(a)) * t).round() as u8;
        Self {
            r: mix(self.r, other.r),
            g: mix(self.g, other.g),
            b: mix(self.b, other.b),
            a: mix(self.a, other.a),
        }
    }
}

impl fmt::Display for Rgba {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:02x}{:02x}{:02x}", self.r, self.g, self.b)?;
        if self.a == 255 {
            Ok(())
        } else {
            write!(f, "{:02x}", self.a)
        }
    }
}

/// A text that is not a color.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{text}` is not a color: write RRGGBB or RRGGBBAA, such as ffcc00")]
pub struct ParseColorError {
    /// The text.
    pub text: String,
}

/// Reads `RRGGBB` or `RRGGBBAA`, optionally after a `#`.
impl FromStr for Rgba {
    type Err = ParseColorError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let digits = text.strip_prefix('#').unwrap_or(text);
        let error = || ParseColorError {
            text: text.to_owned(),
        };
        if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(error());
        }
        let value = u32::from_str_radix(digits, 16).map_err(|_| error())?;
        match digits.len() {
            6 => Ok(Self::from_u32(value << 8 | 0xff)),
            8 => Ok(Self::from_u32(value)),
            _ => Err(error()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fading_scales_alpha_alone() {
        let color = Rgba::from_u32(0x0102_0380);
        assert_eq!(color.faded(0.5), Rgba::from_u32(0x0102_0340));
        assert_eq!((color.faded(2.0), color.faded(-1.0).a), (color, 0));
    }

    #[test]
    fn parses_what_display_writes_and_rejects_the_rest() {
        assert_eq!("#ff8000".parse(), Ok(Rgba::opaque(255, 128, 0)));
        assert_eq!(
            "01020304".parse(),
            Ok(Rgba {
                r: 1,
                g: 2,
                b: 3,
                a: 4
            })
        );
        assert_eq!(Rgba::from_u32(0x0102_0304).to_string(), "01020304");
        for bad in ["", "fff", "+ff800", "ff80000", "gggggg", "ff80001122", "€€"] {
            assert!(bad.parse::<Rgba>().is_err(), "{bad}");
        }
    }
}
