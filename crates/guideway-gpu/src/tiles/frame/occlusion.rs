//! Decides when to draw a window in two occlusion passes: the first draws every fourth cluster, the
//! second flattens of the others only lines that touch a tile that is not full yet. The picture is
//! the same.

use super::window::Window;
use crate::tiles::layouts::FrameCounters;

/// Least mean length of tile lists for which testing for full tiles pays: D2 with all paths in view
/// is above, D1 below. Measured by `guideway bench d2 --methods gpu+rebuild`.
const MIN_MEAN_LIST: u64 = 512;

/// Occlusion state, learned from earlier frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Occlusion {
    pub(crate) is_enabled: bool,
    /// References of a frame in one pass.
    references_in_one_pass: u32,
    /// References of the frame for which two passes did not pay.
    disabled_above: u32,
}

impl Occlusion {
    /// Updates after a window that was drawn completely. Two-pass occlusion stays on while it
    /// halves the tile lists.
    pub(crate) fn update(&mut self, window: &Window, counters: &FrameCounters) {
        let tiles = window.tiles() as u64;
        let hides = 4 * u64::from(counters.full_tiles) >= tiles;
        if self.is_enabled {
            // The second pass over each tile costs about as much as half of the lists.
            self.is_enabled = hides && counters.references <= self.references_in_one_pass / 2;
            if !self.is_enabled {
                self.disabled_above = self.references_in_one_pass;
            }
            return;
        }
        self.references_in_one_pass = counters.references;
        let is_crowded = u64::from(counters.references) >= MIN_MEAN_LIST * tiles;
        self.is_enabled = is_crowded && hides && !self.was_useless();
    }

    /// Enables two passes after a window that exceeded capacities, unless they were useless before.
    /// Returns whether the window should be drawn again.
    pub(crate) fn enable(&mut self, counters: &FrameCounters, line_capacity: u32) -> bool {
        if self.is_enabled {
            return false;
        }
        // Lines beyond the capacity are in no list.
        let listed = counters.lines.min(line_capacity).max(1);
        let all = u64::from(counters.references) * u64::from(counters.lines) / u64::from(listed);
        self.references_in_one_pass = u32::try_from(all).unwrap_or(u32::MAX);
        self.is_enabled = !self.was_useless();
        self.is_enabled
    }

    /// Returns `true` if two passes did not pay for lists of similar length.
    fn was_useless(&self) -> bool {
        let similar = self.disabled_above / 2..=self.disabled_above.saturating_mul(2);
        self.disabled_above > 0 && similar.contains(&self.references_in_one_pass)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Window = Window {
        columns: 0..10,
        rows: 0..10,
    };

    fn counters(references: u32, full_tiles: u32) -> FrameCounters {
        FrameCounters {
            lines: references,
            references,
            full_tiles,
            ..FrameCounters::default()
        }
    }

    #[test]
    fn is_enabled_while_it_halves_long_lists() {
        let mut occlusion = Occlusion::default();
        for few in [counters(50_000, 90), counters(60_000, 20)] {
            occlusion.update(&WINDOW, &few);
            assert!(!occlusion.is_enabled);
        }
        occlusion.update(&WINDOW, &counters(60_000, 30));
        assert!(occlusion.is_enabled);
        occlusion.update(&WINDOW, &counters(20_000, 30));
        assert!(occlusion.is_enabled);
        // Few tiles are full in a near view, and its short lists say nothing.
        occlusion.update(&WINDOW, &counters(20, 3));
        assert!(!occlusion.is_enabled);
    }

    #[test]
    fn stays_disabled_for_lists_that_it_did_not_shorten() {
        let mut occlusion = Occlusion::default();
        assert!(occlusion.enable(&counters(60_000, 0), 60_000));
        assert!(!occlusion.enable(&counters(60_000, 0), 60_000));
        occlusion.update(&WINDOW, &counters(40_000, 90));
        assert!(!occlusion.is_enabled);
        occlusion.update(&WINDOW, &counters(61_000, 90));
        assert!(!occlusion.is_enabled);
        occlusion.update(&WINDOW, &counters(300_000, 90));
        assert!(occlusion.is_enabled);
    }
}
