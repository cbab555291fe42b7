//! Draw ranks of paths on the device. Edits do not change them.

use guideway_scene::Scene;

const NO_RANK: u32 = u32::MAX;

/// Maps rows of the layout to draw ranks of the device, and back.
pub(crate) enum DrawRanks {
    /// The layout ranks no path: rank and row are equal.
    Rows,
    /// Indices into the draw order at the time of the upload.
    Order {
        /// The row of each rank.
        rows: Vec<u32>,
        /// The rank of each row, or `NO_RANK`.
        ranks: Vec<u32>,
    },
}

impl DrawRanks {
    pub(crate) fn of(scene: &Scene) -> Self {
        if scene.draws_by_rows() {
            return Self::Rows;
        }
        let rows = scene.draw_order().to_vec();
        let mut ranks = vec![NO_RANK; scene.row_count()];
        for (&row, rank) in rows.iter().zip(0..) {
            ranks[row as usize] = rank;
        }
        Self::Order { rows, ranks }
    }

    /// The rank of a row, if it has one.
    pub(crate) fn rank(&self, row: u32) -> Option<u32> {
        match self {
            Self::Rows => Some(row),
            Self::Order { ranks, .. } => {
                let rank = ranks.get(row as usize).copied();
                rank.filter(|&rank| rank != NO_RANK)
            }
        }
    }

    /// Returns `true` if the rows of all items have ranks.
    pub(crate) fn have_all<I>(&self, items: &[I], row: impl Fn(&I) -> u32) -> bool {
        matches!(self, Self::Rows) || items.iter().all(|item| self.rank(row(item)).is_some())
    }

    /// The row of a rank.
    pub(crate) fn row(&self, rank: u32) -> u32 {
        match self {
            Self::Rows => rank,
            Self::Order { rows, .. } => rows[rank as usize],
        }
    }

    /// Number of ranks.
    pub(crate) fn count(&self, scene: &Scene) -> usize {
        match self {
            Self::Rows => scene.row_count(),
            Self::Order { rows, .. } => rows.len(),
        }
    }
}
