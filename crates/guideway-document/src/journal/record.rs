//! Records: payloads framed by their size and checksum.

use std::io::{self, Read, Seek, SeekFrom};

use super::encode;
use super::entry::JournalEntry;

/// Size and checksum before each payload.
const FRAME_BYTES: usize = 8;

impl JournalEntry {
    /// The entry as a record to append to a journal file.
    pub fn to_record(&self) -> Vec<u8> {
        let payload = encode::encode(self);
        let mut record = Vec::with_capacity(payload.len() + FRAME_BYTES);
        record.extend((payload.len() as u32).to_le_bytes());
        record.extend(checksum(&payload).to_le_bytes());
        record.extend(payload);
        record
    }
}

/// Counts the whole records from the present position of a journal on, without their payloads.
///
/// # Errors
/// When the journal cannot be read.
pub fn count_records(journal: &mut (impl Read + Seek)) -> io::Result<u64> {
    let start = journal.stream_position()?;
    let mut left = journal.seek(SeekFrom::End(0))?.saturating_sub(start);
    journal.seek(SeekFrom::Start(start))?;
    let mut count = 0;
    let mut frame = [0; FRAME_BYTES];
    while left >= FRAME_BYTES as u64 {
        journal.read_exact(&mut frame)?;
        let size = frame
            .first_chunk()
            .map_or(0, |size| u32::from_le_bytes(*size));
        left -= FRAME_BYTES as u64;
        if left < u64::from(size) {
            break;
        }
        journal.seek_relative(size.into())?;
        left -= u64::from(size);
        count += 1;
    }
    Ok(count)
}

/// Splits the first record off `bytes`: its payload and the remaining bytes. `None` if the record
/// is incomplete or its checksum does not match.
pub(super) fn next_payload(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let (size, rest) = bytes.split_first_chunk()?;
    let (sum, rest) = rest.split_first_chunk()?;
    let (payload, rest) = rest.split_at_checked(u32::from_le_bytes(*size) as usize)?;
    (checksum(payload) == u32::from_le_bytes(*sum)).then_some((payload, rest))
}

/// FNV-1a with 32 bits (Fowler, Noll, Vo).
fn checksum(bytes: &[u8]) -> u32 {
    let step = |hash: u32, &byte: &u8| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193);
    bytes.iter().fold(0x811c_9dc5, step)
}
