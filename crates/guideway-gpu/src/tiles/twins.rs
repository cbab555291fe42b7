//! Exact points of clusters whose own are rounded. The view alone says which are drawn: these, where it comes so near
//! that rounding would show.

use std::collections::HashMap;

use guideway_scene::RenderError;
use wgpu::BufferUsages;

use super::NAME;
use super::chunk::{Chunk, Drawn, PARAMS_BYTES, bytes_of};
use super::pack::{Local, Part};
use super::params::{Cluster, Found, Place, Points};
use super::places::Places;
use super::prepared::PreparedTiles;
use super::shot::Shot;
use super::store::Store;
use crate::device::{FETCHED, Memory};

const WHAT: &str = "exact control points of what is seen from near";
/// Fewest points that there is room for, if there can be.
const LEAST_POINTS: u32 = 1 << 16;

/// The points of clusters that were seen from near, as far as there is room.
pub(super) struct Twins {
    pub(super) chunk: Chunk,
    /// Where the points of each cluster begin; zero if they are not there. The buffer begins with the same words, two of
    /// them in the room of a point.
    places: Vec<u32>,
}

impl Twins {
    /// Room for so many points of these clusters.
    fn new(memory: &mut Memory, clusters: &[Cluster], points: u32) -> Result<Self, RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let buffer = memory.zeros(WHAT, buffer_bytes(clusters.len(), points), usage)?;
        let drawn = Drawn::Near {
            greatest_step_m: clusters.iter().map(|c| c.step_m).fold(0.0, f32::max),
        };
        let all = 0..clusters.len() as u32;
        let mut chunk = Chunk::new(memory, buffer, Points::Exact, all, drawn)?;
        chunk.used_points = table_points(clusters.len());
        Ok(Self {
            chunk,
            places: vec![0; clusters.len()],
        })
    }

    /// Where the points of a cluster begin, if they are there.
    pub(super) fn place(&self, cluster: u32) -> Option<u32> {
        let place = self.places.get(cluster as usize).copied();
        place.filter(|&place| place > 0)
    }
}

/// Points in whose room the places of so many clusters lie.
fn table_points(clusters: usize) -> u32 {
    clusters.div_ceil(2) as u32
}

fn buffer_bytes(clusters: usize, points: u32) -> u64 {
    bytes_of(Points::Exact, table_points(clusters)) + bytes_of(Points::Exact, points)
}

impl PreparedTiles {
    /// Has a place for exact points if a view may be drawn from some.
    pub(super) fn come_near(&mut self, shot: &Shot<'_>) -> Result<(), RenderError> {
        let has_place = self.store.as_ref().is_none_or(|s| s.twins.is_some());
        if has_place || !shot.is_near() || self.make_twins(0)? {
            return Ok(());
        }
        Err(self.no_room_for_twins(0))
    }

    /// Brings the exact points that a frame has found to be missing. If there is no room for all that it needs: how many
    /// these are.
    pub(super) fn bring_twins(
        &mut self,
        shot: &Shot<'_>,
        found: &Found,
    ) -> Result<Option<u32>, RenderError> {
        let near = self.clusters_near(shot, found)?;
        let needed = self.points_of(&near);
        let Some(twins) = self.store.as_ref().and_then(|s| s.twins.as_ref()) else {
            return Ok(Some(needed));
        };
        let is_missing = |cluster: &u32| twins.place(*cluster).is_none();
        let missing: Vec<u32> = near.iter().copied().filter(is_missing).collect();
        if missing.is_empty() {
            let what = "the device misses control points that it has";
            return Err(self.memory.trouble(what.to_owned()));
        }
        let spare_points = twins.chunk.spare_points();
        if self.points_of(&missing) <= spare_points {
            self.send_twins(&missing)?;
            return Ok(None);
        }
        // All others go.
        if !self.make_twins(needed)? {
            return Ok(Some(needed));
        }
        self.send_twins(&near)?;
        Ok(None)
    }

    /// The error for a tile that needs more of them than there can be.
    pub(super) fn no_room_for_twins(&self, points: u32) -> RenderError {
        let held_bytes = self.memory.held_bytes();
        RenderError::Budget {
            method: NAME,
            what: WHAT,
            needed_bytes: held_bytes + bytes_of(Points::Exact, points),
            budget_bytes: held_bytes + self.memory.spare_bytes(),
        }
    }

