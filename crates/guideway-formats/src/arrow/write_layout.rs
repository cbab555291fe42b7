//! Arrow layout writer: writes the elements of a layout, kind by kind, in a table with the columns
//! that they need.

use std::collections::HashMap;
use std::io::Write;

use arrow_schema::Schema;
use guideway_layout::{Direction, Layout, PathRef, Values};
use guideway_spline::Point;

use super::attribute_plan::has_values;
use super::column_names::{
    LATITUDE_KEY, LONGITUDE_KEY, NETWORK_VERSION, PATHS_VERSION, VERSION_KEY,
};
use super::element::Element;
use super::layout_columns::{has_unique_level_ids, sources};
use super::layout_rows::{Row, rows};
use super::schema::is_reserved;
use super::write_column::Precision;
use super::write_error::WriteProblem;
use super::write_file::{BATCH_POINTS, BATCH_ROWS, BATCH_TEXT_BYTES, IpcFile};
use crate::Losses;
use crate::finite::check_finite;

/// Largest distance by which `f32` may move a control point, in meters; beyond it `f64` is used.
const F32_ERROR_M: f64 = 1e-5;

/// Options of [`write_layout`].
#[derive(Clone, Debug, Default)]
pub struct WriteOptions {
    /// Storage type of control points; `None` for `f32` if its error is at most 0.01 mm, else
    /// `f64`.
    pub precision: Option<Precision>,
}

/// Writes a layout as a table: of version 1 if it has nothing but paths, else of version 2, which
/// holds all elements. Returns the losses, of which there are none.
///
/// # Errors
/// When the output fails.
pub fn write_layout(
    layout: &Layout,
    out: &mut impl Write,
    options: &WriteOptions,
) -> Result<Losses, WriteProblem> {
    check_finite(layout)?;
    let precision = options.precision.unwrap_or_else(|| precision_for(layout));
    write_table(layout, out, precision)?;
    Ok(Losses::default())
}

fn write_table(
    layout: &Layout,
    out: &mut impl Write,
    precision: Precision,
) -> Result<(), WriteProblem> {
    let version = version_for(layout);
    let sources = sources(layout, version, precision);
    let fields: Vec<_> = sources.iter().map(|s| s.field(version)).collect();
    let schema = Schema::new_with_metadata(fields, metadata(layout, version));
    let mut file = IpcFile::begin(out, schema)?;
    let kinds = match version {
        PATHS_VERSION => &[Element::Path][..],
        _ => &Element::ALL,
    };
    for &kind in kinds {
        let mut batch: Vec<Row> = Vec::new();
        let (mut points, mut text_bytes) = (0, 0);
        let mut all = rows(layout, kind).peekable();
        while let Some(row) = all.next() {
            batch.push(row);
            points += points_of(layout, kind, row);
            let text = sources.iter().map(|s| s.text_bytes(layout, kind, row));
            text_bytes += text.sum::<usize>();
            let is_full = batch.len() >= BATCH_ROWS
                || points >= BATCH_POINTS
                || text_bytes >= BATCH_TEXT_BYTES;
            if is_full || all.peek().is_none() {
                let arrays = sources.iter().map(|s| s.array(layout, kind, &batch));
                file.write(arrays.collect::<Result<_, _>>()?)?;
                batch.clear();
                (points, text_bytes) = (0, 0);
            }
        }
    }
    file.finish()?.flush()?;
    Ok(())
}

/// Returns the number of points, or of other items of lists, of a row.
fn points_of(layout: &Layout, kind: Element, row: Row) -> usize {
    match kind {
        Element::Path => {
            let path = layout.paths.get(row.index);
            let written = layout.paths.written_curve(row.index);
            let written = written.filter(|_| row.part == 0);
            let run = path.runs().nth(row.part).map_or(0, |run| run.len());
            run + written.map_or(0, |curve| curve.points_m.len() + curve.knots.len())
        }
        Element::Station => layout.stations.nodes(row.index as u32).len(),
        Element::Block => layout.blocks[row.index].members.len(),
        Element::Zone => layout.zones[row.index].outline_m.len(),
        _ => 0,
    }
}

fn metadata(layout: &Layout, version: u32) -> HashMap<String, String> {
    let mut metadata = HashMap::from([(VERSION_KEY.to_owned(), version.to_string())]);
    if let Some(origin) = layout.geo_origin {
        metadata.insert(LONGITUDE_KEY.to_owned(), origin.longitude_deg.to_string());
        metadata.insert(LATITUDE_KEY.to_owned(), origin.latitude_deg.to_string());
    }
    metadata
}

fn precision_for(layout: &Layout) -> Precision {
    let exact = |p: Point<f64>| p.distance(p.to_f32().to_f64()) <= F32_ERROR_M;
    let mut runs = layout.paths.iter().flat_map(PathRef::runs);
    if runs.all(|run| run.iter().all(exact)) {
        Precision::F32
    } else {
        Precision::F64
    }
}

/// Returns the oldest version that holds the whole layout.
fn version_for(layout: &Layout) -> u32 {
    let has_elements = !layout.nodes.is_empty()
        || !layout.stations.is_empty()
        || !layout.vehicle_types.is_empty()
        || !layout.blocks.is_empty()
        || !layout.zones.is_empty()
        || !layout.refused.is_empty()
        || layout.attributes.iter().any(has_values)
        || layout.geo_origin.is_some();
    let paths = &layout.paths;
    let types = paths.vehicle_types();
    let is_plain = |path: PathRef<'_>| {
        path.runs().len() > 0
            && path.start_node().is_none()
            && path.end_node().is_none()
            && path.direction() == Direction::Forward
            && types.of(path.row()).len() == 0
    };
    let mut columns = paths.attributes.iter();
    let has_typed = columns.any(|column| {
        is_reserved(&column.name, PATHS_VERSION)
            || column.quantity.is_some()
            || matches!(column.values, Values::Json(_))
    });
    let is_paths_only = !has_elements
        && !has_typed
        && paths.written_curves().is_empty()
        && paths.iter().all(is_plain)
        && has_levels_of_paths(layout);
    if is_paths_only {
        PATHS_VERSION
    } else {
        NETWORK_VERSION
    }
}

/// Returns whether the levels are those that the identifiers of the paths' levels give.
fn has_levels_of_paths(layout: &Layout) -> bool {
    let mut seen = 0;
    for level in layout.paths.iter().filter_map(PathRef::level) {
        if level > seen {
            return false;
        }
        seen = seen.max(level + 1);
    }
    let is_plain = |level: &guideway_layout::Level| {
        level.name.is_none() && level.elevation_m.is_none() && level.attributes.is_empty()
    };
    seen as usize == layout.levels.len()
        && has_unique_level_ids(layout)
        && layout.levels.iter().all(is_plain)
}
