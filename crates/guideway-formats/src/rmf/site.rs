//! Maps a site to a layout: decides kind and coordinates of the file, and maps its parts in order.

use guideway_layout::{Code, Layout, Place};

use super::frame::{Coordinates, frames};
use super::level::Level;
use super::lifts::map_lifts;
use super::reader::place;
use super::site_mapper::SiteMapper;
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::yaml::{Yaml, YamlNode};

/// Version of the format of a navigation graph, as the provenance of its layout states it.
pub(crate) const NAVIGATION_GRAPH: &str = "navigation graph";

impl<'a, 'y> SiteMapper<'a, 'y> {
    /// Maps the whole file and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(
        mut self,
        yaml: &'y Yaml<'y>,
        root: YamlNode<'y>,
        levels: YamlNode<'y>,
    ) -> Result<Layout, ReadError> {
        self.report_document(yaml);
        let all: Result<Vec<_>, _> = levels
            .entries()
            .map(|(name, content)| Level::read(&mut self.reader.builder, name, content))
            .collect();
        let levels = all?;
        let is_graph = is_graph(&levels, root);
        self.reader.is_graph = is_graph;
        let lifts = root.get("lifts").into_iter().flat_map(YamlNode::entries);
        self.lift_names = lifts.map(|(name, _)| name).collect();
        let coordinates = match is_graph {
            true => Coordinates::Meters,
            false => self.coordinates(root),
        };
        let name = root.get("reference_level_name").and_then(YamlNode::text);
        let reference = levels.iter().position(|level| Some(level.name) == name);
        if let (Some(named), None) = (root.get("reference_level_name"), reference) {
            let message = || format!("there is no level `{}`", name.unwrap_or(named.kind()));
            let at: PlaceFn<'_> = &|| place("reference_level_name", named);
            let remedy = "The first level is used; correct the name";
            self.reader
                .builder
                .report(Code::UnknownValue, at, message, remedy);
        }
        let reference = reference.unwrap_or(0);
        let frames = frames(&mut self.reader.builder, coordinates, &levels, reference);
        for (index, (level, frame)) in levels.iter().zip(&frames).enumerate() {
            self.map_level(index as u32, level, *frame)?;
        }
        self.map_graph_doors(root, &levels)?;
        self.map_properties(root)?;
        map_lifts(&mut self.reader, root, &levels, &frames, reference)?;
        self.count_elements(&levels, root, is_graph);
        Ok(self.reader.builder.layout)
    }

    /// Reports duplicate keys and further documents of the file.
    fn report_document(&mut self, yaml: &Yaml<'_>) {
        for (key, line) in &yaml.duplicate_keys {
            let at: PlaceFn<'_> = &|| Place::on_line("an object", *line);
            let message = || format!("the key `{key}` occurs more than once");
            let remedy = "The last value is used; remove the others";
            self.reader
                .builder
                .report(Code::DuplicateKey, at, message, remedy);
        }
        if let Some(line) = yaml.next_document {
            let at: PlaceFn<'_> = &|| Place::on_line("the next document", line);
            let message = || "the file contains more than one document".to_owned();
            let remedy = "Only the first one is read; split the file";
            self.reader
                .builder
                .report(Code::NotDrawn, at, message, remedy);
        }
    }

    /// The coordinate system of the file. Reports an unknown one.
    fn coordinates(&mut self, root: YamlNode<'_>) -> Coordinates {
        let Some(found) = root.get("coordinate_system") else {
            return Coordinates::Image;
        };
        match found.text() {
            Some("reference_image") => Coordinates::Image,
            Some("cartesian_meters") => Coordinates::Meters,
            Some("wgs84") => Coordinates::Degrees,
            Some("web_mercator") => Coordinates::Mercator,
            other => {
                let name = other.unwrap_or(found.kind());
                let at: PlaceFn<'_> = &|| place("coordinate_system", found);
                let message = || format!("unknown coordinate system `{name}`");
                let remedy = "Pixels of a floor plan are assumed; correct the name";
                self.reader
                    .builder
                    .report(Code::UnknownValue, at, message, remedy);
                Coordinates::Image
            }
        }
    }

    /// Sets the provenance: format, version and element counts.
    fn count_elements(&mut self, levels: &[Level<'_>], root: YamlNode<'_>, is_graph: bool) {
        const KEYS: [&str; 8] = [
            "vertices",
            "lanes",
            "human_lanes",
            "walls",
            "doors",
            "measurements",
            "floors",
            "models",
        ];
        let mut counts = vec![("levels".to_owned(), levels.len() as u64)];
        for key in KEYS.iter().chain(&["fiducials"]) {
            let count = levels.iter().map(|level| level.count(key)).sum();
            counts.push(((*key).to_owned(), count));
        }
        counts.push(("bidirectional".to_owned(), self.bidirectional));
        let graphs = self.graphs.iter();
        counts.extend(graphs.map(|(graph, count)| (format!("lanes of graph {graph}"), *count)));
        let lifts = root.get("lifts").map_or(0, |lifts| lifts.entries().count());
        counts.push(("lifts".to_owned(), lifts as u64));
        let provenance = &mut self.reader.builder.layout.provenance;
        crate::Format::Rmf.name().clone_into(&mut provenance.format);
        let version = if is_graph {
            NAVIGATION_GRAPH
        } else {
            "building"
        };
        version.clone_into(&mut provenance.format_version);
        provenance.counts = counts;
    }
}

/// Tells if the file is a navigation graph: the third value of its first vertex is parameters or
/// missing. In a building it is a height. Without vertices, the key of the name decides.
fn is_graph(levels: &[Level<'_>], root: YamlNode<'_>) -> bool {
    let vertices = levels
        .iter()
        .filter_map(|level| level.content.get("vertices"));
    let mut third = vertices
        .flat_map(YamlNode::items)
        .map(|vertex| vertex.item(2));
    match third.next() {
        Some(item) => item.is_none_or(YamlNode::is_map),
        None => root.get("building_name").is_some(),
    }
}
