//! Cairo: single-threaded.

use std::sync::Arc;

use anyhow::Result;
use cairo::{Context, Format, ImageSurface, LineCap, LineJoin};
use guideway_layout::Layout;
use guideway_scene::{Frame, View};

use super::shared::{FRAMES, WIDTH_PX, curves, store_words, time};

pub(super) fn draw(layout: &Arc<Layout>, view: &View, frame: &mut Frame) -> Result<Vec<f64>> {
    let [width, height] = [view.size().width(), view.size().height()].map(|side| side as i32);
    let mut surface = ImageSurface::create(Format::Rgb24, width, height)?;
    let context = Context::new(&surface)?;
    context.set_line_width(WIDTH_PX);
    context.set_line_cap(LineCap::Round);
    context.set_line_join(LineJoin::Round);
    let times_ms = time(FRAMES, |_| {
        context.set_source_rgb(1.0, 1.0, 1.0);
        context.paint()?;
        context.set_source_rgb(0.0, 0.0, 0.0);
        for path in layout.paths.iter() {
            for run in curves(&path, view) {
                for (i, [a, b, c, d]) in run.enumerate() {
                    if i == 0 {
                        context.move_to(a.x, a.y);
                    }
                    context.curve_to(b.x, b.y, c.x, c.y, d.x, d.y);
                }
            }
            context.stroke()?;
        }
        Ok(())
    })?;
    drop(context);
    let stride = surface.stride() as usize;
    let data = surface.data()?;
    store_words(&data, stride, width as usize, frame);
    Ok(times_ms)
}
