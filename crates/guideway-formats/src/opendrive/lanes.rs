//! Reads lane read_lane_sections: `laneSection` elements in, the center offset of every lane out.
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
use super::reader::DocumentReader;
use crate::ReadError;
use crate::xml::{child, children};

/// One lane of a section.
pub(super) struct Lane<'d, 't> {
    pub(super) node: Node<'d, 't>,
    /// 0 for the center lane, rising to the left, falling to the right.
    pub(super) id: i64,
    /// Width by the distance along the road, in meters.
    widths: Piecewise,
    /// Offset of the outer border by the distance along the road; an alternative to widths.
    borders: Piecewise,
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
        let start_m = reader.number(section, "s").unwrap_or(0.0);
        let mut lanes = Vec::new();
        for side in ["left", "center", "right"] {
            for node in children(section, side).flat_map(|side| children(side, "lane")) {
                let id = node.attribute("id").and_then(|id| id.trim().parse().ok());
                let Some(id) = id else {
                    reader.refuse_lane(node)?;
                    continue;
                };
                let records = |reader: &mut DocumentReader<'_, 'd, 't>, tag| {
                    let records = children(node, tag);
                    read_polynomials(reader, records, "sOffset", start_m)
                };
                let widths = records(reader, "width");
                let borders = records(reader, "border");
                if id != 0 && widths.is_empty() && borders.is_empty() {
                    let message = || "the lane has no `width` and no `border`".to_owned();
                    let remedy = "It is drawn with width 0; give it a width";
                    reader
                        .base
                        .report(Code::MissingField, node, message, remedy);
                }
                lanes.push(Lane {
                    node,
                    id,
                    widths,
                    borders,
                });
            }
        }
        lanes.sort_by_key(|lane: &Lane<'_, '_>| (lane.id < 0, lane.id.unsigned_abs()));
        Ok(Self { start_m, lanes })
    }

    /// Start of every polynomial of its lanes.
    pub(super) fn starts(&self) -> impl Iterator<Item = f64> {
        let lanes = self.lanes.iter();
        lanes.flat_map(|lane| lane.widths.starts().chain(lane.borders.starts()))
    }

    /// Whether a lane is drawn. The center lane has no width; it stands for a road without other
    /// lanes.
    pub(super) fn draws(&self, lane: &Lane<'_, '_>) -> bool {
        lane.id != 0 || self.lanes.len() == 1
    }

    /// The left offset of the center of every lane, as polynomials about s, valid from s on.
    /// `center_lane` is the offset of lane 0.
    pub(super) fn center_offsets(&self, center_lane: Cubic, s: f64) -> Vec<Cubic> {
        let (mut inner, mut side) = (center_lane, 0);
        let center = |lane: &Lane<'_, '_>| {
            if lane.id.signum() != side {
                (inner, side) = (center_lane, lane.id.signum());
            }
            if lane.id == 0 {
                return center_lane;
            }
            let sign = side as f64;
            let outer = match lane.widths.is_empty() {
                true => center_lane.plus(lane.borders.from(s), sign),
                false => inner.plus(lane.widths.from(s), sign),
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

/// Reads polynomials from elements with a start attribute `key` and the coefficients a to d. Skips
/// incomplete ones.
fn read_polynomials<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    records: impl Iterator<Item = Node<'d, 't>>,
    key: &'static str,
    start_m: f64,
) -> Piecewise {
    let mut pieces = Vec::new();
    for record in records {
        let offset = reader.number(record, key);
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|key| reader.number(record, key));
        if let (Some(offset), Some(a), Some(b), Some(c), Some(d)) = (offset, a, b, c, d) {
            pieces.push((start_m + offset, Cubic { a, b, c, d }));
        }
    }
    Piecewise::new(pieces)
}

/// Reads the lane read_lane_sections of a road, sorted by their start.
///
/// # Errors
/// When the layout exceeds a limit, or when the caller cancels.
pub(super) fn read_lane_sections<'d, 't>(
    reader: &mut DocumentReader<'_, 'd, 't>,
    road: Node<'d, 't>,
) -> Result<Vec<LaneSection<'d, 't>>, ReadError> {
    let lanes = child(road, "lanes");
    let read_lane_sections = lanes
        .into_iter()
        .flat_map(|lanes| children(lanes, "laneSection"));
    let read: Result<Vec<_>, _> = read_lane_sections
        .map(|section| LaneSection::read(reader, section))
        .collect();
    let mut read_lane_sections = read?;
    read_lane_sections.sort_by(|a, b| a.start_m.total_cmp(&b.start_m));
    Ok(read_lane_sections)
}
