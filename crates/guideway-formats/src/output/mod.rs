//! Output files: a file is written beside its target, synced to its disk, and put in the place of
//! the target, whole or not at all.
//!
//! | module | purpose |
//! |---|---|
//! | `new_file` | [`NewFile`] and [`replace_file`]: the steps from the first byte to the new file |
//! | `place` | what is at the target: nothing, a file, or a device |
//! | `part` | the unfinished file: its name, its lock, the sweep of stale ones |
//! | `metadata` | owner, permissions and extended attributes of the old file |
//! | `overwrite` | writes into the old file, where a rename cannot keep what it is |
//! | `disk` | the calls of the operating system, each of which fails in a test |
//! | `regular_file` | locked files that the program keeps, such as journals |
//! | `save_error` | [`SaveError`] |

mod disk;
mod metadata;
mod new_file;
mod overwrite;
mod part;
mod place;
mod regular_file;
mod save_error;

pub use new_file::{NewFile, replace_file};
pub use part::{remove_unfinished, try_remove_unfinished};
pub use place::is_same_file;
pub use regular_file::lock_regular_file;
pub use save_error::SaveError;

#[cfg(test)]
mod tests;
