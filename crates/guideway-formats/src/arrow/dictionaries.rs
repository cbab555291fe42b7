//! The dictionaries of a table: the values that its columns name by numbers.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, make_array};
use arrow_buffer::Buffer;
use arrow_data::transform::MutableArrayData;
use arrow_ipc::reader::read_record_batch;
use arrow_ipc::{DictionaryBatch, MetadataVersion};
use arrow_schema::{ArrowError, DataType, Field, Schema};

use super::lossy_texts::{byte_type, to_texts};

/// The values of all dictionaries, by the number that a schema gives to each.
#[derive(Default)]
pub(super) struct Dictionaries(HashMap<i64, ArrayRef>);

impl Dictionaries {
    /// The values of all dictionaries.
    pub(super) fn by_id(&self) -> &HashMap<i64, ArrayRef> {
        &self.0
    }

    /// The memory of a dictionary.
    pub(super) fn byte_count(&self, id: i64) -> usize {
        let known = self.0.get(&id);
        known.map_or(0, |values| values.get_buffer_memory_size())
    }

    /// Reads the values of a message in place of those of its dictionary, or after them. Returns
    /// the column and the number of its texts that are not UTF-8, if there are any.
    ///
    /// # Errors
    /// When the schema has no such dictionary, the message has no values, or none to add them to,
    /// or the library refuses them.
    pub(super) fn read(
        &mut self,
        body: &Buffer,
        message: DictionaryBatch<'_>,
        schema: &Schema,
        version: &MetadataVersion,
    ) -> Result<Option<(String, u64)>, ArrowError> {
        let id = message.id();
        let unknown = || ArrowError::SchemaError(format!("the schema has no dictionary {id}"));
        #[expect(
            deprecated,
            reason = "the library names dictionaries by numbers, and no other way"
        )]
        let fields = schema.fields_with_dict_id(id);
        let field = fields.first().ok_or_else(unknown)?;
        let DataType::Dictionary(_, to) = field.data_type() else {
            return Err(unknown());
        };
        let wrong = |problem| ArrowError::SchemaError(format!("dictionary {id}: {problem}"));
        let batch = message.data();
        let batch = batch.ok_or_else(|| wrong("the message has no values"))?;
        let read = |data_type: DataType| {
            let column = Schema::new(vec![Field::new("", data_type, true)]);
            let read = read_record_batch(body, batch, Arc::new(column), &self.0, None, version);
            Ok::<_, ArrowError>(Arc::clone(read?.column(0)))
        };
        let mut count = 0;
        let values = match read(DataType::clone(to)) {
            Ok(values) => values,
            Err(error) => {
                let bytes = read(byte_type(to)).map_err(|_| error)?;
                make_array(to_texts(bytes.to_data(), to, &mut count)?)
            }
        };
        let values = match (message.isDelta(), self.0.get(&id)) {
            (false, _) => values,
            (true, Some(known)) => joined(known, &values)?,
            (true, None) => return Err(wrong("no values come before those that are added")),
        };
        self.0.insert(id, values);
        Ok((count > 0).then(|| (field.name().clone(), count)))
    }
}

/// Two arrays of the same type, one after the other. The library's own way to join them has code
/// for each pair of types: a fiftieth of the program.
fn joined(first: &ArrayRef, second: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    let parts = [first.to_data(), second.to_data()];
    let count = first.len() + second.len();
    let mut joined = MutableArrayData::try_new(parts.iter().collect(), false, count)?;
    for (index, part) in parts.iter().enumerate() {
        joined.try_extend(index, 0, part.len())?;
    }
    Ok(make_array(joined.freeze()))
}
