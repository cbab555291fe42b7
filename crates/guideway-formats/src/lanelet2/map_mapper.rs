//! Maps an OSM file to a layout: a path per way, and a path along the center line of each lanelet.

use std::collections::{BTreeMap, HashMap, HashSet};

use guideway_layout::{Code, Direction, Layout, NewPath, Place, Quantity, Value};
use guideway_spline::{Point, Runs, polyline_to_runs};
use roxmltree::{Node, NodeId};

use super::center::{align, center_line};
use super::osm::{is_deleted, positions, tag};
use crate::ReadError;
use crate::builder::{PlaceFn, Table};
use crate::source::Source;
use crate::speed_unit;
use crate::xml::{Xml, children};
use crate::xml_builder::XmlBuilder;

/// Tags that become columns, and types of relations that are counted; bounds both for a hostile
/// file.
const MAX_COLUMNS: usize = 64;

/// Tag of the speed limit.
const SPEED_LIMIT: &str = "speed_limit";

/// Unit of a speed limit without one, by the specification of the format.
const SPEED_UNIT: &str = "km/h";

/// The reason for a deleted element.
const DELETED: &str = "it is marked as deleted";

/// Fills a layout from a map.
pub(super) struct MapMapper<'a, 'd, 't> {
    base: XmlBuilder<'a, 'd, 't>,
    /// Position per node identifier, in meters.
    positions: HashMap<&'d str, Point<f64>>,
    ways: HashMap<&'d str, Node<'d, 't>>,
    /// Positions of the bounds that were read, which lanelets share.
    bounds: HashMap<NodeId, Vec<Point<f64>>>,
    /// Tags that have a column.
    columns: HashSet<&'d str>,
}

