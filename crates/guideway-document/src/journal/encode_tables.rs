//! Encodes edits of tables as payload bytes. `decode_tables` is the inverse.

use guideway_layout::{
    Attribute, Attributes, Direction, Level, Member, Quantity, TypeEntries, Value, Values,
};
use guideway_scene::{NewNode, NewStation, Table, TableEdit};

use super::encode::Encoder;
use super::tag;

impl Encoder {
    pub(super) fn tables(&mut self, edit: &TableEdit) {
        match edit {
            TableEdit::SetIds { of, ids } => {
                self.table_edit(tag::SET_IDS, *of);
                self.list(ids, |out, (row, id)| {
                    out.number(*row);
                    out.text(id);
                });
            }
            TableEdit::SetValues {
                of,
                vehicle_type,
                column,
                quantity,
                rows,
                values,
            } => {
                self.table_edit(tag::SET_VALUES, *of);
                self.optional_text(vehicle_type.as_deref());
                self.text(column);
                self.quantity(*quantity);
                self.list(rows, |out, &row| out.number(row));
                self.values(values);
            }
            TableEdit::SetColumn {
                of,
                per_type,
                name,
                column,
            } => {
                self.table_edit(tag::SET_COLUMN, *of);
                self.byte(u8::from(*per_type));
                self.text(name);
                self.byte(u8::from(column.is_some()));
                if let Some(column) = column {
                    self.column(column);
                }
            }
            TableEdit::SetEntries { of, rows, entries } => {
                self.table_edit(tag::SET_ENTRIES, *of);
                self.list(rows, |out, &row| out.number(row));
                self.entries(entries);
            }
            TableEdit::SetEnds(ends) => {
                self.table_edit(tag::SET_ENDS, Table::Paths);
                self.list(ends, |out, &(row, [start, end])| {
                    out.number(row);
                    out.optional(start);
                    out.optional(end);
                });
            }
            TableEdit::SetDirections(directions) => {
                self.table_edit(tag::SET_DIRECTIONS, Table::Paths);
                self.list(directions, |out, &(row, direction)| {
                    out.number(row);
                    out.direction(direction);
                });
            }
            TableEdit::SetLevels { of, levels } => {
                self.table_edit(tag::SET_LEVELS, *of);
                self.list(levels, |out, &(row, level)| {
                    out.number(row);
                    out.optional(level);
                });
            }
            TableEdit::SetStationNodes(stations) => {
                self.table_edit(tag::SET_STATION_NODES, Table::Stations);
                self.list(stations, |out, (row, nodes)| {
                    out.number(*row);
                    out.list(nodes, |out, &node| out.number(node));
                });
            }
            TableEdit::SetMembers(blocks) => {
                self.table_edit(tag::SET_MEMBERS, Table::Paths);
                self.list(blocks, |out, (row, members)| {
                    out.number(*row);
                    out.list(members, |out, &member| out.member(member));
                });
            }
            TableEdit::MoveNodes(to) => {
                self.table_edit(tag::MOVE, Table::Nodes);
                self.list(to, |out, &(row, at_m)| {
                    out.number(row);
                    out.point(at_m);
                });
            }
            TableEdit::MoveStations(to) => {
                self.table_edit(tag::MOVE, Table::Stations);
                self.list(to, |out, &(row, at_m)| {
                    out.number(row);
                    out.optional_point(at_m);
                });
            }
            TableEdit::InsertNodes(new) => {
                self.table_edit(tag::INSERT_PLACES, Table::Nodes);
                self.list(new, Self::node);
            }
            TableEdit::InsertStations(new) => {
                self.table_edit(tag::INSERT_PLACES, Table::Stations);
                self.list(new, Self::station);
            }
            TableEdit::SetExists { of, rows } => {
                self.table_edit(tag::SET_EXISTS, *of);
                self.list(rows, |out, &(row, exists)| {
                    out.number(row);
                    out.byte(u8::from(exists));
                });
            }
            TableEdit::SetZoneLevels(levels) => {
                self.table_edit(tag::SET_ZONE_LEVELS, Table::Paths);
                self.list(levels, |out, &(zone, level)| {
                    out.number(zone);
                    out.optional(level);
                });
            }
            TableEdit::InsertLevel {
                row,
                level,
                elements,
            } => {
                self.table_edit(tag::INSERT_LEVEL, Table::Paths);
                self.number(*row);
                self.level(level);
                for rows in &**elements {
                    self.list(rows, |out, &row| out.number(row));
                }
            }
            TableEdit::RemoveLevel(row) => {
                self.table_edit(tag::REMOVE_LEVEL, Table::Paths);
                self.number(*row);
            }
            TableEdit::SetLevel { row, level } => {
                self.table_edit(tag::SET_LEVEL, Table::Paths);
                self.number(*row);
                self.level(level);
            }
            TableEdit::SetVehicleTypes(types) => {
                self.table_edit(tag::SET_VEHICLE_TYPES, Table::Paths);
                self.list(types, |out, of_type| {
                    out.text(&of_type.id);
                    out.columns(&of_type.attributes);
                });
            }
        }
    }

