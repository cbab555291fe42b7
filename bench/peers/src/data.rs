//! The layouts that are drawn.

use std::sync::Arc;

use anyhow::{Result, bail};
use guideway_bench::Dataset;
use guideway_layout::Layout;

/// So many paths of one of the data sets.
pub(crate) fn layout(set: &str, paths: usize) -> Result<Arc<Layout>> {
    let set = match set {
        "d1" => Dataset::D1,
        "d2" => Dataset::D2,
        _ => bail!("there is no data set {set}: d1 or d2"),
    };
    Ok(Arc::new(set.layout(paths)))
}
