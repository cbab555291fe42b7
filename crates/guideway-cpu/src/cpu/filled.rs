//! Pixels that strokes fill for certain, in a view and in those farther out.
//!
//! Where the scale grows, no stroke gets wider in the world. So what strokes a little thinner than those of a nearer view
//! fill is full in every view that comes no nearer, and need not be covered again as long as the scene stays.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use guideway_scene::{Style, View};
use guideway_spline::Point;

use super::canvas::{Rows, TILE_PX};
use super::shot::{Precision, Shot};
use super::tiles::Grid;
use super::vectors::{LaneWidth, by_lane_width};

/// A picture is found out about in so many bands of rows of tiles, one a frame.
const BANDS: usize = 4;
/// Frames that a band is to hold for, where the view comes nearer: until all others are found and have been of use.
const FRAMES: i32 = 2 * BANDS as i32;
/// A band that does not hold for so many more is found anew.
const FRAMES_AHEAD: i32 = 1;
/// How much nearer views may come, at most, for which it is found what is full: strokes of much nearer ones fill less.
const MOST_NEARER: f64 = 1.25;
/// What is found has to be so large a part of what is not empty, or it is not worth it.
const LEAST_OF_ALL: f64 = 0.5;
/// Half the width of the thinnest strokes that are looked at.
const LEAST_RADIUS_PX: f64 = 0.125;
/// Most pixels to one of a frame, along a side, that are looked up before they are worth finding anew.
const MOST_FINER: f64 = 1.5;
/// Least part of a band that is looked up before it is worth finding anew.
const LEAST_SHARE: f64 = 0.9;
/// What of the sides of a pixel is not looked up, in pixels of what is known: its margin holds for that.
const SIDE_PX: f64 = 1.0 / 64.0;
/// What is kept of each band, from one scale to the next: whoever zooms comes back.
const KEPT: usize = 16;
/// Bits of a word of pixels.
const WORD_PX: i64 = u32::BITS as i64;
/// Words of no pixels at the ends of a row, so that tiles that begin or end beyond read nothing else.
const PADDING: usize = 2;

/// What is known of a scene between its frames.
#[derive(Default)]
pub(super) struct Fills {
    /// What was found of each band last, in the order in which it was.
    bands: [Vec<Filled>; BANDS],
    /// The one that is looked at first when the next is found.
    next: usize,
    /// What the last frame saw.
    before: Option<Look>,
    /// Where it was not worth it.
    in_vain: Option<Look>,
    /// Memory for the next.
    spare: Vec<AtomicU32>,
}

/// Where a frame looks, and what its lines and strokes are made by.
#[derive(Clone, Copy)]
struct Look {
    view: View,
    style: Style,
    precision: Precision,
}

/// Pixels of a band of a view that are full in it, and wherever the world is seen no nearer than by a scale.
pub(super) struct Filled {
    band: usize,
    look: Look,
    /// How much nearer a view may come.
    pub(super) nearer: f64,
    /// Rows of tiles.
    pub(super) rows: Range<usize>,
    /// Words of a row of pixels, a bit a pixel.
    row_words: usize,
    words: Vec<AtomicU32>,
    /// How many pixels are not empty in the view, and full in all.
    counts: [AtomicU32; 2],
}

/// The bands that hold for a frame.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    bands: [Option<KnownBand<'a>>; BANDS],
}

#[derive(Clone, Copy)]
struct KnownBand<'a> {
    filled: &'a Filled,
    /// Its pixels, along a side, for one of the frame.
    finer: f64,
    /// Where the upper left corner of the frame lies among them.
    corner_px: Point<f64>,
}

impl Look {
    fn new(shot: &Shot<'_>) -> Self {
        Self {
            view: *shot.view,
            style: *shot.style,
            precision: shot.precision(),
        }
    }

    /// Whether the same lines are drawn, wherever they are seen from.
    fn is_alike(&self, other: &Self) -> bool {
        (self.style, self.precision) == (other.style, other.precision)
    }

    /// How many times as near another one is.
    fn nearer(&self, other: &Self) -> f64 {
        other.view.px_per_m() / self.view.px_per_m()
    }
}

/// Which of some rows of tiles are a band.
fn rows_of(band: usize, rows: usize) -> Range<usize> {
    rows * band / BANDS..rows * (band + 1) / BANDS
}

impl Fills {
    /// Knows nothing of the scene any more, only where it was not worth it.
    pub(super) fn forget(&mut self) {
        *self = Self {
            in_vain: self.in_vain,
            ..Self::default()
        };
    }

    pub(super) fn bytes(&self) -> u64 {
        let bands = self.bands.iter().flatten().map(Filled::bytes);
        bands.sum::<u64>() + size_of_val(&self.spare[..]) as u64
    }

