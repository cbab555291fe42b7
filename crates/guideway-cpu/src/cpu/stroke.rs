use std::ops::Range;

use guideway_spline::{Point, greater, lesser};

use super::LANES;
use super::canvas::{Canvas, Cuts, Part, TILE_PX, set_bits};
use super::disc::Disc;
use super::polylines::{Coordinate, Polylines, bits_below};
use super::span::{Capsule, Samples, Spans, phases, round};

/// Polylines as they lie in one tile of `C` columns of samples a pixel: in columns from its upper left corner.
pub(super) struct Placed<'a, T, const C: usize> {
    pub(super) lines: &'a Polylines<T>,
    pub(super) scale: f32,
    pub(super) offset: Point<f32>,
}

/// The rows of pixels of each line that have open blocks within its reach: a bit each.
pub(super) struct OpenRows {
    rows: [u32; LANES],
    /// Which lines have such a row, a bit each.
    pub(super) lines: u32,
}

/// Lines side by side, one a lane, all of one radius.
pub(super) struct Batch<const C: usize> {
    /// The end of lesser y, and the other.
    x: [[f32; LANES]; 2],
    y: [[f32; LANES]; 2],
    radius: f32,
}

/// What a capsule has beside its ends.
pub(super) struct Slopes {
    phases: [[i32; LANES]; 2],
    slope: [f32; LANES],
    half: [f32; LANES],
    lean: [f32; LANES],
}

/// The pixels that each line may touch: rows and columns, the last ones included.
pub(super) struct Boxes {
    first_row: [u32; LANES],
    last_row: [u32; LANES],
    first_column: [u32; LANES],
    last_column: [u32; LANES],
    /// All bits, or none if the line does not touch the tile.
    inside: [u32; LANES],
}

impl<'a, T, const C: usize> Placed<'a, T, C> {
    /// Kept lines, a unit of which is so many pixels, and whose middle lies so far from the corner.
    #[inline(always)]
    pub(super) fn kept(lines: &'a Polylines<T>, unit_px: f64, middle_px: Point<f64>) -> Self {
        let per_px = C as f64;
        Self {
            lines,
            scale: (unit_px * per_px) as f32,
            offset: (middle_px * per_px).to_f32(),
        }
    }

    /// Lines cut at the picture, in which the corner lies there.
    #[inline(always)]
    pub(super) fn cut(lines: &'a Polylines<T>, corner_px: Point<f64>) -> Self {
        let columns = C as f32;
        Self {
            lines,
            scale: columns,
            offset: corner_px.to_f32() * -columns,
        }
    }
}

impl<T: Coordinate, const C: usize> Placed<'_, T, C> {
    /// Adds the lines that begin at the vertices of `range` to the shape of a canvas.
    #[inline(always)]
    pub(super) fn stroke(&self, canvas: &mut Canvas<C>, range: Range<usize>, disc: &Disc<C>) {
        for first in range.clone().step_by(LANES) {
            let Some(batch) = self.batch(first, disc.radius) else {
                return;
            };
            let begins = self.lines.begin_bits(first) & bits_below(range.end - first);
            let boxes = batch.boxes();
            let open = boxes.open(canvas.open());
            let todo = begins & open.lines;
            if todo == 0 {
                continue;
            }
            let slopes = batch.slopes();
            for lane in set_bits(todo) {
                let part = boxes.part(lane % LANES, &open);
                batch.stroke(lane % LANES, &slopes, part, canvas, disc);
            }
        }
    }

    /// One vertex.
    #[inline(always)]
    pub(super) fn vertex(&self, vertex: usize) -> Point<f32> {
        let place = |v: T, offset: f32| Samples::<C>::snap(v.into() * self.scale) + offset;
        Point {
            x: place(self.lines.x[vertex], self.offset.x),
            y: place(self.lines.y[vertex], self.offset.y),
        }
    }

    #[inline(always)]
    fn batch(&self, first: usize, radius: f32) -> Option<Batch<C>> {
        let x = self.ends(&self.lines.x, first, self.offset.x)?;
        let y = self.ends(&self.lines.y, first, self.offset.y)?;
        Some(Batch::new(x, y, radius))
    }

    /// One coordinate of both ends of each line.
    #[inline(always)]
    fn ends(&self, of: &[T], first: usize, offset: f32) -> Option<[[f32; LANES]; 2]> {
        let starts: &[T; LANES] = of.get(first..)?.first_chunk()?;
        let ends: &[T; LANES] = of.get(first + 1..)?.first_chunk()?;
        // A loop: the closure of a map may be left out of line, and then without vectors.
        let mut placed = [[0.0; LANES]; 2];
        for i in 0..LANES {
            placed[0][i] = Samples::<C>::snap(starts[i].into() * self.scale) + offset;
            placed[1][i] = Samples::<C>::snap(ends[i].into() * self.scale) + offset;
        }
        Some(placed)
    }
}

