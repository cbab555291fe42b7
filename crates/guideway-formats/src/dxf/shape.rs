//! Shapes of entities, in drawing units.

use guideway_layout::{Code, NoteKind};

use super::affine3::{Affine3, Vector3};
use super::records::Record;

/// The geometry of an entity, in drawing units.
#[derive(Debug)]
pub(super) enum Shape {
    Line([Vector3; 2]),
    Arc(Box<Arc>),
    Polyline(Box<Polyline>),
    Spline(Box<Spline>),
    Insert(Box<Insert>),
    /// Several lines, each of which is a path.
    Lines(Vec<Self>),
    /// A text or a point, which is not drawn.
    Mark(Box<Mark>),
    /// The finding that prevents drawing.
    Broken(Code, String),
}

/// An elliptical arc: center + u cos t + v sin t, for t from `start` over `sweep`, in radians. Any
/// affine map of an elliptical arc is an elliptical arc again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arc {
    pub(super) center: Vector3,
    pub(super) u: Vector3,
    pub(super) v: Vector3,
    pub(super) start: f64,
    pub(super) sweep: f64,
}

/// Straight and circular segments.
#[derive(Debug)]
pub(super) struct Polyline {
    /// The object coordinate system of the vertices.
    pub(super) plane: Affine3,
    pub(super) vertices: Vec<Vertex>,
    pub(super) is_closed: bool,
}

/// A vertex, and the bulge of the segment to the next one: the tangent of a quarter of the arc's
/// angle, 0 for a straight segment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vertex {
    pub(super) position: Vector3,
    pub(super) bulge: f64,
}

/// A NURBS curve, or a curve through fit points.
#[derive(Debug)]
pub(super) struct Spline {
    pub(super) degree: i64,
    pub(super) knots: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// Control points.
    pub(super) points: Vec<Vector3>,
    /// Points that the curve passes through.
    pub(super) fit_points: Vec<Vector3>,
    /// Directions at the first and the last fit point.
    pub(super) tangents: [Option<Vector3>; 2],
    pub(super) is_closed: bool,
}

/// A reference to a block, repeated over a grid of rows and columns.
#[derive(Debug)]
pub(super) struct Insert {
    pub(super) block: u32,
    /// From block coordinates relative to the base point, to the first cell.
    pub(super) transform: Affine3,
    /// Offset from one cell to the next along a row, and along a column.
    pub(super) steps: [Vector3; 2],
    pub(super) columns: u32,
    pub(super) rows: u32,
}

/// A text or a point, in drawing units.
#[derive(Debug)]
pub(super) struct Mark {
    pub(super) kind: NoteKind,
    pub(super) text: String,
    pub(super) at: Vector3,
    /// The text belongs to the INSERT before it.
    pub(super) is_attribute: bool,
}

/// The object coordinate system of a record.
pub(super) fn plane(record: &Record<'_>) -> Affine3 {
    Affine3::of_extrusion(record.vector(210).unwrap_or(Vector3::new(0.0, 0.0, 1.0)))
}
