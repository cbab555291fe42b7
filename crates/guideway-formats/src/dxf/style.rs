//! Layers and colors.

use std::collections::HashMap;

use super::records::Record;

const WHITE: u32 = 0xFFFF_FFFF;

/// The color to draw with, 0 where the view decides: over what is white. It stands for black on white paper
/// and white on a black screen, on which most drawings are made.
pub(super) fn on_paper(color: u32) -> u32 {
    if color == WHITE { 0 } else { color }
}

/// The color of an entity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Color {
    OfLayer,
    /// That of the reference that puts a block into the drawing.
    OfBlock,
    /// 0xRRGGBBAA, 0 for none.
    Rgba(u32),
}

impl Color {
    /// The color of a record: 420 is red, green and blue in one number, 62 an index.
    pub(super) fn of(record: &Record<'_>) -> Self {
        if let Some(rgb) = record.whole(420) {
            return Self::Rgba(((rgb as u32) << 8) | 0xFF);
        }
        match record.whole(62) {
            None | Some(256) => Self::OfLayer,
            Some(0) => Self::OfBlock,
            Some(index) => Self::Rgba(indexed(index)),
        }
    }
}

/// The color of an index of AutoCAD's palette, 0xRRGGBBAA; 0 for what is no index. 7 is black on white and
/// white on black; minus marks a layer that is off.
pub(super) fn indexed(index: i64) -> u32 {
    const FIRST: [u32; 10] = [
        0, 0xFF0000FF, 0xFFFF00FF, 0x00FF00FF, 0x00FFFFFF, 0x0000FFFF, 0xFF00FFFF, WHITE,
        0x808080FF, 0xC0C0C0FF,
    ];
    const GRAYS: [u32; 6] = [0x33, 0x50, 0x69, 0x82, 0xBE, 0xFF];
    /// The brightest channel of the shades of a hue.
    const VALUES: [f64; 5] = [255.0, 165.0, 127.0, 76.0, 38.0];
    let index = index.unsigned_abs();
    match index {
        0..=9 => FIRST[index as usize],
        10..=249 => {
            // 24 hues, 15 degrees apart, of ten shades each; the odd ones are half way to white.
            let hue = (index / 10 - 1) as f64 / 4.0;
            let value = VALUES[(index % 10 / 2) as usize];
            let channel = |offset: f64| {
                let from_peak = ((hue + offset) % 6.0 - 3.0).abs();
                let full = (from_peak - 1.0).clamp(0.0, 1.0);
                let mixed = if index % 2 == 1 {
                    (full + 1.0) / 2.0
                } else {
                    full
                };
                (value * mixed) as u32
            };
            let [r, g, b] = [0.0, 4.0, 2.0].map(channel);
            (r << 24) | (g << 16) | (b << 8) | 0xFF
        }
        250..=255 => (GRAYS[index as usize - 250] * 0x0101_0100) | 0xFF,
        _ => 0,
    }
}

/// A layer of the drawing.
#[derive(Debug)]
pub(super) struct Layer {
    pub(super) name: String,
    pub(super) color: u32,
    pub(super) is_off: bool,
    pub(super) is_frozen: bool,
}

/// All layers: those of the table, and those that an entity names without.
#[derive(Debug, Default)]
pub(super) struct Layers {
    all: Vec<Layer>,
    rows: HashMap<String, u32>,
}

impl Layers {
    pub(super) fn define(&mut self, record: &Record<'_>) {
        let row = self.row(&decoded(record.text(2).unwrap_or_default()));
        let index = record.whole(62).unwrap_or(7);
        let layer = &mut self.all[row as usize];
        layer.is_off = index < 0;
        layer.is_frozen = record.whole(70).unwrap_or(0) & 1 != 0;
        layer.color = match Color::of(record) {
            Color::Rgba(color) => color,
            _ => 0,
        };
    }

    /// The row of a layer; upper and lower case are one.
    pub(super) fn row(&mut self, name: &str) -> u32 {
        let key = name.to_uppercase();
        if let Some(&row) = self.rows.get(&key) {
            return row;
        }
        let row = self.all.len() as u32;
        self.all.push(Layer {
            name: name.to_owned(),
            color: 0,
            is_off: false,
            is_frozen: false,
        });
        self.rows.insert(key, row);
        row
    }

    pub(super) fn get(&self, row: u32) -> &Layer {
        &self.all[row as usize]
    }
}

/// Text of the file: UTF-8 since release 2007, before that mostly Windows-1252, and `\U+00E4` in both.
pub(super) fn decoded(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    };
    let mut parts = text.split(r"\U+");
    let mut whole = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.get(..4).and_then(|d| u32::from_str_radix(d, 16).ok());
        match digits.and_then(char::from_u32) {
            Some(character) => {
                whole.push(character);
                whole.push_str(&part[4..]);
            }
            None => {
                whole.push_str(r"\U+");
                whole.push_str(part);
            }
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_palette_is_that_of_autocad() {
        for (index, rgb) in [
            (1, 0xFF0000),
            (5, 0x0000FF),
            (8, 0x808080),
            (10, 0xFF0000),
            (11, 0xFF7F7F),
            (12, 0xA50000),
            (13, 0xA55252),
            (20, 0xFF3F00),
            (21, 0xFF9F7F),
            (50, 0xFFFF00),
            (90, 0x00FF00),
            (130, 0x00FFFF),
            (170, 0x0000FF),
            (210, 0xFF00FF),
            (250, 0x333333),
            (255, 0xFFFFFF),
        ] {
            let found = indexed(index) >> 8;
            assert_eq!(found, rgb, "{index}: {found:06X}");
        }
        assert_eq!(on_paper(indexed(7)), 0);
        assert_eq!(indexed(-1), indexed(1), "a layer that is off");
        assert_eq!(indexed(i64::MIN), 0);
    }

    #[test]
    fn names_are_decoded() {
        assert_eq!(decoded(b"W\xE4nde"), "Wände");
        assert_eq!(decoded("Wände".as_bytes()), "Wände");
        assert_eq!(decoded(br"W\U+00E4nde\U+"), r"Wände\U+");
        assert_eq!(decoded(br"\U+ZZZZ\U+D800"), r"\U+ZZZZ\U+D800");
    }
}
