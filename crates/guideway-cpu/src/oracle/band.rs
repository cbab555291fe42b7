//! Samples of a band of the picture: composites chords over them, and averages them to pixels.

use guideway_scene::Rgba;
use guideway_spline::{Bounds, Point};

use super::stroke::Stroke;

/// Samples along each side of a pixel.
const SIDE: usize = 16;
const SAMPLES_PER_PIXEL: usize = SIDE * SIDE;

/// Some rows of pixels with all their samples.
pub(super) struct Band {
    bounds_px: Bounds<f64>,
    columns: usize,
    rows: usize,
    background: Rgba,
    samples: Vec<Sample>,
    /// Per pixel, the halves that its samples count, summed over paths.
    halves: Vec<u64>,
}

#[derive(Clone, Copy)]
struct Sample {
    /// Red, green and blue times opacity, then opacity: 0 to 255.
    over: [f32; 4],
    /// Number of the last path that covered it, 0 for none: a path that crosses itself covers it
    /// once.
    covered_by: u32,
}

impl Band {
    /// Bytes per pixel.
    pub(super) const BYTES_PER_PIXEL: u64 =
        (SAMPLES_PER_PIXEL * size_of::<Sample>() + size_of::<u64>()) as u64;

    /// A band of `rows` rows of pixels that shows the background.
    pub(super) fn new(first_row: u32, rows: u32, width: u32, background: Rgba) -> Self {
        let pixels = rows as usize * width as usize;
        let empty = Sample {
            over: premultiplied(background),
            covered_by: 0,
        };
        let [top, bottom, right] = [first_row, first_row + rows, width].map(f64::from);
        Self {
            bounds_px: Bounds {
                min: Point::new(0.0, top),
                max: Point::new(right, bottom),
            },
            columns: width as usize * SIDE,
            rows: rows as usize * SIDE,
            background,
            samples: vec![empty; pixels * SAMPLES_PER_PIXEL],
            halves: vec![0; pixels],
        }
    }

    pub(super) fn bounds_px(&self) -> Bounds<f64> {
        self.bounds_px
    }

    pub(super) fn heap_bytes(&self) -> usize {
        self.samples.capacity() * size_of::<Sample>() + self.halves.capacity() * size_of::<u64>()
    }

    /// Composites a path over every sample within its radius of the line from `start` to `end` that
    /// it, as path number `order`, has not covered yet.
    pub(super) fn cover(
        &mut self,
        start: Point<f64>,
        end: Point<f64>,
        stroke: &Stroke,
        order: u32,
    ) {
        let ink = premultiplied(stroke.color);
        let shows_through = 1.0 - f32::from(stroke.color.a) / 255.0;
        let radius_px = stroke.radius_px;
        let square = radius_px * radius_px;
        let along = end - start;
        let length_squared = along.dot(along);
        let origin = self.bounds_px.min;
        let low = Point::new(start.x.min(end.x), start.y.min(end.y)) - origin;
        let high = Point::new(start.x.max(end.x), start.y.max(end.y)) - origin;
        let (first_row, last_row) = samples_between(low.y, high.y, radius_px, self.rows);
        let (first_column, last_column) = samples_between(low.x, high.x, radius_px, self.columns);

        for row in first_row..last_row {
            for column in first_column..last_column {
                let sample = &mut self.samples[row * self.columns + column];
                // Most samples: chords are shorter than strokes are wide.
                if sample.covered_by == order {
                    continue;
                }
                let at = origin + Point::new(position(column), position(row));
                let from_start = at - start;
                // Nearest point of the line; a line without length is a point.
                let fraction = if length_squared > 0.0 {
                    (from_start.dot(along) / length_squared).clamp(0.0, 1.0)
                } else {
                    0.0
                };
                let apart = from_start - along * fraction;
                if apart.dot(apart) <= square {
                    sample.covered_by = order;
                    for (below, ink) in sample.over.iter_mut().zip(ink) {
                        *below = ink + *below * shows_through;
                    }
                    let ends = stroke.ends_px.iter().flatten();
                    let near = ends.filter(|end| (at - **end).dot(at - **end) <= square);
                    self.halves[row / SIDE * (self.columns / SIDE) + column / SIDE] +=
                        2 - near.count() as u64;
                }
            }
        }
    }

    /// Writes the mean color of each pixel, rounded to nearest.
    pub(super) fn write_colors(&self, pixels: &mut [[u8; 4]]) {
        let width = self.columns / SIDE;
        for (index, pixel) in pixels.iter_mut().enumerate() {
            let (row, column) = (index / width * SIDE, index % width * SIDE);
            let mut sum = [0.0; 4];
            for y in row..row + SIDE {
                let line = &self.samples[y * self.columns + column..][..SIDE];
                for sample in line {
                    for (sum, channel) in sum.iter_mut().zip(sample.over) {
                        *sum += f64::from(channel);
                    }
                }
            }
            *pixel = straight(sum.map(|s| s / SAMPLES_PER_PIXEL as f64), self.background);
        }
    }

    /// Writes the mean number of paths that cover each pixel.
    pub(super) fn write_counts(&self, counts: &mut [f32]) {
        for (count, &halves) in counts.iter_mut().zip(&self.halves) {
            *count = (halves as f64 / (2 * SAMPLES_PER_PIXEL) as f64) as f32;
        }
    }
}

/// Position of a sample along an axis, in pixels from the corner of the band.
fn position(index: usize) -> f64 {
    (index as f64 + 0.5) / SIDE as f64
}

/// The samples from `low - radius` to `high + radius`, and at most two more.
fn samples_between(low_px: f64, high_px: f64, radius_px: f64, count: usize) -> (usize, usize) {
    let first = ((low_px - radius_px) * SIDE as f64 - 0.5).floor();
    let end = ((high_px + radius_px) * SIDE as f64 - 0.5).ceil() + 1.0;
    let held = |index: f64| index.clamp(0.0, count as f64) as usize;
    (held(first), held(end))
}

fn premultiplied(color: Rgba) -> [f32; 4] {
    let opacity = f32::from(color.a) / 255.0;
    [
        f32::from(color.r) * opacity,
        f32::from(color.g) * opacity,
        f32::from(color.b) * opacity,
        f32::from(color.a),
    ]
}

/// Converts to straight alpha. A transparent pixel takes the color of the background.
fn straight([r, g, b, a]: [f64; 4], background: Rgba) -> [u8; 4] {
    if a == 0.0 {
        return [background.r, background.g, background.b, 0];
    }
    [r * 255.0 / a, g * 255.0 / a, b * 255.0 / a, a].map(|channel| channel.round() as u8)
}
