//! tiny-skia: single-threaded, with paths built per frame or once.

use std::sync::Arc;

use anyhow::{Context, Result};
use guideway_layout::{Layout, PathRef};
use guideway_scene::{Frame, View};
use tiny_skia::{Color, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

use super::shared::{FRAMES, WIDTH_PX, curves, time};

/// Builds the paths in every frame.
pub(super) fn draw(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    draw_paths(layout, view, false, frame)
}

/// Builds the paths in the first frame and reuses them, as a program that redraws does.
pub(super) fn draw_kept(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    draw_paths(layout, view, true, frame)
}

fn draw_paths(
    layout: &Layout,
    view: &View,
    reuses_paths: bool,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    let stroke = Stroke {
        width: WIDTH_PX as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    let paint = Paint {
        anti_alias: true,
        ..Paint::default()
    };
    let mut pixmap = Pixmap::new(view.size().width(), view.size().height())
        .context("tiny-skia rejects the picture size")?;
    let outlines = || layout.paths.iter().filter_map(|p| outline(&p, view));
    let mut built = Vec::new();
    let times_ms = time(FRAMES, |frame| {
        if reuses_paths && frame == 0 {
            built.extend(outlines());
        }
        pixmap.fill(Color::WHITE);
        let mut draw = |path: &Path| {
            pixmap.stroke_path(path, &paint, &stroke, Transform::identity(), None);
        };
        if reuses_paths {
            built.iter().for_each(&mut draw);
        } else {
            outlines().for_each(|path| draw(&path));
        }
        Ok(())
    })?;
    let (pixels, _) = pixmap.data().as_chunks();
    frame.pixels_mut().copy_from_slice(pixels);
    Ok(times_ms)
}

fn outline(path: &PathRef<'_>, view: &View) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for run in curves(path, view) {
        for (i, curve) in run.enumerate() {
            let [a, b, c, d] = curve.map(|p| p.to_f32());
            if i == 0 {
                builder.move_to(a.x, a.y);
            }
            builder.cubic_to(b.x, b.y, c.x, c.y, d.x, d.y);
        }
    }
    builder.finish()
}
