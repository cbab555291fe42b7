//! The layouts that are drawn.

use std::sync::Arc;

use anyhow::{Result, bail};
use guideway_datasets::{GeneratedPath, RUN_POINTS, d1, d2};
use guideway_layout::{Geometry, Layout, Paths, TextColumn};

const SEED: u64 = 1;

/// So many paths of one of the data sets.
pub(crate) fn layout(set: &str, paths: usize) -> Result<Arc<Layout>> {
    Ok(Arc::new(match set {
        "d1" => collect(d1(paths, SEED)),
        "d2" => collect(d2(paths, SEED)),
        _ => bail!("there is no data set {set}: d1 or d2"),
    }))
}

fn collect(paths: impl Iterator<Item = GeneratedPath>) -> Layout {
    let (mut ids, mut points, mut ends) = (TextColumn::default(), Vec::new(), Vec::new());
    for path in paths {
        ids.push(&path.id);
        points.extend_from_slice(&path.run);
        ends.push((ids.len() * RUN_POINTS) as u32);
    }
    Layout {
        paths: Paths::from_columns(ids, Geometry::from_f32(points, ends)),
        ..Layout::default()
    }
}
