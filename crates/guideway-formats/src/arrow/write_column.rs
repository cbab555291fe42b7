//! Columns to write: types, the values of the batch being filled, and their conversion to Arrow
//! arrays.

use std::sync::Arc;

use arrow_array::builder::{BooleanBuilder, Float64Builder, Int64Builder, StringBuilder};
use arrow_array::types::{
    Float32Type, Int8Type, Int16Type, Int32Type, UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{ArrayRef, FixedSizeListArray, Float32Array, Float64Array, ListArray};
use arrow_buffer::{OffsetBuffer, ScalarBuffer};
use arrow_schema::{ArrowError, DataType, Field, FieldRef};
use guideway_layout::{Attribute, Value, Values};
use guideway_spline::{Point, Real};

use super::cast::converted;

/// Storage type of coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// Single precision: error below 0.1 mm at 1 km from the origin.
    F32,
    /// Double precision.
    F64,
}

/// Definition of a column to write.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// Type of the values.
    pub column_type: ColumnType,
}

/// Type of the values of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs, reason = "the names are those of Arrow")]
pub enum ColumnType {
    Bool,
    Int8,
    Int16,
    Int32,
    Int64,
    UInt8,
    UInt16,
    UInt32,
    UInt64,
    Float32,
    Float64,
    Text,
}

impl ColumnType {
    fn data_type(self) -> DataType {
        match self {
            Self::Bool => DataType::Boolean,
            Self::Int8 => DataType::Int8,
            Self::Int16 => DataType::Int16,
            Self::Int32 => DataType::Int32,
            Self::Int64 => DataType::Int64,
            Self::UInt8 => DataType::UInt8,
            Self::UInt16 => DataType::UInt16,
            Self::UInt32 => DataType::UInt32,
            Self::UInt64 => DataType::UInt64,
            Self::Float32 => DataType::Float32,
            Self::Float64 => DataType::Float64,
            Self::Text => DataType::Utf8,
        }
    }

    /// Returns the smallest and largest integer of the type, if it is an integer type.
    fn int_range(self) -> Option<(i64, i64)> {
        Some(match self {
            Self::Int8 => (i8::MIN.into(), i8::MAX.into()),
            Self::Int16 => (i16::MIN.into(), i16::MAX.into()),
            Self::Int32 => (i32::MIN.into(), i32::MAX.into()),
            Self::Int64 => (i64::MIN, i64::MAX),
            Self::UInt8 => (0, u8::MAX.into()),
            Self::UInt16 => (0, u16::MAX.into()),
            Self::UInt32 => (0, u32::MAX.into()),
            // Layouts store integers as i64.
            Self::UInt64 => (0, i64::MAX),
            _ => return None,
        })
    }

    const INTS: [Self; 8] = [
        Self::Int8,
        Self::Int16,
        Self::Int32,
        Self::Int64,
        Self::UInt8,
        Self::UInt16,
        Self::UInt32,
        Self::UInt64,
    ];
}

impl Column {
    /// Makes a column.
    pub fn new(name: impl Into<String>, column_type: ColumnType) -> Self {
        Self {
            name: name.into(),
            column_type,
        }
    }

    /// Returns the column of an attribute: of its source type if all values fit, else of a wider
    /// type.
    pub(super) fn from_attribute(attribute: &Attribute) -> Self {
        let source = attribute.source_type.as_deref();
        let column_type = match &attribute.values {
            Values::Bool(_) => ColumnType::Bool,
            Values::Text(_) | Values::Json(_) => ColumnType::Text,
            Values::Float(values) => {
                let exact = |v: f64| f64::from(v as f32).to_bits() == v.to_bits() || v.is_nan();
                match source {
                    Some("Float32") if values.values().all(exact) => ColumnType::Float32,
                    _ => ColumnType::Float64,
                }
            }
            Values::Int(values) => {
                let named = |t: &ColumnType| source == Some(t.data_type().to_string().as_str());
                let fits = |t: &ColumnType| {
                    let range = t.int_range();
                    range.is_some_and(|(low, high)| {
                        values.values().all(|v| (low..=high).contains(&v))
                    })
                };
                let narrow = ColumnType::INTS.into_iter().find(named).filter(fits);
                narrow.unwrap_or(ColumnType::Int64)
            }
        };
        Self::new(&attribute.name, column_type)
    }

    /// Returns whether a value fits the type of the column.
    pub(super) fn fits(&self, value: Value<'_>) -> bool {
        match (self.column_type, value) {
            (ColumnType::Bool, Value::Bool(_))
            | (ColumnType::Text, Value::Text(_) | Value::Json(_)) => true,
            (ColumnType::Float32 | ColumnType::Float64, Value::Float(_) | Value::Int(_)) => true,
            (ints, Value::Int(v)) => ints
                .int_range()
                .is_some_and(|(low, high)| (low..=high).contains(&v)),
            _ => false,
        }
    }

    /// Returns the field of the schema.
    pub(super) fn field(&self) -> Field {
        Field::new(&self.name, self.column_type.data_type(), true)
    }

    /// Makes the empty cells of the column.
    pub(super) fn cells(&self) -> Cells {
        match self.column_type {
            ColumnType::Bool => Cells::Bool(BooleanBuilder::new()),
            ColumnType::Text => Cells::Text(StringBuilder::new()),
            ColumnType::Float32 | ColumnType::Float64 => Cells::Float(Float64Builder::new()),
            _ => Cells::Int(Int64Builder::new()),
        }
    }
}

/// Values of a column in the batch being filled, in the widest type of their kind.
pub(super) enum Cells {
    Bool(BooleanBuilder),
    Int(Int64Builder),
    Float(Float64Builder),
    Text(StringBuilder),
}

