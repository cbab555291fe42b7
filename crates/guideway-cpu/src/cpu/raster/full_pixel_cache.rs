//! Full-pixel cache: finds pixels that stay full while the view zooms in. Later frames skip them.
//!
//! Stroke widths in meters never grow with the scale. Pixels that are full with the strokes of a
//! more magnified view, inset by a margin, are full in every view up to that scale, until an edit.
//!
//! ```text
//!   frame 0   band 0 probed         the picture is probed in four bands, one per frame;
//!   frame 1   band 1 probed         a result is valid until the other bands are probed, and for
//!   ...                             as many frames again
//! ```

use std::ops::Range;
use std::sync::atomic::{AtomicU32, Ordering};

use guideway_scene::{Style, View};
use guideway_spline::Point;

use crate::cpu::ground::damage::TileGrid;
use crate::cpu::ground::frame_context::{FrameContext, LineCacheKey};
use crate::cpu::ground::simd::{SimdLevel, simd_dispatch};
use crate::cpu::ground::tile::{PixelRows, TILE_PX};

/// Bands of a picture: one is probed per frame.
const BANDS: usize = 4;
/// Frames for which the result of a band stays valid while the view zooms in. Derived: four frames
/// to probe all bands, four frames of use.
const FRAMES: i32 = 2 * BANDS as i32;
/// A band whose result is valid for fewer frames is probed again.
const FRAMES_AHEAD: i32 = 1;
/// Largest zoom factor over those frames: inset strokes of nearer views fill too little.
const MAX_ZOOM: f64 = 1.25;
/// Least share of full pixels among the touched ones; below, probing costs more than it saves. D1
/// in strokes of 3 px is above, in strokes of 1.5 px below: `guideway bench d1 --methods cpu
/// --motion zoom --width-px 1.5`.
const MIN_FULL_SHARE: f64 = 0.5;
/// Least half width of inset strokes, in pixels.
const MIN_RADIUS_PX: f64 = 0.125;
/// Most pixels of a band per pixel of a frame, along a side, before it is probed again.
const MAX_RESOLUTION: f64 = 1.5;
/// Least visible share of a band before it is probed again.
const MIN_VISIBLE_SHARE: f64 = 0.9;
/// Rim of a pixel that the look-up leaves out, in pixels of the band. The inset of strokes allows
/// for it.
const SIDE_PX: f64 = 1.0 / 64.0;
/// Results held per band, of different scales: a zoom often comes back.
const BANDS_KEPT: usize = 16;
/// Pixels per word.
const WORD_PX: i64 = u32::BITS as i64;
/// Empty words at either end of a row, so that look-ups beyond the picture find no pixel.
const PADDING: usize = 2;

/// The bands that were probed, and the state of the probes.
#[derive(Default)]
pub(crate) struct FullPixelCache {
    /// Results of each band, in the order in which they were found.
    bands: [Vec<FullPixelBand>; BANDS],
    /// The band that is considered first for the next probe.
    next: usize,
    /// Key of the last frame.
    before: Option<BandKey>,
    /// Key of a view for which probing was not worth it.
    rejected: Option<BandKey>,
    /// Memory for the next result.
    spare: Vec<AtomicU32>,
}

/// A view, and what decides its lines and strokes.
#[derive(Clone, Copy)]
struct BandKey {
    view: View,
    style: Style,
    cache_key: LineCacheKey,
}

/// The full pixels of a band: full in its view and in all views up to a scale.
pub(crate) struct FullPixelBand {
    band: usize,
    key: BandKey,
    /// Largest zoom factor, relative to its view, up to which they are full.
    pub(crate) max_zoom: f64,
    /// Rows of tiles.
    pub(crate) rows: Range<usize>,
    /// Words per row of pixels, one bit per pixel.
    row_words: usize,
    words: Vec<AtomicU32>,
    /// Number of touched pixels in the view, and of full ones in all views.
    counts: [AtomicU32; 2],
}

/// The results that are valid for a frame: one per band.
#[derive(Clone, Copy)]
pub(crate) struct FullPixelLookup<'a> {
    bands: [Option<BandLookup<'a>>; BANDS],
}

#[derive(Clone, Copy)]
struct BandLookup<'a> {
    found: &'a FullPixelBand,
    /// Pixels of the band per pixel of the frame, along a side.
    resolution: f64,
    /// Upper left corner of the frame, in pixels of the band.
    corner_px: Point<f64>,
}

impl BandKey {
    fn new(ctx: &FrameContext<'_>) -> Self {
        Self {
            view: *ctx.view,
            style: *ctx.style,
            cache_key: ctx.cache_key(),
        }
    }

    /// Returns `true` if both views draw the same lines with the same style.
    fn is_alike(&self, other: &Self) -> bool {
        (self.style, self.cache_key) == (other.style, other.cache_key)
    }

    /// Zoom factor from this view to another.
    fn zoom(&self, other: &Self) -> f64 {
        other.view.px_per_m() / self.view.px_per_m()
    }
}

