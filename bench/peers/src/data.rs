//! Input of the renderers: a generated layout, and a view that shows all of it.

use std::sync::Arc;

use anyhow::{Result, bail};
use guideway_bench::Dataset;
use guideway_layout::Layout;
use guideway_scene::{Frame, FrameSize, View};

/// A layout of `paths` paths of the data set `d1` or `d2`.
pub(crate) fn layout(set: &str, paths: usize) -> Result<Arc<Layout>> {
    let set = match set {
        "d1" => Dataset::D1,
        "d2" => Dataset::D2,
        _ => bail!("unknown data set `{set}`; choose d1 or d2"),
    };
    Ok(Arc::new(set.layout(paths)))
}

/// A view of the whole layout at 1920 x 1080 pixels, and an empty frame of that size.
pub(crate) fn view(layout: &Layout) -> Result<(View, Frame)> {
    let size = FrameSize::new(1920, 1080)?;
    let view = View::fit(size, layout.paths.hull_bounds())?;
    Ok((view, Frame::new(size)))
}
