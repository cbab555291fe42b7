use std::ops::Range;

use guideway_spline::{Bounds, Point};

use super::LANES;
use super::canvas::{Canvas, TILE_PX, set_bits};
use super::cluster::Lines;
use super::crossings::Crossing;
use super::disc::{Disc, Discs};
use super::fixed::Fixed;
use super::paint::{Band, Tile};
use super::polylines::{Coordinate, Polylines};
use super::sight::Sight;
use super::span::SOLID;
use super::stroke::Placed;

/// Tiles that a cluster covers from which on it pays to look at each of its pieces alone.
const WIDE_TILES: usize = 4;

/// A piece that may leave a mark on a tile.
pub(super) struct Hit {
    pub(super) rank: u32,
    /// Key of the cluster's sight.
    pub(super) key: u32,
    pub(super) piece: u32,
}

/// What is drawn of a cluster at once.
#[derive(Clone)]
pub(super) enum Share<'a> {
    /// Rounds that follow each other.
    Rounds(Range<usize>),
    /// What crosses the tile.
    Crossings(&'a [Crossing]),
}

/// A cluster, as one tile of `C` columns of samples a pixel sees it.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a, const C: usize> {
    band: &'a Band<'a>,
    tile: &'a Tile,
    sight: &'a Sight,
}

impl<'a, const C: usize> Seen<'a, C> {
    #[inline(always)]
    pub(super) fn new(band: &'a Band<'a>, tile: &'a Tile, key: u32) -> Self {
        let sight = band.sights.get(key);
        Self { band, tile, sight }
    }

