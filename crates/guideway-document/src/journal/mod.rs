//! What a person did, as bytes that are added to a file as it happens: after a crash the file as it was read and
//! these give back the work.
//!
//! A record is the number of its bytes, a checksum, and the act; all numbers little-endian. A record that was cut
//! off by a crash ends the journal.

mod decode;
mod encode;

use guideway_scene::EditError;

use crate::{Change, Document};

/// One thing that was done.
#[derive(Clone, Debug)]
pub enum JournalEntry {
    /// Changes, as one step.
    Do(Vec<Change>),
    /// The last step was undone.
    Undo,
    /// It was done again.
    Redo,
}

/// How much of a journal could be done again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReplayProgress {
    /// Acts done.
    pub entries: usize,
    /// Bytes of the journal that they take. What follows is of no use.
    pub bytes: usize,
}

impl JournalEntry {
    /// The record of this act.
    pub fn to_record(&self) -> Vec<u8> {
        let payload = encode::act(self);
        let mut record = Vec::with_capacity(payload.len() + 8);
        record.extend((payload.len() as u32).to_le_bytes());
        record.extend(checksum(&payload).to_le_bytes());
        record.extend(payload);
        record
    }
}

/// Does what a journal says, as far as it is whole, with a document as it was when the journal began. `goes_on` is
/// told before each act how much is done, and ends it by false.
pub fn replay(
    journal: &[u8],
    document: &mut Document,
    mut goes_on: impl FnMut(ReplayProgress) -> bool,
) -> ReplayProgress {
    let mut done = ReplayProgress {
        entries: 0,
        bytes: 0,
    };
    let mut rest = journal;
    while let Some((payload, behind)) = next_record(rest).filter(|_| goes_on(done)) {
        let is_done = decode::act(payload).is_some_and(|act| act.perform(document).is_ok());
        if !is_done {
            break;
        }
        rest = behind;
        done.entries += 1;
        done.bytes = journal.len() - rest.len();
    }
    done
}

impl JournalEntry {
    fn perform(self, document: &mut Document) -> Result<(), EditError> {
        match self {
            Self::Do(changes) => document.perform("recovered edit", changes)?,
            Self::Undo => drop(document.undo()),
            Self::Redo => drop(document.redo()),
        }
        Ok(())
    }
}

fn next_record(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (len, rest) = bytes.split_first_chunk()?;
    let (sum, rest) = rest.split_first_chunk()?;
    let (payload, behind) = rest.split_at_checked(u32::from_le_bytes(*len) as usize)?;
    (checksum(payload) == u32::from_le_bytes(*sum)).then_some((payload, behind))
}

/// FNV-1a (Fowler, Noll, Vo), 32 bits.
fn checksum(bytes: &[u8]) -> u32 {
    let step = |hash: u32, &byte: &u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    bytes.iter().fold(0x811c_9dc5, step)
}

/// What kind of thing follows.
mod tag {
    pub(super) const DO: u8 = 1;
    pub(super) const UNDO: u8 = 2;
    pub(super) const REDO: u8 = 3;
    pub(super) const TRANSFORM: u8 = 11;
    pub(super) const RESHAPE: u8 = 12;
    pub(super) const RESTYLE: u8 = 13;
    pub(super) const SET_STATES: u8 = 14;
    pub(super) const INSERT: u8 = 15;
    pub(super) const MOVE_NODES: u8 = 16;
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Direction, Geometry, OwnStyle};
    use guideway_scene::{Edit, Insertion, PathState};
    use guideway_spline::{Affine, Point, Runs};

    use super::*;

    /// One of every kind of change.
    fn everything() -> JournalEntry {
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, 1.0), Point::new(2.0, 3.0));
        let mut curves = Geometry::default();
        curves.push(&runs);
        let style = OwnStyle {
            width_m: Some(0.5),
            color_rgba: None,
        };
        let insertion = Insertion {
            id: "é".into(),
            runs,
            start_node: Some(3),
            direction: Direction::Both,
            vehicle_types: vec!["a".into(), "b".into()],
            style,
            attributes_of: Some(7),
            ..Insertion::default()
        };
        let edits = [
            Edit::Transform {
                paths: [1, 2].into(),
                by: Affine::rotation(0.3, Point::new(1.0, 2.0)),
            },
            Edit::Reshape {
                paths: [4].into(),
                curves: curves.into(),
            },
            Edit::Restyle([(1, style)].into()),
            Edit::SetStates([(1, PathState::Hidden), (2, PathState::Removed)].into()),
            Edit::Insert([insertion].into()),
        ];
        let mut changes: Vec<Change> = edits.into_iter().map(Change::Scene).collect();
        changes.push(Change::MoveNodes([(1, Point::new(5.0, 6.0))].into()));
        JournalEntry::Do(changes)
    }

    #[test]
    fn an_act_comes_back_as_it_was_written() {
        for act in [everything(), JournalEntry::Undo, JournalEntry::Redo] {
            let bytes = encode::act(&act);
            let again = decode::act(&bytes).unwrap();
            assert_eq!(format!("{again:?}"), format!("{act:?}"));
        }
    }

    #[test]
    fn damage_is_refused_or_is_another_act() {
        let bytes = encode::act(&everything());
        for len in 0..bytes.len() {
            assert!(decode::act(&bytes[..len]).is_none(), "cut at {len}");
        }
        for at in 0..bytes.len() {
            for flip in [1, 0x80, 0xff] {
                let mut damaged = bytes.clone();
                damaged[at] ^= flip;
                // Must end, and not panic.
                let _ = decode::act(&damaged);
            }
        }
    }
}
