//! Fills the union of areas with one color: swept areas and floor plans below the paths.
//!
//! A sample counts once, however many areas cover it: 16 x 16 samples per pixel, one bit each,
//! as in the oracle. Bands of eight rows of pixels are independent, and threads share them.

use std::ops::Range;

use guideway_scene::Rgba;
use guideway_scene::{Frame, Strip, View};
use guideway_spline::Point;
use rayon::prelude::*;

/// Samples along each side of a pixel.
const SAMPLES: usize = 16;
/// Rows of pixels per band: the samples of a band fit in the cache.
const BAND_PX: usize = 8;
/// Samples per word.
const WORD: usize = u64::BITS as usize;

/// Areas, in meters, whose union is filled. Each is a list of contours: a point is inside if a ray
/// from it crosses them an odd number of times.
#[derive(Clone, Debug, Default)]
pub struct Areas {
    points: Vec<Point<f64>>,
    /// The end of each contour among the points.
    contours: Vec<usize>,
    /// The end of each area among the contours.
    ends: Vec<usize>,
}

impl Areas {
    /// Adds a polygon; its corners in either orientation.
    pub fn push(&mut self, corners: &[Point<f64>]) {
        self.push_outline([corners]);
    }

    /// Adds an area of contours, outer ones and holes.
    pub fn push_outline<'a>(&mut self, contours: impl IntoIterator<Item = &'a [Point<f64>]>) {
        for corners in contours {
            self.points.extend_from_slice(corners);
            self.contours.push(self.points.len());
        }
        self.ends.push(self.contours.len());
    }

    /// Number of areas.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns `true` if there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The contours of an area.
    fn outline(&self, area: usize) -> impl Iterator<Item = &[Point<f64>]> {
        let start = |ends: &[usize], i: usize| i.checked_sub(1).map_or(0, |before| ends[before]);
        let contours = start(&self.ends, area)..self.ends[area];
        contours.map(move |i| &self.points[start(&self.contours, i)..self.contours[i]])
    }
}

/// Composites areas over a strip of a picture; overlaps are filled once.
///
/// # Panics
/// If the size of `frame` is not that of the strip.
pub fn lay_areas(areas: &Areas, strip: &Strip, color: Rgba, frame: &mut Frame) {
    let (view, size) = (strip.view(), strip.size());
    assert_eq!(
        frame.size(),
        size,
        "the frame has to have the size of the strip"
    );
    let (width, height) = (size.width() as usize, size.height() as usize);
    let top_px = strip.rows().start as usize;
    let bands = bands(areas, view, top_px, height.div_ceil(BAND_PX));
    let rows = frame.pixels_mut().par_chunks_mut(width * BAND_PX);
    rows.enumerate()
        .zip(bands)
        .for_each(|((band, pixels), shown)| {
            if shown.is_empty() {
                return;
            }
            let mut samples = Samples::new(width, top_px + band * BAND_PX);
            let mut pixel_corners = Vec::new();
            for area in shown {
                for corners in areas.outline(area as usize) {
                    pixel_corners.clear();
                    pixel_corners.extend(corners.iter().map(|&p| view.pixel_from_world(p)));
                    samples.find_crossings(&pixel_corners);
                }
                samples.cover_between_crossings();
            }
            samples.composite(color, pixels);
        });
}

/// Per band, from a row of the view on, the areas that may cover its samples.
fn bands(areas: &Areas, view: &View, top_px: usize, count: usize) -> Vec<Vec<u32>> {
    let mut bands = vec![Vec::new(); count];
    for i in 0..areas.len() {
        let rows = areas
            .outline(i)
            .flatten()
            .map(|&p| (view.pixel_from_world(p).y - top_px as f64) / BAND_PX as f64);
        let (top, bottom) = rows.fold((f64::INFINITY, f64::NEG_INFINITY), |(top, bottom), y| {
            (top.min(y), bottom.max(y))
        });
        // Casts saturate; NaN gives 0.
        let (first, end) = (top.max(0.0) as usize, (bottom + 1.0).max(0.0) as usize);
        for band in &mut bands[first.min(count)..end.min(count).max(first.min(count))] {
            band.push(i as u32);
        }
    }
    bands
}

/// The samples of a band, one bit each.
struct Samples {
    width_px: usize,
    top_px: usize,
    words: usize,
    bits: Vec<u64>,
    /// Per row of samples, columns that are all set: areas of one vehicle mostly overlap.
    full: Vec<Range<usize>>,
    /// Per row of samples, where the contours of an area cross it.
    crossings: Vec<Vec<f64>>,
    /// The rows that contours of this area cross.
    crossed: Range<usize>,
}

/// Rows of samples of a band.
const ROWS: usize = BAND_PX * SAMPLES;
/// The rows of no contour; each edge extends it.
const NO_ROWS: Range<usize> = Range {
    start: ROWS,
    end: 0,
};

impl Samples {
    fn new(width_px: usize, top_px: usize) -> Self {
        let words = (width_px * SAMPLES).div_ceil(WORD);
        Self {
            width_px,
            top_px,
            words,
            bits: vec![0; words * ROWS],
            full: vec![0..0; ROWS],
            crossings: vec![Vec::new(); ROWS],
            crossed: NO_ROWS,
        }
    }

