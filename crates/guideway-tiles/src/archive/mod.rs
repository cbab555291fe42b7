//! The journal of finished tiles, and the file in the format PMTiles 3 that holds them at the end.
//!
//! Source: PMTiles Version 3 Specification (<https://github.com/protomaps/PMTiles>).
//!
//! ```text
//!   journal   key | block: counts, entries, tiles | block ...        grows while tiles are made
//!                                 |
//!   archive   header | root directory | metadata | leaf directories | tiles
//! ```
//!
//! | module | does |
//! |---|---|
//! | `journal` | keeps each block when it is done, so that a stopped run goes on; equal tiles once |
//! | `directory` | the entries of tiles by number, compressed |
//! | `write` | header, metadata, and the order of the parts |

mod directory;
mod journal;
mod write;

pub(crate) use journal::BlockCounts;
pub use journal::Journal;
pub use write::{ArchiveInfo, ArchiveSize};

#[cfg(test)]
mod tests;
