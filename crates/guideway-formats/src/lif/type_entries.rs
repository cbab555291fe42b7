//! LIF properties per vehicle type: reads the entries of nodes and edges, and sets a value that all
//! types of an element share once, on the element.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Property, TypeEntries, Value};

use super::mapper::Mapper;
use super::members::{Column, REFERENCE_POINT, TYPE_OTHER};
use super::model::{ANY_TYPE, RobotType, robot_name};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::json::{Attributes, Cell, CellResult, Field, OtherMembers, field_place, items};

/// Column of the orientation of 1.0, which is one number.
const ORIENTATION: &str = "vehicleOrientation";

/// Index of the placeholder for all vehicle types.
const ANY_INDEX: u32 = u32::MAX;

/// Value of a column.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ColumnCell<'a> {
    pub(super) column: &'static str,
    pub(super) quantity: Option<guideway_layout::Quantity>,
    pub(super) cell: Cell<'a>,
}

/// A vehicle type of an element, with the index of the entry that has its properties.
pub(super) struct TypeOfEntry {
    pub(super) name: String,
    pub(super) entry: usize,
}

/// The vehicle types of an element, each once.
#[derive(Default)]
pub(super) struct TypesOfElement {
    pub(super) list: Vec<TypeOfEntry>,
    /// The names of a long list.
    names: HashSet<String>,
}

impl TypesOfElement {
    /// Adds the types of an entry that are not known. Returns `false` if there are none.
    pub(super) fn add_all(&mut self, names: Vec<String>, entry: usize) -> bool {
        let before = self.list.len();
        names.into_iter().for_each(|name| self.add(name, entry));
        self.list.len() > before
    }

    fn add(&mut self, name: String, entry: usize) {
        const LONG: usize = 8;
        let mut known = self.list.iter().map(|of| &of.name);
        let is_new = if self.list.len() < LONG {
            known.all(|known| *known != name)
        } else {
            if self.names.is_empty() {
                self.names = known.cloned().collect();
            }
            self.names.insert(name.clone())
        };
        if is_new {
            self.list.push(TypeOfEntry { name, entry });
        }
    }
}

impl ColumnCell<'_> {
    /// Sets the value of a row.
    pub(super) fn set(
        &self,
        mapper: &mut Mapper<'_>,
        table: Table,
        row: usize,
    ) -> Result<(), ReadError> {
        if let Value::Text(text) | Value::Json(text) = self.cell.value() {
            mapper.builder.check_text(text)?;
        }
        match (self.quantity, &self.cell) {
            (Some(quantity), Cell::Number(number)) => {
                let attributes = mapper.builder.attributes(table);
                attributes.set_quantity(row, self.column, *number, quantity);
                Ok(())
            }
            (_, cell) => mapper.builder.set(table, row, self.column, cell.value()),
        }
    }
}

