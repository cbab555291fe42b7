use std::sync::atomic::{AtomicU64, Ordering};

use crate::Problem;

/// How many bytes a file may swell to beyond its own size.
///
/// Compressed buffers, dictionaries and views let a small file stand for a large table. Real ones stay
/// far below this; a file made to exhaust memory is stopped before the memory is asked for. Threads share it.
#[derive(Debug)]
pub(super) struct Budget {
    limit: u64,
    used: AtomicU64,
}

impl Budget {
    const FLOOR_BYTES: u64 = 256 << 20;
    const PER_FILE_BYTE: u64 = 64;

    pub(super) fn for_file(file_bytes: usize) -> Self {
        let limit = (file_bytes as u64).saturating_mul(Self::PER_FILE_BYTE) + Self::FLOOR_BYTES;
        let used = AtomicU64::new(0);
        Self { limit, used }
    }

    /// Notes that `bytes` are about to be made.
    pub(super) fn charge(&self, bytes: u64) -> Result<(), Problem> {
        let with = |used: u64| used.saturating_add(bytes);
        let used = with(self.used.update(Ordering::Relaxed, Ordering::Relaxed, with));
        if used <= self.limit {
            return Ok(());
        }
        Err(Problem::LimitReached {
            what: "bytes that the file swells to",
            limit: self.limit,
            actual: used,
        })
    }
}