impl Cells {
    /// Appends a value that fits the column.
    pub(super) fn push(&mut self, value: Option<Value<'_>>) {
        match (self, value) {
            (Self::Bool(b), Some(Value::Bool(v))) => b.append_value(v),
            (Self::Int(b), Some(Value::Int(v))) => b.append_value(v),
            (Self::Float(b), Some(Value::Float(v))) => b.append_value(v),
            (Self::Float(b), Some(Value::Int(v))) => b.append_value(v as f64),
            (Self::Text(b), Some(Value::Text(v) | Value::Json(v))) => b.append_value(v),
            (Self::Bool(b), _) => b.append_null(),
            (Self::Int(b), _) => b.append_null(),
            (Self::Float(b), _) => b.append_null(),
            (Self::Text(b), _) => b.append_null(),
        }
    }

    /// Returns the bytes of text.
    pub(super) fn text_bytes(&self) -> usize {
        match self {
            Self::Text(b) => b.values_slice().len(),
            _ => 0,
        }
    }

    /// Returns the array of the batch and empties the cells.
    pub(super) fn take(&mut self, column: &Column) -> ArrayRef {
        match (self, column.column_type) {
            (Self::Bool(b), _) => Arc::new(b.finish()),
            (Self::Float(b), ColumnType::Float32) => {
                Arc::new(converted::<_, Float32Type>(&b.finish()))
            }
            (Self::Float(b), _) => Arc::new(b.finish()),
            (Self::Text(b), _) => Arc::new(b.finish()),
            (Self::Int(b), ColumnType::Int8) => Arc::new(converted::<_, Int8Type>(&b.finish())),
            (Self::Int(b), ColumnType::Int16) => Arc::new(converted::<_, Int16Type>(&b.finish())),
            (Self::Int(b), ColumnType::Int32) => Arc::new(converted::<_, Int32Type>(&b.finish())),
            (Self::Int(b), ColumnType::UInt8) => Arc::new(converted::<_, UInt8Type>(&b.finish())),
            (Self::Int(b), ColumnType::UInt16) => Arc::new(converted::<_, UInt16Type>(&b.finish())),
            (Self::Int(b), ColumnType::UInt32) => Arc::new(converted::<_, UInt32Type>(&b.finish())),
            (Self::Int(b), ColumnType::UInt64) => Arc::new(converted::<_, UInt64Type>(&b.finish())),
            (Self::Int(b), _) => Arc::new(b.finish()),
        }
    }
}

/// Identifiers of the batch being filled.
#[derive(Default)]
pub(super) struct IdCells(StringBuilder);

impl IdCells {
    pub(super) fn field(name: &str) -> Field {
        Field::new(name, DataType::Utf8, false)
    }

    pub(super) fn push(&mut self, id: &str) {
        self.0.append_value(id);
    }

    pub(super) fn bytes(&self) -> usize {
        self.0.values_slice().len()
    }

    pub(super) fn take(&mut self) -> ArrayRef {
        Arc::new(self.0.finish())
    }
}

/// Control polygons of the batch being filled.
pub(super) struct PolygonCells {
    coordinates: Coordinates,
    ends: Vec<i32>,
}

enum Coordinates {
    F32(Vec<f32>),
    F64(Vec<f64>),
}

impl PolygonCells {
    pub(super) fn new(precision: Precision) -> Self {
        Self {
            coordinates: match precision {
                Precision::F32 => Coordinates::F32(Vec::new()),
                Precision::F64 => Coordinates::F64(Vec::new()),
            },
            ends: vec![0],
        }
    }

    pub(super) fn rows(&self) -> usize {
        self.ends.len() - 1
    }

    pub(super) fn points(&self) -> usize {
        match &self.coordinates {
            Coordinates::F32(c) => c.len() / 2,
            Coordinates::F64(c) => c.len() / 2,
        }
    }

    pub(super) fn field(&self, name: &str, nullable: bool) -> Field {
        Field::new(name, DataType::List(self.point_field()), nullable)
    }

    fn point_field(&self) -> FieldRef {
        let list = DataType::FixedSizeList(self.coordinate_field(), 2);
        Arc::new(Field::new("item", list, false))
    }

    fn coordinate_field(&self) -> FieldRef {
        let number = match self.coordinates {
            Coordinates::F32(_) => DataType::Float32,
            Coordinates::F64(_) => DataType::Float64,
        };
        Arc::new(Field::new("item", number, false))
    }

    pub(super) fn push<T: Real>(&mut self, run: &[Point<T>]) {
        match &mut self.coordinates {
            Coordinates::F32(c) => extend(c, run),
            Coordinates::F64(c) => extend(c, run),
        }
        let end = i32::try_from(self.points());
        self.ends.push(end.unwrap_or(i32::MAX));
    }

    /// Returns the array of the batch and empties the cells.
    pub(super) fn take(&mut self) -> Result<ArrayRef, ArrowError> {
        let (number, point) = (self.coordinate_field(), self.point_field());
        let coordinates: ArrayRef = match &mut self.coordinates {
            Coordinates::F32(c) => Arc::new(Float32Array::from(std::mem::take(c))),
            Coordinates::F64(c) => Arc::new(Float64Array::from(std::mem::take(c))),
        };
        let ends = std::mem::replace(&mut self.ends, vec![0]);
        let points = FixedSizeListArray::try_new(number, 2, coordinates, None)?;
        let offsets = OffsetBuffer::new(ScalarBuffer::from(ends));
        let list = ListArray::try_new(point, offsets, Arc::new(points), None)?;
        Ok(Arc::new(list))
    }
}

fn extend<T: Real, U: Real>(out: &mut Vec<U>, run: &[Point<T>]) {
    for point in run {
        out.extend([U::of(point.x.to_f64()), U::of(point.y.to_f64())]);
    }
}
