//! The renderers, one per module. Each draws several frames of a layout and returns their times in
//! milliseconds.
//!
//! Peers of Guideway draw path by path in draw order, as a picture with many colors requires.

#[cfg(feature = "blend2d")]
mod blend2d;
#[cfg(feature = "cairo")]
mod cairo;
mod ours;
#[cfg(feature = "python")]
mod python;
mod shared;
mod tiny_skia;
mod vello;

use std::sync::Arc;

use anyhow::{Result, bail};
use guideway_layout::Layout;
use guideway_scene::{Frame, View};

pub(crate) use ours::oracle;

/// Draws frames of a layout; the last one stays in the `Frame`. Returns their times in
/// milliseconds.
type Draw = fn(&Arc<Layout>, &View, &mut Frame) -> Result<Vec<f64>>;

/// All renderers by name, Guideway first.
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

/// Returns `true` if a renderer runs in another process, whose memory is not measured.
pub(crate) fn is_external(method: &str) -> bool {
    method == "skia"
}

/// Draws frames with the named renderer and returns their times in milliseconds.
pub(crate) fn draw(
    method: &str,
    layout: &Arc<Layout>,
    view: &View,
    frame: &mut Frame,
) -> Result<Vec<f64>> {
    match METHODS.iter().find(|(name, _)| *name == method) {
        Some((_, draw)) => draw(layout, view, frame),
        None => bail!("unknown method `{method}`"),
    }
}
