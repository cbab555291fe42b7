use guideway_scene::{Cancel, Shading, Strip, Style};
use guideway_scene::{Rgba, Scene};
use guideway_spline::{Affine, Bounds};
use rayon::prelude::*;

use super::cluster::{CLUSTER_PATHS, Lines, Members};
use super::extent::{Extent, Hull, bounds_anew, shown_bounds};
use super::order::sorted_rows;
use super::place::Placement;
use super::shot::{Precision, Shot, Widths, widths};
use super::vectors::LaneWidth;

/// The rows of a scene in clusters, and what holds for all of them.
pub(super) struct Index {
    /// Rows of paths, those of a cluster next to each other.
    pub(super) paths: Vec<u32>,
    /// Where what is shown of each cluster lies; none if that is nothing.
    pub(super) extents: Vec<Option<Extent>>,
    /// What each cluster was last drawn as.
    pub(super) lines: Vec<Lines>,
    /// Bytes of all of them.
    pub(super) lines_bytes: u64,
    /// What those lines are.
    pub(super) made: Vec<Made>,
    /// Where among `paths` each row is; made for the first edit.
    place_of: Vec<u32>,
    /// Draw rank of each row; none if it is its row.
    pub(super) ranks: Option<Vec<u32>>,
    pub(super) widths: Widths,
    /// The color of all paths, if it is one and opaque.
    pub(super) solid: Option<Rgba>,
}

/// What the lines of a cluster are: kept apart, for every frame asks all in sight.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Made {
    /// That of the views that they are good for; the default if they have to be made anew.
    pub(super) precision: Precision,
    /// How far their curves may be from where all were moved to with their lines, for points are rounded, in meters.
    pub(super) drift_m: f64,
    /// Number of paths and of lines.
    pub(super) paths_and_lines: [u32; 2],
}

/// Paths of an edit that one thread looks up in one go.
const PATHS_AT_ONCE: usize = 1 << 16;
/// Farthest that curves may drift from their lines, in units of these.
const MOST_DRIFT: f64 = 0.25;

/// Paths of a cluster that are about to change.
pub(super) struct Leaving {
    cluster: u32,
    members: Members,
    /// Where those of them lie that are shown; none if that was not looked at.
    from: Option<Hull>,
}

impl Made {
    /// Whether a frame can be drawn with them.
    pub(super) fn is_good(&self, shot: &Shot<'_>) -> bool {
        self.precision == shot.precision() && self.drift_m <= MOST_DRIFT * shot.unit_m()
    }
}

impl Index {
    pub(super) fn new(scene: &Scene) -> Self {
        let mut index = Self {
            paths: sorted_rows(scene.hulls()),
            extents: Vec::new(),
            lines: Vec::new(),
            lines_bytes: 0,
            made: Vec::new(),
            place_of: Vec::new(),
            ranks: None,
            widths: None,
            solid: None,
        };
        let clusters = index.paths.par_chunks(CLUSTER_PATHS);
        index.extents = clusters
            .map(|paths| shown_bounds(scene, paths).map(Extent::new))
            .collect();
        index.resize();
        index.order_anew(scene);
        index
    }

    /// After clusters were added.
    fn resize(&mut self) {
        let clusters = self.paths.len().div_ceil(CLUSTER_PATHS);
        self.extents.resize(clusters, None);
        let new = (self.lines.len()..clusters).into_par_iter();
        self.lines.par_extend(new.map(|_| Lines::default()));
        self.made.resize(clusters, Made::default());
    }

    /// After ranks, colors or widths have changed.
    pub(super) fn order_anew(&mut self, scene: &Scene) {
        let order = scene.draw_order();
        self.ranks = (!order.is_sorted()).then(|| {
            let mut ranks = vec![0; scene.row_count()];
            for (&path, rank) in order.iter().zip(0..) {
                ranks[path as usize] = rank;
            }
            ranks
        });
        self.widths = widths(scene);
        self.solid = scene.common_color().filter(|color| color.is_opaque());
    }

