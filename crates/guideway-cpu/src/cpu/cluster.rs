use std::ops::Range;

use guideway_layout::{Hulls, RunPoints};
use guideway_scene::PathState;
use guideway_spline::{Bounds, Point, hilbert};
use rayon::prelude::*;

use super::LANES;
use super::canvas::{TILE_PX, set_bits};
use super::extent::ask_for;
use super::flatten::flatten;
use super::polylines::{Pen, Polylines, ROUNDS};
use super::shot::Shot;
use super::sight::Sight;
use super::simplify::{HEADS, Heads, MOST_POINTS, simplify};
use super::vectors::by_lane_width;

/// Paths, near each other, that are culled and kept together.
pub(super) const CLUSTER_PATHS: usize = 64;
/// Farthest from its middle, in units, that a cluster whose lines are kept may reach: rounding to `i16`
/// stays within.
pub(super) const MOST_UNITS: f64 = 32_000.0;

/// Paths of a cluster, a bit each.
pub(super) type Members = u64;
const _: () = assert!(CLUSTER_PATHS == Members::BITS as usize);

/// The lines that a cluster of paths was last drawn as.
#[derive(Debug, Default)]
pub(super) enum Lines {
    #[default]
    None,
    /// In units of so many metres from the middle of the cluster: good for every view of that unit.
    Kept(f64, Polylines<i16>),
    /// In pixels of one frame, cut where they leave the picture: of what is too large for the other.
    Cut(Polylines<f32>),
}

/// Buffers to make lines in.
#[derive(Default)]
pub(super) struct Scratch {
    kept: Polylines<i16>,
    /// What the cluster had before.
    before: Polylines<i16>,
    local: Vec<Point<f32>>,
    vertices: Vec<Point<f32>>,
    sources: Vec<Source>,
    heads: Heads,
    pixels: Vec<Point<f64>>,
}

/// What lines of a path are made from.
struct Source {
    round: usize,
    member: u8,
    /// The end of a run's points, or of those before.
    points_end: usize,
    /// Pieces that it and others behind it had before, and that are still good; none if its curve has changed.
    pieces: Range<usize>,
}

/// The order in which the paths of a cluster are drawn. They are sorted along a curve that fills the plane,
/// so with the bits of their numbers reversed the first spread over all of the cluster, and most of what
/// comes later is covered before.
fn spread_out(round: usize, paths: usize) -> impl Iterator<Item = usize> {
    let reversed = |i: usize| (usize::from((i as u8).reverse_bits()) * CLUSTER_PATHS) >> u8::BITS;
    // The more is covered by those before, the more are looked at together.
    const ENDS: [usize; ROUNDS + 1] = [0, 8, 16, 24, 36, CLUSTER_PATHS];
    let numbers = ENDS[round]..ENDS[round + 1];
    numbers.map(reversed).filter(move |&i| i < paths)
}

/// All rows, sorted so that near ones are near each other.
pub(super) fn sorted_rows(hulls: &Hulls) -> Vec<u32> {
    let Some(all) = hulls.all() else {
        return (0..hulls.len() as u32).collect();
    };
    let place = |hull: Bounds<f64>| u64::from(hilbert(hull.center(), all));
    let rows = (0..hulls.len()).into_par_iter();
    let keys = rows.map(|row| {
        let place = hulls.of([row]).map_or(u64::from(u32::MAX), place);
        place << 32 | row as u64
    });
    let mut keys: Vec<u64> = keys.collect();
    keys.par_sort_unstable();
    keys.par_iter().map(|&key| key as u32).collect()
}

impl Lines {
    /// Makes anew what a frame needs within some rows of tiles: the lines of some members, if those of the others
    /// can be kept.
    pub(super) fn make(
        &mut self,
        shot: &Shot<'_>,
        sight: &Sight,
        (paths, middle): (&[u32], Point<f64>),
        changed: Members,
        rows: &Range<usize>,
        scratch: &mut Scratch,
    ) {
        if sight.is_large {
            let mut lines = match std::mem::take(self) {
                Self::Cut(lines) => lines,
                Self::None | Self::Kept(..) => Polylines::default(),
            };
            scratch.cut(shot, paths, rows, &mut lines);
            *self = Self::Cut(lines);
            return;
        }
        let unit_m = shot.unit_m();
        scratch.before = match std::mem::take(self) {
            Self::Kept(_, lines) => lines,
            Self::None | Self::Cut(_) => Polylines::default(),
        };
        scratch.keep(shot, paths, changed, middle, unit_m);
        let mut lines = std::mem::take(&mut scratch.before);
        lines.copy_from(&scratch.kept);
        *self = Self::Kept(unit_m, lines);
    }

