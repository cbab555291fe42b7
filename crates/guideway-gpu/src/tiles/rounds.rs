//! Whether a frame first finds out what is hidden: it draws some clusters, and lists of the others only lines that
//! reach a tile that is not full yet. The picture is the same either way.

use super::params::Found;
use super::window::Window;

/// Shortest mean list of a tile for which looking takes less time than it saves.
const SHORTEST_LIST: u64 = 512;

/// What was learnt from the frames before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Rounds {
    pub(super) are_on: bool,
    /// Length of all lists of a frame that left nothing out.
    listed_at_once: u32,
    /// As long as that, when rounds left out too few.
    in_vain_at: u32,
}

impl Rounds {
    /// After a frame of which all was drawn.
    pub(super) fn learn(&mut self, window: &Window, found: &Found) {
        let tiles = window.tiles() as u64;
        let hides = 4 * u64::from(found.full_tiles) >= tiles;
        if self.are_on {
            // The second look at each tile costs about what half of the lists does.
            self.are_on = hides && found.references <= self.listed_at_once / 2;
            if !self.are_on {
                self.in_vain_at = self.listed_at_once;
            }
            return;
        }
        self.listed_at_once = found.references;
        let is_crowded = u64::from(found.references) >= SHORTEST_LIST * tiles;
        self.are_on = is_crowded && hides && !self.was_in_vain();
    }

    /// After a frame that found more than there is room for, with room for so many lines: whether it should be drawn
    /// again in rounds.
    pub(super) fn may_help(&mut self, found: &Found, line_room: u32) -> bool {
        if self.are_on {
            return false;
        }
        // Lines that had no room are in no list.
        let listed = found.lines.min(line_room).max(1);
        let all = u64::from(found.references) * u64::from(found.lines) / u64::from(listed);
        self.listed_at_once = u32::try_from(all).unwrap_or(u32::MAX);
        self.are_on = !self.was_in_vain();
        self.are_on
    }

    /// Whether they were of no use for about as long lists.
    fn was_in_vain(&self) -> bool {
        let near = self.in_vain_at / 2..=self.in_vain_at.saturating_mul(2);
        self.in_vain_at > 0 && near.contains(&self.listed_at_once)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WINDOW: Window = Window {
        columns: 0..10,
        rows: 0..10,
    };

    fn found(references: u32, full_tiles: u32) -> Found {
        Found {
            lines: references,
            references,
            full_tiles,
            ..Found::default()
        }
    }

    #[test]
    fn they_begin_in_a_crowd_and_go_on_while_they_help() {
        let mut rounds = Rounds::default();
        for few in [found(50_000, 90), found(60_000, 20)] {
            rounds.learn(&WINDOW, &few);
            assert!(!rounds.are_on);
        }
        rounds.learn(&WINDOW, &found(60_000, 30));
        assert!(rounds.are_on);
        rounds.learn(&WINDOW, &found(20_000, 30));
        assert!(rounds.are_on);
        // From near there is little that hides anything, and short lists say nothing.
        rounds.learn(&WINDOW, &found(20, 3));
        assert!(!rounds.are_on);
    }

    #[test]
    fn they_are_not_tried_again_where_they_did_not_help() {
        let mut rounds = Rounds::default();
        assert!(rounds.may_help(&found(60_000, 0), 60_000));
        assert!(!rounds.may_help(&found(60_000, 0), 60_000));
        rounds.learn(&WINDOW, &found(40_000, 90));
        assert!(!rounds.are_on);
        rounds.learn(&WINDOW, &found(61_000, 90));
        assert!(!rounds.are_on);
        rounds.learn(&WINDOW, &found(300_000, 90));
        assert!(rounds.are_on);
    }
}
