//! Maps blocks, vehicles, location types and the drawing of a plant model to groups and attributes
//! of the layout.

use std::collections::{HashMap, HashSet};

use guideway_layout::{Code, Member};
use roxmltree::Node;
use serde_json::{Map, Value as Json};

use super::elements::{BOUNDING_BOX, Element, Kind, LOCATION_TYPE, VEHICLE};
use super::reader::{Known, PlantReader, name_or_empty};
use super::visual_layout::VisualLayout;
use crate::ReadError;
use crate::builder::Table;
use crate::xml::{child, children};

/// Attributes of the layout that only openTCS has.
pub(super) const VEHICLES: &str = "vehicles";
pub(super) const LOCATION_TYPES: &str = "locationTypes";

const BLOCK: Known = Known {
    attributes: &["name", "type"],
    children: &["member", "property", "blockLayout"],
};

const MODEL: Known = Known {
    attributes: &["version", "name"],
    children: &[
        "point",
        "path",
        "vehicle",
        "locationType",
        "location",
        "block",
        "visualLayout",
        "property",
    ],
};

/// Maps what refers to paths, nodes and stations, which are already mapped.
pub(super) struct GroupMapper<'m, 'a, 'd, 't> {
    pub(super) reader: &'m mut PlantReader<'a, 'd, 't>,
    pub(super) visual: &'m VisualLayout<'d, 't>,
    /// Rows by name.
    pub(super) paths: &'m HashMap<&'d str, u32>,
    pub(super) nodes: &'m HashMap<&'d str, u32>,
    pub(super) stations: &'m HashMap<&'d str, u32>,
}

impl<'d, 't> GroupMapper<'_, '_, 'd, 't> {
    /// Maps everything but points, paths and locations.
    ///
    /// # Errors
    /// When the layout exceeds a limit.
    pub(super) fn map_groups(&mut self, model: Node<'d, 't>) -> Result<(), ReadError> {
        let objects = model.children().filter(Node::is_element);
        let names: HashSet<&str> = objects.map(name_or_empty).collect();
        for block in children(model, "block") {
            self.map_block(block, &names)?;
        }
        self.reader.begin();
        let name = model.attribute("name");
        self.reader.set_text(Table::Layout, 0, "name", name)?;
        let vehicles = children(model, "vehicle").map(|node| self.vehicle(node));
        let vehicles: Vec<Json> = vehicles.collect();
        self.set_list(VEHICLES, vehicles)?;
        let used: HashSet<_> = children(model, "location")
            .filter_map(|location| location.attribute("type"))
            .collect();
        let types = children(model, "locationType").filter_map(|node| {
            let kind = self.object(&LOCATION_TYPE, node);
            // A kind that a station names and that has no more than its name needs no entry.
            let is_bare = kind.len() == 1 && used.contains(name_or_empty(node));
            (!is_bare).then(|| kind.into())
        });
        let types: Vec<Json> = types.collect();
        self.set_list(LOCATION_TYPES, types)?;
        self.visual.store(self.reader, &names)?;
        self.reader.finish(Table::Layout, 0, model, &MODEL)
    }

    fn set_list(&mut self, name: &str, values: Vec<Json>) -> Result<(), ReadError> {
        let list = (!values.is_empty()).then(|| values.into());
        self.reader.set_json(Table::Layout, 0, name, list)
    }

    /// An element that the layout holds as JSON, with what its legacy drawing says in addition.
    fn object(&self, element: &Element, node: Node<'d, 't>) -> Map<String, Json> {
        let mut object = element.to_json(node);
        let legacy = self.visual.legacy_element(name_or_empty(node));
        if let Some(unread) = legacy.and_then(|legacy| legacy.unread()) {
            object.insert("modelLayoutElement".into(), unread);
        }
        object
    }

    fn vehicle(&self, node: Node<'d, 't>) -> Json {
        let mut vehicle = self.object(&VEHICLE, node);
        let legacy = self.visual.legacy_element(name_or_empty(node));
        if let Some(color) = legacy.and_then(|legacy| legacy.color) {
            let layout = serde_json::json!({ "color": color });
            vehicle.entry("vehicleLayout").or_insert(layout);
        }
        // Up to version 0.0.5, a vehicle has a length but no other extents.
        if !vehicle.contains_key(BOUNDING_BOX.tag) {
            let mut extents = BOUNDING_BOX.default_json();
            let length = vehicle.remove("length");
            if let Some(length) = length.as_ref().and_then(Json::as_str) {
                extents.insert("length".into(), Kind::Int.json(length));
            }
            vehicle.insert(BOUNDING_BOX.tag.into(), extents.into());
        }
        vehicle.into()
    }

    /// Maps a block; `names` are those of all objects, also of refused ones.
    fn map_block(&mut self, block: Node<'d, 't>, names: &HashSet<&str>) -> Result<(), ReadError> {
        self.reader.begin();
        let name = self.reader.name(block)?;
        let mut seen = HashSet::new();
        let mut members = Vec::new();
        for member in children(block, "member") {
            let name = name_or_empty(member);
            match self.member(name) {
                Some(element) if seen.insert(element) => members.push(element),
                Some(_) => {}
                None if names.contains(name) => self.reader.keep("member", name.into()),
                None => {
                    let message = || format!("the member \"{name}\" does not exist");
                    let remedy = "It is left out of the block; add the element or correct the name";
                    let base = &mut self.reader.base;
                    base.report(Code::UnknownValue, block, message, remedy);
                    self.reader.keep("member", name.into());
                }
            }
        }
        let row = self.reader.base.builder.push_block(&name, members)?;
        let table = Table::Block(row);
        self.reader
            .set_text(table, 0, "type", block.attribute("type"))?;
        let legacy = self.visual.legacy_element(name_or_empty(block));
        let layout = child(block, "blockLayout");
        let color = layout.and_then(|layout| layout.attribute("color"));
        let color = color.or_else(|| legacy?.color);
        self.reader.set_text(table, 0, "color", color)?;
        if let Some(layout) = layout {
            self.reader.keep_unknown(layout, &["color"]);
        }
        if let Some(unread) = legacy.and_then(|legacy| legacy.unread()) {
            self.reader.keep("modelLayoutElement", unread);
        }
        self.reader.finish(table, 0, block, &BLOCK)
    }

    fn member(&self, name: &str) -> Option<Member> {
        let row = |rows: &HashMap<&str, u32>| rows.get(name).copied();
        let path = row(self.paths).map(Member::Path);
        let node = || row(self.nodes).map(Member::Node);
        let station = || row(self.stations).map(Member::Station);
        path.or_else(node).or_else(station)
    }
}
