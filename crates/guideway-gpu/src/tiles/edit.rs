//! Changes of the scene on the device, in place where they can be.

use std::collections::BTreeMap;
use std::sync::Arc;

use guideway_layout::Layout;
use guideway_scene::{Edit, PathState};
use guideway_scene::{EditOutcome, RenderError};

use super::pack::{Local, Packed, Packing, Part, style};
use super::params::{Cluster, PathStyle, Points, Stroke};
use super::places::{Places, cluster_of, room_of};
use super::prepared::PreparedTiles;
use super::store::Store;
use super::touched::ClusterSet;
use crate::device::{Patch, Patcher};

const STROKE_WORDS: usize = size_of::<Stroke>() / 4;
const CLUSTER_WORDS: usize = size_of::<Cluster>() / 4;
const STYLE_WORDS: usize = size_of::<PathStyle>() / 4;
/// How many points may lie unused before all is packed anew: so many, and a quarter of all.
const MOST_UNUSED_POINTS: usize = 1 << 16;

/// What has to be sent.
#[derive(Default)]
struct Changes {
    points: BTreeMap<Target, Patch>,
    strokes: Vec<u32>,
    /// Clusters that are others now, and those of which a curve is.
    clusters: ClusterSet,
    touched: ClusterSet,
    loose: Vec<Part>,
    /// The points of one path.
    scratch: Vec<[f32; 2]>,
}

impl PreparedTiles {
    /// See [`guideway_scene::Prepared::edit`].
    pub(super) fn change(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        let first_new = self.scene.row_count() as u32;
        let scene = Arc::make_mut(&mut self.scene);
        scene.edit(edit).map_err(RenderError::Edit)?;
        self.is_torn = true;
        let new_rows = first_new..self.scene.row_count() as u32;
        let rows: Vec<u32> = edit.paths().chain(new_rows).collect();
        let keeps_looks = matches!(edit, Edit::Transform { .. } | Edit::Reshape { .. });
        if !keeps_looks {
            let before = self.facts.looks();
            self.look_anew();
            if matches!(edit, Edit::Restyle(_)) || self.facts.looks() != before {
                self.easel.kept = None;
            }
        }
        let has_ranks = |store: &Store| rows.iter().all(|&row| store.ranks.rank(row).is_some());
        if !self.store.as_ref().is_some_and(has_ranks) {
            return self.pack_anew();
        }
        let mut moved_bytes = 0;
        if !keeps_looks {
            moved_bytes += self.send_styles(&rows)?;
        }
        if !matches!(edit, Edit::Restyle(_)) {
            let Some(bytes) = self.send_curves(&rows)? else {
                return self.pack_anew();
            };
            moved_bytes += bytes;
        }
        self.is_torn = false;
        Ok(EditOutcome::InPlace { moved_bytes })
    }

    fn pack_anew(&mut self) -> Result<EditOutcome, RenderError> {
        self.bring(Packing::of(&self.scene))?;
        let held = |store: &Store| {
            let points: u64 = store.chunks.iter().map(|c| c.points.bytes()).sum();
            points + store.strokes.bytes() + store.clusters.bytes() + store.styles.bytes()
        };
        Ok(EditOutcome::InPlace {
            moved_bytes: self.store.as_ref().map_or(0, held),
        })
    }

    /// Sends colors and widths of these rows.
    fn send_styles(&mut self, rows: &[u32]) -> Result<u64, RenderError> {
        let Some(store) = &mut self.store else {
            return Ok(0);
        };
        let gpu = &self.shared.gpu;
        let needed = if self.facts.is_plain {
            1
        } else {
            store.ranks.count(&self.scene)
        };
        if needed == 1 || needed as u64 * size_of::<PathStyle>() as u64 > store.styles.bytes() {
            let bytes = store.renew_styles(gpu, &mut self.memory, &self.scene)?;
            self.facts.styles = store.style_count;
            self.unbind();
            return Ok(bytes);
        }
        let mut patch = Patch::default();
        let mut changes = Changes::default();
        let places = self
            .places
            .get_or_insert_with(|| Places::of(store, self.scene.row_count()));
        for &row in rows {
            let Some(rank) = store.ranks.rank(row) else {
                continue;
            };
            let style = style(&self.scene, row);
            patch.set(rank as usize * STYLE_WORDS, &style);
            for &stroke in places.strokes(row) {
                let cluster = cluster_of(store, stroke);
                let widest_m = &mut store.cluster_list[cluster].widest_m;
                if style.width_m > *widest_m {
                    *widest_m = style.width_m;
                    changes.clusters.add(cluster);
                }
            }
        }
        self.send_patches(&[(Target::Styles, &patch)])?;
        Ok(patch.bytes() + self.send(changes)?)
    }

