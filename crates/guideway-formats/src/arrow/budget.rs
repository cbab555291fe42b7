//! Expansion budget: limits the bytes that a file may expand to in memory.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::Problem;

/// Bytes that a file may expand to beyond its size, shared by all threads.
///
/// Compressed buffers, dictionaries and views let a small file represent a large table. Real files
/// stay far below the limit; a malicious one fails before the memory is allocated.
#[derive(Debug)]
pub(super) struct Budget {
    limit: AtomicU64,
    used: AtomicU64,
}

impl Budget {
    const FLOOR_BYTES: u64 = 256 << 20;
    const PER_FILE_BYTE: u64 = 64;

    /// Makes the budget of a file.
    pub(super) fn for_file(file_bytes: usize) -> Self {
        let budget = Self {
            limit: AtomicU64::new(Self::FLOOR_BYTES),
            used: AtomicU64::new(0),
        };
        budget.admit(file_bytes);
        budget
    }

    /// Adds bytes of input, such as those of a record batch in memory.
    pub(super) fn admit(&self, bytes: usize) {
        let more = (bytes as u64).saturating_mul(Self::PER_FILE_BYTE);
        let with = |limit: u64| limit.saturating_add(more);
        self.limit
            .update(Ordering::Relaxed, Ordering::Relaxed, with);
    }

    /// Charges `bytes` before they are allocated.
    ///
    /// # Errors
    /// When the budget is exceeded.
    pub(super) fn charge(&self, bytes: u64) -> Result<(), Problem> {
        let with = |used: u64| used.saturating_add(bytes);
        let used = with(self.used.update(Ordering::Relaxed, Ordering::Relaxed, with));
        let limit = self.limit.load(Ordering::Relaxed);
        if used <= limit {
            return Ok(());
        }
        Err(Problem::LimitReached {
            what: "bytes that the file expands to",
            limit,
            actual: used,
        })
    }
}
