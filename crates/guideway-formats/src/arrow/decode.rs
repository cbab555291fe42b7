//! Message decoder: converts messages to record batches and control polygons, after a check of the
//! declared sizes.

use std::ops::Range;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, RecordBatch, RecordBatchOptions, make_array};
use arrow_ipc::reader::read_record_batch;
use arrow_ipc::{MessageHeader, RecordBatch as IpcBatch};
use arrow_schema::{ArrowError, SchemaRef};

use super::budget::Budget;
use super::catch_decode_panic::catch_decode_panic;
use super::container::Message;
use super::control_polygons::ControlPolygons;
use super::dictionaries::Dictionaries;
use super::lossy_texts::{to_texts, with_bytes};
use super::message_body::{ALIGNMENT, BodyPool};
use super::problems::damaged;
use super::schema::coordinate_buffer;
use crate::Problem;
use crate::input::Input;

/// Decoder of messages. It copies only buffers that are compressed or misaligned.
pub(super) struct Decoder<'a> {
    input: &'a Input<'a>,
    schema: SchemaRef,
    dictionaries: Dictionaries,
    bodies: BodyPool,
    /// Index of the column of control points.
    points: usize,
    /// Index of the buffer with their coordinates, if the schema fixes it.
    coordinates: Option<usize>,
    /// Number of texts of dictionaries that were not UTF-8, by column.
    replaced: Vec<(String, u64)>,
}

/// A record batch and its control polygons, whose coordinates may be deferred.
pub(super) struct Decoded {
    pub(super) batch: RecordBatch,
    pub(super) polygons: ControlPolygons,
    /// Number of texts that were not UTF-8, by column.
    pub(super) replaced: Vec<(String, u64)>,
}

impl<'a> Decoder<'a> {
    /// Makes a decoder of a table whose column `points` holds the control points.
    pub(super) fn new(input: &'a Input<'a>, schema: SchemaRef, points: usize) -> Self {
        Self {
            points,
            coordinates: coordinate_buffer(&schema, points),
            input,
            schema,
            dictionaries: Dictionaries::default(),
            bodies: BodyPool::default(),
            replaced: Vec::new(),
        }
    }

    /// Decodes a message; returns its record batch, or `None` for a dictionary or an empty message.
    pub(super) fn decode(
        &mut self,
        message: &Message,
        budget: &Budget,
    ) -> Result<Option<Decoded>, Problem> {
        let place = message.place();
        let header = message.header(self.input)?;
        catch_decode_panic(&place, || {
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
                    // Each delta copies the whole dictionary.
                    let known = self.dictionaries.byte_count(dictionary.id());
                    budget.charge(known as u64)?;
                }
                let read =
                    (self.dictionaries).read(body.bytes(), dictionary, &self.schema, &version);
                self.replaced.extend(read.map_err(failed)?);
                Ok(None)
            }
            MessageHeader::RecordBatch => {
                let batch = header
                    .header_as_record_batch()
                    .ok_or_else(|| damaged(place, "the record batch is missing"))?;
                let deferred = self.deferred(&batch, at.len());
                let body = self.bodies.read(self.input, at, deferred)?;
                check_batch(&batch, body.bytes(), budget).map_err(|e| e.at(place))?;
                let bytes = body.bytes();
                let read = |schema: SchemaRef| {
                    let dictionaries = self.dictionaries.by_id();
                    read_record_batch(bytes, batch, schema, dictionaries, None, &version)
                };
                let mut replaced = std::mem::take(&mut self.replaced);
                let batch = match read(self.schema.clone()) {
                    Ok(batch) => batch,
                    Err(error) => read(with_bytes(&self.schema).into())
                        .and_then(|batch| batch_to_texts(&batch, &self.schema, &mut replaced))
                        .map_err(|_| failed(error))?,
                };
                let polygons =
                    ControlPolygons::from_column(batch.column(self.points), Some(&body), budget)?;
                Ok(Some(Decoded {
                    batch,
                    polygons,
                    replaced,
                }))
            }
            MessageHeader::NONE => Ok(None),
            other => Err(damaged(
                place,
                format!("unexpected message of type {other:?}"),
            )),
        }
    }

    /// Returns the range of the coordinates in the body of a batch, empty if they cannot be
    /// deferred.
    fn deferred(&self, batch: &IpcBatch<'_>, body_bytes: usize) -> Range<usize> {
        let buffers = batch.buffers().filter(|_| batch.compression().is_none());
        let buffer = self
            .coordinates
            .zip(buffers)
            .filter(|(index, buffers)| *index < buffers.len())
            .map(|(index, buffers)| *buffers.get(index));
        let range = buffer.and_then(|buffer| {
            let start = usize::try_from(buffer.offset()).ok()?;
            let end = start.checked_add(usize::try_from(buffer.length()).ok()?)?;
            // The library would copy a misaligned buffer.
            (end <= body_bytes && start.is_multiple_of(ALIGNMENT)).then_some(start..end)
        });
        range.unwrap_or_default()
    }
}

