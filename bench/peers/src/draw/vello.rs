//! vello_cpu, on one thread or on all cores.

use std::sync::Arc;

use anyhow::Result;
use guideway_layout::{Layout, PathRef};
use guideway_scene::{Frame, View};
use vello_cpu::color::palette::css;
use vello_cpu::kurbo::{BezPath, Cap, Join, Rect, Stroke};
use vello_cpu::{Pixmap, RenderContext, RenderSettings, Resources};

use super::shared::{FRAMES, WIDTH_PX, curves, time};

/// Draws on the calling thread only.
pub(super) fn draw(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    draw_with(0, layout, view, frame)
}

/// Draws on the calling thread and one more thread per core.
pub(super) fn draw_threaded(
    layout: &Arc<Layout>,
    view: &View,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    let cores = std::thread::available_parallelism()?.get();
    draw_with(cores as u16, layout, view, frame)
}

fn draw_with(
    num_threads: u16,
    layout: &Layout,
    view: &View,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    let [width, height] = [view.size().width(), view.size().height()].map(|side| side as u16);
    let settings = RenderSettings {
        num_threads,
        ..RenderSettings::default()
    };
    let mut context = RenderContext::new_with(width, height, settings);
    let mut resources = Resources::new();
    let mut pixmap = Pixmap::new(width, height);
    let stroke = Stroke::new(WIDTH_PX)
        .with_caps(Cap::Round)
        .with_join(Join::Round);
    let times_ms = time(FRAMES, |_| {
        context.reset();
        context.set_paint(css::WHITE);
        context.fill_rect(&Rect::new(0.0, 0.0, width.into(), height.into()));
        context.set_paint(css::BLACK);
        context.set_stroke(stroke.clone());
        for path in layout.paths.iter() {
            context.stroke_path(&outline(&path, view));
        }
        context.flush();
        context.render(&mut pixmap, &mut resources);
        Ok(())
    })?;
    let (pixels, _) = pixmap.data_as_u8_slice().as_chunks();
    frame.pixels_mut().copy_from_slice(pixels);
    Ok(times_ms)
}

fn outline(path: &PathRef<'_>, view: &View) -> BezPath {
    let mut outline = BezPath::new();
    for run in curves(path, view) {
        for (i, curve) in run.enumerate() {
            let [a, b, c, d] = curve.map(|p| (p.x, p.y));
            if i == 0 {
                outline.move_to(a);
            }
            outline.curve_to(b, c, d);
        }
    }
    outline
}
