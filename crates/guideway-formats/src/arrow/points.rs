use std::ops::Range;

use bytemuck::{Pod, cast_slice, cast_slice_mut, zeroed_vec};
use guideway_layout::{Geometry, Hulls, Limits, append_hulls};
use guideway_spline::{Bounds, Point, Real};
use rayon::prelude::*;

use super::polygons::{Coordinates, Fault, Polygons, all_within};
use crate::Problem;
use crate::input::Input;

/// So many points are read and gone through by one thread.
const AT_ONCE: usize = 1 << 14;

/// Of memory, as most systems have it.
const PAGE_BYTES: usize = 1 << 12;

/// The points of all paths that are drawn, in the precision of the file, and of the rows of a batch those of which that is not
/// known yet.
#[derive(Debug, Default)]
pub(super) enum Points {
    #[default]
    None,
    F32(Held<f32>),
    F64(Held<f64>),
}

#[derive(Debug)]
pub(super) struct Held<T> {
    /// Those taken, those brought, and room for more.
    points: Vec<Point<T>>,
    taken: usize,
    /// Where those brought begin, and which point of their batch the first of them is.
    brought: usize,
    first: usize,
    /// Where the runs lie, while each is a path.
    boxes: Vec<Bounds<T>>,
}

impl Points {
    /// With room for about so many points and rows.
    pub(super) fn with_room(of: &Coordinates, points: usize, rows: usize) -> Self {
        match of {
            Coordinates::F32(_) => Self::F32(Held::with_room(points, rows)),
            Coordinates::F64(_) => Self::F64(Held::with_room(points, rows)),
        }
    }

    /// Number of points that were taken.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::None => 0,
            Self::F32(held) => held.taken,
            Self::F64(held) => held.taken,
        }
    }

    /// Forgets all but the first ones.
    pub(super) fn truncate(&mut self, len: usize) {
        match self {
            Self::None => {}
            Self::F32(held) => held.taken = len,
            Self::F64(held) => held.taken = len,
        }
    }

    /// Brings the points of all rows of a batch, from the input if they were not read yet; gives the rows that cannot be drawn.
    pub(super) fn bring(
        &mut self,
        polygons: &Polygons,
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<Vec<(usize, Fault)>, Problem> {
        match (self, &polygons.coordinates) {
            (Self::F32(held), Coordinates::F32(c)) => held.bring(polygons, c, input, limits),
            (Self::F64(held), Coordinates::F64(c)) => held.bring(polygons, c, input, limits),
            // All batches of a file have one schema, and the first of them told the precision.
            _ => unreachable!("one schema, one precision"),
        }
    }

    /// Takes some of the points brought, which follow those that were taken before.
    pub(super) fn take(&mut self, range: Range<usize>) {
        match self {
            Self::None => {}
            Self::F32(held) => held.take(range),
            Self::F64(held) => held.take(range),
        }
    }

    /// Finds where the runs with these ends lie that have no boxes yet.
    pub(super) fn add_boxes(&mut self, ends: &[u32]) {
        match self {
            Self::None => {}
            Self::F32(held) => append_hulls(&mut held.boxes, &held.points[..held.taken], ends),
            Self::F64(held) => append_hulls(&mut held.boxes, &held.points[..held.taken], ends),
        }
    }

    /// Paths of one run each, which have these ends, and where they lie.
    pub(super) fn into_geometry(self, ends: Vec<u32>) -> (Geometry, Hulls) {
        match self {
            Self::None => (Geometry::default(), Vec::<Bounds<f32>>::new().into()),
            Self::F32(held) => {
                let (points, boxes) = held.into_parts();
                (Geometry::from_f32(points, ends), boxes.into())
            }
            Self::F64(held) => {
                let (points, boxes) = held.into_parts();
                (Geometry::from_f64(points, ends), boxes.into())
            }
        }
    }
}

impl<T: Real + Pod> Held<T> {
    fn with_room(points: usize, rows: usize) -> Self {
        Self {
            // Zeros that nobody looks at take no memory.
            points: zeroed_vec(points),
            taken: 0,
            brought: 0,
            first: 0,
            boxes: Vec::with_capacity(rows),
        }
    }

    fn bring(
        &mut self,
        polygons: &Polygons,
        coordinates: &[T],
        input: &Input<'_>,
        limits: &Limits,
    ) -> Result<Vec<(usize, Fault)>, Problem> {
        let range = polygons.range_of_rows(0..polygons.len());
        (self.brought, self.first) = (self.taken, range.start);
        let end = self.taken + range.len();
        if self.points.len() < end {
            self.points.resize(end, Point::default());
        }
        let brought = &mut self.points[self.brought..end];
        let parts = brought.par_chunks_mut(AT_ONCE).enumerate();
        let are_within = parts.map(|(part, points)| -> Result<bool, Problem> {
            let first = range.start + part * AT_ONCE;
            match polygons.left_out {
                Some(at) => {
                    // New pages cost less where the program asks for them than where the system does for it.
                    let pages = points.chunks_mut(PAGE_BYTES / size_of::<Point<T>>());
                    pages.for_each(|page| page[0] = Point::default());
                    input.read(at + first * size_of::<Point<T>>(), cast_slice_mut(points))?;
                }
                None => {
                    let there = first * 2..(first + points.len()) * 2;
                    points.copy_from_slice(cast_slice(&coordinates[there]));
                }
            }
            Ok(all_within(points, limits))
        });
        let are_within = are_within.try_reduce(|| true, |a, b| Ok(a & b))?;
        Ok(polygons.faults(brought, are_within, limits))
    }

    fn take(&mut self, range: Range<usize>) {
        let from = self.brought + range.start - self.first;
        let to = self.taken;
        self.taken += range.len();
        // Where no row is refused, they lie where they belong.
        if from != to {
            self.points.copy_within(from..from + range.len(), to);
        }
    }

    fn into_parts(mut self) -> (Vec<Point<T>>, Vec<Bounds<T>>) {
        self.points.truncate(self.taken);
        (self.points, self.boxes)
    }
}