/// The rows of tiles of a band.
fn rows_of(band: usize, rows: usize) -> Range<usize> {
    rows * band / BANDS..rows * (band + 1) / BANDS
}

impl FullPixelCache {
    /// Removes all results, but remembers the view in which probing was not worth it.
    pub(crate) fn forget(&mut self) {
        *self = Self {
            rejected: self.rejected,
            ..Self::default()
        };
    }

    pub(crate) fn bytes(&self) -> u64 {
        let bands = self.bands.iter().flatten().map(FullPixelBand::bytes);
        bands.sum::<u64>() + size_of_val(&self.spare[..]) as u64
    }

    /// The results that are valid for a frame and all views up to `max_px_per_m`, one per band:
    /// preferably one that needs no new probe, then the one with the widest strokes.
    pub(crate) fn lookup(&self, ctx: &FrameContext<'_>, max_px_per_m: f64) -> FullPixelLookup<'_> {
        let rows = TileGrid::of(ctx.strip).rows.len();
        let bands = std::array::from_fn(|band| {
            let rows = rows_of(band, rows);
            let lookup = self.lookups_of(band, ctx, max_px_per_m);
            let rated = lookup.map(|lookup| {
                let width = 1.0 / lookup.found.max_px_per_m();
                ((lookup.is_worth_it(ctx, &rows), width), lookup)
            });
            let best = rated.reduce(|a, b| if b.0 > a.0 { b } else { a });
            best.map(|(_, lookup)| lookup)
        });
        FullPixelLookup { bands }
    }

    /// All results of a band that are valid for a frame and all views up to `max_px_per_m`.
    fn lookups_of(
        &self,
        band: usize,
        ctx: &FrameContext<'_>,
        max_px_per_m: f64,
    ) -> impl Iterator<Item = BandLookup<'_>> {
        let holds = move |found: &&FullPixelBand| found.max_px_per_m() >= max_px_per_m;
        let found = self.bands[band].iter().filter(holds);
        found.filter_map(|found| found.lookup(ctx))
    }

    /// Plans a probe: the next band without a result, once the scene is unchanged between two
    /// frames. `None` if the view zooms in too fast for results to last, or strokes are too thin.
    pub(crate) fn plan(&mut self, ctx: &FrameContext<'_>) -> Option<FullPixelBand> {
        let key = BandKey::new(ctx);
        let before = self.before.replace(key)?;
        ctx.solid?;
        let is_rejected = self.rejected.is_some_and(|there| there.is_alike(&key));
        if is_rejected || !key.is_alike(&before) {
            return None;
        }
        let speed = before.zoom(&key).max(1.0);
        let zoom = speed.powi(FRAMES);
        // Probing a band while its result still holds saves covering its pixels twice.
        let ahead_px_per_m = ctx.view.px_per_m() * speed.powi(FRAMES_AHEAD);
        let is_thin = || ctx.with_inset_strokes(zoom).min_radius_px() < MIN_RADIUS_PX;
        if zoom > MAX_ZOOM || is_thin() {
            return None;
        }
        let rows = TileGrid::of(ctx.strip).rows.len();
        let band = (self.next..self.next + BANDS).map(|band| band % BANDS);
        let mut unknown = band.filter_map(|band| {
            let rows = rows_of(band, rows);
            let mut lookup = self.lookups_of(band, ctx, ahead_px_per_m);
            let is_known = lookup.any(|lookup| lookup.is_worth_it(ctx, &rows));
            (!is_known && !rows.is_empty()).then_some((band, rows))
        });
        let (band, rows) = unknown.next()?;
        self.next = band + 1;
        let spare = std::mem::take(&mut self.spare);
        Some(FullPixelBand::new(ctx, zoom, (band, rows), spare))
    }

    /// Stores the result of a probe.
    pub(crate) fn store(&mut self, found: FullPixelBand) {
        let [touched, full] = found.counts.each_ref().map(|n| n.load(Ordering::Relaxed));
        let share = f64::from(full) / f64::from(touched.max(1));
        if share < MIN_FULL_SHARE && touched > 0 {
            self.rejected = Some(found.key);
            self.bands = Default::default();
            return;
        }
        let band = &mut self.bands[found.band];
        if band.len() == BANDS_KEPT {
            self.spare = band.remove(0).words;
        }
        band.push(found);
    }
}

impl FullPixelBand {
    fn new(
        ctx: &FrameContext<'_>,
        zoom: f64,
        (band, rows): (usize, Range<usize>),
        mut words: Vec<AtomicU32>,
    ) -> Self {
        let row_words = TileGrid::of(ctx.strip).columns + 2 * PADDING;
        words.clear();
        words.resize_with(row_words * rows.len() * TILE_PX, AtomicU32::default);
        Self {
            band,
            key: BandKey::new(ctx),
            max_zoom: zoom,
            rows,
            row_words,
            words,
            counts: [0, 0].map(AtomicU32::new),
        }
    }

    /// Scale of the nearest view for which it holds.
    pub(crate) fn max_px_per_m(&self) -> f64 {
        self.key.view.px_per_m() * self.max_zoom
    }

