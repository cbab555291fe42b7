//! Tag bytes of the journal format. Journals outlive program versions: values never change.

pub(super) const DO: u8 = 1;
pub(super) const UNDO: u8 = 2;
pub(super) const REDO: u8 = 3;
pub(super) const TRY: u8 = 4;
pub(super) const TRANSFORM: u8 = 11;
pub(super) const RESHAPE: u8 = 12;
pub(super) const RESTYLE: u8 = 13;
pub(super) const SET_STATES: u8 = 14;
pub(super) const INSERT: u8 = 15;
pub(super) const MOVE_NODES: u8 = 16;
pub(super) const TABLES: u8 = 17;
pub(super) const RESHAPE_AS_WRITTEN: u8 = 18;
pub(super) const INSERT_AS_WRITTEN: u8 = 19;
pub(super) const COPY: u8 = 20;

// After `TABLES`:
pub(super) const SET_IDS: u8 = 1;
pub(super) const SET_VALUES: u8 = 2;
pub(super) const SET_COLUMN: u8 = 3;
pub(super) const SET_ENTRIES: u8 = 4;
pub(super) const SET_ENDS: u8 = 5;
pub(super) const SET_DIRECTIONS: u8 = 6;
pub(super) const SET_LEVELS: u8 = 7;
pub(super) const SET_STATION_NODES: u8 = 8;
pub(super) const SET_MEMBERS: u8 = 9;
pub(super) const MOVE: u8 = 10;
pub(super) const INSERT_PLACES: u8 = 11;
pub(super) const SET_EXISTS: u8 = 12;
pub(super) const SET_ZONE_LEVELS: u8 = 13;
pub(super) const INSERT_LEVEL: u8 = 14;
pub(super) const REMOVE_LEVEL: u8 = 15;
pub(super) const SET_LEVEL: u8 = 16;
pub(super) const SET_VEHICLE_TYPES: u8 = 17;