    fn table_edit(&mut self, tag: u8, of: Table) {
        self.byte(tag);
        self.byte(match of {
            Table::Paths => 0,
            Table::Nodes => 1,
            Table::Stations => 2,
        });
    }

    fn optional_text(&mut self, text: Option<&str>) {
        self.byte(u8::from(text.is_some()));
        self.text(text.unwrap_or_default());
    }

    fn optional_point(&mut self, at_m: Option<guideway_spline::Point<f64>>) {
        self.byte(u8::from(at_m.is_some()));
        if let Some(at_m) = at_m {
            self.point(at_m);
        }
    }

    fn quantity(&mut self, quantity: Option<Quantity>) {
        self.text(quantity.map_or("", Quantity::unit));
    }

    pub(super) fn direction(&mut self, direction: Direction) {
        self.byte(match direction {
            Direction::Forward => 0,
            Direction::Both => 1,
        });
    }

    fn member(&mut self, member: Member) {
        let (of, row) = match member {
            Member::Path(row) => (0, row),
            Member::Node(row) => (1, row),
            Member::Station(row) => (2, row),
        };
        self.byte(of);
        self.number(row);
    }

    fn values(&mut self, values: &Values) {
        self.byte(match values {
            Values::Bool(_) => 0,
            Values::Int(_) => 1,
            Values::Float(_) => 2,
            Values::Text(_) => 3,
            Values::Json(_) => 4,
        });
        self.number(values.len() as u32);
        for value in values.iter() {
            self.byte(u8::from(value.is_some()));
            match value {
                None => {}
                Some(Value::Bool(value)) => self.byte(u8::from(value)),
                Some(Value::Int(value)) => self.bytes(&value.to_le_bytes()),
                Some(Value::Float(value)) => self.bytes(&value.to_le_bytes()),
                Some(Value::Text(text) | Value::Json(text)) => self.text(text),
            }
        }
    }

    fn column(&mut self, column: &Attribute) {
        self.text(&column.name);
        self.quantity(column.quantity);
        self.optional_text(column.source_type.as_deref());
        self.values(&column.values);
    }

    fn entries(&mut self, entries: &TypeEntries) {
        self.number(entries.len() as u32);
        for element in 0..entries.len() {
            let types: Vec<&str> = entries.of(element).collect();
            self.list(&types, |out, name| out.text(name));
        }
        self.columns(&entries.attributes);
    }

    fn columns(&mut self, columns: &Attributes) {
        self.number(columns.iter().len() as u32);
        columns.iter().for_each(|column| self.column(column));
    }

    fn level(&mut self, level: &Level) {
        self.text(&level.id);
        self.optional_text(level.name.as_deref());
        let height_m = level.elevation_m.as_slice();
        self.list(height_m, |out, height_m| out.bytes(&height_m.to_le_bytes()));
        self.columns(&level.attributes);
        self.optional(level.source);
    }

    fn node(&mut self, node: &NewNode) {
        self.text(&node.id);
        self.point(node.position_m);
        self.optional(node.level);
        self.list(&node.vehicle_types, |out, name| out.text(name));
        self.optional(node.attributes_of);
    }

    fn station(&mut self, station: &NewStation) {
        self.text(&station.id);
        self.optional_point(station.position_m);
        self.list(&station.nodes, |out, &node| out.number(node));
        self.optional(station.level);
        self.optional(station.attributes_of);
    }
}
