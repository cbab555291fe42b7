//! Reads layers and colors: the layer table, true colors and the AutoCAD Color Index (ACI).

use std::collections::HashMap;

use super::records::Record;
use super::text::TextDecoder;

const WHITE: u32 = 0xFFFF_FFFF;

/// The color of a path, 0xRRGGBBAA. White becomes 0, the color of the view: CAD programs draw white
/// (color 7) as black on white paper and as white on a black screen.
pub(super) fn path_color(color: u32) -> u32 {
    if color == WHITE { 0 } else { color }
}

/// The color of an entity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Color {
    /// The color of its layer.
    ByLayer,
    /// The color of the INSERT that places its block.
    ByBlock,
    /// 0xRRGGBBAA, 0 for none.
    Rgba(u32),
}

impl Color {
    /// The color of a record: group code 420 is a true color, 62 a color index.
    pub(super) fn of(record: &Record<'_>) -> Self {
        if let Some(rgb) = record.int(420) {
            return Self::Rgba(((rgb as u32) << 8) | 0xFF);
        }
        match record.int(62) {
            None | Some(256) => Self::ByLayer,
            Some(0) => Self::ByBlock,
            Some(index) => Self::Rgba(aci_color(index)),
        }
    }
}

/// The color of an AutoCAD Color Index, 0xRRGGBBAA; 0 for an invalid index. Ignores the sign, which
/// marks a layer as off.
///
/// Source: the palette of AutoCAD, reproduced by a formula; the test below has samples of it.
pub(super) fn aci_color(index: i64) -> u32 {
    const FIRST: [u32; 10] = [
        0, 0xFF0000FF, 0xFFFF00FF, 0x00FF00FF, 0x00FFFFFF, 0x0000FFFF, 0xFF00FFFF, WHITE,
        0x808080FF, 0xC0C0C0FF,
    ];
    const GRAYS: [u32; 6] = [0x33, 0x50, 0x69, 0x82, 0xBE, 0xFF];
    /// The brightest channel per pair of shades.
    const VALUES: [f64; 5] = [255.0, 165.0, 127.0, 76.0, 38.0];
    let index = index.unsigned_abs();
    match index {
        0..=9 => FIRST[index as usize],
        10..=249 => {
            // 24 hues, 15 degrees apart, with ten shades each; odd shades are mixed with white 1:1.
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
    /// 0xRRGGBBAA, 0 for none.
    pub(super) color: u32,
    pub(super) is_off: bool,
    pub(super) is_frozen: bool,
}

/// All layers: those of the layer table, and those that only entities name.
#[derive(Debug, Default)]
pub(super) struct Layers {
    /// Decoder of the names of layers and of other texts.
    pub(super) texts: TextDecoder,
    all: Vec<Layer>,
    rows: HashMap<String, u32>,
}

impl Layers {
    /// Reads a LAYER record.
    pub(super) fn define(&mut self, record: &Record<'_>) {
        let row = self.row_of(record.text(2).unwrap_or_default());
        let index = record.int(62).unwrap_or(7);
        let layer = &mut self.all[row as usize];
        layer.is_off = index < 0;
        layer.is_frozen = record.int(70).unwrap_or(0) & 1 != 0;
        layer.color = match Color::of(record) {
            Color::Rgba(color) => color,
            _ => 0,
        };
    }

    /// The row of a layer by its name in the file.
    pub(super) fn row_of(&mut self, name: &[u8]) -> u32 {
        self.row(&self.texts.decode(name))
    }

    /// The row of a layer by its case-insensitive name. Adds a layer if the name is new.
    fn row(&mut self, name: &str) -> u32 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aci_color_matches_the_palette_of_autocad() {
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
            let found = aci_color(index) >> 8;
            assert_eq!(found, rgb, "{index}: {found:06X}");
        }
        assert_eq!(path_color(aci_color(7)), 0);
        assert_eq!(aci_color(-1), aci_color(1), "a layer that is off");
        assert_eq!(aci_color(i64::MIN), 0);
    }
}
