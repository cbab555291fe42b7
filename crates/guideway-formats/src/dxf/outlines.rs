//! Outlines: parses multilines, solids, traces and faces to lines.

use super::affine3::{Affine3, Vector3};
use super::records::Record;
use super::shape::{Polyline, Shape, Vertex, plane};

/// Group codes of the corners of an area.
const CORNERS: [i32; 4] = [10, 11, 12, 13];

fn straight(plane: Affine3, positions: impl IntoIterator<Item = Vector3>) -> Polyline {
    let vertex = |position| Vertex {
        position,
        bulge: 0.0,
    };
    Polyline {
        plane,
        vertices: positions.into_iter().map(vertex).collect(),
        is_closed: true,
    }
}

/// The corners of an area; the fourth of a triangle is absent or repeats the third.
fn corners(record: &Record<'_>) -> Option<Vec<Vector3>> {
    let [first, second, third, fourth] = CORNERS.map(|code| record.vector(code));
    let mut corners = vec![first?, second?, third?];
    corners.extend(fourth.filter(|fourth| Some(*fourth) != third));
    Some(corners)
}

/// The outline of a SOLID or a TRACE, whose third and fourth corners are in the other order.
pub(super) fn solid(record: &Record<'_>) -> Option<Shape> {
    let mut corners = corners(record)?;
    if corners.len() == 4 {
        corners.swap(2, 3);
    }
    Some(Shape::Polyline(Box::new(straight(plane(record), corners))))
}

/// The outline of a 3DFACE, without the edges that its flags hide.
pub(super) fn face(record: &Record<'_>) -> Option<Shape> {
    let corners = corners(record)?;
    let hidden = record.int(70).unwrap_or(0);
    let world = Affine3::scale(1.0, 1.0, 1.0);
    if hidden & 15 == 0 {
        return Some(Shape::Polyline(Box::new(straight(world, corners))));
    }
    // The last edge of a triangle has the flag of the fourth.
    let flag = |edge: usize| match edge + 1 == corners.len() {
        true => 8,
        false => 1 << edge,
    };
    let edges = (0..corners.len()).filter(|&edge| hidden & flag(edge) == 0);
    let line = |edge: usize| Shape::Line([corners[edge], corners[(edge + 1) % corners.len()]]);
    Some(Shape::Lines(edges.map(line).collect()))
}

/// The lines of an MLINE. Each vertex has a miter direction and, for each line, the distance from
/// the vertex along it. Gaps in lines are closed.
pub(super) fn multiline(record: &Record<'_>) -> Option<Shape> {
    const CLOSED: i64 = 2;
    let (vertices, miters) = (record.vectors(11), record.vectors(13));
    // Group code 74 begins the parameters of a line, of which the first is its distance.
    let mut distances: Vec<f64> = Vec::new();
    let mut is_first = false;
    for pair in &record.pairs {
        match pair.code {
            74 => is_first = true,
            41 if is_first => {
                distances.push(record.real_of(pair)?);
                is_first = false;
            }
            _ => {}
        }
    }
    let count = distances.len().checked_div(vertices.len())?;
    if count == 0 || distances.len() != count * vertices.len() || miters.len() != vertices.len() {
        return None;
    }
    let is_closed = record.int(71).unwrap_or(0) & CLOSED != 0;
    let world = Affine3::scale(1.0, 1.0, 1.0);
    let line = |line: usize| {
        let at = |(i, vertex): (usize, &Vector3)| *vertex + miters[i] * distances[i * count + line];
        Shape::Polyline(Box::new(Polyline {
            is_closed,
            ..straight(world, vertices.iter().enumerate().map(at))
        }))
    };
    Some(Shape::Lines((0..count).map(line).collect()))
}
