//! What one thread keeps from tile to tile.

use super::canvas::{Canvas, TILE_PX};
use super::disc::Discs;
use super::layers::Counts;
use super::seen::Hit;
use super::span::{LAYERED, SOLID};

/// What one thread paints with.
pub(super) struct Painter {
    pub(super) solid: Canvas<SOLID>,
    pub(super) solid_discs: Discs<SOLID>,
    pub(super) layers: Canvas<LAYERED>,
    pub(super) discs: Discs<LAYERED>,
    pub(super) hits: Vec<Hit>,
    pub(super) counts: Box<Counts>,
    /// Clusters that lie on the tile.
    pub(super) clusters: Vec<u32>,
}

impl Painter {
    pub(super) fn new() -> Self {
        Self {
            solid: Canvas::new(),
            solid_discs: Discs::default(),
            layers: Canvas::new(),
            discs: Discs::default(),
            hits: Vec::new(),
            counts: Box::new([[0; TILE_PX]; TILE_PX]),
            clusters: Vec::new(),
        }
    }

    /// Most bytes that one holds, apart from lists of what lies on a tile.
    pub(super) fn bytes(is_opaque: bool) -> u64 {
        let canvases = Canvas::<SOLID>::bytes(true) + Canvas::<LAYERED>::bytes(is_opaque);
        let discs = Discs::<SOLID>::bytes() + Discs::<LAYERED>::bytes();
        canvases + discs + size_of::<Counts>() as u64
    }

    /// Bytes of the lists of what lies on a tile.
    pub(super) fn list_bytes(&self) -> u64 {
        let clusters = self.clusters.capacity() * size_of::<u32>();
        (self.hits.capacity() * size_of::<Hit>() + clusters) as u64
    }
}
