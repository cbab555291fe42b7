//! Parses records to entities: curves and INSERTs, with their layer, color and identifier.

use std::f64::consts::TAU;

use guideway_layout::Code;

use super::affine3::Vector3;
use super::hatch::hatch;
use super::notes::{is_note, mark};
use super::outlines::{face, multiline, solid};
use super::records::Record;
use super::shape::{Arc, Polyline, Shape, Spline, Vertex, plane};
use super::style::{Color, Layers};
use super::text::TextDecoder;
use super::xdata::read_path_id;

/// An entity: its shape and the properties that all kinds share.
#[derive(Debug)]
pub(super) struct Entity<'b> {
    pub(super) kind: &'static str,
    /// Its identifier in the file, in hexadecimal; empty in old files.
    pub(super) handle: &'b [u8],
    /// The path identifier in its extended data, if Guideway wrote the file.
    pub(super) path_id: Option<String>,
    pub(super) line: Option<u32>,
    pub(super) layer: u32,
    pub(super) color: Color,
    /// The reason why it is not visible; `None` if it is visible.
    pub(super) hidden: Option<&'static str>,
    pub(super) shape: Shape,
}

/// The supported kinds of entities.
const KINDS: [&str; 18] = [
    "LINE",
    "ARC",
    "CIRCLE",
    "ELLIPSE",
    "LWPOLYLINE",
    "POLYLINE",
    "SPLINE",
    "HELIX",
    "INSERT",
    "MLINE",
    "SOLID",
    "TRACE",
    "3DFACE",
    "HATCH",
    "TEXT",
    "MTEXT",
    "ATTRIB",
    "POINT",
];

/// The kind of a record, if supported.
pub(super) fn known_kind(kind: &[u8]) -> Option<&'static str> {
    KINDS.into_iter().find(|known| known.as_bytes() == kind)
}

impl<'b> Entity<'b> {
    /// Combines the common properties of a record with a shape.
    pub(super) fn of(
        kind: &'static str,
        record: &Record<'b>,
        layers: &mut Layers,
        shape: Shape,
    ) -> Self {
        let hidden = match (record.int(67), record.int(60)) {
            (Some(1), _) => Some("it is in paper space, not in the model"),
            (_, Some(1)) => Some("it is invisible"),
            _ => None,
        };
        let layer = layers.row_of(record.text(8).unwrap_or(b"0"));
        let color = Color::of(record);
        let shape = match record.bad_code.get() {
            Some(code) => {
                let detail = format!("the value of group code {code} is not a number");
                Shape::Broken(Code::WrongType, detail)
            }
            None => shape,
        };
        Self {
            kind,
            handle: record.text(5).unwrap_or_default(),
            path_id: read_path_id(record, &layers.texts),
            line: record.line,
            layer,
            color,
            hidden,
            shape,
        }
    }

    /// The path identifier: the handles of the INSERTs around it, then its own identifier or
    /// handle, or in old files without handles its line.
    pub(super) fn id_after(&self, handle_prefix: &str) -> String {
        let own = match (&self.path_id, self.handle, self.line) {
            (Some(id), ..) => id.clone(),
            (None, b"", Some(line)) => format!("line {line}"),
            (None, b"", None) => self.kind.to_owned(),
            (None, handle, _) => String::from_utf8_lossy(handle).into_owned(),
        };
        format!("{handle_prefix}{own}")
    }

    /// Number of entities that it expands to: 1, or for an INSERT its cells times `in_block(row)`.
    pub(super) fn expanded_count(&self, in_block: impl FnOnce(u32) -> u64) -> u64 {
        match &self.shape {
            Shape::Insert(insert) => {
                let cells = u64::from(insert.columns) * u64::from(insert.rows);
                cells.saturating_mul(in_block(insert.block))
            }
            Shape::Lines(lines) => lines.len() as u64,
            _ => 1,
        }
    }
}

/// Parses the shape of a record of any supported kind except POLYLINE and INSERT.
pub(super) fn shape(kind: &str, record: &Record<'_>, texts: &TextDecoder) -> Shape {
    let shape = match kind {
        "LINE" => line(record),
        "ARC" | "CIRCLE" => circle(record, kind == "ARC"),
        "ELLIPSE" => ellipse(record),
        "LWPOLYLINE" => Some(lwpolyline(record)),
        "MLINE" => multiline(record),
        "SOLID" | "TRACE" => solid(record),
        "3DFACE" => face(record),
        "HATCH" => hatch(record),
        note if is_note(note) => mark(note, record, texts),
        _ => Some(spline(record)),
    };
    shape.unwrap_or_else(|| {
        let detail = "a group code that its shape requires is missing";
        Shape::Broken(Code::MissingField, detail.into())
    })
}

fn line(record: &Record<'_>) -> Option<Shape> {
    Some(Shape::Line([record.vector(10)?, record.vector(11)?]))
}

fn circle(record: &Record<'_>, is_arc: bool) -> Option<Shape> {
    let plane = plane(record);
    let radius = record.real(40)?;
    let (start, sweep) = match is_arc {
        true => {
            let [start, end] = [record.real(50)?, record.real(51)?].map(f64::to_radians);
            (start, sweep_ccw(start, end))
        }
        false => (0.0, TAU),
    };
    Some(Shape::Arc(Box::new(Arc {
        center: plane.point(record.vector(10)?),
        u: plane.x * radius,
        v: plane.y * radius,
        start,
        sweep,
    })))
}

fn ellipse(record: &Record<'_>) -> Option<Shape> {
    let u = record.vector(11)?;
    let normal = plane(record).z;
    let start = record.real(41).unwrap_or(0.0);
    Some(Shape::Arc(Box::new(Arc {
        center: record.vector(10)?,
        u,
        v: normal.cross(u) * record.real(40)?,
        start,
        sweep: sweep_ccw(start, record.real(42).unwrap_or(TAU)),
    })))
}

/// The counter-clockwise angle from `start` to `end`; a full turn if both are equal up to rounding.
fn sweep_ccw(start: f64, end: f64) -> f64 {
    let sweep = (end - start).rem_euclid(TAU);
    if sweep < 1e-9 { TAU } else { sweep }
}

fn lwpolyline(record: &Record<'_>) -> Shape {
    let elevation = record.real(38).unwrap_or(0.0);
    let mut vertices: Vec<Vertex> = Vec::new();
    for pair in record
        .pairs
        .iter()
        .filter(|p| matches!(p.code, 10 | 20 | 42))
    {
        let Some(number) = record.real_of(pair) else {
            continue;
        };
        match (pair.code, vertices.last_mut()) {
            (10, _) => vertices.push(Vertex {
                position: Vector3::new(number, 0.0, elevation),
                bulge: 0.0,
            }),
            (20, Some(last)) => last.position.y = number,
            (_, Some(last)) => last.bulge = number,
            (_, None) => {}
        }
    }
    Shape::Polyline(Box::new(Polyline {
        plane: plane(record),
        vertices,
        is_closed: record.int(70).unwrap_or(0) & 1 != 0,
    }))
}

fn spline(record: &Record<'_>) -> Shape {
    let reals = |code| {
        record
            .all(code)
            .filter_map(|pair| record.real_of(pair))
            .collect()
    };
    Shape::Spline(Box::new(Spline {
        degree: record.int(71).unwrap_or(3),
        knots: reals(40),
        weights: reals(41),
        points: record.vectors(10),
        fit_points: record.vectors(11),
        tangents: [record.vector(12), record.vector(13)],
        // Closed, or periodic.
        is_closed: record.int(70).unwrap_or(0) & 3 != 0,
    }))
}
