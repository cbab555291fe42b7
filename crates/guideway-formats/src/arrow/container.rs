//! Arrow container: finds the schema and the messages of an IPC file or stream, and checks their
//! ranges.

use std::ops::Range;

use arrow_ipc::{Block, Endianness, Footer, Schema as IpcSchema};
use arrow_schema::Schema;
use guideway_layout::Place;

use super::catch_decode_panic::catch_decode_panic;
use super::column_names::{HILBERT_ORDER, ORDER_KEY};
use super::extents::{EXTENTS_KEY, Extent, extents};
use super::problems::damaged;
use crate::Problem;
use crate::input::Input;

/// Start of a message since Arrow 0.15; older messages start with their length.
const CONTINUATION_MARKER: [u8; 4] = [0xFF; 4];
const MAGIC: &[u8] = b"ARROW1";
/// Bytes of the length of a message header.
const LENGTH_BYTES: usize = 4;
/// Footer length and the closing magic.
const TRAILER_BYTES: usize = 4 + MAGIC.len();
/// The magic at the start, padded.
const LEADER_BYTES: usize = 8;

/// Schema and messages of a file or stream, in decoding order.
#[derive(Debug)]
pub(super) struct Container {
    pub(super) schema: Schema,
    pub(super) messages: Vec<Message>,
    /// The paths follow a Hilbert curve.
    pub(super) is_hilbert_ordered: bool,
}

/// Ranges of a message: the header (length and flatbuffer) and the body (the buffers that it
/// describes).
#[derive(Clone, Debug)]
pub(super) struct Message {
    header: Range<usize>,
    pub(super) body: Range<usize>,
    /// Extent of a record batch, if the footer states it.
    pub(super) extent: Option<Extent>,
}

impl Message {
    /// Bytes of the header and the body.
    pub(super) fn bytes(&self) -> u64 {
        (self.header.len() + self.body.len()) as u64
    }

    /// Reads the flatbuffer.
    pub(super) fn header(&self, input: &Input<'_>) -> Result<Vec<u8>, Problem> {
        let mut header = input.bytes(self.header.clone())?;
        let marker = header.strip_prefix(&CONTINUATION_MARKER);
        let prefix = header.len() - marker.unwrap_or(&header).len() + LENGTH_BYTES;
        header.drain(..prefix.min(header.len()));
        Ok(header)
    }

    /// Names the place for errors.
    pub(super) fn place(&self) -> String {
        format!("message at byte {}", self.header.start)
    }
}

/// Finds all messages. The ranges lie within the input and are disjoint.
///
/// # Errors
/// When the input is truncated, or its structure is contradictory.
pub(super) fn open(input: &Input<'_>) -> Result<Container, Problem> {
    let first = input.bytes(0..MAGIC.len().min(input.len()))?;
    if first == MAGIC {
        open_file(input)
    } else {
        open_stream(input)
    }
}

fn open_file(input: &Input<'_>) -> Result<Container, Problem> {
    let truncated = |detail: &str| Problem::Truncated {
        at: input.len() as u64,
        detail: detail.into(),
    };
    let missing = || truncated("the footer at the end of an Arrow file is missing");
    let trailer_at = input
        .len()
        .checked_sub(TRAILER_BYTES)
        .filter(|&at| at >= LEADER_BYTES)
        .ok_or_else(missing)?;
    if input.bytes(trailer_at + LENGTH_BYTES..input.len())? != MAGIC {
        return Err(missing());
    }
    let declared = i64::from(read_i32(input, trailer_at)?);
    let footer_at = usize::try_from(declared)
        .ok()
        .and_then(|len| trailer_at.checked_sub(len))
        .filter(|&at| at >= LEADER_BYTES)
        .ok_or_else(|| damaged("footer", format!("invalid length of {declared} bytes")))?;
    let footer = input.bytes(footer_at..trailer_at)?;
    let footer = catch_decode_panic("footer", || {
        arrow_ipc::root_as_footer(&footer).map_err(|e| damaged("footer", e.to_string()))
    })?;
    let schema = footer
        .schema()
        .ok_or_else(|| damaged("footer", "the schema is missing"))?;
    Ok(Container {
        schema: convert_schema(schema)?,
        messages: file_messages(&footer, footer_at)?,
        is_hilbert_ordered: metadata(&footer, ORDER_KEY) == Some(HILBERT_ORDER),
    })
}

fn file_messages(footer: &Footer<'_>, footer_at: usize) -> Result<Vec<Message>, Problem> {
    let dictionaries = footer.dictionaries().into_iter().flatten();
    let batches = footer.recordBatches().into_iter().flatten();
    let mut messages = Vec::new();
    let mut extents = dictionaries.clone().map(|_| None).chain(extents_of(footer));
    for (index, block) in dictionaries.chain(batches).enumerate() {
        let place = || format!("block {index}");
        let (header, end) = block_range(block)
            .filter(|(header, end)| header.start >= LEADER_BYTES && *end <= footer_at)
            .ok_or_else(|| damaged(place(), describe_block(block)))?;
        messages.push(Message {
            body: header.end..end,
            header,
            extent: extents.next().flatten(),
        });
    }
    check_disjoint(&messages)?;
    Ok(messages)
}

