use std::sync::Arc;

use anyhow::Result;
use cairo::{Context, Format, ImageSurface, LineCap, LineJoin};
use guideway_layout::Layout;
use guideway_render::{Frame, View};

use super::{FRAMES, WIDTH_PX, curves, time};

/// It has no use for threads.
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
    let rows = data.chunks_exact(stride);
    for (pixels, row) in frame
        .pixels_mut()
        .chunks_exact_mut(width as usize)
        .zip(rows)
    {
        let (words, _) = row.as_chunks();
        for (pixel, word) in pixels.iter_mut().zip(words) {
            let [_, r, g, b] = u32::from_ne_bytes(*word).to_be_bytes();
            *pixel = [r, g, b, 255];
        }
    }
    Ok(times_ms)
}
