//! Schema of a table: finds the columns by name and type, the version, and the buffer of
//! coordinates.

use arrow_schema::{DataType, Field, Schema};
use guideway_layout::{Code, Diagnostics, Place};

use super::column_names::{
    COLOR, CONTROL_POINTS, ID, LEVEL, PART, RANK, VERSION, VERSION_KEY, WIDTH,
};
use super::problems::wrong_structure;
use crate::Problem;

/// Index of each column with a meaning, and of the attributes.
#[derive(Debug, Default)]
pub(super) struct ColumnRoles {
    pub(super) control_points: usize,
    pub(super) id: Option<usize>,
    pub(super) part: Option<usize>,
    pub(super) level: Option<usize>,
    pub(super) width: Option<usize>,
    pub(super) color: Option<usize>,
    pub(super) rank: Option<usize>,
    pub(super) attributes: Vec<usize>,
}

impl ColumnRoles {
    /// Finds the columns by name. A column of a known name but another type is an attribute.
    ///
    /// # Errors
    /// When two columns share a name, or there are no control points.
    pub(super) fn find(schema: &Schema, diagnostics: &mut Diagnostics) -> Result<Self, Problem> {
        let mut columns = Self::default();
        let mut control_points = None;
        for (index, field) in schema.fields().iter().enumerate() {
            let (slot, fits, expected) = match field.name().as_str() {
                CONTROL_POINTS => (&mut control_points, true, ""),
                ID => (&mut columns.id, is_id(field), "text or integers"),
                PART => (&mut columns.part, is_integer(field), "uint32"),
                LEVEL => (&mut columns.level, is_text(field.data_type()), "text"),
                WIDTH => (&mut columns.width, is_number(field), "float32"),
                COLOR => (&mut columns.color, is_integer(field), "uint32"),
                RANK => (&mut columns.rank, is_integer(field), "int32"),
                _ => {
                    columns.attributes.push(index);
                    continue;
                }
            };
            if *field.data_type() == DataType::Null && field.name() != CONTROL_POINTS {
                // Writers give a column without values this type.
                continue;
            }
            if slot.is_some() {
                return Err(wrong_structure(
                    field.name(),
                    "one column of this name",
                    "two",
                ));
            }
            if fits {
                *slot = Some(index);
                continue;
            }
            columns.attributes.push(index);
            diagnostics.push(
                Code::WrongType,
                || Place::element(format!("column {}", field.name())),
                || format!("expected {expected}, found {}", field.data_type()),
                "It is read as an attribute; write the column in the expected type",
            );
        }
        columns.control_points = control_points.ok_or_else(|| {
            let names: Vec<&str> = schema.fields().iter().map(|f| f.name().as_str()).collect();
            let found = format!("only the columns {}", names.join(", "));
            wrong_structure("schema", "a column control_points", &found)
        })?;
        Ok(columns)
    }
}

/// Returns the version of the table that the schema states.
///
/// # Errors
/// When it is not an integer, or newer than this reader.
pub(super) fn version(schema: &Schema, diagnostics: &mut Diagnostics) -> Result<u32, Problem> {
    let Some(stated) = schema.metadata().get(VERSION_KEY) else {
        diagnostics.push(
            Code::Version,
            || Place::element("schema"),
            || format!("{VERSION_KEY} is missing; the table is read as version {VERSION}"),
            format!("Add the metadata {VERSION_KEY} = {VERSION} to the schema"),
        );
        return Ok(VERSION);
    };
    match stated.trim().parse::<u32>() {
        Ok(version @ 1..=VERSION) => Ok(version),
        Ok(version) if version > VERSION => Err(Problem::Unsupported {
            place: Place::element(format!("schema, {VERSION_KEY}")),
            what: format!("version {version}"),
            remedy: format!("Use a newer Guideway; this one reads up to version {VERSION}"),
        }),
        _ => Err(wrong_structure(
            VERSION_KEY,
            "an integer from 1",
            &format!("{stated:?}"),
        )),
    }
}

/// Returns the index of the buffer with the coordinates of column `points`.
///
/// The buffers of a record batch are in the order of the columns, those of children after their
/// parent. `None` if the type of a previous column does not fix its number of buffers.
pub(super) fn coordinate_buffer(schema: &Schema, points: usize) -> Option<usize> {
    let fields = schema.fields();
    let before = fields[..points].iter();
    let before: usize = before.map(|f| buffers(f.data_type())).sum::<Option<_>>()?;
    let (DataType::List(items) | DataType::LargeList(items) | DataType::FixedSizeList(items, _)) =
        fields[points].data_type()
    else {
        return None;
    };
    let DataType::FixedSizeList(coordinates, 2) = items.data_type() else {
        return None;
    };
    let is_plain = matches!(
        coordinates.data_type(),
        DataType::Float32 | DataType::Float64
    );
    // The last buffer of the column.
    let count = buffers(fields[points].data_type())?;
    is_plain.then_some(before + count - 1)
}

/// Returns the number of buffers of a column and its children, if its type fixes it.
fn buffers(column: &DataType) -> Option<usize> {
    Some(match column {
        DataType::Null => 0,
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Binary | DataType::LargeBinary => 3,
        DataType::List(items) | DataType::LargeList(items) | DataType::Map(items, _) => {
            2 + buffers(items.data_type())?
        }
        DataType::FixedSizeList(items, _) => 1 + buffers(items.data_type())?,
        DataType::Struct(fields) => {
            let fields = fields.iter().map(|f| buffers(f.data_type()));
            1 + fields.sum::<Option<usize>>()?
        }
        DataType::Boolean | DataType::FixedSizeBinary(_) | DataType::Dictionary(..) => 2,
        plain if plain.is_primitive() => 2,
        _ => return None,
    })
}

/// Returns whether values are text, in any encoding.
pub(super) fn is_text(data_type: &DataType) -> bool {
    match data_type {
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => true,
        DataType::Dictionary(_, values) => matches!(
            values.as_ref(),
            DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View
        ),
        _ => false,
    }
}

fn is_id(field: &Field) -> bool {
    is_text(field.data_type()) || is_integer(field)
}

fn is_integer(field: &Field) -> bool {
    field.data_type().is_integer()
}

fn is_number(field: &Field) -> bool {
    field.data_type().is_integer() || field.data_type().is_floating()
}
