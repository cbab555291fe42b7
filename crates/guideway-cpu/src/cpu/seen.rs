use guideway_spline::{Bounds, Point};

use super::LANES;
use super::canvas::{Canvas, TILE_PX, set_bits};
use super::cluster::{CLUSTER_PATHS, Cluster, Lines};
use super::paint::{Band, Hit, Tile};
use super::polylines::{Coordinate, Polylines};
use super::span::Disc;
use super::stroke::Placed;

/// Tiles that a cluster covers from which on it pays to look at each of its pieces alone.
const WIDE_TILES: usize = 4;

/// A cluster, as one tile of `C` columns of samples a pixel sees it.
#[derive(Clone, Copy)]
pub(super) struct Seen<'a, const C: usize> {
    pub(super) band: &'a Band<'a>,
    pub(super) tile: &'a Tile,
    pub(super) number: u32,
}

impl<'a, const C: usize> Seen<'a, C> {
    fn cluster(&self) -> &'a Cluster {
        &self.band.clusters[self.number as usize]
    }

    /// Where kept lines lie.
    #[inline(always)]
    pub(super) fn placed<T>(&self, unit_m: f64, lines: &'a Polylines<T>) -> Placed<'a, T> {
        let sight = self.cluster().sight.as_ref();
        let middle_px = sight.map_or(Point::default(), |sight| sight.middle_px);
        let per_px = C as f64;
        Placed {
            lines,
            scale: (unit_m * self.band.shot.view.px_per_m() * per_px) as f32,
            offset: ((middle_px - self.tile.corner) * per_px).to_f32(),
        }
    }

    /// Where lines cut at the picture lie.
    #[inline(always)]
    pub(super) fn placed_cut<T>(&self, lines: &'a Polylines<T>) -> Placed<'a, T> {
        let columns = C as f32;
        Placed {
            lines,
            scale: columns,
            offset: self.tile.corner.to_f32() * -columns,
        }
    }

    /// Covers samples with the lines of one round.
    #[inline(always)]
    pub(super) fn solid<T: Coordinate>(
        &self,
        canvas: &mut Canvas<C>,
        disc: &mut Disc<C>,
        placed: &Placed<'_, T>,
        round: usize,
    ) {
        let pieces = placed.lines.round(round);
        let Some(sight) = self.cluster().sight.as_ref() else {
            return;
        };
        let corner = self.tile.corner.to_f32();
        let is_open = canvas.is_open(sight.reach_px.min - corner, sight.reach_px.max - corner);
        if pieces.is_empty() || !is_open {
            return;
        }
        let shot = self.band.shot;
        let is_wide = sight.columns.len() * sight.rows.len() > WIDE_TILES;
        match self.band.common_radius_px {
            Some(radius_px) if !is_wide => {
                disc.resize(columns::<C>(radius_px));
                placed.stroke(canvas, placed.lines.begins_of(pieces), disc);
            }
            common => {
                let within = self.within(placed);
                for first in pieces.clone().step_by(LANES) {
                    for lane in set_bits(placed.lines.hit_bits(first, pieces.end, &within)) {
                        let piece = first + lane;
                        let radius_px = match common {
                            Some(radius_px) => radius_px,
                            None => shot.radius_px(self.path_of(placed, piece)),
                        };
                        let begins = placed.lines.begins_of(piece..piece + 1);
                        disc.resize(columns::<C>(radius_px));
                        placed.stroke(canvas, begins, disc);
                    }
                }
            }
        }
    }

    /// Lists the pieces that may leave a mark on the tile.
    #[inline(always)]
    pub(super) fn gather(&self, hits: &mut Vec<Hit>) {
        match &self.cluster().lines {
            Lines::Kept(unit_m, lines) => self.gather_of(&self.placed(*unit_m, lines), hits),
            Lines::Cut(lines) => self.gather_of(&self.placed_cut(lines), hits),
            Lines::None => {}
        }
    }

    #[inline(always)]
    fn gather_of<T: Coordinate>(&self, placed: &Placed<'_, T>, hits: &mut Vec<Hit>) {
        let within = self.within(placed);
        let pieces = 0..placed.lines.pieces();
        for first in pieces.clone().step_by(LANES) {
            for lane in set_bits(placed.lines.hit_bits(first, pieces.end, &within)) {
                let piece = first + lane;
                let path = self.path_of(placed, piece);
                hits.push(Hit {
                    rank: self.band.ranks.map_or(path, |ranks| ranks[path as usize]),
                    cluster: self.number,
                    piece: piece as u32,
                });
            }
        }
    }

    /// Adds one piece to the shape.
    #[inline(always)]
    pub(super) fn piece(
        &self,
        canvas: &mut Canvas<C>,
        disc: &mut Disc<C>,
        piece: usize,
        path: u32,
    ) {
        disc.resize(columns::<C>(self.band.shot.radius_px(path)));
        match &self.cluster().lines {
            Lines::Kept(unit_m, lines) => {
                let begins = lines.begins_of(piece..piece + 1);
                self.placed(*unit_m, lines).stroke(canvas, begins, disc);
            }
            Lines::Cut(lines) => {
                let begins = lines.begins_of(piece..piece + 1);
                self.placed_cut(lines).stroke(canvas, begins, disc);
            }
            Lines::None => {}
        }
    }

    pub(super) fn path(&self, piece: usize) -> u32 {
        match &self.cluster().lines {
            Lines::Kept(_, lines) => self.member(lines.member(piece)),
            Lines::Cut(lines) => self.member(lines.member(piece)),
            Lines::None => 0,
        }
    }

    fn path_of<T: Coordinate>(&self, placed: &Placed<'_, T>, piece: usize) -> u32 {
        self.member(placed.lines.member(piece))
    }

    fn member(&self, member: u8) -> u32 {
        self.band.paths[self.number as usize * CLUSTER_PATHS + usize::from(member)]
    }

    /// What of the lines may leave a mark on the tile, in their own unit.
    #[inline(always)]
    fn within<T>(&self, placed: &Placed<'_, T>) -> Bounds<f32> {
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

fn columns<const C: usize>(px: f64) -> f32 {
    (px * C as f64) as f32
}
