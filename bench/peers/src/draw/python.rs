//! Skia, by the Python package `skia-python`. The variable `GUIDEWAY_PYTHON` names the interpreter;
//! the default is `python3`.

use std::env;
use std::fs;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use anyhow::{Context, Result, ensure};
use guideway_layout::Layout;
use guideway_scene::{Frame, View};

use super::shared::{FRAMES, WIDTH_PX, curves};

/// Draws frames in a Python process, which builds its paths before the first frame.
pub(super) fn skia(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    let folder = tempfile::tempdir()?;
    let [curves, pixels] = ["curves", "pixels"].map(|file| folder.path().join(file));
    write_curves(layout, view, &curves)?;
    let python = env::var("GUIDEWAY_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let (width, height) = (view.size().width(), view.size().height());
    let output = Command::new(&python)
        .args(["-c", include_str!("strokes.py")])
        .args([width, height].map(|side| side.to_string()))
        .args([WIDTH_PX.to_string(), FRAMES.to_string()])
        .args([&curves, &pixels])
        .output()
        .with_context(|| python.clone())?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "skia by {python}: {errors}");
    let bytes = fs::read(pixels)?;
    let (read, _) = bytes.as_chunks::<4>();
    ensure!(
        read.len() == frame.pixels().len(),
        "skia: the picture has another size"
    );
    frame.pixels_mut().copy_from_slice(read);
    Ok(serde_json::from_slice(&output.stdout)?)
}

/// Writes the curves in the binary format that strokes.py documents.
fn write_curves(layout: &Layout, view: &View, file: &Path) -> Result<()> {
    let mut file = BufWriter::new(fs::File::create(file)?);
    for path in layout.paths.iter() {
        for run in curves(&path, view) {
            let run: Vec<_> = run.collect();
            let Some([start, ..]) = run.first() else {
                continue;
            };
            file.write_all(&(run.len() as u32).to_ne_bytes())?;
            let ends = run.iter().flat_map(|[_, rest @ ..]| rest);
            for point in std::iter::once(start).chain(ends) {
                for coordinate in [point.x, point.y] {
                    file.write_all(&(coordinate as f32).to_ne_bytes())?;
                }
            }
        }
    }
    Ok(file.flush()?)
}