impl<'a, 'd, 't> MapMapper<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            base: XmlBuilder::new(source, xml, file_bytes),
            positions: HashMap::new(),
            ways: HashMap::new(),
            bounds: HashMap::new(),
            columns: HashSet::new(),
        }
    }

    /// Maps all ways and lanelets and returns the layout.
    ///
    /// # Errors
    /// When the layout exceeds a limit, or when the caller cancels.
    pub(super) fn read(mut self, root: Node<'d, 't>) -> Result<Layout, ReadError> {
        self.positions = positions(&mut self.base.builder, self.base.xml, root);
        self.base.refuse_includes()?;
        let mut counts = [("nodes", 0), ("ways", 0), ("lanelets", 0)];
        let mut relations: BTreeMap<&str, u64> = BTreeMap::new();
        for element in root.children().filter(Node::is_element) {
            let kind = match element.tag_name().name() {
                "node" => 0,
                "way" => 1,
                "relation" if is_lanelet(element) => 2,
                "relation" => {
                    let kind = tag(element, "type").unwrap_or("no type");
                    if relations.len() < MAX_COLUMNS || relations.contains_key(kind) {
                        *relations.entry(kind).or_insert(0) += 1;
                    }
                    continue;
                }
                _ => continue,
            };
            counts[kind].1 += 1;
            if let (1, Some(id)) = (kind, element.attribute("id")) {
                self.ways.insert(id, element);
            }
        }
        for way in children(root, "way") {
            self.map_way(way)?;
        }
        for lanelet in children(root, "relation").filter(|&relation| is_lanelet(relation)) {
            self.map_lanelet(lanelet)?;
        }
        for (kind, count) in &relations {
            let at: PlaceFn<'_> = &|| Place::element("relations");
            let message = || format!("relations of the unsupported type {kind}: {count}");
            let remedy = "They are left out but their ways are drawn; Guideway reads lanelets only";
            let builder = &mut self.base.builder;
            builder.report(Code::NotDrawn, at, message, remedy);
        }
        if counts[2].1 == 0 {
            let message = || "the map has no lanelet; only its ways are drawn".to_owned();
            let remedy = "If there should be lanelets, give their relations the tag type=lanelet";
            self.base.report(Code::Implausible, root, message, remedy);
        }
        let provenance = &mut self.base.builder.layout.provenance;
        crate::Format::Lanelet2
            .name()
            .clone_into(&mut provenance.format);
        provenance.format_version =
            crate::text::printable(root.attribute("version").unwrap_or_default());
        let counts = counts.into_iter().chain(relations);
        provenance.counts = counts
            .map(|(name, count)| (crate::text::printable(name), count))
            .collect();
        Ok(self.base.builder.layout)
    }

    fn map_way(&mut self, way: Node<'d, 't>) -> Result<(), ReadError> {
        if is_deleted(way) {
            return self.refuse(way, Code::NotDrawn, DELETED);
        }
        let points = self.points(way)?;
        let missing = children(way, "nd").count() - points.len();
        if missing > 0 {
            let message = || format!("{missing} of its nodes do not exist or have no position");
            let remedy = "It is drawn without them; save the whole map";
            self.base.report(Code::UnknownNode, way, message, remedy);
        }
        self.push_path(way, &points, "way", Direction::Both)
    }

    fn map_lanelet(&mut self, lanelet: Node<'d, 't>) -> Result<(), ReadError> {
        if is_deleted(lanelet) {
            return self.refuse(lanelet, Code::NotDrawn, DELETED);
        }
        let one_way = !matches!(tag(lanelet, "one_way"), Some("no" | "false"));
        let direction = if one_way {
            Direction::Forward
        } else {
            Direction::Both
        };
        self.check_roles(lanelet);
        // A center line in the file takes precedence.
        if let Some(drawn) = self.member(lanelet, "centerline") {
            let points = self.points(drawn)?;
            return self.push_path(lanelet, &points, "lanelet", direction);
        }
        let bounds = ["left", "right"].map(|role| self.member(lanelet, role));
        let [Some(left), Some(right)] = bounds else {
            let detail = "its left or right bound is not a way of the file";
            return self.refuse(lanelet, Code::UnknownNode, detail);
        };
        // Lanelets share bounds, and a million lanelets could each read the same long bounds: the
        // budget of control points pays for every read.
        if self.base.builder.points_left == 0 {
            let detail = self.base.builder.point_budget_exceeded();
            return self.refuse(lanelet, Code::Implausible, &detail);
        }
        let read = [left, right].map(|bound| children(bound, "nd").count() as u64);
        let points_left = self.base.builder.points_left.checked_sub(read[0] + read[1]);
        self.base.builder.points_left = points_left.unwrap_or(0);
        if points_left.is_none() {
            let detail = self.base.builder.point_budget_exceeded();
            return self.refuse(lanelet, Code::Implausible, &detail);
        }
        let (mut left, mut right) = (self.bound(left)?, self.bound(right)?);
        if left.is_empty() || right.is_empty() {
            return self.refuse(lanelet, Code::TooFewPoints, "a bound has no points");
        }
        align(&mut left, &mut right);
        let center = center_line(&left, &right);
        self.push_path(lanelet, &center, "lanelet", direction)
    }

    /// Reports roles that several ways of a lanelet have.
    fn check_roles(&mut self, lanelet: Node<'d, 't>) {
        for role in ["left", "right", "centerline"] {
            let ways = children(lanelet, "member").filter(|member| {
                member.attribute("role") == Some(role) && member.attribute("type") == Some("way")
            });
            let count = ways.count();
            if count > 1 {
                let message = || format!("{count} of its ways have the role `{role}`");
                let remedy = "Only the first one is read; join them to one way";
                self.base
                    .report(Code::UnknownValue, lanelet, message, remedy);
            }
        }
    }

    /// The way with a role in a relation.
    fn member(&self, relation: Node<'d, 't>, role: &str) -> Option<Node<'d, 't>> {
        let mut members = children(relation, "member");
        let member = members
            .find(|m| m.attribute("role") == Some(role) && m.attribute("type") == Some("way"))?;
        self.ways.get(member.attribute("ref")?).copied()
    }

    /// The positions of the nodes of a way, without those of missing nodes.
    fn points(&mut self, way: Node<'d, 't>) -> Result<Vec<Point<f64>>, ReadError> {
        let references = || children(way, "nd").map(|nd| nd.attribute("ref").unwrap_or_default());
        let points: Vec<_> = references()
            .filter_map(|id| self.positions.get(id).copied())
            .collect();
        self.base.builder.check_curve_points(points.len())?;
        Ok(points)
    }

    /// The positions of a bound, which is looked up node by node once.
    fn bound(&mut self, way: Node<'d, 't>) -> Result<Vec<Point<f64>>, ReadError> {
        if let Some(points) = self.bounds.get(&way.id()) {
            return Ok(points.clone());
        }
        let points = self.points(way)?;
        self.bounds.insert(way.id(), points.clone());
        Ok(points)
    }

    fn push_path(
        &mut self,
        element: Node<'d, 't>,
        points: &[Point<f64>],
        kind: &str,
        direction: Direction,
    ) -> Result<(), ReadError> {
        let mut runs = Runs::default();
        polyline_to_runs(points, &mut runs);
        if runs.is_empty() {
            return self.refuse(element, Code::TooFewPoints, "it has fewer than two points");
        }
        let builder = &mut self.base.builder;
        if !builder.within_point_budget(&runs) {
            let detail = builder.point_budget_exceeded();
            return self.refuse(element, Code::Implausible, &detail);
        }
        let id = id(element);
        builder.check_text(id)?;
        let row = self.base.push_path(
            element,
            &NewPath {
                id,
                runs: &runs,
                direction,
                ..NewPath::default()
            },
        )?;
        let builder = &mut self.base.builder;
        builder.set(Table::Paths, row, "element", Value::Text(kind))?;
        self.set_tags(element, row)
    }

    fn set_tags(&mut self, element: Node<'d, 't>, row: usize) -> Result<(), ReadError> {
        let mut seen = HashSet::new();
        for tag in children(element, "tag") {
            let (Some(key), Some(value)) = (tag.attribute("k"), tag.attribute("v")) else {
                continue;
            };
            if key == SPEED_LIMIT && self.set_speed(element, row, value) {
                continue;
            }
            if !self.columns.contains(key) {
                if self.columns.len() == MAX_COLUMNS {
                    let message = || format!("more than {MAX_COLUMNS} different tags");
                    let remedy = "The others are left out";
                    self.base.report(Code::Attribute, element, message, remedy);
                    continue;
                }
                self.base.builder.check_text(key)?;
                self.columns.insert(key);
            }
            let builder = &mut self.base.builder;
            builder.check_text(value)?;
            if seen.insert(key) && key != "element" {
                builder.set(Table::Paths, row, key, Value::Text(value))?;
            }
        }
        Ok(())
    }

    /// Sets the speed limit of a path, in meters per second; reports one that is no speed.
    fn set_speed(&mut self, element: Node<'d, 't>, row: usize, text: &str) -> bool {
        let Some(speed) = speed_unit::parse(text, SPEED_UNIT) else {
            let start: String = text.chars().take(40).collect();
            let message = || format!("the speed limit `{start}` is no speed");
            let remedy = "It is kept as text; give a number, and the unit km/h, mph or m/s";
            self.base
                .report(Code::UnknownValue, element, message, remedy);
            return false;
        };
        let attributes = self.base.builder.attributes(Table::Paths);
        attributes.set_quantity(row, "maxSpeed", speed, Quantity::Speed);
        true
    }

    fn refuse(&mut self, element: Node<'d, 't>, code: Code, detail: &str) -> Result<(), ReadError> {
        let remedy = "It is left out; correct it in the tool that wrote the file";
        self.base.builder.check_text(id(element))?;
        self.base.refuse(id(element), code, element, detail, remedy)
    }
}

fn is_lanelet(relation: Node<'_, '_>) -> bool {
    tag(relation, "type") == Some("lanelet")
}

fn id<'d>(element: Node<'d, '_>) -> &'d str {
    element.attribute("id").unwrap_or_default()
}
