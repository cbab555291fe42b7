//! Hatches: parses the boundaries of filled areas to closed lines.
//!
//! A boundary is a polyline, or a chain of edges: lines, arcs, ellipses and splines. Some follow
//! other entities of the drawing, which are drawn already. Source: the DXF reference, "HATCH" and
//! "Boundary Path Data"; angles of elliptic edges as in ezdxf.

use std::f64::consts::TAU;
use std::iter::Peekable;
use std::slice;

use super::affine3::{Affine3, Vector3};
use super::records::Record;
use super::shape::{Arc, Polyline, Shape, Spline, Vertex, plane};
use crate::pair_reader::Pair;

/// Distance between edges of a chain, as a share of their coordinates.
const CHAIN_GAP: f64 = 1e-6;

/// Flags of a boundary.
const IS_POLYLINE: i64 = 2;
const IS_AROUND_TEXT: i64 = 8;

/// The boundaries of a HATCH that no other entity draws; `None` if a group code is missing.
pub(super) fn hatch(record: &Record<'_>) -> Option<Shape> {
    let elevation = record.real(30).unwrap_or(0.0);
    let mut boundaries = Vec::new();
    let mut reader = BoundaryReader {
        record,
        pairs: record.pairs.iter().peekable(),
        plane: plane(record).after(&Affine3::translation(Vector3::new(0.0, 0.0, elevation))),
    };
    // The number of boundaries comes before the first.
    reader.int_after(91)?;
    while let Some(flags) = reader.next_of(92) {
        let mut shapes = match flags & IS_POLYLINE {
            0 => reader.edges()?,
            _ => vec![reader.polyline()?],
        };
        let is_drawn = reader.next_of(97).is_some_and(|sources| sources > 0);
        while reader.next_if(&[330]).is_some() {}
        if !is_drawn && flags & IS_AROUND_TEXT == 0 {
            boundaries.append(&mut shapes);
        }
    }
    match boundaries.len() {
        1 => boundaries.pop(),
        _ => Some(Shape::Lines(boundaries)),
    }
}

/// Reads the pairs of boundaries in sequence: codes have other meanings in each kind of edge.
struct BoundaryReader<'r, 'b> {
    record: &'r Record<'b>,
    pairs: Peekable<slice::Iter<'r, Pair<'b>>>,
    /// From the coordinates of boundaries to those of the drawing.
    plane: Affine3,
}

/// The numbers of an edge by code: the first of each, and all points.
struct Numbers {
    reals: Vec<(i32, f64)>,
}

impl Numbers {
    fn all(&self, code: i32) -> impl Iterator<Item = f64> {
        let reals = self.reals.iter();
        reals
            .filter(move |(c, _)| *c == code)
            .map(|(_, real)| *real)
    }

    fn first(&self, code: i32) -> Option<f64> {
        self.all(code).next()
    }

    fn points(&self, code: i32) -> Vec<Vector3> {
        let points = self.all(code).zip(self.all(code + 10));
        points.map(|(x, y)| Vector3::new(x, y, 0.0)).collect()
    }

    fn point(&self, code: i32) -> Option<Vector3> {
        self.points(code).first().copied()
    }

    /// The first angle and the sweep. Angles of a clockwise edge count clockwise.
    fn angles(&self, angle: impl Fn(f64) -> f64) -> Option<(f64, f64)> {
        let [start, end] = [self.first(50)?, self.first(51)?];
        let sense = match self.first(73) {
            Some(0.0) => -1.0,
            _ => 1.0,
        };
        let is_whole = (end - start).abs() >= 360.0 - 1e-9;
        let [start, end] = [start, end].map(|degrees| angle(sense * degrees.to_radians()));
        let sweep = (sense * (end - start)).rem_euclid(TAU);
        let is_whole = is_whole || sweep < 1e-9;
        Some((start, sense * if is_whole { TAU } else { sweep }))
    }
}

impl<'r, 'b> BoundaryReader<'r, 'b> {
    fn next_if(&mut self, codes: &[i32]) -> Option<&'r Pair<'b>> {
        self.pairs.next_if(|pair| codes.contains(&pair.code))
    }

    /// The integer of the next pair, if it has this code.
    fn next_of(&mut self, code: i32) -> Option<i64> {
        self.next_if(&[code])?.int()
    }

    /// The integer of the next pair with this code, and skips what is before it.
    fn int_after(&mut self, code: i32) -> Option<i64> {
        self.pairs.find(|pair| pair.code == code)?.int()
    }

    /// The numbers of the next pairs with any of these codes.
    fn numbers(&mut self, codes: &[i32]) -> Numbers {
        let mut reals = Vec::new();
        while let Some(pair) = self.next_if(codes) {
            reals.extend(self.record.real_of(pair).map(|real| (pair.code, real)));
        }
        Numbers { reals }
    }

    /// A boundary of straight and circular segments, always closed.
    fn polyline(&mut self) -> Option<Shape> {
        self.numbers(&[72, 73]);
        self.next_of(93)?;
        let mut vertices: Vec<Vertex> = Vec::new();
        while let Some(pair) = self.next_if(&[10, 20, 42]) {
            let number = self.record.real_of(pair)?;
            match (pair.code, vertices.last_mut()) {
                (10, _) => vertices.push(Vertex {
                    position: Vector3::new(number, 0.0, 0.0),
                    bulge: 0.0,
                }),
                (20, Some(last)) => last.position.y = number,
                (_, Some(last)) => last.bulge = number,
                (_, None) => return None,
            }
        }
        Some(self.closed(vertices))
    }

