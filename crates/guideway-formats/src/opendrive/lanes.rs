//! Reads lane sections: `laneSection` elements in, the center offset of every lane out.
//!
//! ```text
//!   lane  2  -----------   outer border = inner border + width(s)
//!   lane  1  -----------   center = mean of inner and outer border
//!   lane  0  ===========   laneOffset(s) to the left of the geometry line
//!   lane -1  -----------
//! ```

use guideway_layout::Code;
use roxmltree::Node;

use super::polynomial::{Cubic, Piecewise};
use super::reader::{DocumentReader, start_m};
use crate::ReadError;
use crate::xml::{child, children};

/// One lane of a section.
pub(super) struct Lane<'d, 't> {
    pub(super) node: Node<'d, 't>,
    /// 0 for the center lane, rising to the left, falling to the right.
    pub(super) id: i64,
    /// Width by the distance along the road, in meters.
    widths: Piecewise,
    /// Offset of the outer border from lane 0, to the side of the lane, by the distance along the
    /// road; an alternative to widths.
    borders: Piecewise,
    /// True if its records have the sign of the other side.
    is_border_negative: bool,
}

impl Lane<'_, '_> {
    /// Side of the lane: 1 on the left, -1 on the right, 0 for the center lane.
    fn side(&self) -> f64 {
        self.id.signum() as f64
    }

    /// The place along the road at which its widths begin.
    pub(super) fn first_width(&self) -> Option<f64> {
        self.widths.starts().next()
    }

    /// The place along the road and the value of the least width up to a place.
    pub(super) fn least_width(&self, end_m: f64) -> Option<[f64; 2]> {
        self.widths.minimum(end_m)
    }
}

/// A part of a road with a constant set of lanes.
pub(super) struct LaneSection<'d, 't> {
    pub(super) start_m: f64,
    /// From the center outwards: first the left lanes, then the right ones.
    pub(super) lanes: Vec<Lane<'d, 't>>,
}

impl<'d, 't> LaneSection<'d, 't> {
    /// Reads a `laneSection` element.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(
        reader: &mut DocumentReader<'_, 'd, 't>,
        section: Node<'d, 't>,
    ) -> Result<Self, ReadError> {
        let start_m = reader.number(section, "s").unwrap_or_default();
        let mut lanes = Vec::new();
        for (side, sign) in [("left", 1), ("center", 0), ("right", -1)] {
            for node in children(section, side).flat_map(|side| children(side, "lane")) {
                let id = node.attribute("id").and_then(|id| id.trim().parse().ok());
                let Some(id) = id else {
                    reader.refuse_lane(node)?;
                    continue;
                };
                if i64::signum(id) != sign {
                    let message = || format!("the lane {id} stands in `{side}`");
                    let remedy =
                        "It is drawn on the side of its `id`; move it, or correct the `id`";
                    reader.report(Code::Implausible, node, message, remedy);
                }
                let records = |reader: &mut DocumentReader<'_, 'd, 't>, tag| {
                    let records = children(node, tag);
                    read_polynomials(reader, records, "sOffset", start_m)
                };
                let widths = records(reader, "width");
                let borders = records(reader, "border");
                let is_border_negative = borders.sign() < 0.0;
                if id != 0 && widths.is_empty() && borders.is_empty() {
                    let message = || "the lane has no `width` and no `border`".to_owned();
                    let remedy = "It is drawn with width 0; give it a width";
                    reader.report(Code::MissingField, node, message, remedy);
                }
                lanes.push(Lane {
                    node,
                    id,
                    widths,
                    borders,
                    is_border_negative,
                });
            }
        }
        lanes.sort_by_key(|lane: &Lane<'_, '_>| (lane.id < 0, lane.id.unsigned_abs()));
        let section = Self { start_m, lanes };
        section.check_ids(reader);
        section.check_borders(reader);
        section.check_widths_against_borders(reader);
        Ok(section)
    }

    /// Reports lanes whose identifier does not follow that of their inner neighbor.
    fn check_ids(&self, reader: &mut DocumentReader<'_, 'd, 't>) {
        let mut inner: i64 = 0;
        for lane in &self.lanes {
            let expected = match lane.id.signum() {
                0 => 0,
                side if side == inner.signum() => inner.saturating_add(side),
                side => side,
            };
            if lane.id != expected {
                let message = || format!("its `id` is {}, expected {expected}", lane.id);
                let remedy = "It is drawn beside its neighbor; number lanes from 0 outwards";
                reader.report(Code::Implausible, lane.node, message, remedy);
            }
            inner = lane.id;
        }
    }

    /// Reports borders that contradict the side of their lane. Right lanes may state them as
    /// offsets to the left, which are negative, or as distances.
    fn check_borders(&self, reader: &mut DocumentReader<'_, 'd, 't>) {
        let first_right = self
            .lanes
            .iter()
            .find(|lane| lane.id < 0 && !lane.borders.is_empty());
        let is_right_negative = first_right.is_some_and(|lane| lane.is_border_negative);
        for lane in self.lanes.iter().filter(|lane| !lane.borders.is_empty()) {
            let is_expected = lane.is_border_negative == (lane.id < 0 && is_right_negative);
            if !is_expected {
                let message = || "the sign of its border is that of the other side".to_owned();
                let remedy = "It is drawn on the side of its `id`; correct the border or the `id`";
                reader.report(Code::Implausible, lane.node, message, remedy);
            }
        }
    }

    /// Reports lanes whose border is not where their widths end, at the start of the section.
    fn check_widths_against_borders(&self, reader: &mut DocumentReader<'_, 'd, 't>) {
        /// Files round to centimeters.
        const TOLERANCE_M: f64 = 0.02;
        let (mut outer_m, mut side) = (0.0, 0.0);
        for lane in &self.lanes {
            let at_start = |records: &Piecewise| records.between([self.start_m; 2]).a;
            if lane.side() != side {
                (outer_m, side) = (0.0, lane.side());
            }
            let border_m = at_start(&lane.borders).abs();
            if lane.widths.is_empty() {
                outer_m = border_m;
                continue;
            }
            outer_m += at_start(&lane.widths);
            if !lane.borders.is_empty() && (border_m - outer_m).abs() > TOLERANCE_M {
                let message = || {
                    format!("its border is {border_m} m from lane 0, its widths end at {outer_m} m")
                };
                let remedy = "Its widths count; remove the border or correct one of both";
                reader.report(Code::Implausible, lane.node, message, remedy);
            }
        }
    }

    /// Start of every polynomial of its lanes.
    pub(super) fn starts(&self) -> impl Iterator<Item = f64> {
        let lanes = self.lanes.iter();
        lanes.flat_map(|lane| lane.widths.starts().chain(lane.borders.starts()))
    }

    /// Tells if a lane is drawn. The center lane has no width; it stands for a road without other
    /// lanes.
    pub(super) fn draws(&self, lane: &Lane<'_, '_>) -> bool {
        lane.id != 0 || self.lanes.len() == 1
    }

    /// The left offset of the center of every lane between two places, as polynomials about the
    /// first place. `center_lane` is the offset of lane 0.
    pub(super) fn center_offsets(&self, center_lane: Cubic, range_m: [f64; 2]) -> Vec<Cubic> {
        let (mut inner, mut side) = (center_lane, 0.0);
        let center = |lane: &Lane<'_, '_>| {
            if lane.side() != side {
                (inner, side) = (center_lane, lane.side());
            }
            if lane.id == 0 {
                return center_lane;
            }
            let outer = match lane.widths.is_empty() {
                true => {
                    let sign = if lane.is_border_negative { -1.0 } else { 1.0 };
                    center_lane.plus(lane.borders.between(range_m), sign * side)
                }
                false => inner.plus(lane.widths.between(range_m), side),
            };
            let center = Cubic::default().plus(inner, 0.5).plus(outer, 0.5);
            inner = outer;
            center
        };
        self.lanes.iter().map(center).collect()
    }
}