    /// The clusters that a frame has seen from so near that it needs their exact points.
    fn clusters_near(&mut self, shot: &Shot<'_>, found: &Found) -> Result<Vec<u32>, RenderError> {
        let what = "the list of clusters seen";
        let first = size_of::<Found>();
        let clusters = self.facts.clusters as usize;
        let bytes = (first + clusters * size_of::<Place>()) as u64;
        self.make_spare(bytes)?;
        let fetched = self.memory.zeros(what, bytes, FETCHED)?;
        let Some(store) = &self.store else {
            return Ok(Vec::new());
        };
        let mut near = Vec::new();
        let taken = self
            .runner
            .fetch(what, &store.found, &fetched, bytes, |bytes| {
                let places = bytes[first..].chunks_exact(size_of::<Place>());
                let exact = places.rev().take(found.exact as usize);
                let seen = exact.map(|bytes| bytemuck::pod_read_unaligned::<Place>(bytes).seen);
                let is_near = |at: &u32| {
                    let cluster = store.cluster_list.get(*at as usize);
                    cluster.is_some_and(|c| c.step_m > shot.most_step_m())
                };
                near.extend(seen.filter(is_near));
            });
        taken.map_err(|what| self.memory.trouble(what))?;
        near.sort_unstable();
        Ok(near)
    }

    fn points_of(&self, clusters: &[u32]) -> u32 {
        let list = self.store.as_ref().map_or(&[][..], |s| &s.cluster_list);
        clusters.iter().map(|&at| list[at as usize].points).sum()
    }

    /// Makes room for so many exact points, and for more if there can be; those that were there go. False if there cannot
    /// be so much.
    fn make_twins(&mut self, points: u32) -> Result<bool, RenderError> {
        self.unbind();
        let Some(store) = &mut self.store else {
            return Ok(false);
        };
        store.twins = None;
        // Clusters whose points are exact come behind.
        let is_rounded = |c: &Cluster| c.held() == Points::Rounded;
        let clusters = store.cluster_list.partition_point(is_rounded);
        let generous = points.saturating_add(points / 2).max(LEAST_POINTS);
        for points in [generous, points] {
            let bytes = buffer_bytes(clusters, points);
            if bytes > self.shared.gpu.binding_bytes() || !self.make_spare(bytes + PARAMS_BYTES)? {
                continue;
            }
            if let Some(store) = &mut self.store {
                let clusters = &store.cluster_list[..clusters];
                store.twins = Some(Twins::new(&mut self.memory, clusters, points)?);
            }
            self.set_chunks()?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Sends exact points of clusters to where there is room for them.
    fn send_twins(&mut self, clusters: &[u32]) -> Result<(), RenderError> {
        let Some(store) = &mut self.store else {
            return Ok(());
        };
        // If they cannot be sent, none is there.
        let Some(mut twins) = store.twins.take() else {
            return Ok(());
        };
        if !self.parted.is_empty() {
            let rows = self.scene.row_count();
            self.places.get_or_insert_with(|| Places::of(store, rows));
        }
        let first = twins.chunk.used_points;
        let mut points_m = Vec::new();
        let mut parted = HashMap::new();
        for &cluster in clusters {
            twins.places[cluster as usize] = first + points_m.len() as u32;
            self.add_exact_points(cluster, &mut parted, &mut points_m);
        }
        twins.chunk.used_points += points_m.len() as u32;
        let buffer = &twins.chunk.points;
        let sent = self
            .runner
            .set_from(WHAT, buffer, first, &points_m)
            .and_then(|()| self.runner.set_all(WHAT, buffer, &twins.places));
        sent.map_err(|what| self.memory.trouble(what))?;
        if let Some(store) = &mut self.store {
            store.twins = Some(twins);
        }
        Ok(())
    }

    /// Adds the points of a cluster; where its strokes are no longer drawn, anything.
    fn add_exact_points(
        &self,
        cluster: u32,
        parted: &mut HashMap<u32, Vec<Part>>,
        points_m: &mut Vec<[f32; 2]>,
    ) {
        let Some(store) = &self.store else {
            return;
        };
        let cluster = &store.cluster_list[cluster as usize];
        let local = Local::of(cluster);
        let first = points_m.len();
        points_m.resize(first + cluster.points as usize, [0.0; 2]);
        for index in cluster.first_stroke..cluster.first_stroke + cluster.strokes {
            let stroke = store.stroke_list[index as usize];
            if stroke.is_drawn()
                && let Some(part) = self.part_of(store, index, parted)
            {
                let places = points_m[first + stroke.first_point() as usize..].iter_mut();
                for (place, p) in places.zip(part.points(self.scene.layout())) {
                    *place = local.of_world(p);
                }
            }
        }
    }

    /// The part of its path that a stroke is.
    fn part_of(
        &self,
        store: &Store,
        index: u32,
        parted: &mut HashMap<u32, Vec<Part>>,
    ) -> Option<Part> {
        let layout = self.scene.layout();
        let stroke = store.stroke_list[index as usize];
        let row = store.ranks.row(stroke.rank);
        let parts = || {
            let mut parts = Vec::new();
            Part::of_path(layout, row, stroke.rank, &mut parts);
            self.packing.sort(layout, &mut parts);
            parts
        };
        if stroke.is_whole_path() {
            return parts().pop();
        }
        // The strokes of a path lie in the order of its sorted parts.
        let number = self.places.as_ref()?.strokes(row).binary_search(&index);
        let parts = parted.entry(row).or_insert_with(parts);
        parts.get(number.ok()?).copied()
    }
}
