//! What a picture is made with, and what frames leave to the next.

use super::bound::Bound;
use super::canvas::Canvas;
use super::kept::{Kept, Shifter};
use super::kernels::bounds_alone;
use super::level::Level;
use super::params::{Cluster, Found};
use super::room::{Room, Size};
use super::rounds::Rounds;
use super::shot::{Lines, Shot};
use super::touched::{ClusterSet, KeptLines};
use super::window::Window;
use crate::device::{DeviceBuffer, Gpu};

/// What a picture is made with.
#[derive(Default)]
pub(super) struct Easel {
    /// Whether anything is kept from picture to picture.
    pub(super) keeps: bool,
    pub(super) room: Option<Room>,
    pub(super) canvas: Option<Canvas>,
    /// Tiles that several workgroups cover, once there are any.
    pub(super) shares: Option<DeviceBuffer>,
    /// Clusters that were touched before it was drawn, once there are any.
    pub(super) touched: Option<DeviceBuffer>,
    /// For the buffers above; none once one of them is another.
    pub(super) bound: Option<Bound>,
    /// What the canvas shows, if it is a finished picture of the scene as it is, but for what was touched since.
    pub(super) kept: Option<Kept>,
    pub(super) shifter: Option<Shifter>,
    pub(super) rounds: Rounds,
    /// Whether the last frame has seen few clusters.
    pub(super) has_few: bool,
    /// Whether it has had lists so long that several workgroups should cover their tiles.
    pub(super) has_long: bool,
    /// Length of its longest list.
    pub(super) longest: u32,
    /// Where there is no room for all lines of the level.
    pub(super) too_large: Option<Level>,
}

impl Easel {
    /// Whether rounds may make do with the room that was too small.
    pub(super) fn may_help(&mut self, found: &Found) -> bool {
        let line_room = self.room.as_ref().map_or(0, |room| room.size.lines);
        self.rounds.may_help(found, line_room)
    }

    /// Which lines the next window is drawn from, if it is one of a picture that is drawn whole.
    pub(super) fn lines_for(&self, shot: &Shot<'_>, is_part: bool) -> Lines {
        let kept = self.room.as_ref().and_then(|room| room.kept.as_ref());
        if is_part {
            return Lines::OfWindow(kept.map_or(0, KeptLines::count));
        }
        if !self.keeps || self.rounds.are_on || self.too_large == Some(shot.level) {
            return Lines::OfWindow(0);
        }
        match kept.filter(|kept| kept.level == shot.level) {
            Some(kept) => kept.lines(),
            None => Lines::OfLevel,
        }
    }

    /// After curves of some clusters have changed.
    pub(super) fn touch(&mut self, touched: &ClusterSet, clusters: &[Cluster]) {
        if let Some(picture) = &mut self.kept {
            picture.touch(touched.iter().map(|at| &clusters[at]));
        }
        if let Some(room) = &mut self.room {
            let touch = |kept: &mut KeptLines| kept.touch(touched, clusters.len());
            room.kept.take_if(|kept| !touch(kept));
        }
    }

    /// After any of them may have.
    pub(super) fn forget(&mut self) {
        self.kept = None;
        self.forget_lines();
    }

    /// After what is known of them has gone.
    pub(super) fn forget_lines(&mut self) {
        if let Some(room) = &mut self.room {
            room.kept = None;
        }
    }

    /// After one of the buffers that a frame binds has become another.
    pub(super) fn unbind(&mut self) {
        self.bound = None;
        if let Some(shifter) = &mut self.shifter {
            shifter.bound = None;
        }
    }
}

/// Places that the list of each tile of a window can have, if lists are so much shorter that it may do for the next view.
pub(super) fn list_room(gpu: &Gpu, size: Size, window: &Window, longest: u32) -> u32 {
    let tiles = window.tiles().max(1) as u32;
    let [least_alone, _] = bounds_alone(gpu);
    let places = (size.references / tiles).min(least_alone);
    if longest <= places / 2 { places } else { 0 }
}