/// Returns the extents of the record batches that the metadata of the footer states. They are
/// ignored unless they are those of these batches.
fn extents_of(footer: &Footer<'_>) -> impl Iterator<Item = Option<Extent>> {
    let text = metadata(footer, EXTENTS_KEY);
    let batches = footer.recordBatches().map_or(0, |batches| batches.len());
    let all = text.and_then(|text| extents(text, batches));
    all.into_iter().flatten()
}

/// Returns a text of the metadata of the footer.
fn metadata<'a>(footer: &Footer<'a>, key: &str) -> Option<&'a str> {
    let mut metadata = footer.custom_metadata().into_iter().flatten();
    metadata.find(|entry| entry.key() == Some(key))?.value()
}

/// Returns the range of the header with its length prefix, and the end of the body.
fn block_range(block: &Block) -> Option<(Range<usize>, usize)> {
    let start = usize::try_from(block.offset()).ok()?;
    let header_len = usize::try_from(block.metaDataLength()).ok()?;
    let header_end = start.checked_add(header_len).filter(|_| header_len >= 8)?;
    let end = header_end.checked_add(usize::try_from(block.bodyLength()).ok()?)?;
    Some((start..header_end, end))
}

fn describe_block(block: &Block) -> String {
    format!(
        "its range at byte {} with {} + {} bytes is not within the file",
        block.offset(),
        block.metaDataLength(),
        block.bodyLength()
    )
}

/// Fails for blocks that share bytes: a small file could else represent any number of rows.
fn check_disjoint(messages: &[Message]) -> Result<(), Problem> {
    let mut order: Vec<&Message> = messages.iter().collect();
    order.sort_unstable_by_key(|m| m.header.start);
    for pair in order.windows(2) {
        if pair[1].header.start < pair[0].body.end {
            let at = pair[1].header.start;
            return Err(damaged("footer", format!("two blocks share byte {at}")));
        }
    }
    Ok(())
}

fn open_stream(input: &Input<'_>) -> Result<Container, Problem> {
    // Its messages are found by reading all.
    input.read_ahead();
    let mut cursor = StreamCursor { input, at: 0 };
    let (_, first) = cursor
        .next()?
        .ok_or_else(|| damaged("stream", "the schema is missing"))?;
    let schema = catch_decode_panic("stream", || {
        let message =
            arrow_ipc::root_as_message(&first).map_err(|e| damaged("stream", e.to_string()))?;
        message
            .header_as_schema()
            .ok_or_else(|| damaged("stream", "the first message is not a schema"))
            .and_then(convert_schema)
    })?;
    let mut messages = Vec::new();
    while let Some((message, _)) = cursor.next()? {
        messages.push(message);
    }
    Ok(Container {
        schema,
        messages,
        is_hilbert_ordered: false,
    })
}

/// Cursor over the messages of a stream.
struct StreamCursor<'a> {
    input: &'a Input<'a>,
    at: usize,
}

impl StreamCursor<'_> {
    /// Returns the next message and its flatbuffer.
    fn next(&mut self) -> Result<Option<(Message, Vec<u8>)>, Problem> {
        let (start, left) = (self.at, self.input.len() - self.at);
        if left == 0 {
            // The end-of-stream marker is optional.
            return Ok(None);
        }
        let marker = start..start + left.min(CONTINUATION_MARKER.len());
        if self.input.bytes(marker)? == CONTINUATION_MARKER {
            self.at += CONTINUATION_MARKER.len();
        }
        let declared = self.take(LENGTH_BYTES as i64)?;
        let header_len = i64::from(read_i32(self.input, declared.start)?);
        if header_len == 0 {
            return Ok(None);
        }
        let header = start..self.take(header_len)?.end;
        let mut message = Message {
            header,
            body: 0..0,
            extent: None,
        };
        let header = message.header(self.input)?;
        let body_len = catch_decode_panic(&message.place(), || {
            arrow_ipc::root_as_message(&header)
                .map(|m| m.bodyLength())
                .map_err(|e| damaged(message.place(), e.to_string()))
        })?;
        message.body = self.take(body_len)?;
        Ok(Some((message, header)))
    }

    /// Advances by `len` bytes; returns their range.
    fn take(&mut self, len: i64) -> Result<Range<usize>, Problem> {
        let start = self.at;
        let len = usize::try_from(len).map_err(|_| {
            damaged(
                format!("message at byte {start}"),
                format!("invalid length of {len} bytes"),
            )
        })?;
        let end = start
            .checked_add(len)
            .filter(|&end| end <= self.input.len());
        self.at = end.ok_or_else(|| Problem::Truncated {
            at: self.input.len() as u64,
            detail: format!("a range of {len} bytes begins at byte {start}"),
        })?;
        Ok(start..self.at)
    }
}

fn convert_schema(schema: IpcSchema<'_>) -> Result<Schema, Problem> {
    if schema.endianness() != Endianness::Little {
        return Err(Problem::Unsupported {
            place: Place::element("schema"),
            what: "big-endian byte order".into(),
            remedy: "Write the file again on a little-endian machine".into(),
        });
    }
    catch_decode_panic("schema", || {
        arrow_ipc::convert::try_fb_to_schema(schema).map_err(|e| damaged("schema", e.to_string()))
    })
}

/// Reads the number at `at`. The caller checks that it is within the input.
fn read_i32(input: &Input<'_>, at: usize) -> Result<i32, Problem> {
    let mut number = [0; LENGTH_BYTES];
    input.read(at, &mut number)?;
    Ok(i32::from_le_bytes(number))
}