impl Mapper<'_> {
    /// Converts the attributes of an object to cells. Members that the format does not define, and
    /// values of another type, are added to `other`.
    pub(super) fn cells<'f>(
        &mut self,
        attributes: &Attributes<'f>,
        columns: &[Option<Column>],
        other: &mut OtherMembers,
        at: PlaceFn<'_>,
    ) -> Result<Vec<ColumnCell<'f>>, ReadError> {
        let mut cells: Vec<ColumnCell<'f>> = Vec::new();
        for field in attributes.iter() {
            let column = columns[field.index];
            let result = match column {
                Some(column) => self.builder.cell(field, column.kind, at)?,
                None => CellResult::Unfit,
            };
            match (column, result) {
                (Some(column), CellResult::Cell(cell))
                    if cells.iter().all(|cell| cell.column != column.name) =>
                {
                    cells.push(normal(column, cell));
                }
                (_, CellResult::Absent) => {}
                _ => match field.name.split_once('.') {
                    Some((group, name)) => other.add(Some(group), name, field.text),
                    None => other.add(None, field.name, field.text),
                },
            }
        }
        attributes.add_other(other);
        Ok(cells)
    }

    /// Converts the properties of an entry to cells.
    pub(super) fn type_cells<'f>(
        &mut self,
        attributes: &Attributes<'f>,
        columns: &[Option<Column>],
        at: PlaceFn<'_>,
    ) -> Result<Vec<ColumnCell<'f>>, ReadError> {
        let mut other = OtherMembers::default();
        let mut cells = self.cells(attributes, columns, &mut other, at)?;
        cells.extend(other_cell(other, TYPE_OTHER));
        Ok(cells)
    }

    /// Sets the properties of the vehicle types of an element: on the element those that all types
    /// share, else on the entries from row `first_entry` on.
    pub(super) fn set_type_cells(
        &mut self,
        [of_element, of_entry]: [Table; 2],
        row: usize,
        first_entry: usize,
        types: &[TypeOfEntry],
        cells: &[Vec<ColumnCell<'_>>],
    ) -> Result<(), ReadError> {
        let Some(first) = types.first() else {
            return Ok(());
        };
        if types.iter().all(|of| of.entry == first.entry) {
            let mut cells = cells[first.entry].iter();
            return cells.try_for_each(|cell| cell.set(self, of_element, row));
        }
        let mut done: Vec<&'static str> = Vec::new();
        for all in types.iter().map(|of| &cells[of.entry]) {
            for cell in all {
                if done.contains(&cell.column) {
                    continue;
                }
                done.push(cell.column);
                let of_type = |of: &TypeOfEntry| {
                    let mut cells = cells[of.entry].iter();
                    cells.find(|other| other.column == cell.column)
                };
                if types.iter().all(|of| of_type(of) == Some(cell)) {
                    cell.set(self, of_element, row)?;
                    continue;
                }
                for (i, of) in types.iter().enumerate() {
                    if let Some(cell) = of_type(of) {
                        cell.set(self, of_entry, first_entry + i)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Returns the names of the vehicle types of an entry.
    pub(super) fn vehicle_types(
        &mut self,
        vehicle_type: &Field<Cow<'_, str>>,
        robot_types: &Field<Vec<Field<RobotType<'_>>>>,
        at: PlaceFn<'_>,
    ) -> Result<Vec<String>, ReadError> {
        let mut names = Vec::new();
        if let Some(name) = self
            .builder
            .text(vehicle_type, &|| field_place(at, "vehicleTypeId"))?
        {
            names.push(name.to_owned());
        }
        self.builder
            .check_array(robot_types, at, "mobileRobotTypes");
        for (_, robot) in items(robot_types) {
            let Some(robot) = self
                .builder
                .record(robot, &|| field_place(at, "mobileRobotTypes"))
            else {
                continue;
            };
            let manufacturer = self
                .builder
                .text(&robot.manufacturer, &|| field_place(at, "manufacturer"))?;
            let series = self
                .builder
                .text(&robot.series, &|| field_place(at, "seriesName"))?;
            let Some(name) = robot_name(manufacturer, series) else {
                continue;
            };
            self.keep_robot_parts(&name, manufacturer, series, &robot.attributes)?;
            names.push(name);
        }
        Ok(names)
    }

    /// Keeps the parts of a name that its first space does not separate, and further members.
    fn keep_robot_parts(
        &mut self,
        name: &str,
        manufacturer: Option<&str>,
        series: Option<&str>,
        attributes: &Attributes<'_>,
    ) -> Result<(), ReadError> {
        let parts = (manufacturer.unwrap_or_default(), series.unwrap_or_default());
        if name.split_once(' ').unwrap_or(("", name)) != parts {
            let of_type = self.vehicle_type_attributes(name);
            of_type.set(0, "manufacturer", Value::Text(parts.0));
            of_type.set(0, "seriesName", Value::Text(parts.1));
        }
        if attributes.has_other() {
            let mut other = OtherMembers::default();
            attributes.add_other(&mut other);
            if let Some(text) = other.into_text() {
                self.builder.check_text(&text)?;
                let of_type = self.vehicle_type_attributes(name);
                of_type.set(0, super::members::OTHER, Value::Json(&text));
            }
        }
        Ok(())
    }

    /// Reports entries that name no vehicle type, or one that an earlier entry has.
    pub(super) fn report_surplus_entry(&mut self, name: Option<&str>, at: PlaceFn<'_>) {
        let message = || match name {
            Some(name) => format!("an earlier entry has the properties of the type `{name}`"),
            None => "the entry names no vehicle type, beside entries that do".to_owned(),
        };
        let remedy = "The entry is kept but not used; correct the application that wrote the file";
        self.builder.report(Code::Attribute, at, message, remedy);
    }

    /// Sets the entries of the nodes. Entries without properties are implied where they are those
    /// of the paths from and to the node.
    pub(super) fn set_node_types(&mut self) {
        let mut all = std::mem::take(&mut self.node_types);
        let layout = &mut self.builder.layout;
        all.attributes = std::mem::take(&mut layout.nodes.vehicle_types_mut().attributes);
        let path_types = layout.paths.vehicle_types();
        let names = path_types.names().iter().enumerate();
        let indices: HashMap<&str, u32> =
            names.map(|(i, name)| (name.as_str(), i as u32)).collect();
        let index = |name: &str| indices.get(name).copied().unwrap_or(ANY_INDEX);
        let mut of_paths: Vec<(u32, u32)> = Vec::new();
        for path in layout.paths.iter() {
            for node in [path.start_node(), path.end_node()].into_iter().flatten() {
                let types = path_types.of(path.row());
                let is_open = types.len() == 0;
                of_paths.extend(types.map(|name| (node, index(name))));
                of_paths.extend(is_open.then_some((node, ANY_INDEX)));
            }
        }
        of_paths.sort_unstable();
        of_paths.dedup();
        let mut kept = TypeEntries::default();
        let mut rows = Vec::new();
        let mut rest = of_paths.as_slice();
        for node in 0..all.len() {
            let count = rest
                .iter()
                .take_while(|(of, _)| *of as usize == node)
                .count();
            let (of_node, later) = rest.split_at(count);
            rest = later;
            let has_values = all.entries(node).any(|entry| {
                let mut columns = all.attributes.iter();
                columns.any(|column| column.values.get(entry).is_some())
            });
            let types: Vec<&str> = all.of(node).collect();
            let is_implied = !has_values
                && match of_node {
                    [] => types == [ANY_TYPE],
                    _ => {
                        let is_known =
                            |name: &&str| *name == ANY_TYPE || indices.contains_key(name);
                        let mut sorted: Vec<u32> = types.iter().map(|name| index(name)).collect();
                        sorted.sort_unstable();
                        types.iter().all(is_known)
                            && sorted.iter().eq(of_node.iter().map(|(_, index)| index))
                    }
                };
            if is_implied {
                kept.push(&[]);
            } else {
                kept.push(&types);
                rows.extend(all.entries(node));
            }
        }
        kept.attributes = all.attributes.select(&rows);
        *layout.nodes.vehicle_types_mut() = kept;
    }
}

/// The cell of members that the format does not define.
pub(super) fn other_cell(other: OtherMembers, column: &'static str) -> Option<ColumnCell<'static>> {
    let text = other.into_text()?;
    Some(ColumnCell {
        column,
        quantity: None,
        cell: Cell::Json(text),
    })
}

/// The cell of a value in the form that both versions share: a list of one orientation is a number,
/// and choices are spelled as in VDA 5050.
fn normal(column: Column, cell: Cell<'_>) -> ColumnCell<'_> {
    let of_column = |cell| ColumnCell {
        column: column.name,
        quantity: column.quantity,
        cell,
    };
    match (column.member, cell) {
        ("mobileRobotOrientations", Cell::Json(list)) => {
            let numbers = serde_json::from_str::<Vec<f64>>(&list);
            match numbers.as_deref() {
                Ok([one]) => ColumnCell {
                    column: ORIENTATION,
                    quantity: Property::named(ORIENTATION).and_then(Property::quantity),
                    cell: Cell::Number(*one),
                },
                _ => of_column(Cell::Json(list)),
            }
        }
        (REFERENCE_POINT, Cell::Text(text)) if text == "KINEMATIC_CENTER" => {
            of_column(Cell::Text("KINEMATICCENTER".into()))
        }
        (_, cell) => of_column(cell),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_and_long_lists_have_each_type_once() {
        let mut types = TypesOfElement::default();
        for round in 0..3 {
            for i in 0..20 {
                types.add(format!("t{}", i % (7 + 6 * round)), round);
            }
        }
        let names: Vec<_> = types.list.iter().map(|of| of.name.clone()).collect();
        let expected: Vec<_> = (0..19).map(|i| format!("t{i}")).collect();
        assert_eq!(names, expected);
        assert_eq!((types.list[6].entry, types.list[7].entry), (0, 1));
    }
}
