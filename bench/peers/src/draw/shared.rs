//! Constants and helpers of all renderers: stroke width, timing, curves in pixels.

use std::time::Instant;

use anyhow::Result;
use guideway_layout::PathRef;
use guideway_scene::{View, elapsed_ms};
use guideway_spline::{Point, uniform};

/// Stroke width of all paths.
pub(super) const WIDTH_PX: f64 = 3.0;
/// Frames of a slow renderer, which takes seconds per frame.
pub(super) const FRAMES: usize = 3;

/// Time of each call of `draw`, in milliseconds.
pub(super) fn time(frames: usize, mut draw: impl FnMut(usize) -> Result<()>) -> Result<Vec<f64>> {
    let frame = |frame| {
        let start = Instant::now();
        draw(frame)?;
        Ok(elapsed_ms(start))
    };
    (0..frames).map(frame).collect()
}

/// Copies rows of 32-bit words to a frame: blue in the lowest byte, then green and red.
#[cfg(any(feature = "blend2d", feature = "cairo"))]
pub(super) fn store_words(
    bytes: &[u8],
    stride: usize,
    width: usize,
    frame: &mut guideway_scene::Frame,
) {
    let rows = frame.pixels_mut().chunks_exact_mut(width);
    for (pixels, row) in rows.zip(bytes.chunks_exact(stride)) {
        let (words, _) = row.as_chunks();
        for (pixel, word) in pixels.iter_mut().zip(words) {
            let [_, r, g, b] = u32::from_ne_bytes(*word).to_be_bytes();
            *pixel = [r, g, b, 255];
        }
    }
}

/// Bezier curves of each run of a path, in pixels.
pub(super) fn curves<'a>(
    path: &PathRef<'a>,
    view: &'a View,
) -> impl Iterator<Item = impl Iterator<Item = [Point<f64>; 4]> + use<'a>> + use<'a> {
    path.runs().map(|run| {
        let segments = run.segments();
        segments.map(|segment| uniform::to_bezier(&segment).map(|p| view.pixel_from_world(p)))
    })
}
