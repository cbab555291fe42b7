//! Writes the expected, the actual and the difference picture of a failed comparison as PNG.

use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use guideway_scene::Frame;

use crate::compare::pixel_difference;

/// Pixels between two pictures.
const GAP_PX: usize = 4;

/// Writes the expected picture, the difference amplified five times, and the actual picture side by
/// side to `target/scene-suite/`, and returns the path of the file.
///
/// # Errors
/// When the file cannot be written.
pub fn write(name: &str, expected: &Frame, actual: &Frame) -> io::Result<PathBuf> {
    let file = folder().join(format!("{}.png", name.replace('/', "-")));
    let mut sheet = vec![expected.clone()];
    if expected.size() == actual.size() {
        sheet.push(difference_picture(expected, actual));
    }
    sheet.push(actual.clone());
    write_sheet(&file, &sheet, sheet.len())?;
    Ok(file)
}

/// Writes pictures in a grid of `columns` on gray to one PNG file.
///
/// # Errors
/// When the file cannot be written.
pub fn write_sheet(file: &Path, pictures: &[Frame], columns: usize) -> io::Result<()> {
    let side = |side: fn(&Frame) -> u32| pictures.iter().map(side).max().unwrap_or(1) as usize;
    let cell_width = side(|f| f.size().width()) + GAP_PX;
    let cell_height = side(|f| f.size().height()) + GAP_PX;
    let width = cell_width * columns;
    let height = cell_height * pictures.len().div_ceil(columns);
    let mut sheet = vec![[128, 128, 128, 255]; width * height];
    for (index, picture) in pictures.iter().enumerate() {
        let corner = index / columns * cell_height * width + index % columns * cell_width;
        let picture_width = picture.size().width() as usize;
        for (y, row) in picture.pixels().chunks(picture_width).enumerate() {
            sheet[corner + y * width..][..picture_width].copy_from_slice(row);
        }
    }
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    let writer = BufWriter::new(File::create(file)?);
    let mut encoder = png::Encoder::new(writer, width as u32, height as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let mut encoder = encoder.write_header().map_err(io::Error::other)?;
    let written = encoder.write_image_data(sheet.as_flattened());
    written.map_err(io::Error::other)
}

fn difference_picture(expected: &Frame, actual: &Frame) -> Frame {
    let mut picture = expected.clone();
    for (pixel, &drawn) in picture.pixels_mut().iter_mut().zip(actual.pixels()) {
        let strength = (pixel_difference(*pixel, drawn) * 5.0).min(255.0) as u8;
        *pixel = [strength, strength, strength, 255];
    }
    picture
}

fn folder() -> PathBuf {
    let in_workspace = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../target");
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(in_workspace, PathBuf::from);
    target.join("scene-suite")
}
