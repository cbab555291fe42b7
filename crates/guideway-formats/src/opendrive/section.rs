//! Maps a lane section: cuts it into offset segments, fits them, and appends a path per lane.

use guideway_layout::{Code, Direction, NewPath, Quantity, Value};
use guideway_spline::Runs;
use roxmltree::Node;

use super::geometry::Geometry;
use super::lanes::{Lane, LaneSection};
use super::offset_fit::OffsetSegment;
use super::polynomial::Piecewise;
use super::reader::DocumentReader;
use super::speed::{RoadTypes, SpeedLimit, lane_limit};
use crate::ReadError;
use crate::builder::Table;

/// Shorter segments are rounding errors of the tool that wrote the file, in meters.
const MIN_SEGMENT_M: f64 = 1e-9;

/// Least width of a lane that is not reported, in meters: lanes that end may miss 0 by rounding.
const MIN_WIDTH_M: f64 = -0.01;

/// A road without its lane sections.
pub(super) struct Road<'d, 't> {
    node: Node<'d, 't>,
    id: &'d str,
    /// The geometry line, sorted by start.
    geometries: Vec<Geometry>,
    /// Left offset of lane 0.
    lane_offsets: Piecewise,
    /// Sorted places along the road at which a geometry or a lane offset begins or ends.
    cuts: Vec<f64>,
    /// End of the geometry line.
    pub(super) end_m: f64,
    types: RoadTypes<'d, 't>,
    /// True if traffic keeps to the left.
    is_left_hand: bool,
}

impl<'d, 't> Road<'d, 't> {
    /// Makes a road of its geometry line, sorted by start.
    pub(super) fn new(
        node: Node<'d, 't>,
        id: &'d str,
        geometries: Vec<Geometry>,
        lane_offsets: Piecewise,
    ) -> Self {
        let lines = geometries.iter();
        let ends = lines.flat_map(|line| [line.start_m, line.end_m()]);
        let mut cuts: Vec<f64> = ends.chain(lane_offsets.starts()).collect();
        cuts.sort_by(f64::total_cmp);
        let ends = geometries.iter().map(Geometry::end_m);
        Self {
            node,
            id,
            cuts,
            end_m: ends.fold(f64::NEG_INFINITY, f64::max),
            geometries,
            lane_offsets,
            types: RoadTypes::read(node),
            is_left_hand: node.attribute("rule") == Some("LHT"),
        }
    }

    /// The cuts from one place to another.
    fn cuts_in(&self, [start_m, end_m]: [f64; 2]) -> &[f64] {
        let from = self.cuts.partition_point(|cut| *cut < start_m);
        let to = self.cuts.partition_point(|cut| *cut <= end_m);
        self.cuts.get(from..to).unwrap_or_default()
    }

    /// The geometry beside a place.
    fn geometry_at(&self, s: f64) -> Option<&Geometry> {
        let after = self.geometries.partition_point(|line| line.start_m <= s);
        let line = &self.geometries[after.checked_sub(1)?];
        (s <= line.end_m()).then_some(line)
    }
}

/// Maps one section of a road.
pub(super) struct SectionMapper<'r, 'a, 'd, 't> {
    reader: &'r mut DocumentReader<'a, 'd, 't>,
    road: &'r Road<'d, 't>,
    index: usize,
    section: &'r LaneSection<'d, 't>,
    range_m: [f64; 2],
}

impl<'r, 'a, 'd, 't> SectionMapper<'r, 'a, 'd, 't> {
    /// Makes a mapper of the section with an index on a part of the road.
    pub(super) fn new(
        reader: &'r mut DocumentReader<'a, 'd, 't>,
        road: &'r Road<'d, 't>,
        index: usize,
        section: &'r LaneSection<'d, 't>,
        range_m: [f64; 2],
    ) -> Self {
        Self {
            reader,
            road,
            index,
            section,
            range_m,
        }
    }

