//! Maps the paths of a plant model: connection type and control points in, curve and columns out.

use std::collections::HashMap;

use guideway_layout::{Code, Direction, NewPath, Value};
use guideway_spline::{Point, Runs, polyline_to_runs};
use roxmltree::Node;
use serde_json::Value as Json;

use super::elements::PERIPHERAL_OPERATION;
use super::envelope::{KEY_COLUMN, set_envelopes};
use super::reader::{Known, PlantReader, name_or_empty, quoted};
use super::shape::{Connection, beziers_of};
use super::visual_layout::VisualLayout;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::{child, children};

/// Connection types counted by name; openTCS knows seven.
const MAX_CONNECTION_TYPES: usize = 16;

/// Column of paths that lead from their end to their start in the file, because they are driven
/// against its direction only.
pub(super) const REVERSED: &str = "reversed";

/// Columns of paths that only openTCS has.
pub(super) const CONNECTION_TYPE: &str = "connectionType";
pub(super) const PERIPHERAL_OPERATIONS: &str = "peripheralOperations";

/// Cost of a path in files of version 0.0.2.
const ROUTING_COST: &str = "routingCost";

const PATH: Known = Known {
    attributes: &[
        "name",
        "sourcePoint",
        "destinationPoint",
        "length",
        "maxVelocity",
        "maxReverseVelocity",
        "locked",
        ROUTING_COST,
    ],
    children: &["peripheralOperation", KEY_COLUMN, "property", "pathLayout"],
};

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

/// The speeds of a path in the file, in mm/s.
#[derive(Clone, Copy)]
struct Speeds {
    forward: Option<f64>,
    reverse: Option<f64>,
}

impl Speeds {
    /// Tells if the path is driven from its end to its start only.
    fn is_reversed(self) -> bool {
        self.forward == Some(0.0) && self.reverse.is_some_and(|speed| speed > 0.0)
    }

    fn direction(self) -> Direction {
        match self.reverse {
            Some(reverse) if reverse > 0.0 && !self.is_reversed() => Direction::Both,
            _ => Direction::Forward,
        }
    }
}

/// Maps paths between known points.
pub(super) struct PathMapper<'m, 'a, 'd, 't> {
    reader: &'m mut PlantReader<'a, 'd, 't>,
    visual: &'m VisualLayout<'d, 't>,
    /// Row per point name.
    nodes: &'m HashMap<&'d str, u32>,
    /// Row per path name.
    rows: HashMap<&'d str, u32>,
    counts: PathCounts,
}

impl<'m, 'a, 'd, 't> PathMapper<'m, 'a, 'd, 't> {
    pub(super) fn new(
        reader: &'m mut PlantReader<'a, 'd, 't>,
        visual: &'m VisualLayout<'d, 't>,
        nodes: &'m HashMap<&'d str, u32>,
    ) -> Self {
        Self {
            reader,
            visual,
            nodes,
            rows: HashMap::new(),
            counts: PathCounts::default(),
        }
    }

    /// The rows of all mapped paths by name, and their counts.
    pub(super) fn finish(self) -> (HashMap<&'d str, u32>, PathCounts) {
        (self.rows, self.counts)
    }

