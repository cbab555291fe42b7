//! Options of the LIF writer.

use std::time::SystemTime;

use crate::lif::version::Version;

/// Options of [`write_layout`](super::write_layout).
#[derive(Clone, Copy, Debug)]
pub struct WriteOptions {
    /// Version of the format.
    pub version: Version,
    /// Time of the export, for `exportTimestamp` of a new file.
    pub exported: SystemTime,
}
