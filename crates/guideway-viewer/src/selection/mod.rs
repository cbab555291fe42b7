//! Selection and exact edits: search by name and query, numeric moves, commands on the selection.

mod arrange;
mod commands;
mod copied;
mod exact_edit;
mod find;
mod prompted;

pub(crate) use arrange::{PointerPlace, arrange_command};
pub(crate) use commands::{DUPLICATE_OFFSET_PX, counts, selection_command};
pub(crate) use copied::CopiedElements;
pub(crate) use exact_edit::ExactEdit;
pub(crate) use find::Find;
pub(crate) use prompted::{TextQuestion, level_names, prompted_edit, question};
