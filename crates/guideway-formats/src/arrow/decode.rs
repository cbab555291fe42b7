use std::collections::HashMap;
use std::ops::Range;

use arrow_array::{ArrayRef, RecordBatch};
use arrow_ipc::reader::{read_dictionary, read_record_batch};
use arrow_ipc::{MessageHeader, RecordBatch as IpcBatch};
use arrow_schema::{ArrowError, SchemaRef};

use super::body::{ALIGNMENT, Bodies};
use super::budget::Budget;
use super::container::Message;
use super::guard::{damaged, guarded};
use super::polygons::Polygons;
use super::schema::points_buffer;
use crate::Problem;
use crate::input::Input;

/// Turns messages into record batches; buffers that are neither compressed nor misaligned are not
/// copied.
pub(super) struct Decoder<'a> {
    input: &'a Input<'a>,
    schema: SchemaRef,
    dictionaries: HashMap<i64, ArrayRef>,
    bodies: Bodies,
    /// The column of points.
    points: usize,
    /// Which buffer of a batch its coordinates are in, if that can be told.
    coordinates: Option<usize>,
}

/// A record batch, and its points, which may be left to be read.
pub(super) struct Decoded {
    pub(super) batch: RecordBatch,
    pub(super) polygons: Polygons,
}

impl<'a> Decoder<'a> {
    /// Of tables in which column `points` holds the points.
    pub(super) fn new(input: &'a Input<'a>, schema: SchemaRef, points: usize) -> Self {
        Self {
            points,
            coordinates: points_buffer(&schema, points),
            input,
            schema,
            dictionaries: HashMap::new(),
            bodies: Bodies::default(),
        }
    }

    pub(super) fn file_bytes(&self) -> usize {
        self.input.len()
    }

    /// The batch that a message holds, if it holds one and not, say, a dictionary.
    pub(super) fn decode(
        &mut self,
        message: &Message,
        budget: &Budget,
    ) -> Result<Option<Decoded>, Problem> {
        let place = message.place();
        let header = message.header(self.input)?;
        guarded(&place, || {
            self.decode_unguarded(message, &header, &place, budget)
        })
    }

    fn decode_unguarded(
        &mut self,
        message: &Message,
        header: &[u8],
        place: &str,
        budget: &Budget,
    ) -> Result<Option<Decoded>, Problem> {
        let failed = |e: ArrowError| damaged(place, e.to_string());
        let header =
            arrow_ipc::root_as_message(header).map_err(|e| damaged(place, e.to_string()))?;
        let at = message.body.clone();
        let version = header.version();
        match header.header_type() {
            MessageHeader::DictionaryBatch => {
                let dictionary = header
                    .header_as_dictionary_batch()
                    .ok_or_else(|| damaged(place, "the dictionary is missing"))?;
                let batch = dictionary
                    .data()
                    .ok_or_else(|| damaged(place, "the dictionary is missing"))?;
                let body = self.bodies.read(self.input, at, 0..0)?;
                check_batch(&batch, body.bytes(), budget).map_err(|e| e.at(place))?;
                if dictionary.isDelta() {
                    // Joining copies the whole dictionary, for every addition again.
                    let known = self.dictionaries.get(&dictionary.id());
                    budget.charge(known.map_or(0, |d| d.get_buffer_memory_size()) as u64)?;
                }
                let dictionaries = &mut self.dictionaries;
                read_dictionary(
                    body.bytes(),
                    dictionary,
                    &self.schema,
                    dictionaries,
                    &version,
                )
                .map_err(failed)?;
                Ok(None)
            }
            MessageHeader::RecordBatch => {
                let batch = header
                    .header_as_record_batch()
                    .ok_or_else(|| damaged(place, "the record batch is missing"))?;
                let left_out = self.left_out(&batch, at.len());
                let body = self.bodies.read(self.input, at, left_out)?;
                check_batch(&batch, body.bytes(), budget).map_err(|e| e.at(place))?;
                let (bytes, schema) = (body.bytes(), self.schema.clone());
                let batch =
                    read_record_batch(bytes, batch, schema, &self.dictionaries, None, &version)
                        .map_err(failed)?;
                let polygons = Polygons::of(batch.column(self.points), &body, budget)?;
                Ok(Some(Decoded { batch, polygons }))
            }
            MessageHeader::NONE => Ok(None),
            other => Err(damaged(place, format!("a message of type {other:?}"))),
        }
    }

    /// Where the coordinates of points lie in the body of a batch, if they can be left out.
    fn left_out(&self, batch: &IpcBatch<'_>, body_bytes: usize) -> Range<usize> {
        let buffers = batch.buffers().filter(|_| batch.compression().is_none());
        let buffer = self
            .coordinates
            .zip(buffers)
            .filter(|(index, buffers)| *index < buffers.len())
            .map(|(index, buffers)| *buffers.get(index));
        let range = buffer.and_then(|buffer| {
            let start = usize::try_from(buffer.offset()).ok()?;
            let end = start.checked_add(usize::try_from(buffer.length()).ok()?)?;
            // What is not aligned would be copied.
            (end <= body_bytes && start.is_multiple_of(ALIGNMENT)).then_some(start..end)
        });
        range.unwrap_or_default()
    }
}

/// What is wrong with the head of a batch.
enum Fault {
    Lie(String),
    Limit(Problem),
}

impl Fault {
    fn at(self, place: &str) -> Problem {
        match self {
            Self::Lie(detail) => damaged(place, detail),
            Self::Limit(problem) => problem,
        }
    }
}

/// Compares what the head of a batch declares with the bytes of its body: the decoder takes it on trust.
fn check_batch(batch: &IpcBatch<'_>, body: &[u8], budget: &Budget) -> Result<(), Fault> {
    let lie = |detail: String| Err(Fault::Lie(detail));
    if batch.length() < 0 {
        return lie(format!("{} rows are declared", batch.length()));
    }
    for node in batch.nodes().into_iter().flatten() {
        let (length, nulls) = (node.length(), node.null_count());
        if length < 0 || !(0..=length).contains(&nulls) {
            return lie(format!(
                "{length} values, {nulls} of them null, are declared"
            ));
        }
    }
    let mut total = 0;
    for buffer in batch.buffers().into_iter().flatten() {
        let (offset, length) = (buffer.offset(), buffer.length());
        let range = usize::try_from(offset)
            .ok()
            .zip(usize::try_from(length).ok())
            .and_then(|(start, len)| Some(start..start.checked_add(len)?));
        let Some(bytes) = range.and_then(|r| body.get(r)) else {
            return lie(format!(
                "a buffer of {length} bytes at {offset} is declared in a body of {} bytes",
                body.len()
            ));
        };
        total += bytes.len();
        if let (Some(_), Some(declared)) = (batch.compression(), bytes.first_chunk::<8>()) {
            let declared = i64::from_le_bytes(*declared);
            // -1 says that the buffer is stored as it is.
            if declared < -1 {
                return lie(format!("{declared} bytes are declared before compression"));
            }
            budget
                .charge(declared.max(0) as u64)
                .map_err(Fault::Limit)?;
        }
    }
    if total > body.len() {
        // Buffers that share bytes would let a small file stand for any number of columns.
        return lie(format!(
            "buffers of {total} bytes in all are declared in a body of {} bytes",
            body.len()
        ));
    }
    Ok(())
}