    /// Adds the crossings of a contour, in pixels, edge by edge.
    fn find_crossings(&mut self, corners: &[Point<f64>]) {
        let top_px = self.top_px as f64;
        let next = corners.iter().cycle().skip(1);
        for (a, b) in corners.iter().zip(next) {
            let of_edge = samples_between(a.y.min(b.y) - top_px, a.y.max(b.y) - top_px, ROWS);
            // The position of a row is rounded, so its neighbors are tested too.
            let of_edge = of_edge.start.saturating_sub(1)..(of_edge.end + 1).min(ROWS);
            for row in of_edge.clone() {
                let y = top_px + (row as f64 + 0.5) / SAMPLES as f64;
                if (a.y <= y) != (b.y <= y) {
                    let x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
                    self.crossings[row].push(x);
                }
            }
            self.crossed.start = self.crossed.start.min(of_edge.start);
            self.crossed.end = self.crossed.end.max(of_edge.end);
        }
    }

    /// Sets the samples between crossings, and removes these.
    fn cover_between_crossings(&mut self) {
        for row in std::mem::replace(&mut self.crossed, NO_ROWS) {
            let mut crossings = std::mem::take(&mut self.crossings[row]);
            crossings.sort_unstable_by(f64::total_cmp);
            for ends in crossings.chunks_exact(2) {
                let columns = samples_between(ends[0], ends[1], self.width_px * SAMPLES);
                self.mark_new(row, columns);
            }
            crossings.clear();
            self.crossings[row] = crossings;
        }
    }

    /// Sets columns of a row, except those known to be set.
    fn mark_new(&mut self, row: usize, columns: Range<usize>) {
        let full = self.full[row].clone();
        if columns.start > full.end || columns.end < full.start {
            if columns.len() > full.len() {
                self.full[row] = columns.clone();
            }
            return self.mark(row, columns);
        }
        self.full[row] = full.start.min(columns.start)..full.end.max(columns.end);
        self.mark(row, columns.start..full.start);
        self.mark(row, full.end..columns.end);
    }

    fn mark(&mut self, row: usize, columns: Range<usize>) {
        if columns.is_empty() {
            return;
        }
        let row = &mut self.bits[row * self.words..][..self.words];
        let (first, last) = (columns.start / WORD, (columns.end - 1) / WORD);
        let from = u64::MAX << (columns.start % WORD);
        let to = u64::MAX >> (WORD - 1 - (columns.end - 1) % WORD);
        if first == last {
            row[first] |= from & to;
        } else {
            row[first] |= from;
            row[first + 1..last].fill(u64::MAX);
            row[last] |= to;
        }
    }

    /// Composites the color over each pixel, weighted by its share of covered samples.
    fn composite(&self, color: Rgba, pixels: &mut [[u8; 4]]) {
        let mut covered = vec![0_u32; self.width_px];
        for (row, pixels) in pixels.chunks_exact_mut(self.width_px).enumerate() {
            covered.fill(0);
            let rows = self.bits[row * SAMPLES * self.words..].chunks_exact(self.words);
            for bits in rows.take(SAMPLES) {
                for (word, &bits) in bits.iter().enumerate().filter(|(_, bits)| **bits != 0) {
                    let pixels = covered[word * WORD / SAMPLES..].iter_mut();
                    for (i, covered) in pixels.take(WORD / SAMPLES).enumerate() {
                        let samples = bits >> (i * SAMPLES) & 0xFFFF;
                        *covered += samples.count_ones();
                    }
                }
            }
            for (pixel, &covered) in pixels.iter_mut().zip(&covered) {
                if covered > 0 {
                    let share = f64::from(covered) / (SAMPLES * SAMPLES) as f64;
                    *pixel = blend(*pixel, color, share);
                }
            }
        }
    }
}

/// The samples between two positions along an axis, in pixels; a sample is the center of its
/// square.
fn samples_between(from: f64, to: f64, count: usize) -> Range<usize> {
    let side = SAMPLES as f64;
    // Casts saturate.
    let first = (from * side - 0.5).ceil().max(0.0) as usize;
    let end = ((to * side - 0.5).floor() + 1.0).max(0.0) as usize;
    first..end.min(count)
}

/// Composites a color over a share of a pixel; both have straight alpha.
fn blend(below: [u8; 4], color: Rgba, share: f64) -> [u8; 4] {
    let [opacity, b] = [color.a, below[3]].map(|alpha| f64::from(alpha) / 255.0);
    let a = opacity * share;
    let shines = b * (1.0 - a);
    let alpha = a + shines;
    if alpha <= 0.0 {
        return below;
    }
    let mix = |above: u8, below: u8| (f64::from(above) * a + f64::from(below) * shines) / alpha;
    let [r, g, b] = [
        mix(color.r, below[0]),
        mix(color.g, below[1]),
        mix(color.b, below[2]),
    ];
    [r, g, b, alpha * 255.0].map(|v| v.round() as u8)
}

#[cfg(test)]
mod tests;
