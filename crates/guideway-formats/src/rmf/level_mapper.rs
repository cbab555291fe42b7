//! Maps the levels and the properties of a site.

use std::collections::HashSet;

use guideway_layout::{Attributes, Code, Value};

use super::edges::EDGES;
use super::frame::Frame;
use super::level::Level;
use super::parameters::json;
use super::reader::place;
use super::site_mapper::SiteMapper;
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::yaml::YamlNode;

/// Keys of a level that the mapper of its elements reads.
const MAPPED: [&str; 9] = [
    "vertices",
    "lanes",
    "human_lanes",
    "walls",
    "doors",
    "measurements",
    "fiducials",
    "elevation",
    "name",
];

/// Keys of a level that become its properties; all others become the property `other`.
const OF_LEVEL: [&str; 6] = [
    "drawing",
    "layers",
    "flattened_x_offset",
    "flattened_y_offset",
    "x_meters",
    "y_meters",
];

/// Keys of the file that become properties of the layout; all others become the property `other`.
const OF_SITE: [&str; 7] = [
    "coordinate_system",
    "reference_level_name",
    "crs_name",
    "offset",
    "parameters",
    "graphs",
    "crowd_sim",
];

impl<'y> SiteMapper<'_, 'y> {
    /// Maps a level with its vertices and edges.
    pub(super) fn map_level(
        &mut self,
        index: u32,
        level: &Level<'y>,
        frame: Frame,
    ) -> Result<(), ReadError> {
        let elevation = level.content.get("elevation");
        if let Some(odd) = elevation.filter(|e| e.number().is_none()) {
            self.reader
                .report_type(&|| level.place("elevation"), "a number", odd);
        }
        let elevation = elevation.and_then(YamlNode::number);
        let name = level.content.get("name").and_then(YamlNode::text);
        let entries = level.content.entries();
        let entries = entries.filter(|(key, _)| !MAPPED.contains(key));
        let entries = entries.filter(|(_, node)| node.items().len() == 0);
        let attributes = self.properties(entries, &OF_LEVEL, &|| {
            place(&format!("levels.{}", level.name), level.content)
        })?;
        let levels = &mut self.reader.builder.layout.levels;
        levels.push(guideway_layout::Level {
            id: level.name.to_owned(),
            name: name.map(str::to_owned),
            elevation_m: elevation.filter(|e| e.is_finite()),
            attributes,
            source: None,
        });
        let vertices = level.content.get("vertices").into_iter();
        let mut nodes = Vec::with_capacity(level.positions.len());
        for (i, vertex) in vertices.flat_map(YamlNode::items).enumerate() {
            nodes.push(self.map_vertex(index, level, frame, i, vertex)?);
        }
        for (key, element) in EDGES {
            for (i, edge) in level.list(&mut self.reader.builder, key).enumerate() {
                self.map_edge(index, level, &nodes, (key, element, i), edge)?;
            }
        }
        self.report_lists(level);
        Ok(())
    }

    /// Reports lists that become no elements, such as floors and models.
    fn report_lists(&mut self, level: &Level<'_>) {
        let mut seen = HashSet::new();
        let lists = level.content.entries();
        let lists = lists.filter(|(key, node)| !MAPPED.contains(key) && node.items().len() > 0);
        for (key, _) in lists.filter(|(key, _)| seen.insert(*key)) {
            let at: PlaceFn<'_> = &|| level.place(key);
            let message = || format!("{key}: {}", level.count(key));
            let remedy = "They are left out; Guideway draws vertices, lanes, walls, doors and \
                          lifts only";
            let builder = &mut self.reader.builder;
            builder.report(Code::NotDrawn, at, message, remedy);
        }
    }

    /// Maps the properties of the site as a whole.
    pub(super) fn map_properties(&mut self, root: YamlNode<'y>) -> Result<(), ReadError> {
        const MAPPED: [&str; 5] = ["levels", "lifts", "doors", "name", "building_name"];
        let entries = root.entries().filter(|(key, _)| !MAPPED.contains(key));
        let at: PlaceFn<'_> = &|| place("the root", root);
        let mut attributes = self.properties(entries, &OF_SITE, at)?;
        let name = root.get("building_name").or_else(|| root.get("name"));
        if let Some(name) = name.and_then(YamlNode::text) {
            self.reader.builder.check_text(name)?;
            attributes.set(0, "name", Value::Text(name));
        }
        self.reader.builder.layout.attributes = attributes;
        Ok(())
    }

    /// Returns entries as properties, those with other names than `known` in one object.
    fn properties(
        &mut self,
        entries: impl Iterator<Item = (&'y str, YamlNode<'y>)>,
        known: &[&str],
        at: PlaceFn<'_>,
    ) -> Result<Attributes, ReadError> {
        let max_bytes = self.reader.builder.source.options.limits.text_bytes;
        let (mut attributes, mut other) = (Attributes::default(), String::new());
        for (key, node) in entries {
            let is_nested = node.is_map() || node.is_list();
            let is_empty = match is_nested {
                true => node.items().len() == 0 && node.entries().next().is_none(),
                false => node.value().is_none_or(|value| value == Value::Text("")),
            };
            // Aliases could repeat a long text without end.
            if is_empty || other.len() > max_bytes {
                continue;
            }
            if !known.contains(&key) {
                let Some(json) = json(&mut self.reader, key, node, at) else {
                    continue;
                };
                let separator = if other.is_empty() { "{" } else { "," };
                other += &format!("{separator}{}:{json}", serde_json::Value::from(key));
                continue;
            }
            // The name of the reference image; people know it by its file.
            let file = node.get("filename").filter(|_| node.entries().count() == 1);
            let node = file.unwrap_or(node);
            if let Some(value) = node.value() {
                if let Value::Text(text) = value {
                    self.reader.builder.check_text(text)?;
                }
                attributes.set(0, key, value);
            } else if let Some(json) = json(&mut self.reader, key, node, at) {
                attributes.set(0, key, Value::Json(&json));
            }
        }
        if other.len() > max_bytes {
            let message = || "the file has too many properties of its own".to_owned();
            let remedy = "They are left out, because they are too long for a text";
            let builder = &mut self.reader.builder;
            builder.report(Code::Attribute, at, message, remedy);
        } else if !other.is_empty() {
            other.push('}');
            attributes.set(0, "other", Value::Json(&other));
        }
        Ok(attributes)
    }
}
