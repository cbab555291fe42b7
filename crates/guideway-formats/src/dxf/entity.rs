//! The entities of a drawing that are curves, and references to blocks of them.

use std::f64::consts::TAU;

use guideway_layout::Code;

use super::records::Record;
use super::space::{Affine, Vector};
use super::style::{Color, Layers, decoded};
use super::write::APPLICATION;

/// An entity, with what all have.
#[derive(Debug)]
pub(super) struct Entity<'b> {
    pub(super) kind: &'static str,
    /// Its handle, which is its identifier in the file.
    pub(super) handle: &'b [u8],
    /// The identifier of the path that it was written for.
    pub(super) id: Option<String>,
    pub(super) line: Option<u32>,
    pub(super) layer: u32,
    pub(super) color: Color,
    /// Why it is not seen, if it is not.
    pub(super) hidden: Option<&'static str>,
    pub(super) shape: Shape,
}

#[derive(Debug)]
pub(super) enum Shape {
    Line([Vector; 2]),
    Arc(Box<Arc>),
    Polyline(Box<Polyline>),
    Spline(Box<Spline>),
    Insert(Box<Insert>),
    /// What is wrong with it, so that nothing can be drawn.
    Broken(Code, String),
}

/// A part of an ellipse: center + u cos t + v sin t, t from `start` over `sweep`, in radians. Whatever plane it
/// lies on and however a block is stretched, it stays one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) center: Vector,
    pub(super) u: Vector,
    pub(super) v: Vector,
    pub(super) start: f64,
    pub(super) sweep: f64,
}

#[derive(Debug)]
pub(super) struct Polyline {
    /// The plane that the vertices lie on.
    pub(super) plane: Affine,
    pub(super) vertices: Vec<Vertex>,
    pub(super) is_closed: bool,
}

/// A vertex, and how the way to the next one is bent: the tangent of a quarter of the angle of an arc.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) position: Vector,
    pub(super) bulge: f64,
}

#[derive(Debug)]
pub(super) struct Spline {
    pub(super) degree: i64,
    pub(super) knots: Vec<f64>,
    pub(super) weights: Vec<f64>,
    pub(super) points: Vec<Vector>,
    /// Points that the curve passes through, and its directions at the first and last of them.
    pub(super) fit: Vec<Vector>,
    pub(super) tangents: [Option<Vector>; 2],
    pub(super) is_closed: bool,
}

/// A reference to a block, perhaps in rows and columns.
#[derive(Debug)]
pub(super) struct Insert {
    pub(super) block: u32,
    /// From the block's coordinates relative to its base point to the first cell.
    pub(super) placed: Affine,
    /// From one cell to the next along a row, and along a column.
    pub(super) steps: [Vector; 2],
    pub(super) columns: u32,
    pub(super) rows: u32,
}

/// The kinds of entities that are read; a POLYLINE is followed by its VERTEX records.
pub(super) const KINDS: [&str; 8] = [
    "LINE",
    "ARC",
    "CIRCLE",
    "ELLIPSE",
    "LWPOLYLINE",
    "POLYLINE",
    "SPLINE",
    "INSERT",
];

/// The kind of a record, if it is one of those.
pub(super) fn known_kind(kind: &[u8]) -> Option<&'static str> {
    KINDS.into_iter().find(|known| known.as_bytes() == kind)
}

impl<'b> Entity<'b> {
    /// An entity of a record, but for its shape.
    pub(super) fn of(
        kind: &'static str,
        record: &Record<'b>,
        layers: &mut Layers,
        shape: Shape,
    ) -> Self {
        let hidden = match (record.whole(67), record.whole(60)) {
            (Some(1), _) => Some("it is on a sheet of paper, not in the model"),
            (_, Some(1)) => Some("it is invisible"),
            _ => None,
        };
        let layer = layers.row(&decoded(record.text(8).unwrap_or(b"0")));
        let color = Color::of(record);
        let shape = match record.bad.get() {
            Some(code) => {
                let detail = format!("the value of group code {code} is not a number");
                Shape::Broken(Code::WrongType, detail)
            }
            None => shape,
        };
        Self {
            kind,
            handle: record.text(5).unwrap_or_default(),
            id: written_id(record),
            line: record.line,
            layer,
            color,
            hidden,
            shape,
        }
    }

    /// How many entities it stands for: a reference stands for all in its block, as often as it is repeated.
    pub(super) fn count(&self, in_block: impl FnOnce(u32) -> u64) -> u64 {
        match &self.shape {
            Shape::Insert(insert) => {
                let cells = u64::from(insert.columns) * u64::from(insert.rows);
                cells.saturating_mul(in_block(insert.block))
            }
            _ => 1,
        }
    }
}

/// The identifier that the writer of this project leaves in the extended data of an entity.
fn written_id(record: &Record<'_>) -> Option<String> {
    let mut pairs = record.pairs.iter();
    pairs.find(|pair| pair.code == 1001 && pair.text() == APPLICATION.as_bytes())?;
    let texts = pairs.take_while(|pair| pair.code == 1000);
    Some(texts.map(|pair| decoded(pair.text())).collect())
}

/// The shape of a record of a known kind but POLYLINE and INSERT.
pub(super) fn shape(kind: &str, record: &Record<'_>) -> Shape {
    let shape = match kind {
        "LINE" => line(record),
        "ARC" | "CIRCLE" => circle(record, kind == "ARC"),
        "ELLIPSE" => ellipse(record),
        "LWPOLYLINE" => Some(lightweight(record)),
        _ => Some(spline(record)),
    };
    shape.unwrap_or_else(|| {
        let detail = "a group code is missing that its shape needs";
        Shape::Broken(Code::MissingField, detail.into())
    })
}

fn line(record: &Record<'_>) -> Option<Shape> {
    Some(Shape::Line([record.vector(10)?, record.vector(11)?]))
}

/// The plane of a record's own coordinates.
pub(super) fn plane(record: &Record<'_>) -> Affine {
    Affine::of_extrusion(record.vector(210).unwrap_or(Vector::new(0.0, 0.0, 1.0)))
}

fn circle(record: &Record<'_>, is_arc: bool) -> Option<Shape> {
    let plane = plane(record);
    let radius = record.real(40)?;
    let (start, sweep) = match is_arc {
        true => {
            let [start, end] = [record.real(50)?, record.real(51)?].map(f64::to_radians);
            (start, turn(start, end))
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
        sweep: turn(start, record.real(42).unwrap_or(TAU)),
    })))
}

/// The counter-clockwise turn from one angle to another, which is a full one if they are the same.
fn turn(start: f64, end: f64) -> f64 {
    let turn = (end - start).rem_euclid(TAU);
    // What rounding leaves of a full turn is one too.
    if turn < 1e-9 { TAU } else { turn }
}

fn lightweight(record: &Record<'_>) -> Shape {
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
                position: Vector::new(number, 0.0, elevation),
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
        is_closed: record.whole(70).unwrap_or(0) & 1 != 0,
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
        degree: record.whole(71).unwrap_or(3),
        knots: reals(40),
        weights: reals(41),
        points: record.vectors(10),
        fit: record.vectors(11),
        tangents: [record.vector(12), record.vector(13)],
        is_closed: record.whole(70).unwrap_or(0) & 1 != 0,
    }))
}
