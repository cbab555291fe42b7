//! The header of a journal file: identifies the state of the layout file that its entries change.

use std::fs;
use std::io::{self, Read};
use std::path::Path;
use std::time::UNIX_EPOCH;

/// First bytes of every journal; the digit is the version of the entries.
const MAGIC: &[u8; 8] = b"GWJRNAL2";
/// Magic, size and time of the layout file, saved bytes.
pub(super) const HEADER_BYTES: usize = 8 + 8 + 16 + 8;

/// The header of a journal, and the entry bytes that are saved.
pub(super) fn read_header(journal: &mut impl Read) -> io::Result<([u8; HEADER_BYTES], u64)> {
    let mut header = [0; HEADER_BYTES];
    journal.read_exact(&mut header)?;
    let saved = header.last_chunk().map_or(0, |n| u64::from_le_bytes(*n));
    Ok((header, saved))
}

/// The header for the present state of a layout file.
pub(super) fn header(layout_file: &Path, saved_bytes: u64) -> io::Result<[u8; HEADER_BYTES]> {
    let metadata = fs::metadata(layout_file)?;
    let since = metadata.modified()?.duration_since(UNIX_EPOCH);
    let mut header = [0; HEADER_BYTES];
    header[..8].copy_from_slice(MAGIC);
    header[8..16].copy_from_slice(&metadata.len().to_le_bytes());
    // A time before 1970 counts as 1970.
    header[16..32].copy_from_slice(&since.map_or(0, |since| since.as_nanos()).to_le_bytes());
    header[32..].copy_from_slice(&saved_bytes.to_le_bytes());
    Ok(header)
}
