//! Arrow layout writer: writes the paths of a layout as a table with the columns that they need.

use std::path::Path;

use guideway_layout::{Attribute, Direction, Layout, PathRef, Value};
use guideway_spline::Point;

use super::column_names::{COLOR, CONTROL_POINTS, ID, LEVEL, PART, RANK, WIDTH};
use super::write::ArrowWriter;
use super::write_column::{Column, ColumnType, Precision};
use super::write_error::WriteError;
use crate::Losses;
use crate::common_losses::common_losses;

/// Largest error of coordinates stored in `f32`, in meters; beyond it `f64` is used.
const F32_ERROR_M: f64 = 1e-5;

/// Options of [`write_layout`].
#[derive(Clone, Debug, Default)]
pub struct WriteOptions {
    /// Storage type of coordinates; `None` for `f32` if its error is at most 0.01 mm, else `f64`.
    pub precision: Option<Precision>,
}

/// Writes a layout as a table of its paths. Returns the losses.
///
/// # Errors
/// When the file cannot be written.
pub fn write_layout(
    layout: &Layout,
    path: &Path,
    options: &WriteOptions,
) -> Result<Losses, WriteError> {
    let sources = sources(layout);
    let losses = list_losses(layout, &sources);
    let precision = options.precision.unwrap_or_else(|| precision_for(layout));
    let columns = sources.iter().map(Source::column).collect();
    let mut writer = ArrowWriter::create(path, precision, columns)?;
    let mut points: Vec<Point<f64>> = Vec::new();
    for path in layout.paths.iter() {
        for (part, run) in path.runs().enumerate() {
            points.clear();
            points.extend(run.iter());
            let texts: Vec<_> = sources
                .iter()
                .map(|s| s.value(layout, path, part))
                .collect();
            let values: Vec<_> = texts.iter().map(|v| v.as_ref().map(Cell::value)).collect();
            writer.push_run(path.id(), &points, &values)?;
        }
    }
    writer.finish()?;
    Ok(losses)
}

fn precision_for(layout: &Layout) -> Precision {
    let exact = |p: Point<f64>| {
        let error = p - p.to_f32().to_f64();
        error.x.abs().max(error.y.abs()) <= F32_ERROR_M
    };
    let mut runs = layout.paths.iter().flat_map(PathRef::runs);
    if runs.all(|run| run.iter().all(exact)) {
        Precision::F32
    } else {
        Precision::F64
    }
}

