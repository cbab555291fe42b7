//! Schema of a table: finds the columns by name and type, the version, and the buffer of
//! coordinates.

use arrow_schema::{DataType, Field, Schema};
use guideway_layout::{Code, Diagnostics, Place, Quantity};

use super::column_names::{
    COLOR, CONTROL_POINTS, CURVE, DIRECTION, ELEMENT, ELEVATION, END_NODE, EXTENSION_KEY, ID,
    JSON_EXTENSION, LEVEL, LEVEL_NAME, MEMBERS, NETWORK_VERSION, NODES, OF, OUTLINE, PART,
    PATHS_VERSION, RANK, REFUSAL_CODE, REFUSAL_DETAIL, START_NODE, UNIT_KEY, VEHICLE_TYPES,
    VERSION_KEY, WIDTH, X, Y,
};
use super::column_types::{
    is_curve, is_id, is_integers, is_members, is_number, is_points, is_text, is_texts,
};
use super::problems::wrong_structure;
use crate::Problem;
use crate::text::printable;

/// Meaning of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    Id,
    Part,
    Level,
    Width,
    Color,
    Rank,
    Element,
    StartNode,
    EndNode,
    Direction,
    VehicleTypes,
    Curve,
    X,
    Y,
    Nodes,
    Of,
    LevelName,
    Elevation,
    Members,
    Outline,
    RefusalCode,
    RefusalDetail,
}

/// Name and type of the column of a role.
struct Rule {
    role: Role,
    name: &'static str,
    /// First version in which the name has the meaning.
    since: u32,
    fits: fn(&DataType) -> bool,
    expected: &'static str,
}

const fn rule(
    role: Role,
    name: &'static str,
    since: u32,
    fits: fn(&DataType) -> bool,
    expected: &'static str,
) -> Rule {
    Rule {
        role,
        name,
        since,
        fits,
        expected,
    }
}

/// The columns with a meaning except the control points, in the order of the roles.
const RULES: [Rule; 22] = [
    rule(Role::Id, ID, 1, is_id, "text or integers"),
    rule(Role::Part, PART, 1, is_number, "uint32"),
    rule(Role::Level, LEVEL, 1, is_id, "text"),
    rule(Role::Width, WIDTH, 1, is_number, "float32"),
    rule(Role::Color, COLOR, 1, is_number, "uint32"),
    rule(Role::Rank, RANK, 1, is_number, "int32"),
    rule(Role::Element, ELEMENT, 2, is_text, "text"),
    rule(Role::StartNode, START_NODE, 2, is_number, "uint32"),
    rule(Role::EndNode, END_NODE, 2, is_number, "uint32"),
    rule(Role::Direction, DIRECTION, 2, is_text, "text"),
    rule(Role::VehicleTypes, VEHICLE_TYPES, 2, is_texts, "list<text>"),
    rule(Role::Curve, CURVE, 2, is_curve, CURVE_TYPE),
    rule(Role::X, X, 2, is_number, "float64"),
    rule(Role::Y, Y, 2, is_number, "float64"),
    rule(Role::Nodes, NODES, 2, is_integers, "list<uint32>"),
    rule(Role::Of, OF, 2, is_number, "uint32"),
    rule(Role::LevelName, LEVEL_NAME, 2, is_text, "text"),
    rule(Role::Elevation, ELEVATION, 2, is_number, "float64"),
    rule(Role::Members, MEMBERS, 2, is_members, MEMBERS_TYPE),
    rule(
        Role::Outline,
        OUTLINE,
        2,
        is_points,
        "list<fixed_size_list<float64, 2>>",
    ),
    rule(Role::RefusalCode, REFUSAL_CODE, 2, is_text, "text"),
    rule(Role::RefusalDetail, REFUSAL_DETAIL, 2, is_text, "text"),
];
const CURVE_TYPE: &str = "struct<degree: uint32, knots: list<float64>, weights: list<float64>, \
                          points: list<fixed_size_list<float64, 2>>>";
const MEMBERS_TYPE: &str = "list<struct<element: text, index: uint32>>";

/// Returns whether a column of a version has a meaning by its name.
pub(super) fn is_reserved(name: &str, version: u32) -> bool {
    name == CONTROL_POINTS || RULES.iter().any(|r| r.name == name && r.since <= version)
}

/// Index of each column with a meaning, and of the attributes.
#[derive(Debug, Default)]
pub(super) struct ColumnRoles {
    pub(super) version: u32,
    pub(super) control_points: usize,
    roles: [Option<usize>; RULES.len()],
    pub(super) attributes: Vec<usize>,
}