/// The left offset of lane 0 from the geometry line, by the distance along the road.
pub(super) fn read_lane_offset<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    lanes: Option<Node<'d, 't>>,
) -> Piecewise {
    let records = lanes
        .into_iter()
        .flat_map(|lanes| children(lanes, "laneOffset"));
    read_polynomials(reader, records, "s", 0.0)
}

/// The order of elements along a road.
#[derive(Default)]
pub(super) struct Order {
    /// Start of the last element.
    last_m: Option<f64>,
}

impl Order {
    /// Reports an element that begins, by the attribute `key`, before the one ahead of it.
    pub(super) fn check<'d, 't>(
        &mut self,
        reader: &mut DocumentReader<'_, 'd, 't>,
        node: Node<'d, 't>,
        (key, start_m): (&str, f64),
    ) {
        let last_m = self.last_m.replace(start_m);
        if let Some(last_m) = last_m.filter(|last_m| start_m < *last_m) {
            let message = || {
                let tag = node.tag_name().name();
                format!("<{tag}> begins at {key} = {start_m}, after one that begins at {last_m}")
            };
            let remedy = "The order of the starts counts; sort the elements by it";
            reader.report(Code::Implausible, node, message, remedy);
        }
    }
}

/// Reads polynomials from elements with a start attribute `key` and the coefficients a to d. Skips
/// incomplete ones.
fn read_polynomials<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    records: impl Iterator<Item = Node<'d, 't>>,
    key: &'static str,
    start_m: f64,
) -> Piecewise {
    let mut pieces: Vec<(f64, Cubic)> = Vec::new();
    let mut order = Order::default();
    for record in records {
        let offset = reader.number(record, key);
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|key| reader.number(record, key));
        if let (Some(offset), Some(a), Some(b), Some(c), Some(d)) = (offset, a, b, c, d) {
            let (start, cubic) = (start_m + offset, Cubic { a, b, c, d });
            order.check(reader, record, (key, offset));
            let before = pieces.last();
            if before.is_some_and(|(at, other)| *at == start && *other != cubic) {
                let message = || format!("a second record begins at {key} = {offset}");
                let remedy = "The last one counts; remove the others";
                reader.report(Code::Implausible, record, message, remedy);
            }
            pieces.push((start, cubic));
        }
    }
    Piecewise::new(pieces)
}

/// Reads the lane sections of a road, sorted by their start.
///
/// # Errors
/// When the layout exceeds a limit, or when the caller cancels.
pub(super) fn read_lane_sections<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    road: Node<'d, 't>,
) -> Result<Vec<LaneSection<'d, 't>>, ReadError> {
    let lanes = child(road, "lanes").into_iter();
    let sections = lanes.flat_map(|lanes| children(lanes, "laneSection"));
    let mut sections: Vec<Node<'d, 't>> = sections.collect();
    let mut order = Order::default();
    for section in &sections {
        order.check(reader, *section, ("s", start_m(*section)));
    }
    sections.sort_by(|a, b| start_m(*a).total_cmp(&start_m(*b)));
    reader.set_sections(&sections);
    let read = sections.into_iter();
    read.map(|section| LaneSection::read(reader, section))
        .collect()
}
