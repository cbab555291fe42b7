//! Draws every layout file of a folder, each in a cell with its number, and prints which file has which number:
//!
//!     cargo run --example contact_sheet -- FOLDER SHEET.png

use std::error::Error;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway::render::{Budget, Cancel, Frame, FrameSize, Style, View};
use guideway::scene::{LineRule, Scene, SceneOptions};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster};

const COLUMNS: usize = 8;
const CELL_PX: [usize; 2] = [240, 180];
const MARGIN_PX: usize = 4;
/// Wide enough to be seen, and narrow enough for icons.
const LINE_PX: f64 = 1.5;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<_> = std::env::args_os().skip(1).collect();
    let [folder, sheet] = &args[..] else {
        return Err("usage: contact_sheet FOLDER SHEET.png".into());
    };
    let files = files(Path::new(folder))?;
    let step = CELL_PX.map(|side| side + MARGIN_PX);
    let rows = files.len().div_ceil(COLUMNS);
    let size = FrameSize::new(
        (COLUMNS * step[0] + MARGIN_PX) as u32,
        (rows * step[1] + MARGIN_PX) as u32,
    )?;
    let mut frame = Frame::new(size);
    frame.pixels_mut().fill([200, 200, 200, 255]);
    for (i, file) in files.iter().enumerate() {
        let mut cell = draw(file)?;
        number(&mut cell, i + 1);
        let corner = [i % COLUMNS, i / COLUMNS];
        let [left, top] = [0, 1].map(|axis| corner[axis] * step[axis] + MARGIN_PX);
        let width = size.width() as usize;
        for (y, row) in cell.pixels().chunks_exact(CELL_PX[0]).enumerate() {
            let start = (top + y) * width + left;
            frame.pixels_mut()[start..start + CELL_PX[0]].copy_from_slice(row);
        }
        let name = file.strip_prefix(folder).unwrap_or(file);
        println!("{} {}", i + 1, name.display());
    }
    guideway::save_png(&frame, sheet)?;
    Ok(())
}

/// All files in the folders of a folder, but those that tell about the others.
fn files(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files.extend(self::files(&path)?);
        } else if path.extension() != Some(OsStr::new("md")) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

fn draw(file: &Path) -> Result<Frame, Box<dyn Error>> {
    let layout = guideway::open(file)?;
    let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default())?);
    let view = View::fit(
        FrameSize::new(CELL_PX[0] as u32, CELL_PX[1] as u32)?,
        scene.bounds(),
    )?;
    let style = Style {
        line_rule: LineRule::World {
            width_m: 0.1,
            min_px: LINE_PX,
            max_px: LINE_PX,
        },
        ..Style::default()
    };
    let mut frame = Frame::new(view.size());
    let mut drawing = guideway::method("cpu")?.prepare(scene, &Budget::default())?;
    drawing.render(&view, &style, &Cancel::default(), &mut frame)?;
    Ok(frame)
}

/// Puts a number into the lower left corner.
fn number(cell: &mut Frame, number: usize) {
    let mut left = MARGIN_PX;
    for digit in number.to_string().chars() {
        let Some(glyph) = get_raster(digit, FontWeight::Regular, RasterHeight::Size16) else {
            continue;
        };
        let top = CELL_PX[1] - glyph.height();
        for (y, row) in glyph.rows().enumerate() {
            for (x, &ink) in row.iter().enumerate() {
                let pixel = &mut cell.pixels_mut()[(top + y) * CELL_PX[0] + left + x];
                // Blue over whatever lies there.
                let mixed = |below: u8, full: u8| {
                    let [below, full, ink] = [below, full, ink].map(u32::from);
                    ((below * (255 - ink) + full * ink) / 255) as u8
                };
                let [r, g, b, a] = *pixel;
                *pixel = [mixed(r, 0), mixed(g, 0), mixed(b, 255), a];
            }
        }
        left += glyph.width();
    }
}
