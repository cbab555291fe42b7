use arrow_schema::{DataType, Field, Schema};
use guideway_layout::{Code, Diagnostics, Place};

use super::{COLOR, CONTROL_POINTS, ID, LEVEL, PART, RANK, VERSION, VERSION_KEY, WIDTH};
use crate::Problem;

/// Which column of a table is which.
#[derive(Debug, Default)]
pub(super) struct Columns {
    pub(super) control_points: usize,
    pub(super) id: Option<usize>,
    pub(super) part: Option<usize>,
    pub(super) level: Option<usize>,
    pub(super) width: Option<usize>,
    pub(super) color: Option<usize>,
    pub(super) rank: Option<usize>,
    pub(super) attributes: Vec<usize>,
}

impl Columns {
    /// Finds the columns by name. One of a known name and an unfit type is kept as an attribute.
    pub(super) fn find(schema: &Schema, diagnostics: &mut Diagnostics) -> Result<Self, Problem> {
        let mut columns = Self::default();
        let mut control_points = None;
        for (index, field) in schema.fields().iter().enumerate() {
            let (slot, fits, expected) = match field.name().as_str() {
                CONTROL_POINTS => (&mut control_points, true, ""),
                ID => (&mut columns.id, is_id(field), "text or whole numbers"),
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
                // What writers make of a column without values.
                continue;
            }
            if slot.is_some() {
                return Err(structure(field.name(), "one column of this name", "two"));
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
                "Write the column in the type expected; it is kept as an attribute",
            );
        }
        columns.control_points = control_points.ok_or_else(|| {
            let names: Vec<&str> = schema.fields().iter().map(|f| f.name().as_str()).collect();
            let found = format!("only the columns {}", names.join(", "));
            structure("schema", "a column control_points", &found)
        })?;
        Ok(columns)
    }
}

/// The version that the schema states.
pub(super) fn version(schema: &Schema, diagnostics: &mut Diagnostics) -> Result<u32, Problem> {
    let Some(stated) = schema.metadata().get(VERSION_KEY) else {
        diagnostics.push(
            Code::Version,
            || Place::element("schema"),
            || format!("no {VERSION_KEY} is stated; it is read as version {VERSION}"),
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
        _ => Err(structure(
            VERSION_KEY,
            "a whole number from 1",
            &format!("{stated:?}"),
        )),
    }
}

/// Which buffer of a record batch holds the coordinates of column `points`: buffers follow each other as columns do, those of a
/// column's children behind its own. None where some column before has a number of them that its type does not tell.
pub(super) fn points_buffer(schema: &Schema, points: usize) -> Option<usize> {
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
    // The last one of the column's.
    let own = buffers(fields[points].data_type())?;
    is_plain.then_some(before + own - 1)
}

/// Number of buffers of a column, with those of its children.
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

/// The problem of a table whose structure is not that of a layout.
pub(super) fn structure(place: &str, expected: &str, found: &str) -> Problem {
    Problem::Structure {
        place: Place::element(place),
        expected: expected.into(),
        found: found.into(),
    }
}

/// Whether the values are text, however they are stored.
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
