//! Maps the paths of a plant model: connection type and control points in, curve and columns out.

use std::collections::HashMap;

use guideway_layout::{Code, Direction, NewPath, Value};
use guideway_spline::{Point, Runs, polyline_to_runs};
use roxmltree::Node;

use super::envelope::set_envelopes;
use super::reader::{PlantReader, name_or_empty, quoted};
use super::visual_layout::VisualLayout;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::{child, children};

/// Connection types counted by name; openTCS knows seven.
const MAX_CONNECTION_TYPES: usize = 16;

/// Blocks named per path; bounds the text of a hostile file.
const MAX_BLOCKS: usize = 16;

/// The drawn shape of a path.
struct Shape {
    /// Connection type, in upper case.
    kind: String,
    /// Control points, in meters.
    control: Vec<Point<f64>>,
}

/// Counts for the provenance.
#[derive(Default)]
pub(super) struct PathCounts {
    /// Number of paths per connection type.
    pub(super) connection_types: Vec<(String, u64)>,
    pub(super) control_points: u64,
}

/// Maps paths between known points.
pub(super) struct PathMapper<'m, 'a, 'd, 't> {
    reader: &'m mut PlantReader<'a, 'd, 't>,
    visual: &'m VisualLayout<'d>,
    /// Row per point name.
    nodes: &'m HashMap<&'d str, u32>,
    /// Block names per path name.
    blocks: &'m HashMap<&'d str, Vec<&'d str>>,
    counts: PathCounts,
}

impl<'m, 'a, 'd, 't> PathMapper<'m, 'a, 'd, 't> {
    pub(super) fn new(
        reader: &'m mut PlantReader<'a, 'd, 't>,
        visual: &'m VisualLayout<'d>,
        nodes: &'m HashMap<&'d str, u32>,
        blocks: &'m HashMap<&'d str, Vec<&'d str>>,
    ) -> Self {
        Self {
            reader,
            visual,
            nodes,
            blocks,
            counts: PathCounts::default(),
        }
    }

    /// The counts of all mapped paths.
    pub(super) fn into_counts(self) -> PathCounts {
        self.counts
    }

