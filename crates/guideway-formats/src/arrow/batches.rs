//! Record batches of a layout: the rows of its elements, kind by kind, in a table with the columns
//! that they need.

use std::collections::HashMap;
use std::iter::{self, Peekable};
use std::slice;

use arrow_array::{RecordBatch, RecordBatchIterator, RecordBatchReader};
use arrow_schema::{ArrowError, Schema, SchemaRef};
use guideway_layout::{Direction, Layout, Level, PathRef, Values};
use guideway_spline::Point;

use super::attribute_plan::has_values;
use super::column_names::{
    LATITUDE_KEY, LONGITUDE_KEY, NETWORK_VERSION, PATHS_VERSION, VERSION_KEY,
};
use super::element::Element;
use super::layout_columns::{Source, has_unique_level_ids, sources};
use super::layout_rows::{Row, rows};
use super::schema::is_reserved;
use super::write_column::Precision;
use super::write_file::{BATCH_POINTS, BATCH_ROWS, BATCH_TEXT_BYTES};
use crate::finite::check_finite;
use crate::source::WrittenPaths;
use crate::write_error::WriteProblem;

/// Paths per cluster of an index: see `guideway_scene::cluster`.
const CLUSTER_PATHS: usize = 64;
/// Rows per record batch of a layout in Hilbert order. Measured on D1 of two million paths: a view
/// of 1 % of its square meets 2.0 % of the batches, of 4.4 % with [`BATCH_ROWS`], and reading all
/// takes as long.
const ORDERED_BATCH_ROWS: usize = 2048;

/// Returns a layout as record batches, which hold all of it: of version 1 of the table if it has
/// nothing but paths, else of version 2.
///
/// Control points are `f32` if that is exact, else `f64`. Rows are runs of paths and other
/// elements: see `docs/arrow-format.md`. [`read_batches`](super::read_batches) is the inverse.
///
/// ```
/// use guideway_formats::ReadOptions;
/// use guideway_formats::arrow::{batches, read_batches};
///
/// let layout = guideway_layout::Layout::default();
/// let again = read_batches(batches(&layout)?, &ReadOptions::default())?;
/// assert_eq!(again.paths.len(), layout.paths.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// When a number of the layout is not finite.
pub fn batches(layout: &Layout) -> Result<Batches<'_>, WriteProblem> {
    check_finite(layout)?;
    Ok(Batches::new(layout, Precision::exact(layout)))
}

/// Returns all [`batches`] of a layout at once, for a reader that outlives the layout.
///
/// # Errors
/// See [`batches`].
pub fn collected_batches(
    layout: &Layout,
) -> Result<impl RecordBatchReader + Send + use<>, WriteProblem> {
    let mut batches = batches(layout)?;
    let unwatched = WrittenPaths::unwatched();
    let all = iter::from_fn(|| batches.next_batch(&unwatched));
    let all: Vec<_> = all.map(|batch| batch.map(Ok)).collect::<Result<_, _>>()?;
    Ok(RecordBatchIterator::new(all, batches.schema()))
}

/// The record batches of a layout, made one by one.
pub struct Batches<'a> {
    layout: &'a Layout,
    schema: SchemaRef,
    sources: Vec<Source<'a>>,
    /// Kinds that follow.
    kinds: slice::Iter<'a, Element>,
    kind: Element,
    /// Rows of the kind that follow.
    rows: Peekable<Box<dyn Iterator<Item = Row> + 'a>>,
}

impl<'a> Batches<'a> {
    pub(super) fn new(layout: &'a Layout, precision: Precision) -> Self {
        let version = version_for(layout);
        let sources = sources(layout, version, precision);
        let fields: Vec<_> = sources.iter().map(|s| s.field(version)).collect();
        let mut kinds = match version {
            PATHS_VERSION => &[Element::Path][..],
            _ => &Element::ALL,
        }
        .iter();
        let kind = kinds.next().copied().unwrap_or(Element::Path);
        Self {
            layout,
            schema: Schema::new_with_metadata(fields, metadata(layout, version)).into(),
            sources,
            kinds,
            kind,
            rows: rows(layout, kind).peekable(),
        }
    }

    /// Returns the next batch, rows of one kind, and counts its paths.
    pub(super) fn next_batch(
        &mut self,
        written_paths: &WrittenPaths<'_>,
    ) -> Option<Result<RecordBatch, WriteProblem>> {
        while self.rows.peek().is_none() {
            self.kind = *self.kinds.next()?;
            self.rows = rows(self.layout, self.kind).peekable();
        }
        let (layout, kind) = (self.layout, self.kind);
        let mut batch: Vec<Row> = Vec::new();
        let (mut points, mut text_bytes) = (0, 0);
        let is_ordered = layout.paths.is_hilbert_ordered();
        let most_rows = match is_ordered {
            true => ORDERED_BATCH_ROWS,
            false => BATCH_ROWS,
        };
        while let Some(row) = self.rows.next() {
            if kind == Element::Path && row.part == 0 {
                written_paths.count();
            }
            batch.push(row);
            points += points_of(layout, kind, row);
            let text = self.sources.iter().map(|s| s.text_bytes(layout, kind, row));
            text_bytes += text.sum::<usize>();
            // Whole clusters of paths in order, so that a part of a file has those of all of it.
            let ends_cluster = |next: Option<&Row>| {
                next.is_none_or(|next| next.part == 0 && next.index % CLUSTER_PATHS == 0)
            };
            let may_end = kind != Element::Path || !is_ordered || ends_cluster(self.rows.peek());
            let is_full = (batch.len() >= most_rows && may_end)
                || points >= BATCH_POINTS
                || text_bytes >= BATCH_TEXT_BYTES;
            if is_full {
                break;
            }
        }
        Some(self.batch(&batch))
    }

    fn batch(&self, rows: &[Row]) -> Result<RecordBatch, WriteProblem> {
        let arrays = self.sources.iter();
        let arrays = arrays.map(|source| source.array(self.layout, self.kind, rows));
        let arrays = arrays.collect::<Result<_, _>>()?;
        Ok(RecordBatch::try_new(self.schema.clone(), arrays)?)
    }
}

impl Iterator for Batches<'_> {
    type Item = Result<RecordBatch, ArrowError>;

    fn next(&mut self) -> Option<Self::Item> {
        let batch = self.next_batch(&WrittenPaths::unwatched())?;
        Some(batch.map_err(|problem| ArrowError::ExternalError(problem.into())))
    }
}

impl RecordBatchReader for Batches<'_> {
    fn schema(&self) -> SchemaRef {
        self.schema.clone()
    }
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

impl Precision {
    /// The smallest storage type that keeps every digit of the control points of a layout.
    pub fn exact(layout: &Layout) -> Self {
        precision_within(layout, 0.0)
    }
}

/// Returns `f32` if it moves no control point by more than a distance.
pub(super) fn precision_within(layout: &Layout, error_m: f64) -> Precision {
    let exact = |p: Point<f64>| p.distance(p.to_f32().to_f64()) <= error_m;
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
    let is_plain = |level: &Level| {
        level.name.is_none() && level.elevation_m.is_none() && level.attributes.is_empty()
    };
    seen as usize == layout.levels.len()
        && has_unique_level_ids(layout)
        && layout.levels.iter().all(is_plain)
}
