//! Buffers that a thread reuses from tile to tile.

use super::caps::CapTables;
use super::cluster_in_tile::PieceRef;
use super::counted::PathEnd;
use super::coverage_mask::CoverageMask;
use crate::cpu::ground::samples::{LAYERED, SOLID};
use crate::cpu::ground::tile::{SampleHalves, TILE_PX};

/// Buffers of one thread.
pub(crate) struct ThreadScratch {
    pub(crate) solid: CoverageMask<SOLID>,
    pub(crate) solid_caps: CapTables<SOLID>,
    pub(crate) layers: CoverageMask<LAYERED>,
    pub(crate) caps: CapTables<LAYERED>,
    /// Pieces that may touch the tile.
    pub(crate) pieces: Vec<PieceRef>,
    pub(crate) counts: Box<SampleHalves>,
    /// Ends of paths that are to be counted.
    pub(crate) ends: Vec<PathEnd>,
    /// Keys of the clusters that may touch the tile.
    pub(crate) clusters: Vec<u32>,
}

impl ThreadScratch {
    pub(crate) fn new() -> Self {
        Self {
            solid: CoverageMask::new(),
            solid_caps: CapTables::default(),
            layers: CoverageMask::new(),
            caps: CapTables::default(),
            pieces: Vec::new(),
            counts: Box::new([[0; TILE_PX]; TILE_PX]),
            ends: Vec::new(),
            clusters: Vec::new(),
        }
    }

    /// Upper bound of the heap bytes held, without the lists of a tile.
    pub(crate) fn bytes(is_opaque: bool) -> u64 {
        let masks = CoverageMask::<SOLID>::bytes(true) + CoverageMask::<LAYERED>::bytes(is_opaque);
        let caps = CapTables::<SOLID>::bytes() + CapTables::<LAYERED>::bytes();
        masks + caps + size_of::<SampleHalves>() as u64
    }

    /// Heap bytes of the lists of a tile.
    pub(crate) fn list_bytes(&self) -> u64 {
        let clusters = self.clusters.capacity() * size_of::<u32>();
        let ends = self.ends.capacity() * size_of::<PathEnd>();
        (self.pieces.capacity() * size_of::<PieceRef>() + clusters + ends) as u64
    }
}