    /// Appends a path, or records it as refused, with a finding.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn map_path(&mut self, path: Node<'d, 't>) -> Result<(), ReadError> {
        self.reader.begin();
        let name = self.reader.name(path)?;
        let shape = self.read_shape(path)?;
        self.count_shape(&shape);
        let ends = ["sourcePoint", "destinationPoint"].map(|key| {
            let point = path.attribute(key).unwrap_or_default();
            (point, self.nodes.get(point).copied())
        });
        let [(_, Some(start)), (_, Some(end))] = ends else {
            let missing: Vec<&str> = ends.iter().filter(|e| e.1.is_none()).map(|e| e.0).collect();
            let detail = match &missing[..] {
                [point] => format!("the point \"{point}\" does not exist or has no position"),
                points => format!(
                    "the points \"{}\" do not exist or have no position",
                    points.join("\" and \"")
                ),
            };
            self.reader.base.builder.check_text(&detail)?;
            let remedy = "It is left out; add the point, or correct the name";
            let base = &mut self.reader.base;
            return base.refuse(&name, Code::UnknownNode, path, &detail, remedy);
        };
        let element = name_or_empty(path);
        if let Some(layer) = self.visual.hidden_layer(element, child(path, "pathLayout")) {
            let detail = format!("its layer `{layer}` is hidden");
            let remedy = "Show the layer in the model editor to draw its paths";
            let base = &mut self.reader.base;
            return base.refuse(&name, Code::NotDrawn, path, &detail, remedy);
        }
        let nodes = &self.reader.base.builder.layout.nodes;
        let (from, to) = (nodes.position_m(start), nodes.position_m(end));
        let mut runs = Runs::default();
        self.append_curve(path, &shape, [from, to], &mut runs);
        let speeds = Speeds {
            forward: self.reader.magnitude(path, "maxVelocity"),
            reverse: self.reader.magnitude(path, "maxReverseVelocity"),
        };
        let mut ends = [Some(start), Some(end)];
        if speeds.is_reversed() {
            ends.reverse();
            runs = runs.reversed();
        }
        let row = self.reader.base.push_path(
            path,
            &NewPath {
                id: &name,
                runs: &runs,
                start_node: ends[0],
                end_node: ends[1],
                direction: speeds.direction(),
                ..NewPath::default()
            },
        )?;
        if let Some(name) = path.attribute("name") {
            self.rows.entry(name).or_insert(row as u32);
        }
        self.set_speeds(row, speeds)?;
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

    /// Stores the speeds: that of the driven direction, and for the other one a different speed.
    fn set_speeds(&mut self, row: usize, speeds: Speeds) -> Result<(), ReadError> {
        let reader = &mut *self.reader;
        if speeds.is_reversed() {
            let builder = &mut reader.base.builder;
            builder.set(Table::Paths, row, REVERSED, Value::Bool(true))?;
            return reader.set_field(Table::Paths, row, "maxVelocity", speeds.reverse);
        }
        reader.set_field(Table::Paths, row, "maxVelocity", speeds.forward)?;
        let is_other = speeds.direction() == Direction::Both && speeds.reverse != speeds.forward;
        let reverse = speeds.reverse.filter(|_| is_other);
        reader.set_field(Table::Paths, row, "maxReverseVelocity", reverse)
    }

    fn set_path_attributes(
        &mut self,
        row: usize,
        path: Node<'d, 't>,
        shape: &Shape,
    ) -> Result<(), ReadError> {
        let reader = &mut *self.reader;
        let table = Table::Paths;
        let length = reader.magnitude(path, "length");
        reader.set_field(table, row, "length", length)?;
        reader.set_locked(table, row, path)?;
        let curve = beziers_of(reader.base.builder.layout.paths.get(row));
        let of_curve = Connection::of_curve(&curve).map(Connection::name);
        let stated = Some(shape.kind.as_str()).filter(|kind| Some(*kind) != of_curve);
        reader.set_text(table, row, CONNECTION_TYPE, stated)?;
        if matches!(shape.kind.as_str(), "DIRECT" | "ELBOW" | "SLANTED") {
            for point in child(path, "pathLayout")
                .into_iter()
                .flat_map(|l| l.children())
            {
                if point.is_element() {
                    reader.keep("controlPoint", super::elements::ANY.to_json(point).into());
                }
            }
        }
        reader.set_int(table, row, ROUTING_COST, (path.attribute(ROUTING_COST), 1))?;
        let operations = children(path, "peripheralOperation");
        let operations: Vec<Json> = operations
            .map(|operation| PERIPHERAL_OPERATION.to_json(operation).into())
            .collect();
        let operations = (!operations.is_empty()).then(|| operations.into());
        reader.set_json(table, row, PERIPHERAL_OPERATIONS, operations)?;
        let (name, layout) = (name_or_empty(path), child(path, "pathLayout"));
        reader.set_text(table, row, "layer", self.visual.layer(name, layout))?;
        if let Some(layout) = layout {
            reader.keep_unknown(layout, &[CONNECTION_TYPE, "layerId"]);
        }
        let unread = self.visual.legacy_element(name).and_then(|l| l.unread());
        unread
            .into_iter()
            .for_each(|unread| reader.keep("modelLayoutElement", unread));
        set_envelopes(reader, table, row, path)?;
        reader.finish(table, row, path, &PATH)
    }
}
