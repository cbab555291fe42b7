//! Encodes a tile as PNG: with a palette if it has few colors, which is a quarter of the bytes to
//! compress.

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, Filter};

use crate::tile::TILE_PX;

/// Most colors of a palette.
const MAX_COLORS: usize = 256;
/// Slots of the table of colors: few collide.
const SLOTS: usize = 4 * MAX_COLORS;

/// The colors of a tile, by order of appearance.
struct Palette {
    colors: Vec<[u8; 4]>,
    /// A color, and its number plus one, by its hash; 0 is free.
    slots: [([u8; 4], u16); SLOTS],
}

impl Palette {
    fn new() -> Self {
        Self {
            colors: Vec::with_capacity(MAX_COLORS),
            slots: [([0; 4], 0); SLOTS],
        }
    }

    /// Number of a color; `None` if there are too many.
    fn index(&mut self, color: [u8; 4]) -> Option<u8> {
        // Fibonacci hashing (Knuth, The Art of Computer Programming, 6.4).
        let hash = u32::from_ne_bytes(color).wrapping_mul(0x9e37_79b1);
        let mut slot = (hash >> (u32::BITS - SLOTS.ilog2())) as usize;
        loop {
            match self.slots[slot] {
                (_, 0) if self.colors.len() == MAX_COLORS => return None,
                (_, 0) => {
                    self.colors.push(color);
                    self.slots[slot] = (color, self.colors.len() as u16);
                    return Some((self.colors.len() - 1) as u8);
                }
                (known, number) if known == color => return Some((number - 1) as u8),
                _ => slot = (slot + 1) % SLOTS,
            }
        }
    }
}

/// Encodes the rows of a tile. The background gets the number 0, which compresses best.
///
/// # Errors
/// When the encoder fails, as it does without memory.
pub(crate) fn encode<'a>(
    rows: impl Iterator<Item = &'a [[u8; 4]]> + Clone,
    background: [u8; 4],
) -> Result<Vec<u8>, EncodingError> {
    let mut palette = Palette::new();
    let side = TILE_PX as usize;
    let mut bytes = vec![0; side * side];
    let mut last = (background, 0);
    palette.index(background);
    for (row, indices) in rows.clone().zip(bytes.chunks_exact_mut(side)) {
        for (&color, to) in row.iter().zip(indices) {
            if color != last.0 {
                match palette.index(color) {
                    Some(index) => last = (color, index),
                    None => return encode_colors(rows),
                }
            }
            *to = last.1;
        }
    }
    write(&bytes, Some(&palette.colors))
}

fn encode_colors<'a>(rows: impl Iterator<Item = &'a [[u8; 4]]>) -> Result<Vec<u8>, EncodingError> {
    let bytes: Vec<u8> = rows.flatten().flatten().copied().collect();
    write(&bytes, None)
}

fn write(bytes: &[u8], palette: Option<&[[u8; 4]]>) -> Result<Vec<u8>, EncodingError> {
    let mut png = Vec::new();
    let mut encoder = Encoder::new(&mut png, TILE_PX, TILE_PX);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    match palette {
        None => encoder.set_color(ColorType::Rgba),
        Some(colors) => {
            encoder.set_color(ColorType::Indexed);
            encoder.set_filter(Filter::NoFilter);
            let rgb: Vec<u8> = colors
                .iter()
                .flat_map(|[r, g, b, _]| [*r, *g, *b])
                .collect();
            encoder.set_palette(rgb);
            if colors.iter().any(|[.., alpha]| *alpha < u8::MAX) {
                let alphas: Vec<u8> = colors.iter().map(|[.., alpha]| *alpha).collect();
                encoder.set_trns(alphas);
            }
        }
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(bytes)?;
    writer.finish()?;
    Ok(png)
}

/// The pixels of a PNG tile, for tests.
#[cfg(test)]
pub(crate) fn decode(png: &[u8]) -> Vec<[u8; 4]> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
    decoder.set_transformations(png::Transformations::ALPHA);
    let mut reader = decoder.read_info().unwrap();
    let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut bytes).unwrap();
    bytes.as_chunks::<4>().0.to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(color: impl Fn(usize) -> [u8; 4], is_indexed: bool) {
        let side = TILE_PX as usize;
        let pixels: Vec<[u8; 4]> = (0..side * side).map(color).collect();
        let png = encode(pixels.chunks(side), pixels[0]).unwrap();
        assert!(decode(&png) == pixels);
        let color_type = png[25];
        assert_eq!(color_type == 3, is_indexed);
    }

    #[test]
    fn few_colors_get_a_palette_and_all_come_back() {
        check(|i| [i as u8, 0, 7, 255], true);
        check(|i| [0, i as u8 / 2, 7, 128 + (i % 2) as u8], true);
        check(|i| [i as u8, (i / 256) as u8, 0, 200], false);
    }
}
