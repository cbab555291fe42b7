//! One module a renderer. Each draws a few frames and gives the time of each in milliseconds.
//!
//! Others than ours draw a path at a time, in draw order, as a picture of many colors needs.

#[cfg(feature = "blend2d")]
mod blend2d;
#[cfg(feature = "cairo")]
mod cairo;
mod ours;
#[cfg(feature = "python")]
mod python;
mod tiny_skia;
mod vello;

use std::sync::Arc;
use std::time::Instant;

use anyhow::{Result, bail};
use guideway_layout::{Layout, PathRef};
use guideway_scene::{Frame, View, elapsed_ms};
use guideway_spline::{Point, uniform};

pub(crate) use ours::oracle;

/// How wide all paths are.
const WIDTH_PX: f64 = 3.0;
/// Frames of ours: there and back of a zoom. And of the others, which take seconds.
const OWN_FRAMES: usize = 65;
const FRAMES: usize = 3;

type Draw = fn(&Arc<Layout>, &View, &mut Frame) -> Result<Vec<f64>>;

/// Ours first.
pub(crate) const METHODS: &[(&str, Draw)] = &[
    ("cpu", ours::draw),
    ("tiny-skia", tiny_skia::draw),
    ("tiny-skia-kept", tiny_skia::draw_kept),
    ("vello_cpu", vello::draw),
    ("vello_cpu-threads", vello::draw_threaded),
    #[cfg(feature = "cairo")]
    ("cairo", cairo::draw),
    #[cfg(feature = "python")]
    ("skia", python::skia),
    #[cfg(feature = "blend2d")]
    ("blend2d", blend2d::draw::<0, false>),
    #[cfg(feature = "blend2d")]
    ("blend2d-kept", blend2d::draw::<0, true>),
    #[cfg(feature = "blend2d")]
    ("blend2d-threads", blend2d::draw::<2, false>),
    #[cfg(feature = "blend2d")]
    ("blend2d-kept-threads", blend2d::draw::<2, true>),
];

/// Whether a renderer draws in a process of its own: the memory of this one says nothing of it.
pub(crate) fn is_elsewhere(method: &str) -> bool {
    method == "skia"
}

pub(crate) fn draw(
    method: &str,
    layout: &Arc<Layout>,
    view: &View,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    match METHODS.iter().find(|(name, _)| *name == method) {
        Some((_, draw)) => draw(layout, view, frame),
        None => bail!("there is no method {method}"),
    }
}

/// Times of the frames that `draw` makes.
fn time(frames: usize, mut draw: impl FnMut(usize) -> Result<()>) -> Result<Vec<f64>> {
    let frame = |frame| {
        let start = Instant::now();
        draw(frame)?;
        Ok(elapsed_ms(start))
    };
    (0..frames).map(frame).collect()
}

/// Stores rows of words, which hold red, green and blue below their highest byte.
#[cfg(any(feature = "blend2d", feature = "cairo"))]
fn store_words(bytes: &[u8], stride: usize, width: usize, frame: &mut Frame) {
    let rows = frame.pixels_mut().chunks_exact_mut(width);
    for (pixels, row) in rows.zip(bytes.chunks_exact(stride)) {
        let (words, _) = row.as_chunks();
        for (pixel, word) in pixels.iter_mut().zip(words) {
            let [_, r, g, b] = u32::from_ne_bytes(*word).to_be_bytes();
            *pixel = [r, g, b, 255];
        }
    }
}

/// The segments of each run of a path as Bezier curves in pixels.
fn curves<'a>(
    path: &PathRef<'a>,
    view: &'a View,
) -> impl Iterator<Item = impl Iterator<Item = [Point<f64>; 4]> + use<'a>> + use<'a> {
    path.runs().map(|run| {
        let segments = run.segments();
        segments.map(|segment| uniform::to_bezier(&segment).map(|p| view.pixel_from_world(p)))
    })
}
