use std::fmt;
use std::str::FromStr;

/// A color of 8 bits a channel, not premultiplied, in sRGB.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Rgba {
    /// Red.
    pub r: u8,
    /// Green.
    pub g: u8,
    /// Blue.
    pub b: u8,
    /// Opacity.
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

    /// Whether nothing shows through.
    pub const fn is_opaque(self) -> bool {
        self.a == 255
    }

    /// The color at fraction `t` of the way to `other`.
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

impl FromStr for Rgba {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let digits = text.strip_prefix('#').unwrap_or(text);
        let refuse =
            || format!("`{text}` is not a color: write RRGGBB or RRGGBBAA, such as ffcc00");
        if !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Err(refuse());
        }
        let value = u32::from_str_radix(digits, 16).map_err(|_| refuse())?;
        match digits.len() {
            6 => Ok(Self::from_u32(value << 8 | 0xff)),
            8 => Ok(Self::from_u32(value)),
            _ => Err(refuse()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_are_read_as_written() {
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