    /// Appends a path, or records it as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn map_path(&mut self, path: Node<'d, 't>) -> Result<(), ReadError> {
        let name = self.reader.name(path)?;
        let shape = self.read_shape(path)?;
        self.count_shape(&shape);
        let ends = ["sourcePoint", "destinationPoint"].map(|key| {
            let point = path.attribute(key).unwrap_or_default();
            (point, self.nodes.get(point).copied())
        });
        let [(_, Some(start)), (_, Some(end))] = ends else {
            let missing: Vec<&str> = ends.iter().filter(|e| e.1.is_none()).map(|e| e.0).collect();
            for point in &missing {
                self.reader.report_unknown_point(path, point);
            }
            let detail = format!(
                "the point \"{}\" does not exist or has no position",
                missing.join("\" and \"")
            );
            self.reader.base.builder.check_text(&detail)?;
            return self
                .reader
                .base
                .builder
                .refuse(&name, Code::UnknownNode, &detail);
        };
        let nodes = &self.reader.base.builder.layout.nodes;
        let (from, to) = (nodes.position_m(start), nodes.position_m(end));
        let mut runs = Runs::default();
        self.append_curve(path, &shape, [from, to], &mut runs);
        let reverse = self.reader.number(path, &["maxReverseVelocity"]);
        let row = self.reader.base.builder.push_path(&NewPath {
            id: &name,
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            direction: match reverse {
                Some(speed) if speed > 0.0 => Direction::Both,
                _ => Direction::Forward,
            },
            ..NewPath::default()
        })?;
        self.set_path_attributes(row, path, &shape)
    }

    fn read_shape(&mut self, path: Node<'d, 't>) -> Result<Shape, ReadError> {
        let mut control = Vec::new();
        let kind = if let Some(layout) = child(path, "pathLayout") {
            for point in children(layout, "controlPoint") {
                let x = self.reader.number(point, &["x"]);
                let y = self.reader.number(point, &["y"]);
                self.push_control(path, x, y, &mut control);
            }
            layout.attribute("connectionType")
        } else {
            let legacy = self.visual.legacy_element(name_or_empty(path));
            let text = legacy.and_then(|d| d.control_points);
            for pair in text
                .unwrap_or_default()
                .split(';')
                .filter(|p| !p.trim().is_empty())
            {
                let (x, y) = pair.split_once(',').unwrap_or((pair, ""));
                let x = self.reader.parse_number(path, "CONTROL_POINTS", x);
                let y = self.reader.parse_number(path, "CONTROL_POINTS", y);
                self.push_control(path, x, y, &mut control);
            }
            legacy.and_then(|d| d.connection_type)
        };
        self.reader.base.builder.check_curve_points(control.len())?;
        let kind = kind.unwrap_or("DIRECT").trim();
        self.reader.base.builder.check_text(kind)?;
        // openTCS 2.7 wrote "Bezier".
        let kind = kind.to_ascii_uppercase();
        Ok(Shape { kind, control })
    }

    fn push_control(
        &mut self,
        path: Node<'d, 't>,
        x: Option<f64>,
        y: Option<f64>,
        control: &mut Vec<Point<f64>>,
    ) {
        self.counts.control_points += 1;
        let (Some(x), Some(y)) = (x, y) else {
            let message = || "a control point lacks a coordinate".to_owned();
            let remedy = "The control point is left out; correct the file";
            self.reader
                .base
                .report(Code::MissingField, path, message, remedy);
            return;
        };
        let point = self.visual.to_meters(Point::new(x, y));
        if self.reader.base.check_point(point, path) {
            control.push(point);
        }
    }

    fn count_shape(&mut self, shape: &Shape) {
        let types = &mut self.counts.connection_types;
        match types.iter().position(|(kind, _)| *kind == shape.kind) {
            Some(known) => types[known].1 += 1,
            None if types.len() < MAX_CONNECTION_TYPES => types.push((shape.kind.clone(), 1)),
            None => {}
        }
    }

    /// Appends the curve of a shape. Reports a finding where a polyline replaces it.
    fn append_curve(
        &mut self,
        path: Node<'d, 't>,
        shape: &Shape,
        [start, end]: [Point<f64>; 2],
        runs: &mut Runs,
    ) {
        let control = shape.control.as_slice();
        match (shape.kind.as_str(), control) {
            ("DIRECT", _) => runs.push_line(start, end),
            ("ELBOW" | "SLANTED", _) => {
                let kind = &shape.kind;
                let message = || format!("the file does not store the bends of type {kind}");
                let remedy = "A straight line is drawn";
                self.reader
                    .base
                    .report(Code::ApproximateShape, path, message, remedy);
                runs.push_line(start, end);
            }
            // The editor writes one point if both inner control points coincide.
            ("BEZIER", &[handle]) => runs.push_bezier(&[start, handle, handle, end]),
            ("BEZIER", &[first, second]) => runs.push_bezier(&[start, first, second, end]),
            ("BEZIER_3", &[a, b, middle, c, d]) => {
                runs.push_bezier(&[start, a, b, middle]);
                runs.push_bezier(&[middle, c, d, end]);
            }
            (kind, _) => {
                match kind {
                    "POLYPATH" => {}
                    "BEZIER" => self.report_point_count(path, "one or two", control.len()),
                    "BEZIER_3" => self.report_point_count(path, "five", control.len()),
                    _ => self.report_unknown_kind(path, kind),
                }
                let points: Vec<_> = [start].into_iter().chain(control.iter().copied()).collect();
                polyline_to_runs(&[points.as_slice(), &[end]].concat(), runs);
            }
        }
    }

    fn report_point_count(&mut self, path: Node<'d, 't>, expected: &str, actual: usize) {
        let message = || format!("{actual} control points, expected {expected}");
        let remedy = "Straight lines are drawn through them; draw the path again in the editor";
        self.reader
            .base
            .report(Code::TooFewPoints, path, message, remedy);
    }

    fn report_unknown_kind(&mut self, path: Node<'d, 't>, kind: &str) {
        let message = || format!("unknown connection type \"{}\"", quoted(kind));
        let remedy = "Straight lines are drawn through its control points";
        self.reader
            .base
            .report(Code::UnknownValue, path, message, remedy);
    }

    fn set_path_attributes(
        &mut self,
        row: usize,
        path: Node<'d, 't>,
        shape: &Shape,
    ) -> Result<(), ReadError> {
        for key in ["length", "maxVelocity", "maxReverseVelocity"] {
            let Some(text) = path.attribute(key) else {
                continue;
            };
            // Usually integers; early versions may contain fractions.
            let value = match text.trim().parse() {
                Ok(int) => Some(Value::Int(int)),
                Err(_) => self.reader.parse_number(path, key, text).map(Value::Float),
            };
            if let Some(value) = value {
                self.reader
                    .base
                    .builder
                    .set(Table::Paths, row, key, value)?;
            }
        }
        let reader = &mut *self.reader;
        reader.set_bool(Table::Paths, row, "locked", path)?;
        reader.set_text(Table::Paths, row, "connectionType", Some(&shape.kind))?;
        let layer = child(path, "pathLayout").and_then(|l| l.attribute("layerId"));
        let layer = layer.map(|id| self.visual.layer_name(id));
        reader.set_text(Table::Paths, row, "layer", layer)?;
        let blocks = self.blocks.get(name_or_empty(path));
        let blocks = blocks.map(|names| names[..names.len().min(MAX_BLOCKS)].join(", "));
        reader.set_text(Table::Paths, row, "block", blocks.as_deref())?;
        set_envelopes(reader, Table::Paths, row, path)?;
        reader.set_properties(Table::Paths, row, path)
    }
}