    /// What a frame can look up, of what holds for views up to a scale: of each band what was found with the widest strokes.
    pub(super) fn known(&self, shot: &Shot<'_>, most_px_per_m: f64) -> Known<'_> {
        let rows = Grid::of(shot.strip).rows.len();
        let bands = std::array::from_fn(|band| {
            let rows = rows_of(band, rows);
            let known = self.known_of(band, shot, most_px_per_m);
            let rated = known.map(|known| {
                let width = 1.0 / known.filled.most_px_per_m();
                ((known.is_worth_it(shot, &rows), width), known)
            });
            let best = rated.reduce(|a, b| if b.0 > a.0 { b } else { a });
            best.map(|(_, known)| known)
        });
        Known { bands }
    }

    /// All that is known of a band, and holds for views up to a scale.
    fn known_of(
        &self,
        band: usize,
        shot: &Shot<'_>,
        most_px_per_m: f64,
    ) -> impl Iterator<Item = KnownBand<'_>> {
        let holds = move |found: &&Filled| found.most_px_per_m() >= most_px_per_m;
        let found = self.bands[band].iter().filter(holds);
        found.filter_map(|found| found.known(shot))
    }

    /// Where a frame is to find out what it fills for those after it: the next band that is not known, once the scene stays
    /// the same, unless the view comes nearer so fast that it would not hold for long.
    pub(super) fn plan(&mut self, shot: &Shot<'_>) -> Option<Filled> {
        let look = Look::new(shot);
        let before = self.before.replace(look)?;
        shot.solid?;
        let in_vain = self.in_vain.is_some_and(|there| there.is_alike(&look));
        if in_vain || !look.is_alike(&before) {
            return None;
        }
        let speed = before.nearer(&look).max(1.0);
        let nearer = speed.powi(FRAMES);
        // While it still holds, finding it anew does not cost covering all of it too.
        let ahead_px_per_m = shot.view.px_per_m() * speed.powi(FRAMES_AHEAD);
        let is_thin = || shot.thinner(nearer).thinnest_px() < LEAST_RADIUS_PX;
        if nearer > MOST_NEARER || is_thin() {
            return None;
        }
        let rows = Grid::of(shot.strip).rows.len();
        let band = (self.next..self.next + BANDS).map(|band| band % BANDS);
        let mut unknown = band.filter_map(|band| {
            let rows = rows_of(band, rows);
            let mut known = self.known_of(band, shot, ahead_px_per_m);
            let is_known = known.any(|known| known.is_worth_it(shot, &rows));
            (!is_known && !rows.is_empty()).then_some((band, rows))
        });
        let (band, rows) = unknown.next()?;
        self.next = band + 1;
        let spare = std::mem::take(&mut self.spare);
        Some(Filled::new(shot, nearer, (band, rows), spare))
    }

    /// Takes what a frame has found.
    pub(super) fn keep(&mut self, filled: Filled) {
        let [touched, full] = filled.counts.each_ref().map(|n| n.load(Ordering::Relaxed));
        let share = f64::from(full) / f64::from(touched.max(1));
        if share < LEAST_OF_ALL && touched > 0 {
            self.in_vain = Some(filled.look);
            self.bands = Default::default();
            return;
        }
        let band = &mut self.bands[filled.band];
        if band.len() == KEPT {
            self.spare = band.remove(0).words;
        }
        band.push(filled);
    }
}

impl Filled {
    fn new(
        shot: &Shot<'_>,
        nearer: f64,
        (band, rows): (usize, Range<usize>),
        mut words: Vec<AtomicU32>,
    ) -> Self {
        let row_words = Grid::of(shot.strip).columns + 2 * PADDING;
        words.clear();
        words.resize_with(row_words * rows.len() * TILE_PX, AtomicU32::default);
        Self {
            band,
            look: Look::new(shot),
            nearer,
            rows,
            row_words,
            words,
            counts: [0, 0].map(AtomicU32::new),
        }
    }

    /// The scale of the nearest view that it holds for.
    pub(super) fn most_px_per_m(&self) -> f64 {
        self.look.view.px_per_m() * self.nearer
    }

    fn bytes(&self) -> u64 {
        size_of_val(&self.words[..]) as u64
    }

    /// Bytes that what is known of so many pixels takes, about.
    pub(super) fn planned_bytes(pixels: usize) -> u64 {
        pixels.div_ceil(4) as u64
    }

