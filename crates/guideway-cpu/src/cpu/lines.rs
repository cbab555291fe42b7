use std::sync::atomic::{AtomicU64, Ordering};

use guideway_layout::RunPoints;
use guideway_render::{Cancel, RenderError, Style, View};
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use super::bin::Grid;
use super::cull::cluster_paths;
use super::flatten::flatten;

/// A straight piece of a path, in pixels.
#[derive(Clone, Copy)]
pub(super) struct Line {
    pub(super) start: Point<f32>,
    pub(super) end: Point<f32>,
    /// Row of the path in the layout.
    pub(super) path: u32,
}

/// One scene, as one frame sees it.
#[derive(Clone, Copy)]
pub(super) struct Shot<'a> {
    pub(super) scene: &'a Scene,
    pub(super) view: &'a View,
    pub(super) style: &'a Style,
    pub(super) cancel: &'a Cancel,
}

impl Shot<'_> {
    /// Half the stroke width of a path.
    pub(super) fn radius_px(&self, path: u32) -> f64 {
        let width_m = self.scene.width_m(path);
        self.style
            .line_rule
            .radius_px(width_m, self.view.px_per_m())
    }

    /// Where a path of some radius leaves a mark. A pixel is added so that the caps of lines that are cut
    /// there stay out of sight.
    pub(super) fn seen(&self, radius_px: f64) -> Bounds<f64> {
        let size = self.view.size();
        let corner = Point::new(f64::from(size.width()), f64::from(size.height()));
        let picture = Bounds {
            min: Point::default(),
            max: corner,
        };
        picture.inflated(radius_px + 1.0)
    }

    /// Calls `emit` with all lines of a path that may leave a mark. `points` is a buffer to be kept.
    pub(super) fn flatten(
        &self,
        path: u32,
        points: &mut Vec<Point<f64>>,
        mut emit: impl FnMut(Line, f32),
    ) {
        let radius_px = self.radius_px(path);
        let seen = self.seen(radius_px);
        let mut emit = |start: Point<f64>, end: Point<f64>| {
            let line = Line {
                start: start.to_f32(),
                end: end.to_f32(),
                path,
            };
            emit(line, radius_px as f32);
        };
        let pixel = |p| self.view.pixel_from_world(p);
        for run in self.scene.layout().paths.geometry().runs(path as usize) {
            points.clear();
            match run {
                RunPoints::F64(run) => points.extend(run.iter().map(|&p| pixel(p))),
                RunPoints::F32(run) => points.extend(run.iter().map(|p| pixel(p.to_f64()))),
            }
            flatten(points, seen, &mut emit);
        }
    }
}

/// Lines of clusters that are next to each other, in draw order.
#[derive(Default)]
struct Group {
    lines: Vec<Line>,
    drawn: u64,
    made: u64,
    points: Vec<Point<f64>>,
}

/// All lines of a band of the picture, in draw order: one group after the other.
#[derive(Default)]
pub(super) struct Lines {
    groups: Vec<Group>,
    /// Number of the first line of each group.
    firsts: Vec<u32>,
}

/// There is more than the memory allowed.
pub(super) struct TooMuch;

impl Lines {
    /// Share of the lines by which a full group grows: more wastes memory, less wastes time.
    const GROWTH: usize = 4;

    /// Bytes that lines hold at most, room to grow included.
    pub(super) fn bytes_for(lines: u64) -> u64 {
        let bytes = lines * size_of::<Line>() as u64;
        bytes + bytes / Self::GROWTH as u64
    }

    /// Flattens the paths of `clusters`, in groups so that threads can work beside each other, and keeps
    /// the lines that may leave a mark within the grid.
    pub(super) fn fill(
        &mut self,
        shot: &Shot<'_>,
        clusters: &[u32],
        groups: usize,
        grid: &Grid,
        limit_bytes: u64,
    ) -> Result<Result<(), TooMuch>, RenderError> {
        self.groups.resize_with(groups, Group::default);
        let per_group = clusters.len().div_ceil(groups);
        let total = AtomicU64::new(0);
        let is_too_much = || {
            let lines = total.load(Ordering::Relaxed);
            lines > u64::from(u32::MAX) || Self::bytes_for(lines) > limit_bytes
        };
        self.groups
            .par_iter_mut()
            .enumerate()
            .try_for_each(|(i, group)| {
                group.lines.clear();
                (group.drawn, group.made) = (0, 0);
                let end = clusters.len().min((i + 1) * per_group);
                for &cluster in &clusters[end.min(i * per_group)..end] {
                    shot.cancel.check()?;
                    let before = group.lines.len();
                    for &path in cluster_paths(shot.scene, cluster) {
                        group.add(shot, path, grid);
                    }
                    let added = group.lines.len() - before;
                    total.fetch_add(added as u64, Ordering::Relaxed);
                    if is_too_much() {
                        break;
                    }
                }
                Ok(())
            })?;
        self.number();
        Ok(if is_too_much() { Err(TooMuch) } else { Ok(()) })
    }

    fn number(&mut self) {
        let mut first = 0_u32;
        self.firsts.clear();
        for group in &self.groups {
            self.firsts.push(first);
            first = first.wrapping_add(group.lines.len() as u32);
        }
    }

    /// Lets go of all memory when it is more than that.
    pub(super) fn shrink(&mut self, limit_bytes: u64) {
        if self.bytes() > limit_bytes {
            *self = Self::default();
        }
    }

    /// Lines that there are anywhere in the picture.
    pub(super) fn made(&self) -> u64 {
        self.groups.iter().map(|g| g.made).sum()
    }

    /// Number of lines held.
    pub(super) fn len(&self) -> u64 {
        self.groups.iter().map(|g| g.lines.len() as u64).sum()
    }

    /// Paths that had a line anywhere in the picture.
    pub(super) fn drawn(&self) -> u64 {
        self.groups.iter().map(|g| g.drawn).sum()
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> u64 {
        let lines: usize = self.groups.iter().map(|g| g.lines.capacity()).sum();
        (lines * size_of::<Line>()) as u64
    }

    /// Number of the first line, and the lines, of each group.
    pub(super) fn groups(&self) -> impl IndexedParallelIterator<Item = (u32, &[Line])> {
        let lines = self.groups.par_iter().map(|g| g.lines.as_slice());
        self.firsts.par_iter().copied().zip(lines)
    }

    /// The lines of falling `numbers`.
    pub(super) fn falling<'a>(
        &'a self,
        numbers: impl Iterator<Item = u32> + 'a,
    ) -> impl Iterator<Item = &'a Line> {
        let mut group = self.groups.len();
        let mut first = u32::MAX;
        numbers.map(move |number| {
            while number < first {
                group -= 1;
                first = self.firsts[group];
            }
            &self.groups[group].lines[(number - first) as usize]
        })
    }
}

impl Group {
    fn add(&mut self, shot: &Shot<'_>, path: u32, grid: &Grid) {
        let Self {
            lines,
            drawn,
            made,
            points,
        } = self;
        let before = *made;
        shot.flatten(path, points, |line, radius_px| {
            *made += 1;
            if !grid.rows_of(&line, radius_px).is_empty() {
                if lines.len() == lines.capacity() {
                    lines.reserve_exact(64.max(lines.len() / Lines::GROWTH));
                }
                lines.push(line);
            }
        });
        *drawn += u64::from(*made > before);
    }
}
