//! Writes the embedded fonts without the programs and tables that fit letters to pixels, which no
//! picture uses: more than half of the fonts of letters. All but those of pages, which are sent
//! compressed as a whole, are gzip.

use std::error::Error;
use std::fs;
use std::io::Write;
use std::path::Path;

use epaint_default_fonts::{HACK_REGULAR, NOTO_EMOJI_REGULAR, UBUNTU_LIGHT};
use flate2::Compression;
use flate2::write::GzEncoder;

/// Tables of hinting, names and signatures.
const UNUSED: [&[u8; 4]; 12] = [
    b"DSIG", b"FFTM", b"LTSH", b"TTFA", b"VDMX", b"cvt ", b"fpgm", b"gasp", b"hdmx", b"name",
    b"post", b"prep",
];
const DIRECTORY_BYTES: usize = 12;
const RECORD_BYTES: usize = 16;
/// Place of the format of `loca` in `head`.
const LOCA_FORMAT: usize = 50;

/// Flags of the parts of a composite glyph.
const HAS_WORDS: u16 = 1;
const HAS_SCALE: u16 = 1 << 3;
const HAS_MORE: u16 = 1 << 5;
const HAS_TWO_SCALES: u16 = 1 << 6;
const HAS_MATRIX: u16 = 1 << 7;
const HAS_INSTRUCTIONS: u16 = 1 << 8;

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    let folder = std::env::var("OUT_DIR")?;
    let is_page = std::env::var("CARGO_CFG_TARGET_ARCH")? == "wasm32";
    for (name, font) in [
        ("hack.ttf", HACK_REGULAR),
        ("letters.ttf", UBUNTU_LIGHT),
        ("symbols.ttf", NOTO_EMOJI_REGULAR),
    ] {
        let stripped = stripped(font).ok_or(name)?;
        let content = if is_page {
            stripped
        } else {
            packed(&stripped)?
        };
        fs::write(Path::new(&folder).join(name), content)?;
    }
    Ok(())
}

fn packed(font: &[u8]) -> std::io::Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(font)?;
    encoder.finish()
}

/// A TrueType font without its unused tables and the instructions of its glyphs. `None` if it is
/// none.
fn stripped(font: &[u8]) -> Option<Vec<u8>> {
    let count = word(font, 4)?;
    let mut tables = Vec::new();
    for index in 0..usize::from(count) {
        let record = font.get(DIRECTORY_BYTES + index * RECORD_BYTES..)?;
        let tag: [u8; 4] = record.get(..4)?.try_into().ok()?;
        let (start, length) = (long(record, 8)?, long(record, 12)?);
        let content = font.get(start..start + length)?;
        if !UNUSED.contains(&&tag) {
            tables.push((tag, content.to_vec()));
        }
    }
    let place = |name: &[u8; 4]| tables.iter().position(|(tag, _)| tag == name);
    let [head, loca, glyf, maxp] = [
        place(b"head")?,
        place(b"loca")?,
        place(b"glyf")?,
        place(b"maxp")?,
    ];
    let is_long = word(&tables[head].1, LOCA_FORMAT)? == 1;
    let (mut glyphs, mut starts) = (Vec::new(), vec![0]);
    let start = |index| match is_long {
        true => long(&tables[loca].1, 4 * index),
        false => Some(2 * usize::from(word(&tables[loca].1, 2 * index)?)),
    };
    for index in 0..usize::from(word(&tables[maxp].1, 4)?) {
        let glyph = tables[glyf].1.get(start(index)?..start(index + 1)?)?;
        glyphs.extend(without_instructions(glyph)?);
        glyphs.resize(glyphs.len().next_multiple_of(2), 0);
        starts.push(u32::try_from(glyphs.len()).ok()?);
    }
    tables[head].1[LOCA_FORMAT..][..2].copy_from_slice(&[0, 1]);
    tables[loca].1 = starts.into_iter().flat_map(u32::to_be_bytes).collect();
    tables[glyf].1 = glyphs;
    file(&tables)
}

/// The outline of a glyph alone.
fn without_instructions(glyph: &[u8]) -> Option<Vec<u8>> {
    let Some(contours) = word(glyph, 0) else {
        return Some(Vec::new());
    };
    // The number of contours of a composite glyph is negative.
    if let Ok(contours) = usize::try_from(contours.cast_signed()) {
        let at = 10 + 2 * contours;
        let length = usize::from(word(glyph, at)?);
        let points = glyph.get(at + 2 + length..)?;
        return Some([&glyph[..at], &[0, 0], points].concat());
    }
    let mut outline = glyph.to_vec();
    let mut at = 10;
    loop {
        let flags = word(glyph, at)?;
        outline[at..at + 2].copy_from_slice(&(flags & !HAS_INSTRUCTIONS).to_be_bytes());
        let has = |flag| usize::from(flags & flag != 0);
        at += 6 + 2 * has(HAS_WORDS);
        at += 2 * has(HAS_SCALE) + 4 * has(HAS_TWO_SCALES) + 8 * has(HAS_MATRIX);
        if has(HAS_MORE) == 0 {
            outline.truncate(at);
            return Some(outline);
        }
    }
}

/// A font file of tables, without checksums.
fn file(tables: &[([u8; 4], Vec<u8>)]) -> Option<Vec<u8>> {
    let count = u16::try_from(tables.len()).ok()?;
    let mut file = [0, 1, 0, 0].to_vec();
    file.extend(count.to_be_bytes());
    file.extend([0; 6]);
    let mut start = DIRECTORY_BYTES + tables.len() * RECORD_BYTES;
    for (tag, content) in tables {
        file.extend(tag);
        for number in [0, start, content.len()] {
            file.extend(u32::try_from(number).ok()?.to_be_bytes());
        }
        start += content.len().next_multiple_of(4);
    }
    for (_, content) in tables {
        file.extend(content);
        file.resize(file.len().next_multiple_of(4), 0);
    }
    Some(file)
}

fn word(bytes: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(bytes.get(at..at + 2)?.try_into().ok()?))
}

fn long(bytes: &[u8], at: usize) -> Option<usize> {
    let number = u32::from_be_bytes(bytes.get(at..at + 4)?.try_into().ok()?);
    usize::try_from(number).ok()
}
