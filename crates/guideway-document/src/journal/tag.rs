//! Tag bytes of the journal format. Journals outlive program versions: values never change.

pub(super) const DO: u8 = 1;
pub(super) const UNDO: u8 = 2;
pub(super) const REDO: u8 = 3;
pub(super) const TRANSFORM: u8 = 11;
pub(super) const RESHAPE: u8 = 12;
pub(super) const RESTYLE: u8 = 13;
pub(super) const SET_STATES: u8 = 14;
pub(super) const INSERT: u8 = 15;
pub(super) const MOVE_NODES: u8 = 16;
