//! Journal: edits as bytes, appended to a file while they happen, from which work is recovered
//! after a crash.
//!
//! A record is its payload size, a checksum of the payload, and the payload, all little-endian:
//!
//! ```text
//! | u32 size | u32 FNV-1a | payload: u8 tag, content ... | u32 size | ...
//! ```
//!
//! A record that a crash cut off ends the journal.
//!
//! | file | input | output |
//! |---|---|---|
//! | `entry` | | [`JournalEntry`] |
//! | `encode`, `decode`, and `_tables` for edits of tables | entry, payload | payload, entry |
//! | `record` | payload | record with size and checksum, and back |
//! | `replay` | journal, document | the recovered document |

mod decode;
mod decode_tables;
mod encode;
mod encode_tables;
mod entry;
mod record;
mod replay;
mod tag;

pub use entry::JournalEntry;
pub use record::count_records;
pub use replay::{ReplayProgress, replay};

#[cfg(test)]
mod tests;