    fn closed(&self, mut vertices: Vec<Vertex>) -> Shape {
        // Some writers repeat the first corner at the end.
        let first = vertices.first().map(|first| first.position);
        let is_first = |last: &mut Vertex| Some(last.position) == first && last.bulge == 0.0;
        if vertices.len() > 1 {
            vertices.pop_if(is_first);
        }
        Shape::Polyline(Box::new(Polyline {
            plane: self.plane,
            vertices,
            is_closed: true,
        }))
    }

    /// A boundary of edges: one shape if all of them are lines and arcs, each of which begins where
    /// the one before it ends, else a shape per edge.
    fn edges(&mut self) -> Option<Vec<Shape>> {
        self.next_of(93)?;
        let mut vertices: Vec<Vertex> = Vec::new();
        let mut ends = Vec::new();
        let mut shapes = Vec::new();
        while let Some(kind) = self.next_of(72) {
            match kind {
                1 => {
                    let numbers = self.numbers(&[10, 20, 11, 21]);
                    let line = [numbers.point(10)?, numbers.point(11)?];
                    vertices.push(Vertex {
                        position: line[0],
                        bulge: 0.0,
                    });
                    ends.push(line[1]);
                    shapes.push(Shape::Line(line.map(|end| self.plane.point(end))));
                }
                2 => {
                    let numbers = self.numbers(&[10, 20, 40, 50, 51, 73]);
                    let (center, radius) = (numbers.point(10)?, numbers.first(40)?);
                    let (start, sweep) = numbers.angles(|angle| angle)?;
                    let at =
                        |angle: f64| center + Vector3::new(angle.cos(), angle.sin(), 0.0) * radius;
                    vertices.push(Vertex {
                        position: at(start),
                        bulge: (sweep / 4.0).tan(),
                    });
                    ends.push(at(start + sweep));
                    let [u, v] = [(radius, 0.0), (0.0, radius)];
                    shapes.push(self.arc(center, [u, v], start, sweep));
                }
                3 => shapes.push(self.ellipse()?),
                4 => shapes.push(self.spline()?),
                _ => return None,
            }
        }
        let starts = vertices.iter().map(|vertex| vertex.position);
        let next = starts.clone().skip(1).chain(starts.take(1));
        let meets = |(end, next): (&Vector3, Vector3)| {
            (next - *end).norm() <= CHAIN_GAP * (1.0 + end.norm())
        };
        // A bulge cannot be a whole circle.
        let is_chain = shapes.len() > 1 && ends.len() == shapes.len();
        match is_chain && ends.iter().zip(next).all(meets) {
            true => Some(vec![self.closed(vertices)]),
            false => Some(shapes),
        }
    }

    fn arc(&self, center: Vector3, axes: [(f64, f64); 2], start: f64, sweep: f64) -> Shape {
        let [u, v] = axes.map(|(x, y)| self.plane.direction(Vector3::new(x, y, 0.0)));
        Shape::Arc(Box::new(Arc {
            center: self.plane.point(center),
            u,
            v,
            start,
            sweep,
        }))
    }

    fn ellipse(&mut self) -> Option<Shape> {
        let numbers = self.numbers(&[10, 20, 11, 21, 40, 50, 51, 73]);
        let (center, major, ratio) = (numbers.point(10)?, numbers.point(11)?, numbers.first(40)?);
        // The file has angles seen from the center; the parameter is another one.
        let parameter = |angle: f64| (angle.sin() / ratio).atan2(angle.cos());
        let (start, sweep) = numbers.angles(parameter)?;
        let axes = [(major.x, major.y), (-major.y * ratio, major.x * ratio)];
        Some(self.arc(center, axes, start, sweep))
    }

    fn spline(&mut self) -> Option<Shape> {
        let degree = self.next_of(94)?;
        let head = self.numbers(&[73, 74, 95, 96]);
        let mut numbers = self.numbers(&[40, 10, 20, 42]);
        // Code 97 counts fit points here; after the last edge it counts sources of the boundary.
        let mut ahead = self.pairs.clone();
        let is_fit = ahead.next().is_some_and(|pair| pair.code == 97)
            && ahead
                .next()
                .is_some_and(|pair| matches!(pair.code, 11 | 12 | 72 | 97));
        if is_fit {
            self.next_of(97)?;
            numbers
                .reals
                .extend(self.numbers(&[11, 21, 12, 22, 13, 23]).reals);
        }
        let in_drawing = |code: i32| -> Vec<Vector3> {
            let points = numbers.points(code).into_iter();
            points.map(|point| self.plane.point(point)).collect()
        };
        let tangent = |code| Some(self.plane.direction(numbers.point(code)?));
        Some(Shape::Spline(Box::new(Spline {
            degree,
            knots: numbers.all(40).collect(),
            weights: numbers.all(42).collect(),
            points: in_drawing(10),
            fit_points: in_drawing(11),
            tangents: [tangent(12), tangent(13)],
            is_closed: head.first(74) == Some(1.0),
        })))
    }
}
