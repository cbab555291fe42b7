//! The picture of a comparison: removed, new and changed paths in colors over the others in gray.

use std::collections::BTreeSet;
use std::sync::Arc;

use guideway::compose::{Decorations, Picture};
use guideway::layout::{Change, Changes, ElementKind, Layout, UserError, merge};
use guideway::scene::{FrameSize, LineRule, Scene, SceneOptions};

use crate::cli::output::Output;
use crate::cli::picture_file::OTHER_PATHS;
use crate::cli::picture_output::PictureOutput;

/// Colors as RRGGBBAA, of increasing draw rank.
const OLD_SHAPE: u32 = 0xf2b2_b2ff;
const CHANGED: u32 = 0x1f6f_d6ff;
const ADDED: u32 = 0x2a9d_3aff;
const REMOVED: u32 = 0xd627_28ff;

const TITLE: &str =
    "red: removed, green: new, blue: changed (old shape in pale red), gray: as before";

/// Draws the changes of paths.
pub(super) fn write(
    [old, new]: [&Layout; 2],
    found: &Changes<'_>,
    output: &PictureOutput<'_>,
    out: &Output,
) -> Result<(), UserError> {
    let progress = out.progress("drawing");
    let layout = colored([old, new], found);
    let options = SceneOptions::default();
    let scene = Arc::new(Scene::new(Arc::new(layout), &options)?);
    let mut picture = Picture::new(scene, FrameSize::new(1920, 1080)?);
    picture.style.line_rule = LineRule::World {
        width_m: 0.1,
        min_px: 2.0,
        max_px: 8.0,
    };
    picture.decorations = Decorations {
        has_scale_bar: true,
        has_nodes: true,
        has_stations: true,
        title: Some(TITLE.to_owned()),
        ..Decorations::default()
    };
    output.write(&picture, &progress)?;
    Ok(())
}

/// The new layout and the old paths that are gone or had another shape, with colors and ranks.
fn colored([old, new]: [&Layout; 2], found: &Changes<'_>) -> Layout {
    let mut of_new = vec![(OTHER_PATHS, 0); new.paths.len()];
    let mut of_old = BTreeSet::new();
    let mut removed = BTreeSet::new();
    for of in found
        .elements
        .iter()
        .filter(|of| of.element == ElementKind::Path)
    {
        let (old_row, new_row) = (of.old_row(), of.new_row().map(|row| row as usize));
        match (of.change, old_row, new_row) {
            (Change::Removed, Some(row), _) => {
                of_old.insert(row as usize);
                removed.insert(row as usize);
            }
            (Change::Added, _, Some(row)) => of_new[row] = (ADDED, 3),
            (change, Some(old_row), Some(row)) => {
                of_new[row] = (CHANGED, 2);
                if matches!(change, Change::Moved { .. } | Change::Reshaped { .. }) {
                    of_old.insert(old_row as usize);
                }
            }
            _ => {}
        }
    }
    let rows: Vec<usize> = of_old.into_iter().collect();
    let of_rows = rows.iter().map(|row| match removed.contains(row) {
        true => (REMOVED, 4),
        false => (OLD_SHAPE, 1),
    });
    let of_rows: Vec<(u32, i32)> = of_rows.collect();
    let mut before = Layout {
        paths: old.paths.select(&rows, |_| None),
        levels: old.levels.clone(),
        ..Layout::default()
    };
    let mut after = new.clone();
    for (layout, styles) in [(&mut before, &of_rows), (&mut after, &of_new)] {
        let (colors, ranks) = styles.iter().copied().unzip();
        layout.paths.set_color_rgba(colors);
        layout.paths.set_rank(ranks);
    }
    merge(vec![before, after])
}
