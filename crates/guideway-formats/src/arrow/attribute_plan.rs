//! Attribute plan: the columns that hold the attributes of all elements of a layout. Attributes of
//! several elements with one name and type share a column.

use std::collections::HashMap;

use arrow_array::{ArrayRef, new_null_array};
use arrow_schema::Field;
use guideway_layout::{Attribute, Attributes, Layout, Quantity, Value, Values};

use super::attribute_names::column_for;
use super::column_names::{
    EXTENSION_KEY, EXTENSION_METADATA_KEY, JSON_EXTENSION, PATHS_VERSION, UNIT_KEY,
};
use super::element::Element;
use super::layout_rows::Row;
use super::schema::is_reserved;
use super::write_column::Column;

/// Column of an attribute.
pub(super) struct AttributeSource<'a> {
    /// Name in the table, and type.
    column: Column,
    /// Name in the layout.
    name: &'a str,
    is_json: bool,
    quantity: Option<Quantity>,
    /// The attributes of elements that have a table.
    tables: Vec<(Element, &'a Attribute)>,
    /// Elements that have attributes of their own in this column.
    groups: Vec<Element>,
}

/// Attributes of the elements of one kind.
enum Owners<'a> {
    /// One table with a row per element.
    Table(&'a Attributes),
    /// A table of one row per element.
    Groups(Vec<&'a Attributes>),
}

fn owners(layout: &Layout, kind: Element) -> Owners<'_> {
    match kind {
        Element::Path => Owners::Table(&layout.paths.attributes),
        Element::PathType => Owners::Table(&layout.paths.vehicle_types().attributes),
        Element::Node => Owners::Table(&layout.nodes.attributes),
        Element::NodeType => Owners::Table(&layout.nodes.vehicle_types().attributes),
        Element::Station => Owners::Table(&layout.stations.attributes),
        Element::Layout => Owners::Table(&layout.attributes),
        Element::Level => Owners::Groups(layout.levels.iter().map(|l| &l.attributes).collect()),
        Element::VehicleType => {
            Owners::Groups(layout.vehicle_types.iter().map(|t| &t.attributes).collect())
        }
        Element::Block => Owners::Groups(layout.blocks.iter().map(|b| &b.attributes).collect()),
        Element::Zone => Owners::Groups(layout.zones.iter().map(|z| &z.attributes).collect()),
        Element::RefusedPath => Owners::Groups(Vec::new()),
    }
}

fn attributes_of(layout: &Layout, kind: Element, row: usize) -> Option<&Attributes> {
    match kind {
        Element::Level => layout.levels.get(row).map(|level| &level.attributes),
        Element::VehicleType => layout.vehicle_types.get(row).map(|t| &t.attributes),
        Element::Block => layout.blocks.get(row).map(|block| &block.attributes),
        Element::Zone => layout.zones.get(row).map(|zone| &zone.attributes),
        _ => None,
    }
}

/// Returns whether an attribute has a value in any row.
pub(super) fn has_values(attribute: &Attribute) -> bool {
    (0..attribute.values.len()).any(|row| attribute.values.get(row).is_some())
}

/// Returns the columns of the attributes of a layout.
pub(super) fn plan(layout: &Layout, version: u32) -> Vec<AttributeSource<'_>> {
    let mut sources: Vec<AttributeSource<'_>> = Vec::new();
    for kind in Element::ALL {
        match owners(layout, kind) {
            Owners::Table(attributes) => {
                let all = version == PATHS_VERSION;
                for attribute in attributes.iter().filter(|a| all || has_values(a)) {
                    let source = source_of(&mut sources, attribute, version);
                    source.tables.push((kind, attribute));
                }
            }
            Owners::Groups(groups) => {
                for attribute in groups.into_iter().flat_map(Attributes::iter) {
                    if has_values(attribute) {
                        let source = source_of(&mut sources, attribute, version);
                        if !source.groups.contains(&kind) {
                            source.groups.push(kind);
                        }
                    }
                }
            }
        }
    }
    sources
}

/// Returns the column of an attribute, which is added if there is none.
fn source_of<'s, 'a>(
    sources: &'s mut Vec<AttributeSource<'a>>,
    attribute: &'a Attribute,
    version: u32,
) -> &'s mut AttributeSource<'a> {
    let mut column = Column::from_attribute(attribute);
    let known = sources.iter().position(|s| s.holds(attribute, &column));
    let index = known.unwrap_or_else(|| {
        if version > PATHS_VERSION {
            let is_used = |name: &str| sources.iter().any(|s| s.column.name == name);
            let is_taken = |name: &str| is_reserved(name, version) || is_used(name);
            column.name = column_for(&attribute.name, is_taken);
        }
        sources.push(AttributeSource {
            column,
            name: &attribute.name,
            is_json: matches!(attribute.values, Values::Json(_)),
            quantity: attribute.quantity,
            tables: Vec::new(),
            groups: Vec::new(),
        });
        sources.len() - 1
    });
    &mut sources[index]
}

impl AttributeSource<'_> {
    /// Returns whether an attribute, which `column` would hold alone, is in this column.
    fn holds(&self, attribute: &Attribute, column: &Column) -> bool {
        self.name == attribute.name
            && self.column.column_type == column.column_type
            && self.is_json == matches!(attribute.values, Values::Json(_))
            && self.quantity == attribute.quantity
    }

    /// Returns the field of the schema.
    pub(super) fn field(&self) -> Field {
        let mut metadata = HashMap::new();
        if let Some(quantity) = self.quantity {
            metadata.insert(UNIT_KEY.to_owned(), quantity.unit().to_owned());
        }
        if self.is_json {
            metadata.insert(EXTENSION_KEY.to_owned(), JSON_EXTENSION.to_owned());
            metadata.insert(EXTENSION_METADATA_KEY.to_owned(), String::new());
        }
        self.column.field().with_metadata(metadata)
    }

    fn table(&self, kind: Element) -> Option<&Attribute> {
        let table = self.tables.iter().find(|table| table.0 == kind);
        table.map(|table| table.1)
    }

    /// Returns the bytes of text of an element that has a table.
    pub(super) fn text_bytes(&self, kind: Element, row: usize) -> usize {
        match self.table(kind).and_then(|table| table.values.get(row)) {
            Some(Value::Text(text) | Value::Json(text)) => text.len(),
            _ => 0,
        }
    }

    /// Returns the array of a batch.
    pub(super) fn array(&self, layout: &Layout, kind: Element, rows: &[Row]) -> ArrayRef {
        let mut cells = self.column.cells();
        if let Some(table) = self.table(kind) {
            // A row that continues a path has only its part.
            let value = |row: &Row| table.values.get(row.index).filter(|_| row.part == 0);
            rows.iter().for_each(|row| cells.push(value(row)));
        } else if self.groups.contains(&kind) {
            let value = |row: &Row| {
                let attribute = attributes_of(layout, kind, row.index)?.get(self.name)?;
                let column = Column::from_attribute(attribute);
                attribute
                    .values
                    .get(0)
                    .filter(|_| self.holds(attribute, &column))
            };
            rows.iter().for_each(|row| cells.push(value(row)));
        } else {
            return new_null_array(self.column.field().data_type(), rows.len());
        }
        cells.take(&self.column)
    }
}
