//! Reader of record batches in memory, such as those of the Arrow C stream interface.

use arrow_array::{RecordBatch, RecordBatchReader};
use arrow_schema::{DataType, SchemaRef};
use guideway_layout::{Diagnostics, Layout};

use super::budget::Budget;
use super::catch_decode_panic::catch_decode_panic;
use super::control_polygons::ControlPolygons;
use super::decode::Decoded;
use super::problems::damaged;
use super::read::{TableReader, table_columns};
use super::reading::Reading;
use crate::input::Input;
use crate::source::Source;
use crate::{Format, Problem, ReadError, ReadOptions};

/// Name of the layout in error texts.
const NAME: &str = "record batches";

/// Reads a layout from record batches: those of [`batches`](super::batches), or a table of paths
/// that another program made.
///
/// # Errors
/// When the columns have another structure, a batch has other columns than the schema, a limit is
/// exceeded, or the caller cancels the read.
pub fn read_batches(
    batches: impl RecordBatchReader,
    options: &ReadOptions<'_>,
) -> Result<Layout, ReadError> {
    let source = Source {
        name: NAME,
        options,
    };
    source.check_format(Format::Arrow)?;
    read_table(source, batches).map_err(|problem| source.fail(problem))
}

fn read_table(source: Source<'_>, batches: impl RecordBatchReader) -> Result<Layout, Problem> {
    let limits = &source.options.limits;
    let mut diagnostics = Diagnostics::with_limit(limits.diagnostics_per_code);
    let schema = batches.schema();
    let columns = table_columns(&schema, &mut diagnostics)?;
    let budget = Budget::for_file(0);
    let reading = Reading {
        schema: &schema,
        columns: &columns,
        limits,
        budget: &budget,
    };
    let input = Input::Bytes(&[]);
    let mut reader = TableReader::new(&input, reading, diagnostics);
    for (index, batch) in batches.enumerate() {
        if source.options.progress.is_some_and(|p| p.cancelled()) {
            return Err(Problem::Cancelled);
        }
        let place = format!("record batch {index}");
        let batch = batch.map_err(|e| damaged(&place, e.to_string()))?;
        check_columns(&batch, &schema, &place)?;
        budget.admit(batch.get_array_memory_size());
        let polygons = catch_decode_panic(&place, || {
            ControlPolygons::from_column(batch.column(columns.control_points), None, &budget)
        })?;
        reader.add(&Decoded {
            batch,
            polygons,
            replaced: Vec::new(),
        })?;
    }
    reader.into_layout(source.name)
}

/// Fails if a batch has other types than the schema.
fn check_columns(batch: &RecordBatch, schema: &SchemaRef, place: &str) -> Result<(), Problem> {
    let stated = schema.fields().iter().map(|field| field.data_type());
    let found = batch.columns().iter().map(|column| column.data_type());
    if stated.clone().eq(found.clone()) {
        return Ok(());
    }
    let names = |types: &mut dyn Iterator<Item = &DataType>| {
        types
            .map(DataType::to_string)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let (stated, found) = (
        names(&mut stated.into_iter()),
        names(&mut found.into_iter()),
    );
    Err(damaged(
        place,
        format!("its columns are {found}; the schema states {stated}"),
    ))
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::{ArrayRef, Int64Array, RecordBatchIterator, StringArray};
    use arrow_schema::ArrowError;

    use super::super::write_column::{PolygonCells, Precision};
    use super::*;
    use crate::Progress;

    fn batch(ids: ArrayRef) -> RecordBatch {
        let mut cells = PolygonCells::new(Precision::F64);
        for _ in 0..ids.len() {
            cells.push(&[0.0, 1.0, 2.0, 3.0].map(|x| guideway_spline::Point::new(x, 0.0)));
        }
        let points = cells.take().expect("points");
        RecordBatch::try_from_iter([("id", ids), ("control_points", points)]).expect("a batch")
    }

    fn texts() -> RecordBatch {
        batch(Arc::new(StringArray::from(vec!["a", "b"])))
    }

    fn read(batches: Vec<Result<RecordBatch, ArrowError>>) -> Result<Layout, ReadError> {
        let reader = RecordBatchIterator::new(batches, texts().schema());
        read_batches(reader, &ReadOptions::default())
    }

    #[test]
    fn batches_of_other_programs_are_read() {
        let layout = read(vec![Ok(texts()), Ok(texts())]).expect("a layout");
        assert_eq!(layout.paths.len(), 4);
        assert_eq!(layout.paths.get(3).id(), "b");
    }

    #[test]
    fn a_batch_of_other_columns_or_a_failed_one_is_refused() {
        let numbers = batch(Arc::new(Int64Array::from(vec![1])));
        let refused = read(vec![Ok(texts()), Ok(numbers)]).expect_err("a refusal");
        let text = refused.to_string();
        assert!(
            text.contains("record batch 1") && text.contains("Int64"),
            "{text}"
        );
        let failed = ArrowError::ComputeError("out of sorts".into());
        let refused = read(vec![Err(failed)]).expect_err("a refusal");
        assert!(refused.to_string().contains("out of sorts"));
    }

    #[test]
    fn a_cancelled_read_ends() {
        struct Cancel;
        impl Progress for Cancel {
            fn cancelled(&self) -> bool {
                true
            }
        }
        let options = ReadOptions {
            progress: Some(&Cancel),
            ..ReadOptions::default()
        };
        let reader = RecordBatchIterator::new([Ok(texts())], texts().schema());
        let refused = read_batches(reader, &options).expect_err("a refusal");
        assert!(matches!(refused.problem, Problem::Cancelled));
    }
}