    /// Sends curves of these rows, or none if it is better to pack all of them anew.
    fn send_curves(&mut self, rows: &[u32]) -> Result<Option<u64>, RenderError> {
        let Some(store) = &mut self.store else {
            return Ok(None);
        };
        let scene = &self.scene;
        let places = self
            .places
            .get_or_insert_with(|| Places::of(store, scene.row_count()));
        let mut changes = Changes::default();
        let mut parts = Vec::new();
        for &row in rows {
            parts.clear();
            if scene.state(row) == PathState::Shown
                && let Some(rank) = store.ranks.rank(row)
            {
                Part::of_path(scene.layout(), row, rank, &mut parts);
            }
            if parts.len() > 1 {
                self.parted.insert(row);
                self.packing.sort(scene.layout(), &mut parts);
            } else if !self.parted.is_empty() {
                self.parted.remove(&row);
            }
            if set_in_place(store, places, scene.layout(), &parts, row, &mut changes) {
                continue;
            }
            for &stroke in places.strokes(row) {
                let old = &mut store.stroke_list[stroke as usize];
                old.extent = old.first_point();
                changes.strokes.push(stroke);
                changes.touched.add(cluster_of(store, stroke));
            }
            if !parts.is_empty() {
                places.forget(store, row);
                changes.loose.extend_from_slice(&parts);
            }
        }
        let points: usize = store.chunks.iter().map(|c| c.used_points as usize).sum();
        if places.unused_points > MOST_UNUSED_POINTS.max(points / 4) {
            return Ok(None);
        }
        Ok(Some(self.send(changes)?))
    }

    /// Sends changes; returns how many bytes they took.
    fn send(&mut self, mut changes: Changes) -> Result<u64, RenderError> {
        let (Some(store), Some(places)) = (&mut self.store, &mut self.places) else {
            return Ok(0);
        };
        let gpu = &self.shared.gpu;
        let mut are_renewed = false;
        let has_loose = !changes.loose.is_empty();
        if has_loose {
            let loose = std::mem::take(&mut changes.loose);
            let packed = Packed::of(&self.scene, loose, self.packing.exact());
            let (strokes, clusters) = (store.stroke_list.len(), store.cluster_list.len());
            let chunk = store.add(gpu, &mut self.memory, &packed)?;
            places.add(store, strokes, clusters, self.scene.row_count());
            let first_point = store.cluster_list[clusters].first_point;
            let patch = changes.points.entry(Target::Points(chunk)).or_default();
            set_points(patch, first_point, packed.exact_m.into_iter());
            are_renewed = store.make_room(gpu, &mut self.memory)?;
            changes
                .strokes
                .extend(strokes as u32..store.stroke_list.len() as u32);
            for cluster in clusters..store.cluster_list.len() {
                changes.clusters.add(cluster);
                changes.touched.add(cluster);
            }
        }
        store.count_whole_paths(changes.touched.iter());
        let (mut strokes, mut clusters) = (Patch::default(), Patch::default());
        if !are_renewed {
            for &stroke in &changes.strokes {
                let at = stroke as usize;
                strokes.set(at * STROKE_WORDS, &store.stroke_list[at]);
            }
            for cluster in changes.clusters.iter() {
                clusters.set(cluster * CLUSTER_WORDS, &store.cluster_list[cluster]);
            }
        }
        for cluster in changes.clusters.iter() {
            let reach_m = f64::from(store.cluster_list[cluster].reach_m());
            self.facts.reach_m = self.facts.reach_m.max(reach_m);
        }
        self.facts.clusters = store.cluster_list.len() as u32;
        let mut patches = vec![(Target::Strokes, &strokes), (Target::Clusters, &clusters)];
        let of_points = changes.points.iter();
        patches.extend(of_points.map(|(&target, patch)| (target, patch)));
        let mut bytes = patches.iter().map(|(_, patch)| patch.bytes()).sum();
        if are_renewed {
            bytes += store.strokes.bytes() + store.clusters.bytes();
        }
        self.send_patches(&patches)?;
        if let Some(store) = &self.store {
            self.easel.touch(&changes.touched, &store.cluster_list);
        }
        if are_renewed {
            self.easel.forget_lines();
        }
        if has_loose {
            self.set_chunks()?;
            self.unbind();
        }
        Ok(bytes)
    }

