//! Selection and exact edits: search by name and query, numeric moves, commands on the selection.

mod commands;
mod exact_edit;
mod find;

pub(crate) use commands::selection_command;
pub(crate) use exact_edit::ExactEdit;
pub(crate) use find::Find;
