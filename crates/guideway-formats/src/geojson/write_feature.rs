//! GeoJSON features as text: identifiers, properties, points and lines.

use std::io::{self, Write};

use guideway_layout::{Attributes, Direction, Layout, PathRef, Value};
use guideway_spline::Point;

use crate::clamped::rounded;

/// Properties that a route graph reserves.
pub(super) const RESERVED: [&str; 3] = ["id", "startid", "endid"];

/// Writer of the features of a collection: `begin`, properties, then `point` or `lines`.
pub(super) struct FeatureWriter<'w, W> {
    out: &'w mut W,
    is_first: bool,
}

impl<'w, W: Write> FeatureWriter<'w, W> {
    /// Makes a writer to the array of features.
    pub(super) fn new(out: &'w mut W) -> Self {
        Self {
            out,
            is_first: true,
        }
    }

    /// Begins a feature with its identifier.
    pub(super) fn begin(&mut self, id: &str) -> io::Result<()> {
        let separator = if self.is_first { "\n" } else { ",\n" };
        self.is_first = false;
        write!(
            self.out,
            r#"{separator}{{"type":"Feature","properties":{{"id":"#
        )?;
        self.id_value(id)
    }

    fn property(&mut self, name: &str, value: Value<'_>) -> io::Result<()> {
        self.name(name)?;
        match value {
            Value::Bool(value) => write!(self.out, "{value}"),
            Value::Int(value) => write!(self.out, "{value}"),
            Value::Float(value) => self.json(&value),
            Value::Text(value) => self.json(value),
            Value::Json(value) => write!(self.out, "{value}"),
        }
    }

    /// Writes a property with the identifier of a node.
    pub(super) fn id(&mut self, name: &str, id: &str) -> io::Result<()> {
        self.name(name)?;
        self.id_value(id)
    }

    /// Writes an identifier. Nav2 requires integers, so an integer is written as a number.
    fn id_value(&mut self, id: &str) -> io::Result<()> {
        match id.parse::<u32>() {
            Ok(number) if number.to_string() == id => write!(self.out, "{number}"),
            _ => self.json(id),
        }
    }

    fn name(&mut self, name: &str) -> io::Result<()> {
        write!(self.out, ",")?;
        self.json(name)?;
        write!(self.out, ":")
    }

    /// Writes level, direction and vehicle types of a path as properties; a reader takes them as
    /// columns.
    pub(super) fn path_properties(&mut self, layout: &Layout, path: PathRef<'_>) -> io::Result<()> {
        let column = |name| layout.paths.attributes.get(name);
        let level = path.level().and_then(|l| layout.levels.get(l as usize));
        if let (Some(level), None) = (level, column("level")) {
            self.property("level", Value::Text(&level.id))?;
        }
        if path.direction() == Direction::Both && column("direction").is_none() {
            self.property("direction", Value::Text("both"))?;
        }
        let types: Vec<&str> = layout.paths.vehicle_types().of(path.row()).collect();
        if !types.is_empty() && column("vehicle_types").is_none() {
            self.property("vehicle_types", Value::Text(&types.join(", ")))?;
        }
        Ok(())
    }

    /// Writes the attributes of a row as properties.
    pub(super) fn attributes(&mut self, attributes: &Attributes, row: usize) -> io::Result<()> {
        for attribute in attributes.iter() {
            let reserved = RESERVED.contains(&attribute.name.as_str());
            if let Some(value) = attribute.values.get(row).filter(|_| !reserved) {
                self.property(&attribute.name, value)?;
            }
        }
        Ok(())
    }

    /// Ends a feature with a point.
    pub(super) fn point(&mut self, position: Point<f64>) -> io::Result<()> {
        write!(self.out, r#"}},"geometry":{{"type":"Point","coordinates":"#)?;
        self.position(position)?;
        write!(self.out, "}}}}")
    }

    /// Ends a feature with a line, or with several.
    pub(super) fn lines(&mut self, lines: &[Vec<Point<f64>>]) -> io::Result<()> {
        let is_multi = lines.len() != 1;
        let (kind, open, close) = match is_multi {
            true => ("MultiLineString", "[", "]"),
            false => ("LineString", "", ""),
        };
        write!(
            self.out,
            r#"}},"geometry":{{"type":"{kind}","coordinates":{open}"#
        )?;
        for (i, line) in lines.iter().enumerate() {
            write!(self.out, "{}[", if i == 0 { "" } else { "," })?;
            for (j, &point) in line.iter().enumerate() {
                write!(self.out, "{}", if j == 0 { "" } else { "," })?;
                self.position(point)?;
            }
            write!(self.out, "]")?;
        }
        write!(self.out, "{close}}}}}")
    }

    fn position(&mut self, position: Point<f64>) -> io::Result<()> {
        let [x, y] = [position.x, position.y].map(rounded);
        write!(self.out, "[")?;
        self.json(&x)?;
        write!(self.out, ",")?;
        self.json(&y)?;
        write!(self.out, "]")
    }

    fn json<T: serde::Serialize + ?Sized>(&mut self, value: &T) -> io::Result<()> {
        serde_json::to_writer(&mut *self.out, value).map_err(io::Error::from)
    }
}