    /// Appends a path per lane.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn map(mut self) -> Result<(), ReadError> {
        let segments = self.segments();
        let road_limit = self.road.types.limit(self.reader, self.range_m);
        for (lane, segments) in self.section.lanes.iter().zip(&segments) {
            self.reader.lane_count += 1;
            self.check_width(lane);
            if self.section.draws(lane) {
                self.map_lane(lane, segments, &road_limit)?;
            }
        }
        Ok(())
    }

    /// The segments of every lane.
    fn segments(&mut self) -> Vec<Vec<OffsetSegment<'r>>> {
        let [start_m, end_m] = self.range_m;
        let section = self.section;
        let mut cuts = vec![start_m, end_m];
        cuts.extend(self.road.cuts_in(self.range_m));
        cuts.extend(section.starts());
        cuts.retain(|&s| (start_m..=end_m).contains(&s));
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|b, a| *b - *a < MIN_SEGMENT_M);
        let mut segments = vec![Vec::new(); section.lanes.len()];
        // Every lane has a segment per cut, so cuts and lanes multiply: checks the budget first.
        let segment_count = (cuts.len() as u64).saturating_mul(section.lanes.len() as u64);
        if segment_count > self.reader.base.builder.points_left {
            self.reader.base.builder.points_left = 0;
            return segments;
        }
        for cut in cuts.windows(2) {
            let range_m = [cut[0], cut[1]];
            let Some(line) = self.road.geometry_at(0.5 * (cut[0] + cut[1])) else {
                continue;
            };
            let center_lane = self.road.lane_offsets.between(range_m);
            let offsets = section.center_offsets(center_lane, range_m);
            for (segments, offset) in segments.iter_mut().zip(offsets) {
                segments.push(OffsetSegment {
                    line,
                    start_m: cut[0] - line.start_m,
                    length_m: cut[1] - cut[0],
                    offset,
                });
            }
        }
        segments
    }

    /// Reports a lane without a width at its start or with a negative one.
    fn check_width(&mut self, lane: &Lane<'d, 't>) {
        let [start_m, end_m] = self.range_m;
        let first_m = lane.first_width();
        if let Some(first_m) = first_m.filter(|first| *first > start_m + MIN_SEGMENT_M) {
            let offset_m = first_m - start_m;
            let message = || format!("its first width is {offset_m} m after its start");
            let remedy = "It is drawn with width 0 up to there; give it a width at `sOffset` 0";
            self.reader
                .report(Code::MissingField, lane.node, message, remedy);
        }
        let least = lane.least_width(end_m);
        if let Some([place_m, width_m]) = least.filter(|[_, width]| *width < MIN_WIDTH_M) {
            let message = || format!("its width is {width_m:.3} m at s = {place_m:.3} m");
            let remedy = "It is drawn on the other side of its inner border; correct the width";
            self.reader
                .report(Code::Implausible, lane.node, message, remedy);
        }
    }

    fn map_lane(
        &mut self,
        lane: &Lane<'d, 't>,
        segments: &[OffsetSegment<'_>],
        road_limit: &SpeedLimit,
    ) -> Result<(), ReadError> {
        let road = self.road;
        let id = &format!("{}.{}.{}", road.id, self.index, lane.id);
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
            return self.reader.refuse(id, code, lane.node, &detail, remedy);
        }
        if error_m > tolerance_m {
            let message =
                || format!("the curve is drawn within {error_m} m, not within {tolerance_m} m");
            let remedy =
                "The geometry line has a cusp or a very tight bend there; check that it is right";
            self.reader
                .report(Code::ApproximateShape, lane.node, message, remedy);
        }
        // In right-hand traffic, left lanes (id > 0) lead against the geometry line.
        if (lane.id > 0) != road.is_left_hand && lane.id != 0 {
            runs = runs.reversed();
        }
        let row = self.reader.base.push_path(
            lane.node,
            &NewPath {
                id,
                runs: &runs,
                direction: match lane.id {
                    0 => Direction::Both,
                    _ => Direction::Forward,
                },
                ..NewPath::default()
            },
        )?;
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
        let limit = lane_limit(self.reader, lane.node).unwrap_or_else(|| road_limit.clone());
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
