use std::ops::Range;

use arrow_ipc::{Block, Endianness, Footer, Schema as IpcSchema};
use arrow_schema::Schema;
use guideway_layout::Place;

use super::guard::{damaged, guarded};
use crate::Problem;
use crate::input::Input;

/// What a message begins with since Arrow 0.15; before, with its length at once.
const CONTINUATION_MARKER: [u8; 4] = [0xFF; 4];
const MAGIC: &[u8] = b"ARROW1";
/// The length of a message's head.
const LENGTH_BYTES: usize = 4;
/// Footer length and the closing magic.
const TRAILER_BYTES: usize = 4 + MAGIC.len();
/// The magic at the start, padded.
const LEADER_BYTES: usize = 8;

/// Where the messages of a file or stream lie, in the order in which they have to be decoded.
#[derive(Debug)]
pub(super) struct Container {
    pub(super) schema: Schema,
    pub(super) messages: Vec<Message>,
}

/// One message: a flatbuffer that describes it, with its length before it, and the buffers that it describes.
#[derive(Clone, Debug)]
pub(super) struct Message {
    header: Range<usize>,
    pub(super) body: Range<usize>,
}

impl Message {
    /// The flatbuffer.
    pub(super) fn header(&self, input: &Input<'_>) -> Result<Vec<u8>, Problem> {
        let mut header = input.bytes(self.header.clone())?;
        let marker = header.strip_prefix(&CONTINUATION_MARKER);
        let prefix = header.len() - marker.unwrap_or(&header).len() + LENGTH_BYTES;
        header.drain(..prefix.min(header.len()));
        Ok(header)
    }

    /// Where it begins, as errors name it.
    pub(super) fn place(&self) -> String {
        format!("message at byte {}", self.header.start)
    }
}

/// Finds all messages. Every range returned lies within the input, and none shares a byte with another.
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
        .ok_or_else(|| {
            damaged(
                "footer",
                format!("a length of {declared} bytes is declared"),
            )
        })?;
    let footer = input.bytes(footer_at..trailer_at)?;
    let footer = guarded("footer", || {
        arrow_ipc::root_as_footer(&footer).map_err(|e| damaged("footer", e.to_string()))
    })?;
    let schema = footer
        .schema()
        .ok_or_else(|| damaged("footer", "there is no schema"))?;
    let container = Container {
        schema: convert_schema(schema)?,
        messages: file_messages(&footer, footer_at)?,
    };
    input.read_ahead();
    Ok(container)
}

fn file_messages(footer: &Footer<'_>, footer_at: usize) -> Result<Vec<Message>, Problem> {
    let dictionaries = footer.dictionaries().into_iter().flatten();
    let batches = footer.recordBatches().into_iter().flatten();
    let mut messages = Vec::new();
    for (index, block) in dictionaries.chain(batches).enumerate() {
        let place = || format!("block {index}");
        let (header, end) = block_range(block)
            .filter(|(header, end)| header.start >= LEADER_BYTES && *end <= footer_at)
            .ok_or_else(|| damaged(place(), block_text(block)))?;
        let body = header.end..end;
        messages.push(Message { header, body });
    }
    check_apart(&messages)?;
    Ok(messages)
}

/// The range of the header, with its length prefix, and the end of the body.
fn block_range(block: &Block) -> Option<(Range<usize>, usize)> {
    let start = usize::try_from(block.offset()).ok()?;
    let header_len = usize::try_from(block.metaDataLength()).ok()?;
    let header_end = start.checked_add(header_len).filter(|_| header_len >= 8)?;
    let end = header_end.checked_add(usize::try_from(block.bodyLength()).ok()?)?;
    Some((start..header_end, end))
}

fn block_text(block: &Block) -> String {
    format!(
        "it is declared at byte {} with {} + {} bytes, which is not within the file",
        block.offset(),
        block.metaDataLength(),
        block.bodyLength()
    )
}

/// Blocks that share bytes would let a small file stand for any number of rows.
fn check_apart(messages: &[Message]) -> Result<(), Problem> {
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
    input.read_ahead();
    let mut walk = Walk { input, at: 0 };
    let (_, first) = walk
        .next()?
        .ok_or_else(|| damaged("stream", "it ends before its schema"))?;
    let schema = guarded("stream", || {
        let message =
            arrow_ipc::root_as_message(&first).map_err(|e| damaged("stream", e.to_string()))?;
        message
            .header_as_schema()
            .ok_or_else(|| damaged("stream", "it does not begin with a schema"))
            .and_then(convert_schema)
    })?;
    let mut messages = Vec::new();
    while let Some((message, _)) = walk.next()? {
        messages.push(message);
    }
    Ok(Container { schema, messages })
}

/// Goes through the messages of a stream, one after the other.
struct Walk<'a> {
    input: &'a Input<'a>,
    at: usize,
}

impl Walk<'_> {
    /// The next message, and its flatbuffer.
    fn next(&mut self) -> Result<Option<(Message, Vec<u8>)>, Problem> {
        let (start, left) = (self.at, self.input.len() - self.at);
        if left == 0 {
            // A stream may end without its end mark.
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
        let mut message = Message { header, body: 0..0 };
        let header = message.header(self.input)?;
        let body_len = guarded(&message.place(), || {
            arrow_ipc::root_as_message(&header)
                .map(|m| m.bodyLength())
                .map_err(|e| damaged(message.place(), e.to_string()))
        })?;
        message.body = self.take(body_len)?;
        Ok(Some((message, header)))
    }

    fn take(&mut self, len: i64) -> Result<Range<usize>, Problem> {
        let start = self.at;
        let len = usize::try_from(len).map_err(|_| {
            damaged(
                format!("message at byte {start}"),
                format!("a length of {len} bytes is declared"),
            )
        })?;
        let end = start
            .checked_add(len)
            .filter(|&end| end <= self.input.len());
        self.at = end.ok_or_else(|| Problem::Truncated {
            at: self.input.len() as u64,
            detail: format!("{len} bytes are declared at byte {start}"),
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
    guarded("schema", || {
        arrow_ipc::convert::try_fb_to_schema(schema).map_err(|e| damaged("schema", e.to_string()))
    })
}

/// The number at `at`, which the caller knows to be within the input.
fn read_i32(input: &Input<'_>, at: usize) -> Result<i32, Problem> {
    let mut number = [0; LENGTH_BYTES];
    input.read(at, &mut number)?;
    Ok(i32::from_le_bytes(number))
}
