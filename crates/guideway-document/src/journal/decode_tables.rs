//! Decodes edits of tables from payload bytes, which may be damaged.

use std::sync::Arc;

use guideway_layout::{
    Attribute, Attributes, Direction, Level, Member, Quantity, TextCells, TypeEntries, Values,
    VehicleType,
};
use guideway_scene::{NewNode, NewStation, Table, TableEdit};
use guideway_spline::Point;

use super::decode::Decoder;
use super::tag;

impl Decoder<'_> {
    pub(super) fn tables(&mut self) -> Option<TableEdit> {
        let kind = self.byte()?;
        let of = match self.byte()? {
            0 => Table::Paths,
            1 => Table::Nodes,
            2 => Table::Stations,
            _ => return None,
        };
        Some(match (kind, of) {
            (tag::SET_IDS, _) => {
                let id = |input: &mut Self| Some((input.number()?, input.text()?.into()));
                TableEdit::SetIds {
                    of,
                    ids: self.list(id)?.into(),
                }
            }
            (tag::SET_VALUES, _) => TableEdit::SetValues {
                of,
                vehicle_type: self.optional_text()?.map(Arc::from),
                column: self.text()?.into(),
                quantity: self.quantity()?,
                rows: self.rows()?,
                values: Arc::new(self.values()?),
            },
            (tag::SET_COLUMN, _) => {
                let (per_type, name) = (self.byte()? != 0, self.text()?.into());
                let column = match self.byte()? {
                    0 => None,
                    _ => Some(Arc::new(self.column()?)),
                };
                TableEdit::SetColumn {
                    of,
                    per_type,
                    name,
                    column,
                }
            }
            (tag::SET_ENTRIES, _) => TableEdit::SetEntries {
                of,
                rows: self.rows()?,
                entries: Arc::new(self.entries()?),
            },
            (tag::SET_ENDS, _) => {
                let ends = |input: &mut Self| {
                    Some((input.number()?, [input.optional()?, input.optional()?]))
                };
                TableEdit::SetEnds(self.list(ends)?.into())
            }
            (tag::SET_DIRECTIONS, _) => {
                let direction = |input: &mut Self| Some((input.number()?, input.direction()?));
                TableEdit::SetDirections(self.list(direction)?.into())
            }
            (tag::SET_LEVELS, _) => {
                let level = |input: &mut Self| Some((input.number()?, input.optional()?));
                TableEdit::SetLevels {
                    of,
                    levels: self.list(level)?.into(),
                }
            }
            (tag::SET_STATION_NODES, _) => {
                let nodes = |input: &mut Self| {
                    Some((
                        input.number()?,
                        input.list(Self::number)?.into_boxed_slice(),
                    ))
                };
                TableEdit::SetStationNodes(self.list(nodes)?.into())
            }
            (tag::SET_MEMBERS, _) => {
                let members = |input: &mut Self| {
                    Some((
                        input.number()?,
                        input.list(Self::member)?.into_boxed_slice(),
                    ))
                };
                TableEdit::SetMembers(self.list(members)?.into())
            }
            (tag::MOVE, Table::Nodes) => {
                let node = |input: &mut Self| Some((input.number()?, input.point()?));
                TableEdit::MoveNodes(self.list(node)?.into())
            }
            (tag::MOVE, Table::Stations) => {
                let station = |input: &mut Self| Some((input.number()?, input.optional_point()?));
                TableEdit::MoveStations(self.list(station)?.into())
            }
            (tag::INSERT_PLACES, Table::Nodes) => {
                TableEdit::InsertNodes(self.list(Self::node)?.into())
            }
            (tag::INSERT_PLACES, Table::Stations) => {
                TableEdit::InsertStations(self.list(Self::station)?.into())
            }
            (tag::SET_EXISTS, _) => {
                let exists = |input: &mut Self| Some((input.number()?, input.byte()? != 0));
                TableEdit::SetExists {
                    of,
                    rows: self.list(exists)?.into(),
                }
            }
            (tag::SET_ZONE_LEVELS, _) => {
                let level = |input: &mut Self| Some((input.number()?, input.optional()?));
                TableEdit::SetZoneLevels(self.list(level)?.into())
            }
            (tag::INSERT_LEVEL, _) => TableEdit::InsertLevel {
                row: self.number()?,
                level: Arc::new(self.level()?),
                elements: Arc::new([
                    self.list(Self::number)?,
                    self.list(Self::number)?,
                    self.list(Self::number)?,
                ]),
            },
            (tag::REMOVE_LEVEL, _) => TableEdit::RemoveLevel(self.number()?),
            (tag::SET_LEVEL, _) => TableEdit::SetLevel {
                row: self.number()?,
                level: Arc::new(self.level()?),
            },
            (tag::SET_VEHICLE_TYPES, _) => {
                let of_type = |input: &mut Self| {
                    let (id, attributes) = (input.text()?, input.columns()?);
                    Some(VehicleType { id, attributes })
                };
                TableEdit::SetVehicleTypes(self.list(of_type)?.into())
            }
            _ => return None,
        })
    }

    fn optional_text(&mut self) -> Option<Option<String>> {
        let is_present = self.byte()? != 0;
        let text = self.text()?;
        Some(is_present.then_some(text))
    }

    fn optional_point(&mut self) -> Option<Option<Point<f64>>> {
        match self.byte()? {
            0 => Some(None),
            _ => Some(Some(self.point()?)),
        }
    }

    fn quantity(&mut self) -> Option<Option<Quantity>> {
        match self.text()?.as_str() {
            "" => Some(None),
            unit => Some(Some(Quantity::of_unit(unit)?)),
        }
    }

    pub(super) fn direction(&mut self) -> Option<Direction> {
        match self.byte()? {
            0 => Some(Direction::Forward),
            1 => Some(Direction::Both),
            _ => None,
        }
    }

    fn member(&mut self) -> Option<Member> {
        let of = self.byte()?;
        let row = self.number()?;
        match of {
            0 => Some(Member::Path(row)),
            1 => Some(Member::Node(row)),
            2 => Some(Member::Station(row)),
            _ => None,
        }
    }

    fn values(&mut self) -> Option<Values> {
        let truth = |input: &mut Self| Some(input.byte()? != 0);
        Some(match self.byte()? {
            0 => Values::Bool(self.cells(truth)?.into_iter().collect()),
            1 => {
                let cells = self.cells(|input| input.take().map(i64::from_le_bytes))?;
                Values::Int(cells.into_iter().collect())
            }
            2 => {
                let cells = self.cells(|input| input.take().map(f64::from_le_bytes))?;
                Values::Float(cells.into_iter().collect())
            }
            3 => Values::Text(self.texts()?),
            4 => Values::Json(self.texts()?),
            _ => return None,
        })
    }

    fn texts(&mut self) -> Option<TextCells> {
        let texts = self.cells(Self::text)?;
        Some(texts.iter().map(Option::as_deref).collect())
    }

    fn cells<T>(&mut self, cell: impl Fn(&mut Self) -> Option<T>) -> Option<Vec<Option<T>>> {
        self.list(|input| match input.byte()? {
            0 => Some(None),
            _ => Some(Some(cell(input)?)),
        })
    }

    fn column(&mut self) -> Option<Attribute> {
        let name = self.text()?;
        let quantity = self.quantity()?;
        let source_type = self.optional_text()?;
        Some(Attribute {
            name,
            values: self.values()?,
            quantity,
            source_type,
        })
    }

    fn entries(&mut self) -> Option<TypeEntries> {
        let elements = self.list(|input| input.list(Self::text))?;
        let mut entries = TypeEntries::default();
        for types in &elements {
            let types: Vec<&str> = types.iter().map(String::as_str).collect();
            entries.push(&types);
        }
        entries.attributes = self.columns()?;
        Some(entries)
    }

    fn columns(&mut self) -> Option<Attributes> {
        let mut attributes = Attributes::default();
        let columns = self.list(Self::column)?;
        columns
            .into_iter()
            .for_each(|column| attributes.insert(column));
        Some(attributes)
    }

    fn level(&mut self) -> Option<Level> {
        let (id, name) = (self.text()?, self.optional_text()?);
        let height_m = self.list(|input| input.take().map(f64::from_le_bytes))?;
        Some(Level {
            id,
            name,
            elevation_m: height_m.first().copied(),
            attributes: self.columns()?,
            source: self.optional()?,
        })
    }

    fn node(&mut self) -> Option<NewNode> {
        Some(NewNode {
            id: self.text()?,
            position_m: self.point()?,
            level: self.optional()?,
            vehicle_types: self.list(Self::text)?,
            attributes_of: self.optional()?,
        })
    }

    fn station(&mut self) -> Option<NewStation> {
        Some(NewStation {
            id: self.text()?,
            position_m: self.optional_point()?,
            nodes: self.list(Self::number)?,
            level: self.optional()?,
            attributes_of: self.optional()?,
        })
    }
}
