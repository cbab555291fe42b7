//! Elements other than paths: reads their rows, batch by batch, into the tables of the layout.
//!
//! | file | defines |
//! |---|---|
//! | `tables` | all kinds together, in the order in which they refer to each other |
//! | `element_rows` | identifiers, attributes and plain columns of one kind |
//! | `nodes`, `stations` | their tables |
//! | `type_rows` | properties of paths and nodes per vehicle type |
//! | `groups` | levels, vehicle types, blocks, zones, refused paths |
//! | `faults` | findings about values that do not fit |

mod element_rows;
mod faults;
mod groups;
mod nodes;
mod stations;
mod tables;
mod type_rows;

pub(super) use self::tables::ElementTables;
