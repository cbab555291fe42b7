//! Texts that are not UTF-8: the Arrow library refuses a whole batch for one of them. Such a batch
//! is decoded with bytes in place of texts, and what is not UTF-8 in them is replaced.

use std::borrow::Cow;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::{Array, LargeStringArray, StringArray, StringViewArray, make_array};
use arrow_data::ArrayData;
use arrow_schema::{ArrowError, DataType, Field, FieldRef, Schema, UnionFields};

/// Returns a schema with bytes in place of texts, but for those of dictionaries, which come in
/// messages of their own.
pub(super) fn with_bytes(schema: &Schema) -> Schema {
    let fields = schema.fields().iter().map(byte_field);
    Schema::new_with_metadata(fields.collect::<Vec<_>>(), schema.metadata().clone())
}

fn byte_field(field: &FieldRef) -> FieldRef {
    let data_type = byte_type(field.data_type());
    Arc::new(Field::clone(field).with_data_type(data_type))
}

/// Returns a type with bytes in place of texts.
pub(super) fn byte_type(data_type: &DataType) -> DataType {
    let of = byte_field;
    match data_type {
        DataType::Utf8 => DataType::Binary,
        DataType::LargeUtf8 => DataType::LargeBinary,
        DataType::Utf8View => DataType::BinaryView,
        DataType::List(item) => DataType::List(of(item)),
        DataType::LargeList(item) => DataType::LargeList(of(item)),
        DataType::ListView(item) => DataType::ListView(of(item)),
        DataType::LargeListView(item) => DataType::LargeListView(of(item)),
        DataType::FixedSizeList(item, count) => DataType::FixedSizeList(of(item), *count),
        DataType::Map(item, is_sorted) => DataType::Map(of(item), *is_sorted),
        DataType::Struct(fields) => DataType::Struct(fields.iter().map(of).collect()),
        DataType::RunEndEncoded(ends, values) => {
            DataType::RunEndEncoded(Arc::clone(ends), of(values))
        }
        DataType::Union(fields, mode) => {
            let fields = fields.iter().map(|(id, field)| (id, of(field)));
            DataType::Union(fields.collect::<UnionFields>(), *mode)
        }
        other => other.clone(),
    }
}

/// Returns an array of texts from one of bytes, whose type differs in nothing else. Adds the number
/// of texts in which bytes are replaced.
///
/// # Errors
/// When the library refuses the array.
pub(super) fn to_texts(
    data: ArrayData,
    to: &DataType,
    replaced: &mut u64,
) -> Result<ArrayData, ArrowError> {
    if data.data_type() == to {
        return Ok(data);
    }
    let mut text = |bytes: Option<&[u8]>| {
        let text = bytes.map(String::from_utf8_lossy)?;
        *replaced += u64::from(matches!(text, Cow::Owned(_)));
        Some(text.into_owned())
    };
    let array = make_array(data);
    Ok(match to {
        DataType::Utf8 => {
            let texts = array.as_binary::<i32>().iter().map(&mut text);
            texts.collect::<StringArray>().into_data()
        }
        DataType::LargeUtf8 => {
            let texts = array.as_binary::<i64>().iter().map(&mut text);
            texts.collect::<LargeStringArray>().into_data()
        }
        DataType::Utf8View => {
            let texts = array.as_binary_view().iter().map(&mut text);
            texts.collect::<StringViewArray>().into_data()
        }
        _ => {
            let data = array.into_data();
            let children = data.child_data().iter().zip(child_types(to));
            let children = children.map(|(child, to)| to_texts(child.clone(), to, replaced));
            let children = children.collect::<Result<Vec<_>, _>>()?;
            let data = data.into_builder().data_type(to.clone());
            data.child_data(children).build()?
        }
    })
}

/// The types of the children of an array, in their order.
fn child_types(data_type: &DataType) -> Vec<&DataType> {
    match data_type {
        DataType::List(item)
        | DataType::LargeList(item)
        | DataType::ListView(item)
        | DataType::LargeListView(item)
        | DataType::FixedSizeList(item, _)
        | DataType::Map(item, _) => vec![item.data_type()],
        DataType::Struct(fields) => fields.iter().map(|field| field.data_type()).collect(),
        DataType::RunEndEncoded(ends, values) => vec![ends.data_type(), values.data_type()],
        DataType::Union(fields, _) => fields.iter().map(|(_, field)| field.data_type()).collect(),
        DataType::Dictionary(_, values) => vec![values],
        _ => Vec::new(),
    }
}