impl<const C: usize> Batch<C> {
    /// Lines from their first ends to their second ones.
    #[inline(always)]
    pub(super) fn new(x: [[f32; LANES]; 2], y: [[f32; LANES]; 2], radius: f32) -> Self {
        let mut batch = Self { x, y, radius };
        for i in 0..LANES {
            let is_up = y[1][i] < y[0][i];
            batch.x[0][i] = choose(is_up, x[1][i], x[0][i]);
            batch.x[1][i] = choose(is_up, x[0][i], x[1][i]);
            batch.y[0][i] = lesser(y[0][i], y[1][i]);
            batch.y[1][i] = greater(y[0][i], y[1][i]);
        }
        batch
    }

    /// Adds what may be seen of one line to the shape of a canvas.
    #[inline(always)]
    pub(super) fn stroke(
        &self,
        lane: usize,
        slopes: &Slopes,
        part: Part,
        canvas: &mut Canvas<C>,
        disc: &Disc<C>,
    ) {
        canvas.stroke(&(&self.capsule(slopes, lane), disc), part);
    }

    #[inline(always)]
    fn capsule(&self, slopes: &Slopes, lane: usize) -> Capsule {
        Capsule {
            x: self.x.map(|x| x[lane]),
            y: self.y.map(|y| y[lane]),
            phases: slopes.phases.map(|phases| phases[lane]),
            slope: slopes.slope[lane],
            half: slopes.half[lane],
            lean: slopes.lean[lane],
        }
    }

    #[inline(always)]
    pub(super) fn boxes(&self) -> Boxes {
        let side = (TILE_PX * C) as f32;
        let mut boxes = Boxes {
            first_row: [0; LANES],
            last_row: [0; LANES],
            first_column: [0; LANES],
            last_column: [0; LANES],
            inside: [0; LANES],
        };
        for i in 0..LANES {
            let left = lesser(self.x[0][i], self.x[1][i]) - self.radius;
            let right = greater(self.x[0][i], self.x[1][i]) + self.radius;
            let top = self.y[0][i] - self.radius;
            let bottom = self.y[1][i] + self.radius;
            let is_inside = (right > 0.0) & (left < side) & (bottom > 0.0) & (top < side);
            boxes.inside[i] = if is_inside { u32::MAX } else { 0 };
            boxes.first_row[i] = pixel_at::<C>(top);
            boxes.last_row[i] = pixel_at::<C>(bottom);
            boxes.first_column[i] = pixel_at::<C>(left);
            boxes.last_column[i] = pixel_at::<C>(right);
        }
        boxes
    }

    #[inline(always)]
    pub(super) fn slopes(&self) -> Slopes {
        /// Lines less high than this, in columns, have no borders apart from their caps.
        const LEVEL: f32 = 1.0 / 64.0;
        let mut slopes = Slopes {
            phases: [[0; LANES]; 2],
            slope: [0.0; LANES],
            half: [0.0; LANES],
            lean: [0.0; LANES],
        };
        for i in 0..LANES {
            let (dx, dy) = (self.x[1][i] - self.x[0][i], self.y[1][i] - self.y[0][i]);
            let length = (dx * dx + dy * dy).sqrt();
            let height = greater(dy, LEVEL);
            slopes.slope[i] = dx / height;
            slopes.half[i] = Samples::<C>::snap(self.radius * length / height);
            let lean = Samples::<C>::snap(self.radius * dx / greater(length, LEVEL));
            slopes.lean[i] = choose(dy < LEVEL, f32::NAN, lean);
            slopes.phases[0][i] = phases::<C>(self.y[0][i]);
            slopes.phases[1][i] = phases::<C>(self.y[1][i]);
        }
        slopes
    }
}

