//! Layout lists: arrays of lists, records and dictionaries for the columns of a layout.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::types::{ArrowDictionaryKeyType, Int32Type};
use arrow_array::{
    ArrayRef, DictionaryArray, FixedSizeListArray, Float64Array, ListArray, PrimitiveArray,
    StringArray, StructArray, UInt32Array,
};
use arrow_buffer::{NullBuffer, OffsetBuffer};
use arrow_schema::{ArrowError, DataType, Field, FieldRef, Fields};
use guideway_layout::{Layout, Member, TypeEntries, WrittenCurve};
use guideway_spline::Point;

use super::column_names::{
    BOTH, DEGREE, FORWARD, KNOTS, MEMBER_ELEMENT, MEMBER_INDEX, POINTS, WEIGHTS,
};
use super::element::Element;
use crate::write_error::WriteProblem;

/// Names of the directions, in the order of their type.
pub(super) const DIRECTIONS: [&str; 2] = [FORWARD, BOTH];

fn item(data_type: DataType) -> FieldRef {
    Arc::new(Field::new("item", data_type, false))
}

pub(super) fn list_type(items: DataType) -> DataType {
    DataType::List(item(items))
}

pub(super) fn point_type() -> DataType {
    DataType::FixedSizeList(item(DataType::Float64), 2)
}

pub(super) fn dictionary_type(keys: DataType) -> DataType {
    DataType::Dictionary(Box::new(keys), Box::new(DataType::Utf8))
}

pub(super) fn types_type() -> DataType {
    list_type(dictionary_type(DataType::Int32))
}

pub(super) fn members_type() -> DataType {
    list_type(DataType::Struct(member_fields()))
}

fn member_fields() -> Fields {
    Fields::from(vec![
        Field::new(MEMBER_ELEMENT, DataType::Utf8, false),
        Field::new(MEMBER_INDEX, DataType::UInt32, false),
    ])
}

pub(super) fn curve_type() -> DataType {
    DataType::Struct(curve_fields())
}

fn curve_fields() -> Fields {
    let numbers = || list_type(DataType::Float64);
    Fields::from(vec![
        // Null in rows without a curve, which the writer of Parquet in pyarrow refuses otherwise.
        Field::new(DEGREE, DataType::UInt32, true),
        Field::new(KNOTS, numbers(), true),
        Field::new(WEIGHTS, numbers(), true),
        Field::new(POINTS, list_type(point_type()), true),
    ])
}

/// Texts that the rows of all batches refer to.
pub(super) struct Dictionary<K: ArrowDictionaryKeyType> {
    values: ArrayRef,
    keys: HashMap<String, K::Native>,
}

impl<K: ArrowDictionaryKeyType> Dictionary<K> {
    /// Makes a dictionary of fixed texts, whose keys are their numbers.
    pub(super) fn new<'a>(texts: impl IntoIterator<Item = &'a str>) -> Self {
        let texts: Vec<&str> = texts.into_iter().collect();
        Self {
            values: Arc::new(StringArray::from(texts)),
            keys: HashMap::new(),
        }
    }

    /// Returns the array of keys.
    pub(super) fn array(
        &self,
        keys: impl Iterator<Item = Option<K::Native>>,
    ) -> Result<ArrayRef, WriteProblem>
    where
        PrimitiveArray<K>: FromIterator<Option<K::Native>>,
    {
        let keys = keys.collect();
        let array = DictionaryArray::<K>::try_new(keys, self.values.clone())?;
        Ok(Arc::new(array))
    }
}

impl Dictionary<Int32Type> {
    /// Makes the dictionary of the vehicle types of paths and nodes.
    pub(super) fn of_types(layout: &Layout) -> Self {
        let mut keys = HashMap::new();
        let mut names: Vec<&str> = Vec::new();
        let tables = [layout.paths.vehicle_types(), layout.nodes.vehicle_types()];
        for name in tables.into_iter().flat_map(TypeEntries::names) {
            keys.entry(name.clone()).or_insert_with(|| {
                names.push(name);
                names.len() as i32 - 1
            });
        }
        Self {
            values: Arc::new(StringArray::from(names)),
            keys,
        }
    }

    /// Returns whether there are no texts.
    pub(super) fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Returns the array of lists of texts; an empty list is null.
    pub(super) fn lists<'a, T: Iterator<Item = &'a str>>(
        &self,
        rows: impl Iterator<Item = Option<T>>,
    ) -> Result<ArrayRef, WriteProblem> {
        let (mut keys, mut lengths) = (Vec::new(), Vec::new());
        for row in rows {
            let before = keys.len();
            let texts = row.into_iter().flatten();
            keys.extend(texts.map(|text| self.keys.get(text).copied()));
            lengths.push(Some(keys.len() - before).filter(|&length| length > 0));
        }
        let items = self.array(keys.into_iter())?;
        list(items, dictionary_type(DataType::Int32), &lengths)
    }
}

