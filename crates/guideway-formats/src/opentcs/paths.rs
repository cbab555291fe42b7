//! From a path of a plant model to runs.

use guideway_layout::{Code, Direction, NewPath, Value};
use guideway_spline::{Point, Runs, polyline_to_runs};
use roxmltree::Node;

use super::drawing::Drawing;
use super::plant::{Plant, name_of};
use crate::ReadError;
use crate::builder::Table;
use crate::xml::{child, children};

/// How many connection types are counted by name; the format knows seven.
const MOST_CONNECTION_TYPES: usize = 16;

/// Most blocks that are named for one path; a file could else make texts without end.
const MOST_BLOCKS: usize = 16;

/// How a path is drawn.
struct Shape {
    kind: String,
    /// In meters.
    control: Vec<Point<f64>>,
}

impl<'d, 't> Plant<'_, 'd, 't> {
    pub(super) fn map_path(
        &mut self,
        path: Node<'d, 't>,
        drawing: &Drawing<'d>,
    ) -> Result<(), ReadError> {
        let name = self.name(path)?;
        let shape = self.shape(path, drawing)?;
        self.count_shape(&shape);
        let ends = ["sourcePoint", "destinationPoint"].map(|key| {
            let point = path.attribute(key).unwrap_or_default();
            (point, self.nodes.get(point).copied())
        });
        let [(_, Some(start)), (_, Some(end))] = ends else {
            let missing: Vec<&str> = ends.iter().filter(|e| e.1.is_none()).map(|e| e.0).collect();
            for point in &missing {
                self.report_unknown_node(path, point);
            }
            let detail = format!(
                "the point \"{}\" is not there or has no position",
                missing.join("\" and \"")
            );
            self.builder.check_text(&detail)?;
            return self.builder.refuse(&name, Code::UnknownNode, &detail);
        };
        let nodes = &self.builder.layout.nodes;
        let (from, to) = (nodes.position_m(start), nodes.position_m(end));
        let mut runs = Runs::default();
        self.append(path, &shape, [from, to], &mut runs);
        let reverse = self.number(path, &["maxReverseVelocity"]);
        let row = self.builder.push_path(&NewPath {
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
        self.set_path_attributes(row, path, &shape, drawing)
    }

    fn shape(&mut self, path: Node<'d, 't>, drawing: &Drawing<'d>) -> Result<Shape, ReadError> {
        let mut control = Vec::new();
        let kind = if let Some(layout) = child(path, "pathLayout") {
            for point in children(layout, "controlPoint") {
                let x = self.number(point, &["x"]);
                let y = self.number(point, &["y"]);
                self.push_control(path, x, y, drawing, &mut control);
            }
            layout.attribute("connectionType")
        } else {
            let drawn = drawing.of(name_of(path));
            let text = drawn.and_then(|d| d.control_points);
            for pair in text
                .unwrap_or_default()
                .split(';')
                .filter(|p| !p.trim().is_empty())
            {
                let (x, y) = pair.split_once(',').unwrap_or((pair, ""));
                let x = self.parse(path, "CONTROL_POINTS", x);
                let y = self.parse(path, "CONTROL_POINTS", y);
                self.push_control(path, x, y, drawing, &mut control);
            }
            drawn.and_then(|d| d.connection_type)
        };
        self.builder.check_curve_points(control.len())?;
        let kind = kind.unwrap_or("DIRECT").trim();
        self.builder.check_text(kind)?;
        // Files of openTCS 2.7 have "Bezier".
        let kind = kind.to_ascii_uppercase();
        Ok(Shape { kind, control })
    }

    fn push_control(
        &mut self,
        path: Node<'d, 't>,
        x: Option<f64>,
        y: Option<f64>,
        drawing: &Drawing<'d>,
        control: &mut Vec<Point<f64>>,
    ) {
        self.control_points += 1;
        let (Some(x), Some(y)) = (x, y) else {
            let message = || "a control point lacks a coordinate".to_owned();
            self.report(
                Code::MissingField,
                path,
                message,
                "It is left out; correct the file",
            );
            return;
        };
        let point = drawing.to_meters(Point::new(x, y));
        let xml = self.xml;
        if self.builder.check_point(point, &|| xml.place(path)) {
            control.push(point);
        }
    }

    fn count_shape(&mut self, shape: &Shape) {
        let types = &mut self.connection_types;
        match types.iter().position(|(kind, _)| *kind == shape.kind) {
            Some(known) => types[known].1 += 1,
            None if types.len() < MOST_CONNECTION_TYPES => types.push((shape.kind.clone(), 1)),
            None => {}
        }
    }

    fn append(
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
                let message = || {
                    format!(
                        "the bends of a path of type {} are not in the file",
                        shape.kind
                    )
                };
                let remedy = "A straight line is drawn";
                self.report(Code::ApproximateShape, path, message, remedy);
                runs.push_line(start, end);
            }
            // The editor writes one point where both handles are the same.
            ("BEZIER", &[handle]) => runs.push_bezier(&[start, handle, handle, end]),
            ("BEZIER", &[first, second]) => runs.push_bezier(&[start, first, second, end]),
            ("BEZIER_3", &[a, b, middle, c, d]) => {
                runs.push_bezier(&[start, a, b, middle]);
                runs.push_bezier(&[middle, c, d, end]);
            }
            (kind, _) => {
                match kind {
                    "POLYPATH" => {}
                    "BEZIER" => self.report_handles(path, "one or two", control.len()),
                    "BEZIER_3" => self.report_handles(path, "five", control.len()),
                    _ => self.report_kind(path, kind),
                }
                let points: Vec<_> = [start].into_iter().chain(control.iter().copied()).collect();
                polyline_to_runs(&[points.as_slice(), &[end]].concat(), runs);
            }
        }
    }

    fn report_handles(&mut self, path: Node<'d, 't>, expected: &str, actual: usize) {
        let message = || format!("{actual} control points, {expected} expected");
        let remedy = "Straight lines are drawn through them; draw the path again in the editor";
        self.report(Code::TooFewPoints, path, message, remedy);
    }

    fn report_kind(&mut self, path: Node<'d, 't>, kind: &str) {
        let start: String = kind.chars().take(40).collect();
        let message = || format!("the connection type \"{start}\" is not known");
        let remedy = "Straight lines are drawn through its control points";
        self.report(Code::UnknownValue, path, message, remedy);
    }

    fn set_path_attributes(
        &mut self,
        row: usize,
        path: Node<'d, 't>,
        shape: &Shape,
        drawing: &Drawing<'d>,
    ) -> Result<(), ReadError> {
        for key in ["length", "maxVelocity", "maxReverseVelocity"] {
            let Some(text) = path.attribute(key) else {
                continue;
            };
            // Files have whole numbers, but early ones may not.
            let value = match text.trim().parse() {
                Ok(whole) => Some(Value::Int(whole)),
                Err(_) => self.parse(path, key, text).map(Value::Float),
            };
            if let Some(value) = value {
                self.builder.set(Table::Paths, row, key, value)?;
            }
        }
        self.bool_attribute(Table::Paths, row, "locked", path)?;
        self.text_attribute(Table::Paths, row, "connectionType", Some(&shape.kind))?;
        let layer = child(path, "pathLayout").and_then(|l| l.attribute("layerId"));
        let layer = layer.map(|id| drawing.layer_name(id));
        self.text_attribute(Table::Paths, row, "layer", layer)?;
        let blocks = self.blocks.get(name_of(path));
        let blocks = blocks.map(|names| names[..names.len().min(MOST_BLOCKS)].join(", "));
        self.text_attribute(Table::Paths, row, "block", blocks.as_deref())?;
        self.set_envelopes(Table::Paths, row, path)?;
        self.set_properties(Table::Paths, row, path)
    }
}