/// Source of the values of a column.
enum Source<'a> {
    Part,
    Level,
    Width(&'a [f32]),
    Color(&'a [u32]),
    Rank(&'a [i32]),
    StartNode,
    EndNode,
    Direction,
    VehicleTypes,
    Attribute(&'a Attribute),
}

/// A value, or a text composed for one.
enum Cell<'a> {
    Plain(Value<'a>),
    Text(String),
}

impl Cell<'_> {
    fn value(&self) -> Value<'_> {
        match self {
            Self::Plain(value) => *value,
            Self::Text(text) => Value::Text(text),
        }
    }
}

/// Returns the sources of the columns that are not empty.
fn sources(layout: &Layout) -> Vec<Source<'_>> {
    let paths = &layout.paths;
    let any = |test: &dyn Fn(PathRef<'_>) -> bool| paths.iter().any(test);
    let mut sources = Vec::new();
    let mut add = |needed: bool, source| {
        if needed {
            sources.push(source);
        }
    };
    add(any(&|p| p.runs().len() > 1), Source::Part);
    add(any(&|p| p.level().is_some()), Source::Level);
    let styles = [
        paths.width_m().map(Source::Width),
        paths.color_rgba().map(Source::Color),
        paths.rank().map(Source::Rank),
    ];
    for style in styles.into_iter().flatten() {
        add(true, style);
    }
    add(any(&|p| p.start_node().is_some()), Source::StartNode);
    add(any(&|p| p.end_node().is_some()), Source::EndNode);
    add(
        any(&|p| p.direction() != Direction::Forward),
        Source::Direction,
    );
    add(
        any(&|p| paths.vehicle_types().of(p.row()).len() > 0),
        Source::VehicleTypes,
    );
    for attribute in paths.attributes.iter() {
        let reserved = [ID, CONTROL_POINTS, PART, LEVEL, WIDTH, COLOR, RANK];
        let name = attribute.name.as_str();
        if !reserved.contains(&name) && sources.iter().all(|s| s.name() != name) {
            sources.push(Source::Attribute(attribute));
        }
    }
    sources
}

impl<'a> Source<'a> {
    fn name(&self) -> &'a str {
        match self {
            Self::Part => PART,
            Self::Level => LEVEL,
            Self::Width(_) => WIDTH,
            Self::Color(_) => COLOR,
            Self::Rank(_) => RANK,
            Self::StartNode => "start_node",
            Self::EndNode => "end_node",
            Self::Direction => "direction",
            Self::VehicleTypes => "vehicle_types",
            Self::Attribute(attribute) => &attribute.name,
        }
    }

    fn column(&self) -> Column {
        let column_type = match self {
            Self::Part | Self::Color(_) => ColumnType::UInt32,
            Self::Rank(_) => ColumnType::Int32,
            Self::Width(_) => ColumnType::Float32,
            Self::Attribute(attribute) => return Column::from_attribute(attribute),
            _ => ColumnType::Text,
        };
        Column::new(self.name(), column_type)
    }

    /// Returns the value of a path; rows that continue a path have only their part.
    fn value(&self, layout: &'a Layout, path: PathRef<'a>, part: usize) -> Option<Cell<'a>> {
        if let Self::Part = self {
            return Some(Cell::Plain(Value::Int(part as i64)));
        }
        if part > 0 {
            return None;
        }
        let row = path.row();
        let node = |node: Option<u32>| Some(Cell::Plain(Value::Text(layout.nodes.id(node?))));
        match self {
            Self::Part => None,
            Self::Level => {
                let level = layout.levels.get(path.level()? as usize)?;
                Some(Cell::Plain(Value::Text(&level.id)))
            }
            Self::Width(column) => {
                let width = column[row];
                (!width.is_nan()).then(|| Cell::Plain(Value::Float(width.into())))
            }
            Self::Color(column) => {
                (column[row] != 0).then(|| Cell::Plain(Value::Int(column[row].into())))
            }
            Self::Rank(column) => Some(Cell::Plain(Value::Int(column[row].into()))),
            Self::StartNode => node(path.start_node()),
            Self::EndNode => node(path.end_node()),
            Self::Direction => Some(Cell::Plain(Value::Text(match path.direction() {
                Direction::Forward => "forward",
                Direction::Both => "both",
            }))),
            Self::VehicleTypes => {
                let types: Vec<&str> = layout.paths.vehicle_types().of(row).collect();
                (!types.is_empty()).then(|| Cell::Text(types.join(", ")))
            }
            Self::Attribute(attribute) => attribute.values.get(row).map(Cell::Plain),
        }
    }
}

/// Lists the parts of a layout that a table of paths does not hold.
fn list_losses(layout: &Layout, sources: &[Source<'_>]) -> Losses {
    let mut losses = common_losses(layout);
    let detail = "nodes: only identifiers of start and end nodes are written";
    losses.add("nodes", layout.nodes.len(), detail);
    losses.add_stations(layout);
    let described = layout.levels.iter();
    let described = described.filter(|l| l.name.is_some() || l.elevation_m.is_some());
    let detail = "names or elevations of levels: only identifiers are written";
    losses.add("levels", described.count(), detail);
    // An attribute with the name of a column with a meaning is not a source.
    let is_held = |name: &str| {
        let is_source = |s: &Source<'_>| matches!(s, Source::Attribute(a) if a.name == name);
        sources.iter().any(is_source)
    };
    losses.add_columns(&layout.paths.attributes, "paths", is_held);
    let findings: u64 = layout.diagnostics.counts().map(|(_, n)| n).sum();
    losses.add(
        "diagnostics",
        findings as usize,
        "diagnostics of the reader",
    );
    losses
}
