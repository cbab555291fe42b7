use std::ops::Range;

use guideway_layout::RunPoints;
use guideway_scene::PathState;
use guideway_spline::{Bounds, Point};

use super::canvas::TILE_PX;
use super::flatten::flatten;
use super::joins::Links;
use super::joints::{Chain, Joints, Run};
use super::polylines::{Pen, Polylines, ROUNDS};
use super::shot::Shot;
use super::sight::Sight;
use super::simplify::Chords;
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
    /// In units of so many meters from the middle of the cluster: good for every view of that unit.
    Kept(f64, Polylines<i16>),
    /// In pixels of one frame, cut where they leave the picture: of what is too large for the other.
    Cut(Polylines<f32>),
}

/// Buffers to make lines in.
#[derive(Default)]
pub(super) struct Scratch {
    kept: Polylines<i16>,
    local: Vec<Point<f32>>,
    runs: Vec<Run>,
    joints: Joints,
    links: Links,
    chains: Vec<Chain>,
    chords: Chords,
    pixels: Vec<Point<f64>>,
}

/// Paths of a cluster in an order of which each beginning spreads over all of it: they are sorted along a curve that fills the
/// plane, so this reverses the bits of their numbers.
fn spread_out(paths: usize) -> impl Iterator<Item = usize> {
    let reversed = |i: usize| (usize::from((i as u8).reverse_bits()) * CLUSTER_PATHS) >> u8::BITS;
    let numbers = 0..CLUSTER_PATHS;
    numbers.map(reversed).filter(move |&i| i < paths)
}

impl Lines {
    /// Makes anew what a frame needs within some rows of tiles.
    pub(super) fn make(
        &mut self,
        shot: &Shot<'_>,
        sight: &Sight,
        (paths, middle): (&[u32], Point<f64>),
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
        let mut lines = match std::mem::take(self) {
            Self::Kept(_, lines) => lines,
            Self::None | Self::Cut(_) => Polylines::default(),
        };
        scratch.keep(shot, paths, middle, unit_m);
        lines.copy_from(&scratch.kept);
        *self = Self::Kept(unit_m, lines);
    }

    /// Number of paths and of lines that may leave a mark on the picture.
    pub(super) fn count(&self, shot: &Shot<'_>, sight: &Sight) -> [u32; 2] {
        match self {
            Self::None => [0, 0],
            Self::Cut(lines) => lines.paths_and_lines(),
            Self::Kept(unit_m, lines) => {
                let within = within_units(shot, sight.middle_px, *unit_m);
                let mut counts = [0, 0];
                count_within_by(shot.lane_width, lines, &within, &mut counts);
                counts
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

    /// Asks for them, so that whoever draws them soon does not wait.
    #[inline(always)]
    pub(super) fn ask_for(&self) {
        match self {
            Self::None => {}
            Self::Kept(_, lines) => lines.ask_for(),
            Self::Cut(lines) => lines.ask_for(),
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

by_lane_width!(
    fn count_within_by(lines: &Polylines<i16>, within: &Bounds<f32>, counts: &mut [u32; 2])
    by count_within
);

#[inline(always)]
fn count_within(lines: &Polylines<i16>, within: &Bounds<f32>, counts: &mut [u32; 2]) {
    *counts = lines.count_within(within);
}

/// Where center lines leave a mark, in units from the middle of a cluster, y down.
fn within_units(shot: &Shot<'_>, middle: Point<f64>, unit_m: f64) -> Bounds<f32> {
    let per_px = 1.0 / (shot.view.px_per_m() * unit_m);
    let seen = shot.seen_px();
    Bounds {
        min: ((seen.min - middle) * per_px).to_f32(),
        max: ((seen.max - middle) * per_px).to_f32(),
    }
}

impl Scratch {
    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let own = self.local.capacity() * size_of::<Point<f32>>()
            + self.runs.capacity() * size_of::<Run>()
            + self.chains.capacity() * size_of::<Chain>()
            + self.pixels.capacity() * size_of::<Point<f64>>();
        let lists = self.joints.bytes() + self.links.bytes() + self.chords.bytes();
        self.kept.bytes() + lists + own as u64
    }

    /// Lines of all paths that are shown, in units from `middle_m`.
    fn keep(&mut self, shot: &Shot<'_>, paths: &[u32], middle_m: Point<f64>, unit_m: f64) {
        let scene = shot.scene;
        let Self {
            kept, local, runs, ..
        } = self;
        kept.clear();
        let per_m = 1.0 / unit_m;
        let place = |p: Point<f64>| {
            Point::new((p.x - middle_m.x) * per_m, (middle_m.y - p.y) * per_m).to_f32()
        };
        local.clear();
        runs.clear();
        for member in spread_out(paths.len()) {
            let path = paths[member];
            if scene.state(path) != PathState::Shown {
                continue;
            }
            for run in scene.layout().paths.geometry().runs(path as usize) {
                let first = local.len();
                match run {
                    RunPoints::F64(run) => local.extend(run.iter().map(|&p| place(p))),
                    RunPoints::F32(run) => local.extend(run.iter().map(|p| place(p.to_f64()))),
                }
                runs.extend(Run::new(member, first..local.len()));
            }
        }
        simplify_by(shot.lane_width, self, shot.tolerance_units(), shot.joins());
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
                        pen.set(1 << member);
                        pen.draw(start.to_f32(), cut);
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
    fn simplify_by(scratch: &mut Scratch, tolerance: f32, joins: bool)
    by simplify_all
);

/// A number of less than 16 bits, rounded to the nearest integer.
#[inline(always)]
pub(super) fn round(x: f32) -> i16 {
    /// Adding this rounds it, in the lowest bits of the sum.
    const ROUND: f32 = 1.5 * (1 << 23) as f32;
    (x + ROUND).to_bits() as i16
}

/// Makes kept lines of all runs, those that go on from each other as one if they may be joined.
#[inline(always)]
fn simplify_all(scratch: &mut Scratch, tolerance: f32, joins: bool) {
    let Scratch {
        kept,
        local,
        runs,
        joints,
        links,
        chains,
        chords,
        ..
    } = scratch;
    joints.begin(local);
    links.find(runs, local, joins);
    links.chain((runs, local), joints, chains);
    joints.find_room(tolerance);
    chords.find(joints, chains);
    let mut pen = Pen::new();
    let mut ended = 0;
    for chain in chains {
        (ended..chain.round).for_each(|round| kept.end_round(round));
        ended = chain.round;
        pen.set(chain.members);
        chords.vertices(joints, &chain.joints, local, tolerance, |vertex| {
            let vertex = Point {
                x: round(vertex.x),
                y: round(vertex.y),
            };
            pen.draw(vertex, kept);
        });
        pen.lift(kept);
    }
    (ended..ROUNDS).for_each(|round| kept.end_round(round));
    kept.finish();
}
