//! Renders every layout file of a folder into a cell of one picture, and lists the files by number:
//!
//!     cargo run --example contact_sheet -- FOLDER SHEET.png

use std::error::Error;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway::compose::{NoProgress, Picture};
use guideway::scene::{Frame, FrameSize, LineRule, Rgba, Scene, SceneOptions, Style, TextLine};
use guideway::spline::Point;

const COLUMNS: usize = 8;
const CELL_PX: [usize; 2] = [240, 180];
const MARGIN_PX: usize = 4;
/// Wide enough to be visible, narrow enough for a thumbnail.
const LINE_PX: f64 = 1.5;
/// Width of a digit of the number in a cell.
const DIGIT_PX: f64 = 9.0;

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<_> = std::env::args_os().skip(1).collect();
    let [folder, sheet] = &args[..] else {
        return Err("usage: contact_sheet FOLDER SHEET.png".into());
    };
    let files = layout_files(Path::new(folder))?;
    let step = CELL_PX.map(|side| side + MARGIN_PX);
    let rows = files.len().div_ceil(COLUMNS);
    let size = FrameSize::new(
        (COLUMNS * step[0] + MARGIN_PX) as u32,
        (rows * step[1] + MARGIN_PX) as u32,
    )?;
    let mut frame = Frame::new(size);
    frame.pixels_mut().fill([200, 200, 200, 255]);
    for (i, file) in files.iter().enumerate() {
        let cell = render_cell(file, i + 1)?;
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

/// All files in a folder and its subfolders, except Markdown.
fn layout_files(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files.extend(layout_files(&path)?);
        } else if path.extension() != Some(OsStr::new("md")) {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// Renders a file, with its number in the lower left corner.
fn render_cell(file: &Path, number: usize) -> Result<Frame, Box<dyn Error>> {
    let layout = guideway::open(file)?;
    let scene = Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default())?);
    let size = FrameSize::new(CELL_PX[0] as u32, CELL_PX[1] as u32)?;
    let mut picture = Picture::new(scene, size);
    picture.style = Style {
        line_rule: LineRule::World {
            width_m: 0.1,
            min_px: LINE_PX,
            max_px: LINE_PX,
        },
        ..Style::default()
    };
    picture.overlay.texts.push(TextLine {
        text: number.to_string(),
        left_middle_px: Point::new(MARGIN_PX as f64, CELL_PX[1] as f64 - DIGIT_PX),
        angle_rad: 0.0,
        anchor: 0.0,
        char_width_px: DIGIT_PX,
        color: Rgba::opaque(0, 0, 255),
        halo: Rgba::from_u32(0),
    });
    let method = guideway::method("cpu")?;
    let (frame, _) = picture.render_frame(&*method, &NoProgress)?;
    Ok(frame)
}