impl ColumnRoles {
    /// Finds the columns by name. A column of a known name but another type is an attribute.
    ///
    /// # Errors
    /// When two columns share a name, or there are no control points.
    pub(super) fn find(
        schema: &Schema,
        version: u32,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, Problem> {
        let mut columns = Self {
            version,
            ..Self::default()
        };
        let mut control_points = None;
        for (index, field) in schema.fields().iter().enumerate() {
            let rules = RULES.iter().filter(|rule| rule.since <= version);
            let rule = rules.clone().find(|rule| rule.name == field.name());
            let slot = match rule {
                Some(rule) => &mut columns.roles[rule.role as usize],
                None if field.name() == CONTROL_POINTS => &mut control_points,
                None => {
                    check_unit(field, diagnostics);
                    columns.attributes.push(index);
                    continue;
                }
            };
            if *field.data_type() == DataType::Null && rule.is_some() {
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
            match rule.filter(|rule| !rule.accepts(field.data_type(), version)) {
                None => *slot = Some(index),
                Some(rule) => {
                    columns.attributes.push(index);
                    diagnostics.push(
                        Code::WrongType,
                        || Place::element(format!("column {}", field.name())),
                        || format!("expected {}, found {}", rule.expected, field.data_type()),
                        "It is read as an attribute; write the column in the expected type",
                    );
                }
            }
        }
        columns.control_points = control_points.ok_or_else(|| {
            if let Some(geometry) = schema.fields().iter().find(|field| is_geoarrow(field)) {
                return Problem::Unsupported {
                    place: Place::element(format!("column {}", geometry.name())),
                    what: "a table of GeoArrow".to_owned(),
                    remedy: "Convert it: geopandas.GeoDataFrame.from_arrow(TABLE).to_file(\
                             \"FILE.geojson\")"
                        .into(),
                };
            }
            let names: Vec<&str> = schema.fields().iter().map(|f| f.name().as_str()).collect();
            let found = format!("only the columns {}", names.join(", "));
            wrong_structure("schema", "a column control_points", &found)
        })?;
        Ok(columns)
    }

    /// Returns the index of the column with a meaning, if the table has it.
    pub(super) fn get(&self, role: Role) -> Option<usize> {
        self.roles[role as usize]
    }
}

/// Returns whether a column has geometries as the extension types of GeoArrow.
fn is_geoarrow(field: &Field) -> bool {
    let name = field.metadata().get("ARROW:extension:name");
    name.is_some_and(|name| name.starts_with("geoarrow."))
}

impl Rule {
    fn accepts(&self, column: &DataType, version: u32) -> bool {
        // Levels by their number are of version 2.
        let is_text_only = self.role == Role::Level && version < NETWORK_VERSION;
        (self.fits)(column) && (is_text(column) || !is_text_only)
    }
}

/// Reports a unit in which the layout has no quantity.
fn check_unit(field: &Field, diagnostics: &mut Diagnostics) {
    let Some(unit) = field.metadata().get(UNIT_KEY) else {
        return;
    };
    if quantity(field).is_some() {
        return;
    }
    diagnostics.push(
        Code::Attribute,
        || Place::element(format!("column {}", field.name())),
        || format!("the unit {} is not known", printable(unit)),
        "The values are read without a unit; write numbers in m, rad, m/s, rad/s, kg or s",
    );
}

/// Returns the quantity that the values of a column measure, by the unit in its metadata.
pub(super) fn quantity(field: &Field) -> Option<Quantity> {
    Quantity::of_unit(field.metadata().get(UNIT_KEY)?)
}

/// Returns whether the texts of a column are JSON.
pub(super) fn is_json(field: &Field) -> bool {
    let extension = field.metadata().get(EXTENSION_KEY);
    extension.is_some_and(|name| name == JSON_EXTENSION) && is_text(field.data_type())
}

/// Returns the version of the table that the schema states.
///
/// # Errors
/// When it is not an integer, or newer than this reader.
pub(super) fn version(schema: &Schema, diagnostics: &mut Diagnostics) -> Result<u32, Problem> {
    let Some(stated) = schema.metadata().get(VERSION_KEY) else {
        // polars drops the metadata of the schema, but not this column.
        let version = match schema.column_with_name(ELEMENT) {
            Some(_) => NETWORK_VERSION,
            None => PATHS_VERSION,
        };
        diagnostics.push(
            Code::Version,
            || Place::element("schema"),
            || format!("{VERSION_KEY} is missing; the table is read as version {version}"),
            format!("Add the metadata {VERSION_KEY} = {version} to the schema"),
        );
        return Ok(version);
    };
    match stated.trim().parse::<u32>() {
        Ok(version @ PATHS_VERSION..=NETWORK_VERSION) => Ok(version),
        Ok(version) if version > NETWORK_VERSION => Err(Problem::Unsupported {
            place: Place::element(format!("schema, {VERSION_KEY}")),
            what: format!("version {version}"),
            remedy: format!("Use a newer Guideway; this one reads up to version {NETWORK_VERSION}"),
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