    fn known(&self, shot: &Shot<'_>) -> Option<KnownBand<'_>> {
        let now = Look::new(shot);
        let finer = now.nearer(&self.look);
        let is_right = self.look.is_alike(&now) && 1.0 <= finer * self.nearer * (1.0 + 1e-9);
        // The pixels for a row of a tile fit in a word of 64 bits.
        let is_fine = (TILE_PX as f64 + 1.0) * finer < 63.0;
        let corner_m = shot.view.world_from_pixel(Point::default());
        let corner_px = self.look.view.pixel_from_world(corner_m);
        let above = Point::new(0.0, (self.rows.start * TILE_PX) as f64);
        (is_right && is_fine).then(|| KnownBand {
            filled: self,
            finer,
            corner_px: corner_px - above,
        })
    }

    /// Takes note of a whole tile: of how many pixels that are not empty, which are full for certain.
    pub(super) fn store(&self, corner: Point<f64>, touched: u32, full: &Rows) {
        let pixels = full.iter().map(|row| row.count_ones()).sum();
        for (count, pixels) in self.counts.iter().zip([touched, pixels]) {
            count.fetch_add(pixels, Ordering::Relaxed);
        }
        let column = corner.x as usize / TILE_PX + PADDING;
        let first_row = corner.y as usize - self.rows.start * TILE_PX;
        let rows = self.words.chunks_exact(self.row_words).skip(first_row);
        for (row, word) in rows.zip(full) {
            row[column].store(*word, Ordering::Relaxed);
        }
    }

    /// Sixty-four pixels of a row, from one of a word on.
    #[inline(always)]
    fn pixels(&self, row: usize, word: usize, shift: u32) -> u64 {
        let words = &self.words[row * self.row_words..][..self.row_words];
        let Some(words) = words.get(word..word + 3) else {
            return 0;
        };
        let bits = words.iter().rev().fold(0, |bits, word| {
            bits << WORD_PX | u128::from(word.load(Ordering::Relaxed))
        });
        (bits >> shift) as u64
    }
}

impl Known<'_> {
    /// Number of pixels of a picture that are full for certain.
    #[cfg(test)]
    pub(super) fn count(&self, shot: &Shot<'_>) -> u32 {
        let (side, grid) = (TILE_PX as f64, Grid::of(shot.strip));
        let rows = (grid.rows.clone()).flat_map(|y| (0..grid.columns).map(move |x| (x, y)));
        let tiles =
            rows.map(|(x, y)| self.tile(shot.lane_width, Point::new(x as f64, y as f64) * side));
        tiles.flatten().map(u32::count_ones).sum()
    }

    /// The pixels of a tile that are full for certain.
    pub(super) fn tile(&self, lane_width: LaneWidth, corner: Point<f64>) -> Rows {
        let mut full = [0; TILE_PX];
        add_full_by(lane_width, self, corner, &mut full);
        full
    }
}

by_lane_width!(
    fn add_full_by(known: &Known<'_>, corner: Point<f64>, full: &mut Rows)
    by add_full
);

#[inline(always)]
fn add_full(known: &Known<'_>, corner: Point<f64>, full: &mut Rows) {
    for band in known.bands.iter().flatten() {
        band.add_full(corner, full);
    }
}

impl KnownBand<'_> {
    /// Whether so much of some rows of tiles can be looked up, and so easily, that they are not worth finding anew.
    fn is_worth_it(&self, shot: &Shot<'_>, rows: &Range<usize>) -> bool {
        self.finer <= MOST_FINER && self.share(shot, rows) >= LEAST_SHARE
    }

    /// The part of some rows of tiles of a frame that can be looked up.
    fn share(&self, shot: &Shot<'_>, rows: &Range<usize>) -> f64 {
        let within = |first: f64, pixels: f64, own: f64| {
            let [start, end] = [first, first + pixels].map(|px| px * self.finer);
            let seen = end.min(own) - start.max(0.0);
            seen.max(0.0) / (end - start)
        };
        let size = shot.view.size();
        let [left, top] = [self.corner_px.x, self.corner_px.y].map(|px| px / self.finer);
        let top = top + (rows.start * TILE_PX) as f64;
        let own_width = f64::from(self.filled.look.view.size().width());
        let own_height = (self.filled.rows.len() * TILE_PX) as f64;
        within(left, f64::from(size.width()), own_width)
            * within(top, (rows.len() * TILE_PX) as f64, own_height)
    }

    /// Adds the pixels of a tile of which all that is looked up is full.
    #[inline(always)]
    fn add_full(&self, corner: Point<f64>, full: &mut Rows) {
        let left = self.corner_px.x + corner.x * self.finer;
        let top = self.corner_px.y + corner.y * self.finer;
        let rows = (self.filled.rows.len() * TILE_PX) as i64;
        let first_bit = left.floor() as i64 + PADDING as i64 * WORD_PX;
        let is_beside = top >= rows as f64 || top + TILE_PX as f64 * self.finer <= 0.0;
        if first_bit < 0 || is_beside {
            return;
        }
        let (word, shift) = (first_bit / WORD_PX, first_bit % WORD_PX);
        let mut needed = [0_u64; TILE_PX];
        for (x, needed) in needed.iter_mut().enumerate() {
            let [first, last] = self.looked_up(left - left.floor(), x);
            *needed = (2 << last) - (1 << first);
        }
        for (y, full) in full.iter_mut().enumerate() {
            let [first, last] = self.looked_up(top, y);
            if first < 0 || last >= rows {
                continue;
            }
            let mut there = u64::MAX;
            for row in first..=last {
                there &= self
                    .filled
                    .pixels(row as usize, word as usize, shift as u32);
            }
            for (x, needed) in needed.iter().enumerate() {
                *full |= u32::from(there & needed == *needed) << x;
            }
        }
    }

    /// The first and the last pixel that lie in one of the frame, along a side of a tile that begins at a place.
    #[inline(always)]
    fn looked_up(&self, start: f64, pixel: usize) -> [i64; 2] {
        let from = start + pixel as f64 * self.finer;
        let first = (from + SIDE_PX).floor() as i64;
        let last = (from + self.finer - SIDE_PX).floor() as i64;
        [first, last.max(first)]
    }
}