    /// Number of paths and of lines that may leave a mark on the picture.
    pub(super) fn count(&self, shot: &Shot<'_>, sight: &Sight) -> [u32; 2] {
        match self {
            Self::None => [0, 0],
            Self::Cut(lines) => lines.paths_and_lines(),
            Self::Kept(unit_m, lines) => {
                count(lines, &within_units(shot, sight.middle_px, *unit_m))
            }
        }
    }

    /// Number of paths and of lines.
    pub(super) fn paths_and_lines(&self) -> [u32; 2] {
        match self {
            Self::None => [0, 0],
            Self::Kept(_, lines) => lines.paths_and_lines(),
            Self::Cut(lines) => lines.paths_and_lines(),
        }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::None => 0,
            Self::Kept(_, lines) => lines.bytes(),
            Self::Cut(lines) => lines.bytes(),
        }
    }
}

/// Where centre lines leave a mark, in units from the middle of a cluster, y down.
fn within_units(shot: &Shot<'_>, middle: Point<f64>, unit_m: f64) -> Bounds<f32> {
    let per_px = 1.0 / (shot.view.px_per_m() * unit_m);
    let seen = shot.seen_px();
    Bounds {
        min: ((seen.min - middle) * per_px).to_f32(),
        max: ((seen.max - middle) * per_px).to_f32(),
    }
}

/// Paths and lines of the pieces within a box.
fn count(lines: &Polylines<i16>, within: &Bounds<f32>) -> [u32; 2] {
    let (mut drawn, mut made, mut last) = (0, 0, None);
    let pieces = 0..lines.pieces();
    for first in pieces.clone().step_by(LANES) {
        for lane in set_bits(lines.hit_bits(first, pieces.end, within)) {
            let piece = first + lane;
            made += lines.lines(piece) as u32;
            drawn += u32::from(last != Some(lines.member(piece)));
            last = Some(lines.member(piece));
        }
    }
    [drawn, made]
}

