//! Flattens the curves of a path, clips them to a tile with its buffer, and encodes them as the
//! commands of vector tiles.

use guideway_layout::RunPoints;
use guideway_spline::{Bounds, Point, flatten_run};

use super::extent::{BUFFER_SHARE, EXTENT};
use super::message::zigzag;
use crate::descent::segment_hull;

/// Largest distance of a line from its curve by flattening, in units of the tile.
const TOLERANCE: f64 = 1.0;
/// Commands of a geometry.
const MOVE_TO: u32 = 1;
const LINE_TO: u32 = 2;

/// The lines of one path in a tile.
pub(super) struct TileLines {
    /// Upper left corner of the tile.
    corner: Point<f64>,
    units_per_m: f64,
    /// The tile with its buffer, in units.
    clip_box: Bounds<f64>,
    /// Control points of consecutive segments, in units.
    points: Vec<Point<f64>>,
    /// Vertices of all lines, and the first one of each line.
    vertices: Vec<[i32; 2]>,
    starts: Vec<usize>,
    commands: Vec<u32>,
    is_in_tile: bool,
}

impl TileLines {
    /// Lines in the tile of a square.
    pub(super) fn new(square: Bounds<f64>) -> Self {
        let extent = f64::from(EXTENT);
        let buffer = extent * BUFFER_SHARE;
        let mut lines = Self {
            corner: Point::default(),
            units_per_m: 1.0,
            clip_box: Bounds {
                min: Point::new(-buffer, -buffer),
                max: Point::new(extent + buffer, extent + buffer),
            },
            points: Vec::new(),
            vertices: Vec::new(),
            starts: Vec::new(),
            commands: Vec::new(),
            is_in_tile: false,
        };
        lines.begin(square);
        lines
    }

    /// Goes on to the tile of another square.
    pub(super) fn begin(&mut self, square: Bounds<f64>) {
        self.corner = Point::new(square.min.x, square.max.y);
        self.units_per_m = f64::from(EXTENT) / square.size().x;
    }

    /// Removes all lines.
    pub(super) fn clear(&mut self) {
        self.vertices.clear();
        self.starts.clear();
        self.is_in_tile = false;
    }

    /// Returns `true` if a curve meets the tile, even if it is too small for a line.
    pub(super) fn is_in_tile(&self) -> bool {
        self.is_in_tile
    }

    /// Appends the part of a run that meets the tile.
    pub(super) fn push(&mut self, run: RunPoints<'_>) {
        let (corner, units_per_m, clip_box) = (self.corner, self.units_per_m, self.clip_box);
        let unit = |p: Point<f64>| {
            let from_corner = (p - corner) * units_per_m;
            Point::new(from_corner.x, -from_corner.y)
        };
        let is_met = |segment: &[Point<f64>; 4]| segment_hull(segment).intersects(clip_box);
        let mut points = std::mem::take(&mut self.points);
        points.clear();
        points.extend(run.iter().map(unit));
        if points.iter().all(|p| clip_box.contains(*p)) {
            self.flatten(&points);
            self.points = points;
            return;
        }
        points.clear();
        for p in run.iter().map(unit) {
            points.push(p);
            // Behind the last segment that meets the tile, and before the next one.
            if points.last_chunk().is_some_and(|segment| !is_met(segment)) {
                let count = points.len();
                if count > 4 {
                    self.flatten(&points[..count - 1]);
                }
                points.drain(..count - 3);
            }
        }
        if points.len() >= 4 {
            self.flatten(&points);
        }
        self.points = points;
    }

    fn flatten(&mut self, points: &[Point<f64>]) {
        let mut last = None;
        flatten_run(points, TOLERANCE, &mut |vertex| {
            if let Some(last) = last.replace(vertex)
                && let Some(line) = clip(last, vertex, self.clip_box)
            {
                self.push_line(line);
            }
        });
    }

    /// Appends a line, which continues the last one if it begins at its end.
    fn push_line(&mut self, line: [Point<f64>; 2]) {
        self.is_in_tile = true;
        let [start, end] = line.map(|p| [nearest(p.x), nearest(p.y)]);
        let is_joined = self.vertices.last() == Some(&start);
        if start == end {
            return;
        }
        if !is_joined {
            self.starts.push(self.vertices.len());
            self.vertices.push(start);
        }
        self.vertices.push(end);
    }

    /// The commands of all lines; `None` without lines.
    pub(super) fn commands(&mut self) -> Option<&[u32]> {
        self.commands.clear();
        let mut from = [0, 0];
        let starts = self.starts.iter().copied();
        let ends = starts.clone().skip(1).chain([self.vertices.len()]);
        for (start, end) in starts.zip(ends) {
            for (i, &vertex) in self.vertices[start..end].iter().enumerate() {
                let command = |id: u32, count: usize| id | (count as u32) << 3;
                match i {
                    0 => self.commands.push(command(MOVE_TO, 1)),
                    1 => self.commands.push(command(LINE_TO, end - start - 1)),
                    _ => {}
                }
                let step = |axis: usize| i64::from(vertex[axis]) - i64::from(from[axis]);
                let step = [step(0), step(1)].map(|step| zigzag(step) as u32);
                self.commands.extend(step);
                from = vertex;
            }
        }
        (!self.commands.is_empty()).then_some(&self.commands)
    }
}

/// The whole number nearest to a small one. Processors without an instruction for rounding make
/// [`f64::round`] a call.
fn nearest(number: f64) -> i32 {
    (number + 0.5_f64.copysign(number)) as i32
}

/// Clips a line to a box (Liang and Barsky 1984).
fn clip(a: Point<f64>, b: Point<f64>, within: Bounds<f64>) -> Option<[Point<f64>; 2]> {
    if within.contains(a) && within.contains(b) {
        return Some([a, b]);
    }
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    let along = b - a;
    for (start, step, min, max) in [
        (a.x, along.x, within.min.x, within.max.x),
        (a.y, along.y, within.min.y, within.max.y),
    ] {
        if step == 0.0 {
            if start < min || start > max {
                return None;
            }
        } else {
            let (t0, t1) = ((min - start) / step, (max - start) / step);
            from = from.max(t0.min(t1));
            to = to.min(t0.max(t1));
        }
    }
    let start = if from > 0.0 { a + along * from } else { a };
    let end = if to < 1.0 { a + along * to } else { b };
    (from <= to).then_some([start, end])
}