impl<const C: usize> Cuts for (&Capsule, &Disc<C>) {
    #[inline(always)]
    fn width_px(&self) -> u32 {
        (2.0 / C as f32 * self.1.radius) as u32
    }

    #[inline(always)]
    fn pixels(&self, row: usize) -> u32 {
        self.0.pixels::<C>(self.1.radius, row)
    }

    #[inline(always)]
    fn spans(&self, row: usize) -> Spans {
        self.0.spans(self.1, row, (TILE_PX * C) as f32)
    }
}

/// The capsule around one line.
#[cfg(test)]
pub(super) fn capsule<const C: usize>(a: [f32; 2], b: [f32; 2], radius: f32) -> Capsule {
    let [x, y] = [0, 1].map(|axis| [[a[axis]; LANES], [b[axis]; LANES]]);
    let batch = Batch::<C>::new(x, y, radius);
    batch.capsule(&batch.slopes(), 0)
}

impl Boxes {
    /// From the first and the last row and column of each, and whether it touches the tile: -1 if it does.
    #[inline(always)]
    pub(super) fn new(
        rows: [[u16; LANES]; 2],
        columns: [[u16; LANES]; 2],
        inside: [i16; LANES],
    ) -> Self {
        let mut boxes = Self {
            first_row: [0; LANES],
            last_row: [0; LANES],
            first_column: [0; LANES],
            last_column: [0; LANES],
            inside: [0; LANES],
        };
        for i in 0..LANES {
            boxes.first_row[i] = rows[0][i].into();
            boxes.last_row[i] = rows[1][i].into();
            boxes.first_column[i] = columns[0][i].into();
            boxes.last_column[i] = columns[1][i].into();
            boxes.inside[i] = i32::from(inside[i]) as u32;
        }
        boxes
    }

    /// The part of a line that may cover samples of open blocks.
    #[inline(always)]
    pub(super) fn part(&self, lane: usize, open: &OpenRows) -> Part {
        let pixels = u32::MAX << self.first_column[lane]
            & u32::MAX >> (TILE_PX as u32 - 1 - self.last_column[lane]);
        Part {
            rows: open.rows[lane],
            pixels,
        }
    }

    /// Where lines may cover samples of blocks that are open.
    #[inline(always)]
    pub(super) fn open<const C: usize>(&self, open: &[u32; C]) -> OpenRows {
        let window_px = Canvas::<C>::WINDOW_PX as u32;
        let mut all = [0; LANES];
        let mut bits = [0; LANES];
        for i in 0..LANES {
            let rows =
                u32::MAX << self.first_row[i] & u32::MAX >> (TILE_PX as u32 - 1 - self.last_row[i]);
            let mut open_rows = 0;
            for (window, &open) in open.iter().enumerate() {
                let left = window as u32 * window_px;
                let is_touched =
                    (self.first_column[i] < left + window_px) & (self.last_column[i] >= left);
                open_rows |= if is_touched { open } else { 0 };
            }
            all[i] = open_rows & rows & self.inside[i];
            bits[i] = if all[i] != 0 { 1 << i } else { 0 };
        }
        OpenRows {
            rows: all,
            lines: bits.iter().fold(0, |all, bit| all | bit),
        }
    }
}

/// The pixel of the tile that is nearest to a position; one on a border may give that before it.
#[inline(always)]
fn pixel_at<const C: usize>(x: f32) -> u32 {
    round(x * (1.0 / C as f32) - 0.5, TILE_PX as f32 - 1.0)
}

/// As bits, for a choice of two values may become two stores.
#[inline(always)]
fn choose(is_first: bool, first: f32, second: f32) -> f32 {
    let mask = u32::from(is_first).wrapping_neg();
    f32::from_bits(first.to_bits() & mask | second.to_bits() & !mask)
}