    /// The scene, as one frame sees it.
    pub(super) fn shot<'a>(
        &self,
        scene: &'a Scene,
        lane_width: LaneWidth,
        (strip, style, cancel): (&'a Strip, &'a Style, &'a Cancel),
    ) -> Shot<'a> {
        let is_density = style.shading != Shading::Color;
        Shot {
            scene,
            strip,
            view: strip.view(),
            place: Placement::new(strip.view()),
            style,
            cancel,
            widths: self.widths,
            lane_width,
            solid: self.solid.filter(|_| !is_density),
            thinner_than: None,
        }
    }

    /// The paths of a cluster.
    pub(super) fn paths_of(&self, cluster: u32) -> &[u32] {
        let first = cluster as usize * CLUSTER_PATHS;
        &self.paths[first..self.paths.len().min(first + CLUSTER_PATHS)]
    }

    /// Bytes that a scene of so many rows takes, before any line is made.
    pub(super) fn planned_bytes(rows: usize) -> u64 {
        let a_cluster = size_of::<Lines>() + size_of::<Made>() + size_of::<Option<Extent>>();
        let clusters = rows.div_ceil(CLUSTER_PATHS) * a_cluster;
        (clusters + rows * 3 * size_of::<u32>()) as u64
    }

    /// Bytes held, without what lines point to.
    pub(super) fn bytes(&self) -> u64 {
        let ranks = self.ranks.as_ref().map_or(0, Vec::capacity);
        let rows = self.paths.capacity() + self.place_of.capacity() + ranks;
        let clusters = self.extents.capacity() * size_of::<Option<Extent>>()
            + self.lines.capacity() * size_of::<Lines>()
            + self.made.capacity() * size_of::<Made>();
        (rows * size_of::<u32>() + clusters) as u64
    }

    /// Lets go of lines: those of the clusters that are not to be kept.
    pub(super) fn forget_lines(&mut self, is_kept: impl Fn(u32) -> bool) {
        for (cluster, (lines, made)) in (0..).zip(self.lines.iter_mut().zip(&mut self.made)) {
            if !is_kept(cluster) {
                (*lines, *made) = (Lines::None, Made::default());
            }
        }
        self.lines_bytes = self.lines.iter().map(Lines::bytes).sum();
    }

    /// Takes note of where some paths are, before their curves and states are changed.
    pub(super) fn leave(&mut self, scene: &Scene, paths: &[u32]) -> Vec<Leaving> {
        let clusters = self.clusters_of(paths);
        let leaving = clusters.par_iter().map(|&(cluster, members)| Leaving {
            cluster,
            members,
            from: self.hull_of_few(scene, cluster, members),
        });
        leaving.collect()
    }

    /// Makes anew what depends on the curves and the states of paths that have changed: by a map, if one was what changed
    /// them. Gives where what is changed was and is.
    pub(super) fn touch(
        &mut self,
        scene: &Scene,
        leaving: &[Leaving],
        by: Option<Affine>,
    ) -> Vec<Bounds<f64>> {
        let geometry = scene.layout().paths.geometry();
        let extents = leaving.par_iter().map(|left| {
            let before = self.extents[left.cluster as usize];
            let is_whole = self.is_whole(left);
            let known = match (before, by) {
                (Some(before), Some(by)) if is_whole => {
                    before.mapped(by, geometry.mapped_bounds(before.bounds, by))
                }
                (Some(before), _) if !is_whole => left.from.and_then(|from| {
                    let to = self.hull_of_few(scene, left.cluster, left.members)?;
                    before.after(from, to)
                }),
                _ => None,
            };
            let anew = || bounds_anew(scene, self.paths_of(left.cluster));
            // The middle of curves that are all new does not depend on those before: what is undone looks as it did.
            known.or_else(|| match before.filter(|_| !is_whole) {
                Some(before) => anew().map(|bounds| before.changed(bounds)),
                None => anew().map(Extent::new),
            })
        });
        let extents: Vec<Option<Extent>> = extents.collect();
        let mut changed = Vec::with_capacity(2 * leaving.len());
        let moves = by.and_then(Affine::as_translation).is_some();
        for (left, now) in leaving.iter().zip(extents) {
            let cluster = left.cluster;
            let is_moved = moves && self.is_whole(left);
            let (extent, made) = (
                &mut self.extents[cluster as usize],
                &mut self.made[cluster as usize],
            );
            let before = std::mem::replace(extent, now);
            let both = before.into_iter().chain(now);
            changed.extend(both.map(|extent| extent.bounds));
            if let Some(now) = now.filter(|_| is_moved) {
                made.drift_m += geometry.rounding_m(now.bounds);
                continue;
            }
            made.precision = Precision::default();
        }
        changed
    }

    /// Whether all paths of a cluster are about to change.
    fn is_whole(&self, left: &Leaving) -> bool {
        left.members.count_ones() as usize == self.paths_of(left.cluster).len()
    }

    /// Where some members of a cluster lie; none if they are so many that a look at all takes hardly longer.
    fn hull_of_few(&self, scene: &Scene, cluster: u32, members: Members) -> Option<Hull> {
        const FEW: u32 = CLUSTER_PATHS as u32 / 4;
        let paths = self.paths_of(cluster);
        let few = (members.count_ones() <= FEW).then(|| {
            let named = (0..paths.len()).filter(|member| members >> member & 1 == 1);
            named.map(|member| paths[member]).collect::<Vec<u32>>()
        });
        few.map(|few| bounds_anew(scene, &few))
    }

    /// Where the clusters of some paths lie.
    pub(super) fn bounds_of(&mut self, paths: &[u32]) -> Vec<Bounds<f64>> {
        let clusters = self.clusters_of(paths);
        let bounds = clusters
            .iter()
            .filter_map(|&(cluster, _)| self.extents[cluster as usize]);
        bounds.map(|extent| extent.bounds).collect()
    }

    /// The clusters of some paths, each once, with those of its members.
    fn clusters_of(&mut self, paths: &[u32]) -> Vec<(u32, Members)> {
        if self.place_of.is_empty() {
            self.place_of.resize(self.paths.len(), 0);
            for (&path, place) in self.paths.iter().zip(0..) {
                self.place_of[path as usize] = place;
            }
        }
        let (clusters, place_of) = (self.lines.len(), &self.place_of);
        let members_of = |mut members: Vec<Members>, paths: &[u32]| {
            for &path in paths {
                let place = place_of[path as usize] as usize;
                members[place / CLUSTER_PATHS] |= 1 << (place % CLUSTER_PATHS);
            }
            members
        };
        let both = |mut a: Vec<Members>, b: Vec<Members>| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a |= b);
            a
        };
        let parts = paths.par_chunks(PATHS_AT_ONCE);
        let parts = parts.fold(|| vec![0; clusters], members_of);
        let members = parts.reduce_with(both).unwrap_or_default();
        let named = (0..).zip(members).filter(|(_, members)| *members != 0);
        named.collect()
    }

    /// Puts rows behind the last into clusters of their own. Gives where they are.
    pub(super) fn append(&mut self, scene: &Scene) -> Vec<Bounds<f64>> {
        let first = self.paths.len() as u32;
        self.paths.extend(first..scene.row_count() as u32);
        self.resize();
        if !self.place_of.is_empty() {
            self.place_of.extend(first..self.paths.len() as u32);
        }
        let rows: Vec<u32> = (first..self.paths.len() as u32).collect();
        // They were nowhere before.
        let leaving = self.clusters_of(&rows).into_iter();
        let leaving = leaving.map(|(cluster, members)| Leaving {
            cluster,
            members,
            from: None,
        });
        let leaving: Vec<Leaving> = leaving.collect();
        self.touch(scene, &leaving, None)
    }
}
