//! Lane sections: where the center of every lane is beside the reference line.

use guideway_layout::Code;
use roxmltree::Node;

use super::polynomial::{Cubic, Piecewise};
use super::road::Mapper;
use crate::ReadError;
use crate::xml::{child, children};

/// One lane of a section.
pub(super) struct Lane<'d, 't> {
    pub(super) node: Node<'d, 't>,
    /// 0 in the middle, rising to the left, falling to the right.
    pub(super) id: i64,
    /// By the distance along the road.
    widths: Piecewise,
    /// Distances of the outer border instead of widths.
    borders: Piecewise,
}

/// A stretch of a road with the same lanes.
pub(super) struct Section<'d, 't> {
    pub(super) start_m: f64,
    /// From the middle outwards: first those to the left, then those to the right.
    pub(super) lanes: Vec<Lane<'d, 't>>,
}

impl<'d, 't> Section<'d, 't> {
    pub(super) fn read(
        mapper: &mut Mapper<'_, 'd, 't>,
        section: Node<'d, 't>,
    ) -> Result<Self, ReadError> {
        let start_m = mapper.number(section, "s").unwrap_or(0.0);
        let mut lanes = Vec::new();
        for side in ["left", "center", "right"] {
            for node in children(section, side).flat_map(|side| children(side, "lane")) {
                let id = node.attribute("id").and_then(|id| id.trim().parse().ok());
                let Some(id) = id else {
                    mapper.refuse_lane(node, "it has no whole number as its `id`")?;
                    continue;
                };
                let records = |mapper: &mut Mapper<'_, 'd, 't>, tag| {
                    let records = children(node, tag);
                    records_of(mapper, records, "sOffset", start_m)
                };
                let widths = records(mapper, "width");
                let borders = records(mapper, "border");
                if id != 0 && widths.is_empty() && borders.is_empty() {
                    let message = || "there is no width".to_owned();
                    let remedy = "It is drawn without width; give it a width";
                    mapper.report(Code::MissingField, node, message, remedy);
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

    /// Where the polynomials of its lanes begin.
    pub(super) fn starts(&self) -> impl Iterator<Item = f64> {
        let lanes = self.lanes.iter();
        lanes.flat_map(|lane| lane.widths.starts().chain(lane.borders.starts()))
    }

    /// Whether a lane is drawn: the one in the middle has no width, and shows only a road that has no other.
    pub(super) fn shows(&self, lane: &Lane<'_, '_>) -> bool {
        lane.id != 0 || self.lanes.len() == 1
    }

    /// The offset of the center of every lane to the left, as polynomials about s that hold from there on.
    pub(super) fn centers(&self, middle: Cubic, s: f64) -> Vec<Cubic> {
        let (mut inner, mut side) = (middle, 0);
        let center = |lane: &Lane<'_, '_>| {
            if lane.id.signum() != side {
                (inner, side) = (middle, lane.id.signum());
            }
            if lane.id == 0 {
                return middle;
            }
            let sign = side as f64;
            let outer = match lane.widths.is_empty() {
                true => middle.plus(lane.borders.from(s), sign),
                false => inner.plus(lane.widths.from(s), sign),
            };
            let center = Cubic::default().plus(inner, 0.5).plus(outer, 0.5);
            inner = outer;
            center
        };
        self.lanes.iter().map(center).collect()
    }
}

/// The offset of the middle of a road from its reference line.
pub(super) fn offsets<'d, 't>(
    mapper: &mut Mapper<'_, 'd, 't>,
    lanes: Option<Node<'d, 't>>,
) -> Piecewise {
    let records = lanes
        .into_iter()
        .flat_map(|lanes| children(lanes, "laneOffset"));
    records_of(mapper, records, "s", 0.0)
}

fn records_of<'d, 't>(
    mapper: &mut Mapper<'_, 'd, 't>,
    records: impl Iterator<Item = Node<'d, 't>>,
    key: &'static str,
    start_m: f64,
) -> Piecewise {
    let mut pieces = Vec::new();
    for record in records {
        let offset = mapper.number(record, key);
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|key| mapper.number(record, key));
        if let (Some(offset), Some(a), Some(b), Some(c), Some(d)) = (offset, a, b, c, d) {
            pieces.push((start_m + offset, Cubic { a, b, c, d }));
        }
    }
    Piecewise::new(pieces)
}

/// The lane sections of a road.
pub(super) fn sections<'d, 't>(
    mapper: &mut Mapper<'_, 'd, 't>,
    road: Node<'d, 't>,
) -> Result<Vec<Section<'d, 't>>, ReadError> {
    let lanes = child(road, "lanes");
    let sections = lanes
        .into_iter()
        .flat_map(|lanes| children(lanes, "laneSection"));
    let read: Result<Vec<_>, _> = sections
        .map(|section| Section::read(mapper, section))
        .collect();
    let mut sections = read?;
    sections.sort_by(|a, b| a.start_m.total_cmp(&b.start_m));
    Ok(sections)
}