    fn bytes(&self) -> u64 {
        size_of_val(&self.words[..]) as u64
    }

    /// Estimate of the heap bytes of a band of a picture.
    pub(crate) fn planned_bytes(pixels: usize) -> u64 {
        pixels.div_ceil(4) as u64
    }

    fn lookup(&self, ctx: &FrameContext<'_>) -> Option<BandLookup<'_>> {
        let now = BandKey::new(ctx);
        let resolution = now.zoom(&self.key);
        let is_right = self.key.is_alike(&now) && 1.0 <= resolution * self.max_zoom * (1.0 + 1e-9);
        // A row of the look-up of a tile has to fit in 64 bits.
        let is_fine = (TILE_PX as f64 + 1.0) * resolution < 63.0;
        let corner_m = ctx.view.world_from_pixel(Point::default());
        let corner_px = self.key.view.pixel_from_world(corner_m);
        let above = Point::new(0.0, (self.rows.start * TILE_PX) as f64);
        (is_right && is_fine).then(|| BandLookup {
            found: self,
            resolution,
            corner_px: corner_px - above,
        })
    }

    /// Stores the full pixels of a tile, with the number of touched ones.
    pub(crate) fn store(&self, corner: Point<f64>, touched: u32, full: &PixelRows) {
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

    /// 64 pixels of a row, from a bit of a word on.
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

impl FullPixelLookup<'_> {
    /// Number of pixels of a picture that are known to be full.
    #[cfg(test)]
    pub(crate) fn count(&self, ctx: &FrameContext<'_>) -> u32 {
        let (side, grid) = (TILE_PX as f64, TileGrid::of(ctx.strip));
        let rows = (grid.rows.clone()).flat_map(|y| (0..grid.columns).map(move |x| (x, y)));
        let tiles = rows.map(|(x, y)| self.tile(ctx.simd, Point::new(x as f64, y as f64) * side));
        tiles.flatten().map(u32::count_ones).sum()
    }

    /// The pixels of a tile that are known to be full.
    pub(crate) fn tile(&self, simd: SimdLevel, corner: Point<f64>) -> PixelRows {
        let mut full = [0; TILE_PX];
        add_full_by(simd, self, corner, &mut full);
        full
    }
}

simd_dispatch!(
    fn add_full_by(lookup: &FullPixelLookup<'_>, corner: Point<f64>, full: &mut PixelRows)
    by add_full
);

#[inline(always)]
fn add_full(lookup: &FullPixelLookup<'_>, corner: Point<f64>, full: &mut PixelRows) {
    for band in lookup.bands.iter().flatten() {
        band.add_full(corner, full);
    }
}

impl BandLookup<'_> {
    /// Returns `true` if it covers enough of some rows of tiles, finely enough, not to be probed
    /// again.
    fn is_worth_it(&self, ctx: &FrameContext<'_>, rows: &Range<usize>) -> bool {
        self.resolution <= MAX_RESOLUTION && self.share(ctx, rows) >= MIN_VISIBLE_SHARE
    }

    /// The share of some rows of tiles of a frame that lies within the band.
    fn share(&self, ctx: &FrameContext<'_>, rows: &Range<usize>) -> f64 {
        let within = |first: f64, pixels: f64, own: f64| {
            let [start, end] = [first, first + pixels].map(|px| px * self.resolution);
            let seen = end.min(own) - start.max(0.0);
            seen.max(0.0) / (end - start)
        };
        let size = ctx.view.size();
        let [left, top] = [self.corner_px.x, self.corner_px.y].map(|px| px / self.resolution);
        let top = top + (rows.start * TILE_PX) as f64;
        let own_width = f64::from(self.found.key.view.size().width());
        let own_height = (self.found.rows.len() * TILE_PX) as f64;
        within(left, f64::from(size.width()), own_width)
            * within(top, (rows.len() * TILE_PX) as f64, own_height)
    }

    /// Adds the pixels of a tile whose look-up finds only full pixels.
    #[inline(always)]
    fn add_full(&self, corner: Point<f64>, full: &mut PixelRows) {
        let left = self.corner_px.x + corner.x * self.resolution;
        let top = self.corner_px.y + corner.y * self.resolution;
        let rows = (self.found.rows.len() * TILE_PX) as i64;
        let first_bit = left.floor() as i64 + PADDING as i64 * WORD_PX;
        let is_beside = top >= rows as f64 || top + TILE_PX as f64 * self.resolution <= 0.0;
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
                there &= self.found.pixels(row as usize, word as usize, shift as u32);
            }
            for (x, needed) in needed.iter().enumerate() {
                *full |= u32::from(there & needed == *needed) << x;
            }
        }
    }

    /// First and last pixel of the band within a pixel of the frame, along one axis, for a tile
    /// that begins at `start`.
    #[inline(always)]
    fn looked_up(&self, start: f64, pixel: usize) -> [i64; 2] {
        let from = start + pixel as f64 * self.resolution;
        let first = (from + SIDE_PX).floor() as i64;
        let last = (from + self.resolution - SIDE_PX).floor() as i64;
        [first, last.max(first)]
    }
}
