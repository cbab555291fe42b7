//! Maps roads to a layout: cuts every lane section into offset segments, fits them, and appends a
//! path per lane.

use guideway_layout::{Code, Direction, Layout, NewPath, Place, Quantity, Value};
use guideway_spline::{Point, Runs};
use roxmltree::Node;

use super::geometry::Geometry;
use super::lanes::{Lane, LaneSection, read_lane_offset, read_lane_sections};
use super::offset_fit::OffsetSegment;
use super::plan_view::read_geometry;
use super::polynomial::Piecewise;
use super::reader::DocumentReader;
use super::speed::{SpeedLimit, speed_limit};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::source::Source;
use crate::xml::{Xml, child, children};

/// Shorter segments are rounding errors of the tool that wrote the file, in meters.
const MIN_SEGMENT_M: f64 = 1e-9;

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

/// A road without its lanes.
struct Road<'d, 't> {
    node: Node<'d, 't>,
    id: &'d str,
    /// The geometry line, sorted by start.
    geometries: Vec<Geometry>,
    /// Left offset of lane 0.
    lane_offsets: Piecewise,
    /// Whether traffic keeps to the left.
    is_left_hand: bool,
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
        let mut geometries = Vec::new();
        let plan = children(node, "planView");
        for geometry in plan.flat_map(|plan| children(plan, "geometry")) {
            geometries.extend(read_geometry(&mut self.reader, geometry));
        }
        geometries.sort_by(|a: &Geometry, b| a.start_m.total_cmp(&b.start_m));
        let lane_offsets = read_lane_offset(&mut self.reader, child(node, "lanes"));
        let read_lane_sections = read_lane_sections(&mut self.reader, node)?;
        let road = Road {
            node,
            id,
            geometries,
            lane_offsets,
            is_left_hand: node.attribute("rule") == Some("LHT"),
        };
        if read_lane_sections.is_empty() {
            let message = || "the road has no lanes".to_owned();
            self.reader
                .base
                .report(Code::NotDrawn, node, message, "Give it a lane section");
        }
        let ends = read_lane_sections.iter().skip(1).map(|next| next.start_m);
        let road_end_m = road
            .geometries
            .iter()
            .map(Geometry::end_m)
            .fold(f64::NEG_INFINITY, f64::max);
        for (index, (section, end_m)) in read_lane_sections
            .iter()
            .zip(ends.chain([road_end_m]))
            .enumerate()
        {
            self.map_section(&road, index, section, end_m.min(road_end_m))?;
        }
        Ok(())
    }

    fn map_section(
        &mut self,
        road: &Road<'d, 't>,
        index: usize,
        section: &LaneSection<'d, 't>,
        end_m: f64,
    ) -> Result<(), ReadError> {
        let mut cuts = vec![section.start_m, end_m];
        let geometries = road.geometries.iter();
        cuts.extend(geometries.flat_map(|geometry| [geometry.start_m, geometry.end_m()]));
        cuts.extend(road.lane_offsets.starts().chain(section.starts()));
        cuts.retain(|&s| (section.start_m..=end_m).contains(&s));
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < MIN_SEGMENT_M);
        // Every lane has a segment per cut, so cuts and lanes multiply: checks the budget first.
        let segment_count = (cuts.len() as u64).saturating_mul(section.lanes.len() as u64);
        let mut segments: Vec<Vec<OffsetSegment<'_>>> = vec![Vec::new(); section.lanes.len()];
        if segment_count <= self.reader.base.builder.points_left {
            for cut in cuts.windows(2) {
                let middle_m = 0.5 * (cut[0] + cut[1]);
                let geometries = &road.geometries;
                let after = geometries.partition_point(|line| line.start_m <= middle_m);
                let line = after.checked_sub(1).map(|i| &geometries[i]);
                let Some(line) = line.filter(|line| middle_m <= line.end_m()) else {
                    continue;
                };
                let center_lane = road.lane_offsets.from(cut[0]);
                let center_offsets = section.center_offsets(center_lane, cut[0]);
                for (segments, offset) in segments.iter_mut().zip(center_offsets) {
                    segments.push(OffsetSegment {
                        line,
                        start_m: cut[0] - line.start_m,
                        length_m: cut[1] - cut[0],
                        offset,
                    });
                }
            }
        } else {
            self.reader.base.builder.points_left = 0;
        }
        for (lane, segments) in section.lanes.iter().zip(&segments) {
            self.reader.lane_count += 1;
            if section.draws(lane) {
                let id = format!("{}.{index}.{}", road.id, lane.id);
                self.map_lane(road, &id, lane, segments, [section.start_m, end_m])?;
            }
        }
        Ok(())
    }

    fn map_lane(
        &mut self,
        road: &Road<'d, 't>,
        id: &str,
        lane: &Lane<'d, 't>,
        segments: &[OffsetSegment<'_>],
        range_m: [f64; 2],
    ) -> Result<(), ReadError> {
        let mut runs = Runs::default();
        let tolerance_m = self
            .reader
            .base
            .builder
            .source
            .options
            .limits
            .conversion_tolerance_m;
        let mut error_m = 0.0_f64;
        for segment in segments {
            let max_points = self.reader.base.builder.points_left;
            error_m = error_m.max(segment.append(tolerance_m, max_points, &mut runs));
            if runs.points().len() as u64 > max_points {
                break;
            }
        }
        let builder = &mut self.reader.base.builder;
        let refused = if !builder.within_point_budget(&runs) {
            Some((Code::Implausible, builder.point_budget_exceeded()))
        } else if runs.is_empty() {
            Some((
                Code::MissingField,
                "the road has no geometry line beside it".to_owned(),
            ))
        } else if !runs.points().iter().all(|p| p.is_finite()) {
            Some((
                Code::NonFinite,
                "the geometry line has a point without a direction, or its numbers overflow"
                    .to_owned(),
            ))
        } else if !builder.within_coordinate_limit(&runs) {
            Some((
                Code::OutOfRange,
                "it exceeds the largest allowed coordinate".to_owned(),
            ))
        } else {
            None
        };
        if let Some((code, detail)) = refused {
            let remedy = "It is left out; correct the road in the tool that wrote the file";
            let base = &mut self.reader.base;
            return base.refuse(id, code, lane.node, &detail, remedy);
        }
        if error_m > tolerance_m {
            let message =
                || format!("the curve is drawn within {error_m} m, not within {tolerance_m} m");
            let remedy =
                "The geometry line has a cusp or a very tight bend there; check that it is right";
            self.reader
                .base
                .report(Code::ApproximateShape, lane.node, message, remedy);
        }
        // In right-hand traffic, left lanes (id > 0) lead against the geometry line.
        if (lane.id > 0) != road.is_left_hand && lane.id != 0 {
            runs = reversed(&runs);
        }
        let row = self.reader.base.builder.push_path(&NewPath {
            id,
            runs: &runs,
            direction: match lane.id {
                0 => Direction::Both,
                _ => Direction::Forward,
            },
            ..NewPath::default()
        })?;
        let kind = lane.node.attribute("type").unwrap_or("none");
        for (name, value) in [
            ("type", Some(kind)),
            ("road", road.node.attribute("name")),
            (
                "junction",
                road.node.attribute("junction").filter(|&j| j != "-1"),
            ),
        ] {
            if let Some(value) = value.filter(|value| !value.is_empty()) {
                self.reader.base.builder.check_text(value)?;
                self.reader
                    .base
                    .builder
                    .set(Table::Paths, row, name, Value::Text(value))?;
            }
        }
        let limit = speed_limit(&mut self.reader, road.node, lane.node, range_m);
        let builder = &mut self.reader.base.builder;
        match limit {
            SpeedLimit::Unlimited => Ok(()),
            SpeedLimit::MetersPerSecond(speed) => {
                let attributes = builder.attributes(Table::Paths);
                attributes.set_quantity(row, "maxSpeed", speed, Quantity::Speed);
                Ok(())
            }
            SpeedLimit::Unknown(text) => {
                builder.set(Table::Paths, row, "speed", Value::Text(&text))
            }
        }
    }
}

/// The same curve in the opposite direction.
fn reversed(runs: &Runs) -> Runs {
    let mut reversed = Runs::default();
    let all: Vec<&[Point<f64>]> = runs.iter().collect();
    for run in all.into_iter().rev() {
        let points: Vec<Point<f64>> = run.iter().rev().copied().collect();
        reversed.push(&points);
    }
    reversed
}
