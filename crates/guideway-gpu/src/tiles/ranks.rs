//! Which path a draw rank of the device stands for.

use guideway_scene::Scene;

const NONE: u32 = u32::MAX;

/// Draw ranks as the device has them. They stay as they are while the scene is edited.
pub(super) enum Ranks {
    /// The layout ranks no path: the rank is the row.
    Rows,
    /// Places in the draw order as it was.
    Places {
        /// The row of each rank.
        rows: Vec<u32>,
        /// The rank of each row, if it was drawn.
        ranks: Vec<u32>,
    },
}

impl Ranks {
    pub(super) fn of(scene: &Scene) -> Self {
        if scene.layout().paths.rank().is_none() {
            return Self::Rows;
        }
        let rows = scene.draw_order().to_vec();
        let mut ranks = vec![NONE; scene.row_count()];
        for (&row, rank) in rows.iter().zip(0..) {
            ranks[row as usize] = rank;
        }
        Self::Places { rows, ranks }
    }

    /// The rank of a row, if it has one.
    pub(super) fn rank(&self, row: u32) -> Option<u32> {
        match self {
            Self::Rows => Some(row),
            Self::Places { ranks, .. } => {
                let rank = ranks.get(row as usize).copied();
                rank.filter(|&rank| rank != NONE)
            }
        }
    }

    /// The row of a rank.
    pub(super) fn row(&self, rank: u32) -> u32 {
        match self {
            Self::Rows => rank,
            Self::Places { rows, .. } => rows[rank as usize],
        }
    }

    /// Number of ranks that a table of them has.
    pub(super) fn count(&self, scene: &Scene) -> usize {
        match self {
            Self::Rows => scene.row_count(),
            Self::Places { rows, .. } => rows.len(),
        }
    }
}