/// Returns lists of row numbers.
pub(super) fn indices<'a>(rows: impl Iterator<Item = &'a [u32]>) -> Result<ArrayRef, WriteProblem> {
    let (mut items, mut lengths) = (Vec::new(), Vec::new());
    for row in rows {
        items.extend_from_slice(row);
        lengths.push(Some(row.len()));
    }
    let items = Arc::new(UInt32Array::from(items));
    list(items, DataType::UInt32, &lengths)
}

/// Returns lists of points.
pub(super) fn points<'a>(
    rows: impl Iterator<Item = Option<&'a [Point<f64>]>>,
) -> Result<ArrayRef, WriteProblem> {
    let (mut coordinates, mut lengths) = (Vec::new(), Vec::new());
    for row in rows {
        let points = row.unwrap_or_default().iter();
        coordinates.extend(points.flat_map(|p| [p.x, p.y]));
        lengths.push(row.map(<[_]>::len));
    }
    let coordinates = Arc::new(Float64Array::from(coordinates));
    let items = FixedSizeListArray::try_new(item(DataType::Float64), 2, coordinates, None)?;
    list(Arc::new(items), point_type(), &lengths)
}

fn numbers<'a>(rows: impl Iterator<Item = Option<&'a [f64]>>) -> Result<ArrayRef, WriteProblem> {
    let (mut items, mut lengths) = (Vec::new(), Vec::new());
    for row in rows {
        items.extend_from_slice(row.unwrap_or_default());
        lengths.push(row.map(<[_]>::len));
    }
    let items = Arc::new(Float64Array::from(items));
    list(items, DataType::Float64, &lengths)
}

/// Returns lists of members.
pub(super) fn members<'a>(
    rows: impl Iterator<Item = &'a [Member]>,
) -> Result<ArrayRef, WriteProblem> {
    let (mut kinds, mut numbers, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
    for row in rows {
        for member in row {
            let (kind, number) = match *member {
                Member::Path(number) => (Element::Path, number),
                Member::Node(number) => (Element::Node, number),
                Member::Station(number) => (Element::Station, number),
            };
            kinds.push(kind.name());
            numbers.push(number);
        }
        lengths.push(Some(row.len()));
    }
    let columns: Vec<ArrayRef> = vec![
        Arc::new(StringArray::from(kinds)),
        Arc::new(UInt32Array::from(numbers)),
    ];
    let items = StructArray::try_new(member_fields(), columns, None)?;
    list(Arc::new(items), DataType::Struct(member_fields()), &lengths)
}

/// Returns records of curves.
pub(super) fn curves<'a>(
    rows: impl Iterator<Item = Option<&'a WrittenCurve>>,
) -> Result<ArrayRef, WriteProblem> {
    let rows: Vec<Option<&WrittenCurve>> = rows.collect();
    let degrees = rows.iter().map(|curve| curve.map_or(0, |c| c.degree));
    let knots = rows
        .iter()
        .map(|curve| Some(curve.map_or(&[][..], |c| &c.knots)));
    let weights = rows.iter().map(|curve| curve.as_ref()?.weights.as_deref());
    let control_points = rows
        .iter()
        .map(|curve| curve.map(|c| c.points_m.as_slice()));
    let columns: Vec<ArrayRef> = vec![
        Arc::new(UInt32Array::from_iter_values(degrees)),
        numbers(knots)?,
        numbers(weights)?,
        points(control_points)?,
    ];
    let present = NullBuffer::from_iter(rows.iter().map(Option::is_some));
    let curves = StructArray::try_new(curve_fields(), columns, Some(present))?;
    Ok(Arc::new(curves))
}

/// Returns the array of lists of these lengths, null where there is none.
fn list(
    items: ArrayRef,
    item_type: DataType,
    lengths: &[Option<usize>],
) -> Result<ArrayRef, WriteProblem> {
    let total: usize = lengths.iter().flatten().sum();
    if i32::try_from(total).is_err() {
        let detail = format!("{total} items in one batch of lists");
        return Err(ArrowError::InvalidArgumentError(detail).into());
    }
    let offsets = OffsetBuffer::from_lengths(lengths.iter().map(|length| length.unwrap_or(0)));
    let present = lengths.iter().map(Option::is_some);
    let nulls = lengths
        .contains(&None)
        .then(|| NullBuffer::from_iter(present));
    let list = ListArray::try_new(item(item_type), offsets, items, nulls)?;
    Ok(Arc::new(list))
}
