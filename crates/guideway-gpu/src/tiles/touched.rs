//! Lines that are kept, and which clusters edits have touched since.

use guideway_scene::{RenderError, View};
use wgpu::BufferUsages;

use super::level::Level;
use super::prepared::PreparedTiles;
use super::shot::{Lines, Shot};

/// What part of the clusters, or of their lines, may be others before all are made anew.
const MOST_TOUCHED: usize = 4;

/// Clusters, by their number.
#[derive(Default)]
pub(super) struct ClusterSet {
    marked: Vec<bool>,
    count: u32,
}

impl ClusterSet {
    pub(super) fn add(&mut self, cluster: usize) {
        if self.marked.len() <= cluster {
            self.marked.resize(cluster + 1, false);
        }
        self.count += u32::from(!self.marked[cluster]);
        self.marked[cluster] = true;
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = usize> {
        let all = self.marked.iter().enumerate();
        all.filter_map(|(cluster, &is_marked)| is_marked.then_some(cluster))
    }
}

/// Lines that can be drawn again: all of a level, of the scene as it is but for what was touched since.
pub(super) struct KeptLines {
    pub(super) level: Level,
    /// With those that were struck out.
    count: u32,
    /// How many there were when all were made.
    made: u32,
    /// The view of the frame that made them, and the paths that it has counted, if these are still all.
    pub(super) drawn: Option<(View, u32)>,
    touched: ClusterSet,
}

impl KeptLines {
    pub(super) fn new(level: Level, count: u32, drawn: (View, u32)) -> Self {
        Self {
            level,
            count,
            made: count,
            drawn: Some(drawn),
            touched: ClusterSet::default(),
        }
    }

    pub(super) fn count(&self) -> u32 {
        self.count
    }

    /// How they are drawn.
    pub(super) fn lines(&self) -> Lines {
        match self.touched.count {
            0 => Lines::Kept(self.count),
            touched => Lines::Renewed(self.count, touched),
        }
    }

    /// After an edit of clusters, of so many. False if it is better to make all lines anew.
    pub(super) fn touch(&mut self, touched: &ClusterSet, clusters: usize) -> bool {
        touched.iter().for_each(|cluster| self.touched.add(cluster));
        self.touched.count as usize <= clusters / MOST_TOUCHED
    }

    /// After those of clusters that were touched have become others, and all are so many. None if too many are others.
    pub(super) fn renewed(self, count: u32) -> Option<Self> {
        // About as many are struck out as are added.
        let added = count.saturating_sub(self.made) as usize;
        (added <= self.made as usize / MOST_TOUCHED).then_some(Self {
            count,
            drawn: None,
            touched: ClusterSet::default(),
            ..self
        })
    }
}

impl PreparedTiles {
    /// Which lines the next window is drawn from, if it is one of a picture that is drawn whole. The device knows which
    /// clusters were touched.
    pub(super) fn lines_for(
        &mut self,
        shot: &Shot<'_>,
        is_part: bool,
    ) -> Result<Lines, RenderError> {
        let lines = self.easel.lines_for(shot, is_part);
        if !matches!(lines, Lines::Renewed(..)) || self.send_touched()? {
            return Ok(lines);
        }
        self.easel.forget_lines();
        Ok(self.easel.lines_for(shot, is_part))
    }

    /// False if there is no room for them.
    fn send_touched(&mut self) -> Result<bool, RenderError> {
        let easel = &mut self.easel;
        let (Some(store), Some(kept)) = (
            &self.store,
            easel.room.as_ref().and_then(|r| r.kept.as_ref()),
        ) else {
            return Ok(false);
        };
        let list: Vec<u32> = kept.touched.iter().map(|cluster| cluster as u32).collect();
        let what = "the clusters touched";
        if easel
            .touched
            .as_ref()
            .is_none_or(|buffer| buffer.bytes() < size_of_val(list.as_slice()) as u64)
        {
            let most = store.cluster_list.len() / MOST_TOUCHED + 1;
            let bytes = (most * size_of::<u32>()) as u64;
            easel.touched = None;
            if bytes > self.memory.spare_bytes() {
                return Ok(false);
            }
            let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
            easel.touched = Some(self.memory.zeros(what, bytes, usage)?);
            easel.unbind();
        }
        if let Some(buffer) = &self.easel.touched {
            let set = self.runner.set_all(what, buffer, &list);
            set.map_err(|what| self.memory.trouble(what))?;
        }
        Ok(true)
    }
}