    #[inline(always)]
    pub(super) fn lines(&self) -> &'a Lines {
        &self.band.index.lines[self.sight.cluster as usize]
    }

    /// Where kept lines lie.
    #[inline(always)]
    pub(super) fn placed<T>(&self, unit_m: f64, lines: &'a Polylines<T>) -> Placed<'a, T, C> {
        let unit_px = unit_m * self.band.shot.view.px_per_m();
        Placed::kept(lines, unit_px, self.sight.middle_px - self.tile.corner)
    }

    /// Where lines cut at the picture lie.
    #[inline(always)]
    pub(super) fn placed_cut<T>(&self, lines: &'a Polylines<T>) -> Placed<'a, T, C> {
        Placed::cut(lines, self.tile.corner)
    }

    /// Lists the pieces that may leave a mark on the tile.
    #[inline(always)]
    pub(super) fn gather(&self, key: u32, hits: &mut Vec<Hit>) {
        match self.lines() {
            Lines::Kept(unit_m, lines) => self.gather_of(&self.placed(*unit_m, lines), key, hits),
            Lines::Cut(lines) => self.gather_of(&self.placed_cut(lines), key, hits),
            Lines::None => {}
        }
    }

    #[inline(always)]
    fn gather_of<T: Coordinate>(&self, placed: &Placed<'_, T, C>, key: u32, hits: &mut Vec<Hit>) {
        let within = self.within(placed);
        let pieces = 0..placed.lines.pieces();
        for first in pieces.clone().step_by(LANES) {
            for lane in set_bits(placed.lines.hit_bits(first, pieces.end, &within)) {
                let piece = first + lane;
                hits.push(self.hit(placed.lines, key, piece as u32));
            }
        }
    }

    /// Lists the piece of lines that cross the tile.
    #[inline(always)]
    pub(super) fn add(&self, crossing: &Crossing, hits: &mut Vec<Hit>) {
        let Crossing { key, piece, .. } = *crossing;
        match self.lines() {
            Lines::Kept(_, lines) => hits.push(self.hit(lines, key, piece)),
            Lines::Cut(lines) => hits.push(self.hit(lines, key, piece)),
            Lines::None => {}
        }
    }

    #[inline(always)]
    fn hit<T: Coordinate>(&self, lines: &Polylines<T>, key: u32, piece: u32) -> Hit {
        let path = self.path(lines.member(piece as usize));
        let ranks = self.band.index.ranks.as_ref();
        let rank = ranks.map_or(path, |ranks| ranks[path as usize]);
        Hit { rank, key, piece }
    }

    /// The path of a member of the cluster.
    #[inline(always)]
    pub(super) fn path(&self, member: usize) -> u32 {
        self.band.index.paths_of(self.sight.cluster)[member]
    }

    /// What of the lines may leave a mark on the tile, in their own unit.
    #[inline(always)]
    fn within<T>(&self, placed: &Placed<'_, T, C>) -> Bounds<f32> {
        let reach = columns::<C>(self.band.widest_px + 1.0 / 16.0);
        let side = (TILE_PX * C) as f32;
        let per_column = 1.0 / placed.scale;
        let least = Point::new(-reach, -reach) - placed.offset;
        let most = Point::new(side + reach, side + reach) - placed.offset;
        Bounds {
            min: least * per_column,
            max: most * per_column,
        }
    }
}

impl<'a> Seen<'a, SOLID> {
    /// Where kept lines lie in whole numbers, if the cluster is small.
    #[inline(always)]
    fn fixed(&self, unit_m: f64, lines: &'a Polylines<i16>) -> Option<Fixed<'a>> {
        let unit_px = unit_m * self.band.shot.view.px_per_m();
        let middle_px = self.sight.middle_px - self.tile.corner;
        (self.sight.is_small).then(|| Fixed::new(lines, unit_px, middle_px))
    }

    /// Half the stroke width of a piece, in columns.
    #[inline(always)]
    fn radius<T: Coordinate>(&self, placed: &Placed<'_, T, SOLID>, piece: usize) -> f32 {
        let own_px = || (self.band.shot).radius_px(self.path(placed.lines.member(piece)));
        columns::<SOLID>(self.band.common_radius_px.unwrap_or_else(own_px))
    }

    /// Covers samples with a share of the lines, all of one opaque color.
    #[inline(always)]
    pub(super) fn solid(
        &self,
        canvas: &mut Canvas<SOLID>,
        discs: &mut Discs<SOLID>,
        share: Share<'_>,
    ) {
        let corner = self.tile.corner.to_f32();
        let reach_px = self.sight.reach_px;
        if !canvas.is_open(reach_px.min - corner, reach_px.max - corner) {
            return;
        }
        match self.lines() {
            Lines::Kept(unit_m, lines) => {
                self.solid_of(
                    canvas,
                    discs,
                    &self.placed(*unit_m, lines),
                    share,
                    self.fixed(*unit_m, lines),
                );
            }
            // Where a line was cut changes with the view.
            Lines::Cut(_) if self.band.shot.thinner_than.is_some() => {}
            Lines::Cut(lines) => {
                self.solid_of(canvas, discs, &self.placed_cut(lines), share, None);
            }
            Lines::None => {}
        }
    }

    #[inline(always)]
    fn solid_of<T: Coordinate>(
        &self,
        canvas: &mut Canvas<SOLID>,
        discs: &mut Discs<SOLID>,
        placed: &Placed<'_, T, SOLID>,
        share: Share<'_>,
        fixed: Option<Fixed<'_>>,
    ) {
        let rounds = match share {
            Share::Rounds(rounds) => rounds,
            Share::Crossings(crossings) => {
                for crossing in crossings {
                    let disc = discs.of(self.radius(placed, crossing.piece as usize));
                    let [start, end] = crossing.begins.map(|vertex| vertex as usize);
                    cover(placed, &fixed, canvas, start..end, disc);
                }
                return;
            }
        };
        let pieces = placed.lines.of_rounds(rounds);
        if pieces.is_empty() {
            return;
        }
        let is_wide = self.sight.columns().len() * self.sight.rows().len() > WIDE_TILES;
        match self.band.common_radius_px {
            Some(radius_px) if !is_wide => {
                let disc = discs.of(columns::<SOLID>(radius_px));
                let begins = placed.lines.begins_of(pieces);
                cover(placed, &fixed, canvas, begins, disc);
            }
            _ => {
                let within = self.within(placed);
                for first in pieces.clone().step_by(LANES) {
                    for lane in set_bits(placed.lines.hit_bits(first, pieces.end, &within)) {
                        let piece = first + lane;
                        let begins = placed.lines.begins_of(piece..piece + 1);
                        let disc = discs.of(self.radius(placed, piece));
                        cover(placed, &fixed, canvas, begins, disc);
                    }
                }
            }
        }
    }
}

/// Asks for the lines of the cluster behind one of a tile's, to be drawn next: clusters lie anywhere in memory.
#[inline(always)]
pub(super) fn ask_for_next(band: &Band<'_>, clusters: &[u32], drawn: usize) {
    if let Some(&next) = clusters.get(drawn + 1) {
        let sight = band.sights.get(next);
        band.index.lines[sight.cluster as usize].ask_for();
    }
}

/// Covers samples with the lines that begin at some vertices.
#[inline(always)]
fn cover<T: Coordinate>(
    placed: &Placed<'_, T, SOLID>,
    fixed: &Option<Fixed<'_>>,
    canvas: &mut Canvas<SOLID>,
    begins: Range<usize>,
    disc: &Disc<SOLID>,
) {
    match fixed {
        Some(fixed) => fixed.stroke(canvas, begins, disc),
        None => placed.stroke(canvas, begins, disc),
    }
}

#[inline(always)]
pub(super) fn columns<const C: usize>(px: f64) -> f32 {
    (px * C as f64) as f32
}
