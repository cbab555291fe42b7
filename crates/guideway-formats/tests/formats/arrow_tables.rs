//! Builders of Arrow tables for tests, and readers of the layouts that they give.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::{Array, ArrayRef, FixedSizeListArray, ListArray, RecordBatch};
use arrow_ipc::CompressionType;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_schema::{DataType, Field, Schema};
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{Attribute, Layout};

/// `rows` straight polygons of four points, as list<fixed_size_list<float32, 2>>.
pub(crate) fn polygons(rows: usize) -> ListArray {
    let coordinates = (0..rows).flat_map(|row| (0..4).flat_map(move |x| [x as f32, row as f32]));
    let coordinates = arrow_array::Float32Array::from_iter_values(coordinates);
    let item = Arc::new(Field::new("item", DataType::Float32, true));
    let points = FixedSizeListArray::new(item, 2, Arc::new(coordinates), None);
    let item = Arc::new(Field::new("item", points.data_type().clone(), true));
    let offsets = arrow_buffer::OffsetBuffer::from_lengths(vec![4; rows]);
    ListArray::new(item, offsets, Arc::new(points), None)
}

pub(crate) fn batch(columns: Vec<(&str, ArrayRef)>) -> RecordBatch {
    let batch = RecordBatch::try_from_iter_with_nullable(
        columns.into_iter().map(|(name, c)| (name, c, true)),
    )
    .expect("columns of one length");
    let metadata = HashMap::from([("guideway.version".to_owned(), "1".to_owned())]);
    let schema = Schema::clone(&batch.schema()).with_metadata(metadata);
    batch
        .with_schema(Arc::new(schema))
        .expect("the same columns")
}

pub(crate) fn file(batches: &[RecordBatch], compression: Option<CompressionType>) -> Vec<u8> {
    let options = IpcWriteOptions::default();
    let options = options.try_with_compression(compression).expect("a codec");
    let mut writer = FileWriter::try_new_with_options(Vec::new(), &batches[0].schema(), options)
        .expect("a writer");
    for batch in batches {
        writer.write(batch).expect("a batch");
    }
    writer.into_inner().expect("a file")
}

pub(crate) fn read(bytes: &[u8]) -> Layout {
    read_bytes("test", bytes, &ReadOptions::default()).unwrap_or_else(|e| panic!("{e}"))
}

pub(crate) fn read_columns(columns: Vec<(&str, ArrayRef)>) -> Layout {
    read(&file(&[batch(columns)], None))
}

pub(crate) fn attribute<'a>(layout: &'a Layout, name: &str) -> &'a Attribute {
    let attribute = layout.paths.attributes.get(name);
    attribute.unwrap_or_else(|| panic!("no attribute {name}"))
}

pub(crate) fn ids(layout: &Layout) -> Vec<&str> {
    layout.paths.iter().map(|p| p.id()).collect()
}