/// Makes texts of the bytes in a batch. Adds the number of texts that are not UTF-8 per column.
fn batch_to_texts(
    batch: &RecordBatch,
    schema: &SchemaRef,
    replaced: &mut Vec<(String, u64)>,
) -> Result<RecordBatch, ArrowError> {
    let columns = batch.columns().iter().zip(schema.fields());
    let columns = columns.map(|(column, field)| {
        let mut count = 0;
        let texts = to_texts(column.to_data(), field.data_type(), &mut count)?;
        if count > 0 {
            replaced.push((field.name().clone(), count));
        }
        Ok(make_array(texts))
    });
    let columns = columns.collect::<Result<Vec<ArrayRef>, ArrowError>>()?;
    let options = RecordBatchOptions::new().with_row_count(Some(batch.num_rows()));
    RecordBatch::try_new_with_options(Arc::clone(schema), columns, &options)
}

/// Fault of the header of a batch.
enum HeaderFault {
    Inconsistent(String),
    Limit(Problem),
}

impl HeaderFault {
    fn at(self, place: &str) -> Problem {
        match self {
            Self::Inconsistent(detail) => damaged(place, detail),
            Self::Limit(problem) => problem,
        }
    }
}

/// Compares the header of a batch with the bytes of its body, because the library trusts the
/// header.
fn check_batch(batch: &IpcBatch<'_>, body: &[u8], budget: &Budget) -> Result<(), HeaderFault> {
    let inconsistent = |detail: String| Err(HeaderFault::Inconsistent(detail));
    if batch.length() < 0 {
        return inconsistent(format!("invalid number of {} rows", batch.length()));
    }
    for node in batch.nodes().into_iter().flatten() {
        let (length, nulls) = (node.length(), node.null_count());
        if length < 0 || !(0..=length).contains(&nulls) {
            return inconsistent(format!(
                "invalid number of {length} values with {nulls} nulls"
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
            return inconsistent(format!(
                "the buffer range, {length} bytes at {offset}, is not within its body of {} bytes",
                body.len()
            ));
        };
        total += bytes.len();
        if let (Some(_), Some(declared)) = (batch.compression(), bytes.first_chunk::<8>()) {
            let declared = i64::from_le_bytes(*declared);
            // -1 marks an uncompressed buffer.
            if declared < -1 {
                return inconsistent(format!("invalid uncompressed size of {declared} bytes"));
            }
            budget
                .charge(declared.max(0) as u64)
                .map_err(HeaderFault::Limit)?;
        }
    }
    if total > body.len() {
        // Buffers that share bytes would let a small file represent any number of columns.
        return inconsistent(format!(
            "the buffers have {total} bytes in total, their body has {} bytes",
            body.len()
        ));
    }
    Ok(())
}
