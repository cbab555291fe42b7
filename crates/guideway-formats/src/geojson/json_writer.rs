//! JSON writer: writes objects, arrays and values with their separators, and positions.

use std::io::{self, Write};

use guideway_layout::{Attributes, Value};
use guideway_spline::Point;
use serde::Serialize;
use serde_json::value::RawValue;

use crate::clamped::rounded;
use crate::wgs84::LocalProjection;

/// Streams JSON to `out`.
pub(super) struct JsonWriter<'w, W> {
    out: &'w mut W,
    needs_comma: bool,
    /// Projection of written positions; `None` for meters.
    degrees: Option<LocalProjection>,
}

impl<'w, W: Write> JsonWriter<'w, W> {
    pub(super) fn new(out: &'w mut W, degrees: Option<LocalProjection>) -> Self {
        Self {
            out,
            needs_comma: false,
            degrees,
        }
    }

    /// Opens an object or an array.
    pub(super) fn begin(&mut self, bracket: char) -> io::Result<()> {
        self.separate()?;
        self.needs_comma = false;
        write!(self.out, "{bracket}")
    }

    /// Opens an object on a line of its own.
    pub(super) fn begin_line(&mut self) -> io::Result<()> {
        self.separate()?;
        self.needs_comma = false;
        write!(self.out, "\n{{")
    }

    /// Closes an object or an array.
    pub(super) fn end(&mut self, bracket: char) -> io::Result<()> {
        self.needs_comma = true;
        write!(self.out, "{bracket}")
    }

    /// Writes the key of the next value.
    pub(super) fn key(&mut self, name: &str) -> io::Result<()> {
        self.any(name)?;
        self.needs_comma = false;
        write!(self.out, ":")
    }

    /// Writes a value that serializes to JSON.
    pub(super) fn any<T: Serialize + ?Sized>(&mut self, value: &T) -> io::Result<()> {
        self.separate()?;
        serde_json::to_writer(&mut *self.out, value).map_err(io::Error::from)
    }

    /// Writes a field of an object.
    pub(super) fn field<T: Serialize + ?Sized>(&mut self, name: &str, value: &T) -> io::Result<()> {
        self.key(name)?;
        self.any(value)
    }

    /// Writes a value of a column. A number that JSON lacks is written as text.
    pub(super) fn value(&mut self, value: Value<'_>) -> io::Result<()> {
        match value {
            Value::Bool(value) => self.any(&value),
            Value::Int(value) => self.any(&value),
            Value::Float(value) if value.is_finite() => self.any(&value),
            Value::Float(value) if value.is_nan() => self.any("NaN"),
            Value::Float(value) if value > 0.0 => self.any("Infinity"),
            Value::Float(_) => self.any("-Infinity"),
            Value::Text(value) => self.any(value),
            Value::Json(value) => match serde_json::from_str::<&RawValue>(value) {
                Ok(value) => self.any(value),
                Err(_) => self.any(value),
            },
        }
    }

    /// Writes the values of a row as fields, except those that `skip` names.
    pub(super) fn row(
        &mut self,
        attributes: &Attributes,
        row: usize,
        skip: impl Fn(&str) -> bool,
    ) -> io::Result<()> {
        for attribute in attributes.iter().filter(|a| !skip(&a.name)) {
            if let Some(value) = attribute.values.get(row) {
                self.key(&attribute.name)?;
                self.value(value)?;
            }
        }
        Ok(())
    }

    /// Writes the geometry of a feature and closes the feature.
    pub(super) fn geometry(
        &mut self,
        kind: &str,
        coordinates: impl FnOnce(&mut Self) -> io::Result<()>,
    ) -> io::Result<()> {
        self.key("geometry")?;
        self.begin('{')?;
        self.field("type", kind)?;
        self.key("coordinates")?;
        coordinates(self)?;
        self.end('}')?;
        self.end('}')
    }

    /// Writes the point of a feature and closes the feature.
    pub(super) fn point(&mut self, position_m: Point<f64>) -> io::Result<()> {
        self.geometry("Point", |json| json.position(position_m))
    }

    /// Writes the lines of a feature and closes the feature.
    pub(super) fn lines(&mut self, lines: &[Vec<Point<f64>>]) -> io::Result<()> {
        match lines {
            [line] => self.geometry("LineString", |json| json.line(line)),
            lines => self.geometry("MultiLineString", |json| {
                json.begin('[')?;
                lines.iter().try_for_each(|line| json.line(line))?;
                json.end(']')
            }),
        }
    }

    /// Writes an array of positions.
    pub(super) fn line(&mut self, line: &[Point<f64>]) -> io::Result<()> {
        self.begin('[')?;
        line.iter().try_for_each(|&point| self.position(point))?;
        self.end(']')
    }

    fn position(&mut self, position_m: Point<f64>) -> io::Result<()> {
        let position = match self.degrees {
            None => [position_m.x, position_m.y].map(rounded),
            Some(degrees) => {
                let degrees = degrees.to_degrees(position_m);
                [degrees.x, degrees.y].map(rounded_degrees)
            }
        };
        self.any(&position)
    }

    fn separate(&mut self) -> io::Result<()> {
        if std::mem::replace(&mut self.needs_comma, true) {
            write!(self.out, ",")?;
        }
        Ok(())
    }
}

/// Rounds degrees to a step below one micrometer.
fn rounded_degrees(degrees: f64) -> f64 {
    const STEPS: f64 = 1e12;
    (degrees * STEPS).round() / STEPS + 0.0
}