    fn send_patches(&mut self, patches: &[(Target, &Patch)]) -> Result<(), RenderError> {
        self.make_patcher()?;
        let (Some(store), Some(patcher)) = (&self.store, &self.patcher) else {
            return Ok(());
        };
        for (target, patch) in patches {
            let buffer = match target {
                Target::Points(chunk) => &store.chunks[*chunk].points,
                Target::Twins => match &store.twins {
                    Some(twins) => &twins.chunk.points,
                    None => continue,
                },
                Target::Strokes => &store.strokes,
                Target::Clusters => &store.clusters,
                Target::Styles => &store.styles,
            };
            let sent = patcher.apply(&self.shared.gpu, &self.runner, patch, buffer);
            sent.map_err(|what| self.memory.trouble(what))?;
        }
        Ok(())
    }

    fn make_patcher(&mut self) -> Result<(), RenderError> {
        if self.patcher.is_none() {
            self.patcher = Some(Patcher::new(&self.shared.gpu, &mut self.memory)?);
        }
        Ok(())
    }
}

/// A buffer that changes.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Target {
    /// Points of a chunk.
    Points(usize),
    /// Exact points in place of rounded ones.
    Twins,
    Strokes,
    Clusters,
    Styles,
}

/// Sets points of a buffer from one on.
fn set_points<T: bytemuck::NoUninit>(
    patch: &mut Patch,
    first_point: u32,
    points: impl Iterator<Item = T>,
) {
    let words = size_of::<T>() / size_of::<u32>();
    for (point, index) in points.zip(first_point as usize..) {
        patch.set(index * words, &point);
    }
}

/// Gives the strokes of a path new points where the old ones are, unless they do not fit there.
fn set_in_place(
    store: &mut Store,
    places: &Places,
    layout: &Layout,
    parts: &[Part],
    row: u32,
    changes: &mut Changes,
) -> bool {
    let strokes = places.strokes(row);
    if parts.is_empty() || parts.len() != strokes.len() {
        return false;
    }
    changes.scratch.clear();
    for (part, &stroke) in parts.iter().zip(strokes) {
        let cluster = cluster_of(store, stroke);
        let local = Local::of(&store.cluster_list[cluster]);
        let first = changes.scratch.len();
        let points = part.points(layout).map(|p| local.of_world(p));
        changes.scratch.extend(points);
        let points = &changes.scratch[first..];
        let is_home = points.iter().all(|&p| places.is_home(cluster, p));
        if !is_home || room_of(store, stroke) as usize != points.len() {
            return false;
        }
    }
    let scratch = std::mem::take(&mut changes.scratch);
    let mut rest = scratch.as_slice();
    for (part, &stroke) in parts.iter().zip(strokes) {
        let at = cluster_of(store, stroke);
        let index = at as u32;
        let chunk = store.chunks.partition_point(|c| c.clusters.end <= index);
        let cluster = &mut store.cluster_list[at];
        let old = &mut store.stroke_list[stroke as usize];
        let new = part.stroke(old.first_point());
        if *old != new {
            *old = new;
            changes.strokes.push(stroke);
        }
        let (points, behind) = rest.split_at(new.points() as usize);
        rest = behind;
        points.iter().for_each(|p| cluster.hold(*p));
        let first_point = cluster.first_point + new.first_point();
        let patch = changes.points.entry(Target::Points(chunk)).or_default();
        match cluster.held() {
            Points::Rounded => {
                let rounded = points.iter().map(|p| cluster.rounded(*p));
                set_points(patch, first_point, rounded);
            }
            Points::Exact => set_points(patch, first_point, points.iter().copied()),
        }
        if let Some(place) = store.twins.as_ref().and_then(|twins| twins.place(index)) {
            let patch = changes.points.entry(Target::Twins).or_default();
            set_points(patch, place + new.first_point(), points.iter().copied());
        }
        changes.clusters.add(at);
        changes.touched.add(at);
    }
    changes.scratch = scratch;
    true
}
