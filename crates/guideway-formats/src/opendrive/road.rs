//! Maps roads to a layout: reads their geometry line and lane sections, and checks their lengths.

use guideway_layout::{Code, Layout, Place};
use roxmltree::Node;

use super::geometry::Geometry;
use super::lanes::{Order, read_lane_offset, read_lane_sections};
use super::plan_view::read_geometry;
use super::reader::DocumentReader;
use super::section::{Road, SectionMapper};
use crate::ReadError;
use crate::builder::PlaceFn;
use crate::source::Source;
use crate::xml::{Xml, child, children};

/// Differences of lengths that are reported, in meters. Tools round to millimeters and centimeters.
const MAX_LENGTH_ERROR_M: f64 = 0.05;

/// Lists and elements that are counted but not drawn.
const NOT_DRAWN: [(&str, &str); 4] = [
    ("objects", "object"),
    ("signals", "signal"),
    ("objects", "bridge"),
    ("objects", "tunnel"),
];

/// Fills a layout from roads.
pub(super) struct RoadMapper<'a, 'd, 't> {
    reader: DocumentReader<'a, 'd, 't>,
}

impl<'a, 'd, 't> RoadMapper<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            reader: DocumentReader::new(source, xml, file_bytes),
        }
    }

    /// Maps all roads and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(mut self, root: Node<'d, 't>) -> Result<Layout, ReadError> {
        let roads = || children(root, "road");
        for road in roads() {
            self.map_road(road)?;
        }
        self.reader.base.refuse_includes()?;
        for (list, tag) in NOT_DRAWN {
            let lists = roads().flat_map(|road| children(road, list));
            let count = lists.flat_map(|list| children(list, tag)).count();
            if count > 0 {
                let at: PlaceFn<'_> = &|| Place::element(list);
                let remedy = "They are left out; Guideway draws the lanes of roads only";
                let message = || format!("<{tag}> elements: {count}");
                self.reader
                    .base
                    .builder
                    .report(Code::NotDrawn, at, message, remedy);
            }
        }
        let header = child(root, "header");
        let revision = |key| header.and_then(|h| h.attribute(key)).unwrap_or("?");
        let version = format!("{}.{}", revision("revMajor"), revision("revMinor"));
        let provenance = &mut self.reader.base.builder.layout.provenance;
        crate::Format::OpenDrive
            .name()
            .clone_into(&mut provenance.format);
        provenance.format_version = version.chars().take(16).collect();
        let mut counts = vec![
            ("roads", roads().count() as u64),
            ("junctions", children(root, "junction").count() as u64),
            ("lanes", self.reader.lane_count),
        ];
        counts.extend(self.reader.shape_counts);
        let counts = counts
            .into_iter()
            .map(|(name, count)| (name.to_owned(), count));
        provenance.counts = counts.collect();
        Ok(self.reader.base.builder.layout)
    }

    fn map_road(&mut self, node: Node<'d, 't>) -> Result<(), ReadError> {
        let id = node.attribute("id").unwrap_or_default();
        self.reader.base.builder.check_text(id)?;
        let (mut geometries, mut is_complete) = (Vec::new(), true);
        let plan = children(node, "planView");
        let mut order = Order::default();
        for geometry in plan.flat_map(|plan| children(plan, "geometry")) {
            let read = read_geometry(&mut self.reader, geometry);
            is_complete &= read.is_some();
            if let Some(read) = &read {
                order.check(&mut self.reader, geometry, ("s", read.start_m));
            }
            geometries.extend(read);
        }
        geometries.sort_by(|a: &Geometry, b| a.start_m.total_cmp(&b.start_m));
        let lane_offsets = read_lane_offset(&mut self.reader, child(node, "lanes"));
        let sections = read_lane_sections(&mut self.reader, node)?;
        if sections.is_empty() {
            let message = || "the road has no lanes".to_owned();
            let remedy = "Give it a lane section";
            self.reader.report(Code::NotDrawn, node, message, remedy);
        }
        // A geometry that is left out has a finding of its own.
        if is_complete {
            check_lengths(&mut self.reader, node, &geometries);
        }
        let road = Road::new(node, id, geometries, lane_offsets);
        let ends = sections.iter().skip(1).map(|next| next.start_m);
        let ends = ends.chain([road.end_m]);
        for (index, (section, end_m)) in sections.iter().zip(ends).enumerate() {
            let range_m = [section.start_m, end_m.min(road.end_m)];
            SectionMapper::new(&mut self.reader, &road, index, section, range_m).map()?;
        }
        Ok(())
    }
}

/// Reports a road whose length is not that of its geometry line, and gaps and overlaps along it.
fn check_lengths<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    road: Node<'d, 't>,
    geometries: &[Geometry],
) {
    let length_m = match road.has_attribute("length") {
        true => reader.number(road, "length"),
        false => None,
    };
    let mut end_m = 0.0_f64;
    let mut found = Vec::new();
    for geometry in geometries {
        let (start_m, gap_m) = (geometry.start_m, geometry.start_m - end_m);
        if gap_m > MAX_LENGTH_ERROR_M {
            found.push(format!(
                "its geometry has a gap from s = {end_m} m to {start_m} m"
            ));
        } else if gap_m < -MAX_LENGTH_ERROR_M {
            found.push(format!(
                "its geometry overlaps from s = {start_m} m to {end_m} m"
            ));
        }
        end_m = end_m.max(geometry.end_m());
    }
    if let Some(length_m) = length_m.filter(|length| (length - end_m).abs() > MAX_LENGTH_ERROR_M)
        && !geometries.is_empty()
    {
        found.push(format!(
            "its length is {length_m} m; its geometry ends at s = {end_m} m"
        ));
    }
    for message in found {
        let remedy = "It is drawn along its geometry; correct `length` and `s`";
        reader.report(Code::Implausible, road, || message, remedy);
    }
}
