//! Stores the identifier of a path in the extended data (xdata) of its entity, and reads it back.

use std::io::{self, Write};

use super::pair_writer::PairWriter;
use super::records::Record;
use super::text::TextDecoder;

/// The application name under which an entity stores the identifier of its path.
pub(super) const APP_ID: &str = "GUIDEWAY";

/// Largest text value of extended data, in bytes. Derived: the DXF reference allows 255, less
/// some slack.
const MAX_TEXT_BYTES: usize = 240;

/// Longest escape of one byte of text, in bytes: `\U+0000`.
const MAX_ESCAPE_BYTES: usize = 7;

/// The identifier that [`write_path_id`] left in an entity.
pub(super) fn read_path_id(record: &Record<'_>, texts: &TextDecoder) -> Option<String> {
    let mut pairs = record.pairs.iter();
    pairs.find(|pair| pair.code == 1001 && pair.text() == APP_ID.as_bytes())?;
    let parts = pairs.take_while(|pair| pair.code == 1000);
    Some(parts.map(|pair| texts.decode(pair.text())).collect())
}

/// Appends an identifier to an entity, split over as many text values as it needs.
pub(super) fn write_path_id<W: Write>(pairs: &mut PairWriter<'_, W>, id: &str) -> io::Result<()> {
    pairs.text(1001, APP_ID)?;
    let mut rest = id;
    loop {
        let length = rest.floor_char_boundary(MAX_TEXT_BYTES / MAX_ESCAPE_BYTES);
        let (part, after) = rest.split_at(length);
        pairs.text(1000, part)?;
        if after.is_empty() {
            return Ok(());
        }
        rest = after;
    }
}