impl Scratch {
    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let points = self.local.capacity() + self.vertices.capacity();
        let own = points * size_of::<Point<f32>>()
            + self.sources.capacity() * size_of::<Source>()
            + self.pixels.capacity() * size_of::<Point<f64>>();
        self.kept.bytes() + own as u64
    }

    /// Lines of all paths that are shown, in units from `middle_m`: of members that have changed from their curves,
    /// of the others from what there was before.
    fn keep(
        &mut self,
        shot: &Shot<'_>,
        paths: &[u32],
        changed: Members,
        middle_m: Point<f64>,
        unit_m: f64,
    ) {
        let scene = shot.scene;
        let Self {
            kept,
            before,
            local,
            sources,
            ..
        } = self;
        kept.clear();
        let per_m = 1.0 / unit_m;
        let place = |p: Point<f64>| {
            Point::new((p.x - middle_m.x) * per_m, (middle_m.y - p.y) * per_m).to_f32()
        };
        let members = (0..paths.len()).filter(|member| changed >> member & 1 == 1);
        ask_for(scene, members.map(|member| paths[member] as usize));
        local.clear();
        sources.clear();
        let mut piece = 0;
        for round in 0..ROUNDS {
            for member in spread_out(round, paths.len()) {
                let first = piece;
                while piece < before.pieces() && usize::from(before.member(piece)) == member {
                    piece += 1;
                }
                let source = |points_end, pieces| Source {
                    round,
                    member: member as u8,
                    points_end,
                    pieces,
                };
                let path = paths[member];
                if changed >> member & 1 == 0 {
                    match sources.last_mut() {
                        // What lies side by side is kept at once.
                        Some(last)
                            if !last.pieces.is_empty()
                                && (last.round, last.pieces.end) == (round, first) =>
                        {
                            last.pieces.end = piece;
                        }
                        _ => sources.push(source(local.len(), first..piece)),
                    }
                } else if scene.state(path) == PathState::Shown {
                    for run in scene.layout().paths.geometry().runs(path as usize) {
                        match run {
                            RunPoints::F64(run) => local.extend(run.iter().map(|&p| place(p))),
                            RunPoints::F32(run) => {
                                local.extend(run.iter().map(|p| place(p.to_f64())));
                            }
                        }
                        sources.push(source(local.len(), 0..0));
                    }
                }
            }
        }
        local.resize(local.len() + MOST_POINTS, Point::default());
        simplify_by(shot.lane_width, self, shot.tolerance_units());
    }

    /// Lines within some rows of tiles, counted as those of all of the picture.
    fn cut(
        &mut self,
        shot: &Shot<'_>,
        paths: &[u32],
        rows: &Range<usize>,
        cut: &mut Polylines<f32>,
    ) {
        let pixels = &mut self.pixels;
        cut.clear();
        let (seen, reach) = (shot.seen_px(), shot.widest_px() + 1.0);
        let top = (rows.start * TILE_PX) as f64 - reach;
        let bottom = (rows.end * TILE_PX) as f64 + reach;
        let mut pen = Pen::new();
        let (mut drawn, mut made) = (0, 0);
        for (member, &path) in paths.iter().enumerate() {
            if shot.scene.state(path) != PathState::Shown {
                continue;
            }
            let before = made;
            for run in shot.scene.layout().paths.geometry().runs(path as usize) {
                pixels.clear();
                pixels.extend(run.iter().map(|p| shot.view.pixel_from_world(p)));
                let mut last = None;
                flatten(pixels, seen, &mut |start: Point<f64>, end: Point<f64>| {
                    made += 1;
                    if start.y.max(end.y) < top || start.y.min(end.y) > bottom {
                        return;
                    }
                    if last != Some(start) {
                        pen.lift(cut);
                        pen.set(member as u8, start.to_f32());
                    }
                    pen.draw(end.to_f32(), cut);
                    last = Some(end);
                });
                pen.lift(cut);
            }
            drawn += u32::from(made > before);
        }
        (0..ROUNDS).for_each(|round| cut.end_round(round));
        cut.finish();
        cut.set_paths_and_lines([drawn, made]);
    }
}

by_lane_width!(
    fn simplify_by(scratch: &mut Scratch, tolerance: f32)
    by simplify_all
);

/// Makes kept lines of all runs.
#[inline(always)]
fn simplify_all(scratch: &mut Scratch, tolerance: f32) {
    /// Adding this to a number of less than 16 bits rounds it to the nearest integer, in the low bits.
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    let Scratch {
        kept,
        before,
        local,
        sources,
        heads,
        vertices,
        ..
    } = scratch;
    let round = |x: f32| (x + ROUND).to_bits() as i16;
    let mut pen = Pen::new();
    let (mut first, mut ended) = (0, 0);
    for (i, source) in sources.iter().enumerate() {
        let head = i % HEADS;
        if head == 0 {
            let runs = sources[i..].iter().scan(first, |start, source| {
                let end = source.points_end;
                Some(std::mem::replace(start, end)..end)
            });
            heads.find(local, runs, tolerance);
        }
        (ended..source.round).for_each(|round| kept.end_round(round));
        ended = source.round;
        kept.push_pieces(before, source.pieces.clone());
        let points = source.points_end - first;
        let joints = heads.of(head);
        simplify(&local[first..], points, joints, tolerance, vertices);
        for (i, vertex) in vertices.iter().enumerate() {
            let vertex = Point {
                x: round(vertex.x),
                y: round(vertex.y),
            };
            if i == 0 {
                pen.set(source.member, vertex);
            } else {
                pen.draw(vertex, kept);
            }
        }
        pen.lift(kept);
        first = source.points_end;
    }
    (ended..ROUNDS).for_each(|round| kept.end_round(round));
    kept.finish();
}
