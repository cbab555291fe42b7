//! GeoJSON member `guideway`: maps the parts of a layout that are no features.

use std::borrow::Cow;
use std::collections::HashMap;

use guideway_layout::{Block, Code, GeoOrigin, Level, Member as Element, Place, VehicleType};

use super::columns::Named;
use super::declared::{Declared, Owner, records};
use super::extension::Reference;
use super::mapper::Mapper;
use super::model::Member;
use super::names;
use super::properties::Properties;
use super::unit::Unit;
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::json::{Field, field_place};
use crate::wgs84::LocalProjection;

impl Mapper<'_> {
    /// Maps all of the member but its blocks.
    pub(super) fn map_member(&mut self, member: &Member<'_>) -> Result<(), ReadError> {
        let at: PlaceFn<'_> = &|| Place::element("guideway");
        self.builder.check_repeated(member.repeated, at);
        let version = self.builder.number(&member.version, at);
        if version.is_some_and(|version| version > f64::from(names::VERSION)) {
            let message = || "a newer version of Guideway wrote the file".to_owned();
            let remedy = "Parts that this version does not know are ignored; update Guideway";
            self.builder.report(Code::Version, at, message, remedy);
        }
        if let Some(columns) = member.columns.get() {
            self.declared = Declared::read(columns);
        }
        self.map_unit(member, at)?;
        let properties = self.single(Owner::Layout, &member.properties, at)?;
        self.builder.layout.attributes = properties;
        for level in records(&member.levels) {
            let at: PlaceFn<'_> = &|| field_place(at, "levels");
            let id = self.builder.text(&level.id, at)?.unwrap_or_default();
            let name = self.builder.text(&level.name, at)?;
            let level = Level {
                id: id.to_owned(),
                name: name.map(str::to_owned),
                elevation_m: level.elevation.get().copied(),
                attributes: self.single(Owner::Levels, &level.properties, at)?,
                source: None,
            };
            self.push_level(level);
        }
        for vehicle_type in records(&member.vehicle_types) {
            let at: PlaceFn<'_> = &|| field_place(at, "vehicleTypes");
            let id = self.builder.text(&vehicle_type.id, at)?.unwrap_or_default();
            let vehicle_type = VehicleType {
                id: id.to_owned(),
                attributes: self.single(Owner::VehicleTypes, &vehicle_type.properties, at)?,
            };
            self.builder.layout.vehicle_types.push(vehicle_type);
        }
        Ok(())
    }

    fn map_unit(&mut self, member: &Member<'_>, at: PlaceFn<'_>) -> Result<(), ReadError> {
        let at_unit: PlaceFn<'_> = &|| field_place(at, "unit");
        let Some(unit) = self.builder.text(&member.unit, at_unit)? else {
            return Ok(());
        };
        let origin = member.origin.get().and_then(|origin| {
            let longitude_deg = *origin.longitude.get()?;
            let latitude_deg = *origin.latitude.get()?;
            let is_sound = longitude_deg.abs() <= 180.0 && latitude_deg.abs() <= 90.0;
            is_sound.then_some(GeoOrigin {
                longitude_deg,
                latitude_deg,
            })
        });
        match (unit, origin) {
            ("deg", Some(origin)) => {
                self.set_unit(Unit::Degrees(LocalProjection::about(origin)));
            }
            ("m", origin) => self.set_origin(origin),
            _ => {
                let message = || format!("`{unit}` is not `m`, or `deg` with an origin on earth");
                let remedy = "Positions are read as meters; correct the unit and the origin";
                self.builder
                    .report(Code::UnknownValue, at_unit, message, remedy);
            }
        }
        Ok(())
    }

    /// Maps the blocks, after all elements.
    pub(super) fn map_blocks(&mut self, member: &Member<'_>) -> Result<(), ReadError> {
        if member.blocks.is_absent() {
            return Ok(());
        }
        let layout = &self.builder.layout;
        let ids = [
            first_rows((0..layout.nodes.len() as u32).map(|row| layout.nodes.id(row))),
            first_rows(layout.paths.iter().map(|path| path.id())),
            first_rows((0..layout.stations.len() as u32).map(|row| layout.stations.id(row))),
        ];
        for block in records(&member.blocks) {
            let at: PlaceFn<'_> = &|| Place::element("guideway.blocks");
            let id = self
                .builder
                .text(&block.id, at)?
                .unwrap_or_default()
                .to_owned();
            let listed = block.members.get();
            let listed = listed.and_then(|list| list.parse::<Vec<(String, Reference)>>());
            let listed = listed.unwrap_or_default();
            let count = listed.len();
            let found = listed.into_iter().filter_map(|(kind, reference)| {
                let (kind, rows): (fn(u32) -> Element, _) = match kind.as_str() {
                    "node" => (Element::Node, (&self.rows.nodes, &ids[0])),
                    "path" => (Element::Path, (&self.rows.paths, &ids[1])),
                    "station" => (Element::Station, (&self.rows.stations, &ids[2])),
                    _ => return None,
                };
                let row = match reference {
                    Reference::Row(row) => rows.0.get(row as usize).copied().flatten(),
                    Reference::Id(id) => rows.1.get(&id).copied(),
                };
                row.map(kind)
            });
            let members: Vec<Element> = found.collect();
            if members.len() < count || block.members.get().is_some() && count == 0 {
                let missing = count - members.len();
                let message = || format!("the block `{id}` names {missing} unknown elements");
                let remedy = "They are ignored; correct the block";
                self.builder.report(Code::UnknownValue, at, message, remedy);
            }
            let attributes = self.single(Owner::Blocks, &block.properties, at)?;
            self.builder.layout.blocks.push(Block {
                id,
                members,
                attributes,
            });
        }
        Ok(())
    }

    /// Returns the properties of a record as the only row of a table.
    fn single(
        &mut self,
        owner: Owner,
        properties: &Field<Properties<'_>>,
        at: PlaceFn<'_>,
    ) -> Result<guideway_layout::Attributes, ReadError> {
        self.builder.check_type(properties, at, "an object");
        let properties = properties.get().into_iter().flat_map(Properties::iter);
        let named = properties.map(|(name, property)| (Cow::Borrowed(name), property));
        let named: Vec<Named<'_>> = named.collect();
        self.single_row(owner, named, at)
    }
}

/// Returns the first row of each identifier.
fn first_rows<'l>(ids: impl Iterator<Item = &'l str>) -> HashMap<String, u32> {
    let mut rows = HashMap::new();
    for (row, id) in ids.enumerate() {
        if !rows.contains_key(id) {
            rows.insert(id.to_owned(), row as u32);
        }
    }
    rows
}
