//! From a map to a layout: ways become paths, and lanelets the paths in their middle.

use std::collections::{BTreeMap, HashMap, HashSet};

use guideway_layout::{Code, Direction, Layout, NewPath, Place, Value};
use guideway_spline::{Point, Runs, polyline_to_runs};
use roxmltree::Node;

use super::center::{align, middle};
use super::osm::{is_deleted, positions, tag};
use crate::ReadError;
use crate::builder::{Builder, POINT_BUDGET_EXCEEDED, PlaceFn, Table};
use crate::source::Source;
use crate::xml::{Xml, children};

/// Most tags that become columns; a file could else make columns without end.
const MOST_COLUMNS: usize = 64;

/// Why what is still in the file is not drawn.
const DELETED: &str = "it was deleted in the editor";

/// Fills a layout from a map.
pub(super) struct Mapper<'a, 'd, 't> {
    builder: Builder<'a>,
    xml: &'d Xml<'t>,
    positions: HashMap<&'d str, Point<f64>>,
    ways: HashMap<&'d str, Node<'d, 't>>,
    columns: HashSet<&'d str>,
}

impl<'a, 'd, 't> Mapper<'a, 'd, 't> {
    pub(super) fn new(source: Source<'a>, xml: &'d Xml<'t>, file_bytes: usize) -> Self {
        Self {
            builder: Builder::new(source, file_bytes),
            xml,
            positions: HashMap::new(),
            ways: HashMap::new(),
            columns: HashSet::new(),
        }
    }

    pub(super) fn map(mut self, root: Node<'d, 't>) -> Result<Layout, ReadError> {
        self.positions = positions(&mut self.builder, self.xml, root);
        let xml = self.xml;
        let mut counts = [("nodes", 0), ("ways", 0), ("lanelets", 0)];
        let mut relations: BTreeMap<&str, u64> = BTreeMap::new();
        for element in root.children().filter(Node::is_element) {
            let kind = match element.tag_name().name() {
                "node" => 0,
                "way" => 1,
                "relation" if is_lanelet(element) => 2,
                "relation" => {
                    let kind = tag(element, "type").unwrap_or("no type");
                    if relations.len() < MOST_COLUMNS || relations.contains_key(kind) {
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
            let message = || format!("relations of the type {kind}: {count}");
            let remedy =
                "They are left out, their ways are drawn: what is read are ways and lanelets";
            self.builder.report(Code::NotDrawn, at, message, remedy);
        }
        if counts[2].1 == 0 {
            let message = || "there is no lanelet: the ways of the map are drawn".to_owned();
            let remedy = "Give relations the tag type=lanelet if there should be some";
            let at: PlaceFn<'_> = &|| xml.place(root);
            self.builder.report(Code::Implausible, at, message, remedy);
        }
        let provenance = &mut self.builder.layout.provenance;
        crate::Format::Lanelet2
            .name()
            .clone_into(&mut provenance.format);
        provenance.format_version =
            crate::text::printable(root.attribute("version").unwrap_or_default());
        let counts = counts.into_iter().chain(relations);
        provenance.counts = counts
            .map(|(name, count)| (crate::text::printable(name), count))
            .collect();
        Ok(self.builder.layout)
    }

    fn map_way(&mut self, way: Node<'d, 't>) -> Result<(), ReadError> {
        if is_deleted(way) {
            return self.refuse(way, Code::NotDrawn, DELETED);
        }
        let points = self.points(way)?;
        let missing = children(way, "nd").count() - points.len();
        if missing > 0 {
            let xml = self.xml;
            let at: PlaceFn<'_> = &|| xml.place(way);
            let message = || format!("{missing} of its nodes are not there or have no position");
            let remedy = "It is drawn without them; save the whole map";
            self.builder.report(Code::UnknownNode, at, message, remedy);
        }
        self.push(way, &points, "way", Direction::Both)
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
        // One that somebody drew counts.
        if let Some(drawn) = self.member(lanelet, "centerline") {
            let points = self.points(drawn)?;
            return self.push(lanelet, &points, "lanelet", direction);
        }
        let bounds = ["left", "right"].map(|role| self.member(lanelet, role));
        let [Some(left), Some(right)] = bounds else {
            let detail = "it has no left and right bound, or a bound is no way of the file";
            return self.refuse(lanelet, Code::UnknownNode, detail);
        };
        // Bounds are shared, so many lanelets could walk a few long ones without end: each walk is paid for.
        if self.builder.points_left == 0 {
            return self.refuse(lanelet, Code::Implausible, POINT_BUDGET_EXCEEDED);
        }
        let walked = [left, right].map(|bound| children(bound, "nd").count() as u64);
        let left_over = self.builder.points_left.checked_sub(walked[0] + walked[1]);
        self.builder.points_left = left_over.unwrap_or(0);
        if left_over.is_none() {
            return self.refuse(lanelet, Code::Implausible, POINT_BUDGET_EXCEEDED);
        }
        let (mut left, mut right) = (self.points(left)?, self.points(right)?);
        if left.is_empty() || right.is_empty() {
            return self.refuse(lanelet, Code::TooFewPoints, "a bound has no points");
        }
        align(&mut left, &mut right);
        self.push(lanelet, &middle(&left, &right), "lanelet", direction)
    }

    /// The way that has a role in a relation.
    fn member(&self, relation: Node<'d, 't>, role: &str) -> Option<Node<'d, 't>> {
        let mut members = children(relation, "member");
        let member = members
            .find(|m| m.attribute("role") == Some(role) && m.attribute("type") == Some("way"))?;
        self.ways.get(member.attribute("ref")?).copied()
    }

    /// The positions of the nodes of a way. Nodes that are not there are left out.
    fn points(&mut self, way: Node<'d, 't>) -> Result<Vec<Point<f64>>, ReadError> {
        let references = || children(way, "nd").map(|nd| nd.attribute("ref").unwrap_or_default());
        let points: Vec<_> = references()
            .filter_map(|id| self.positions.get(id).copied())
            .collect();
        self.builder.check_curve_points(points.len())?;
        Ok(points)
    }

    fn push(
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
        if !self.builder.within_point_budget(&runs) {
            return self.refuse(element, Code::Implausible, POINT_BUDGET_EXCEEDED);
        }
        let id = id(element);
        self.builder.check_text(id)?;
        let row = self.builder.push_path(&NewPath {
            id,
            runs: &runs,
            direction,
            ..NewPath::default()
        })?;
        self.builder
            .set(Table::Paths, row, "element", Value::Text(kind))?;
        self.set_tags(element, row)
    }

    fn set_tags(&mut self, element: Node<'d, 't>, row: usize) -> Result<(), ReadError> {
        let xml = self.xml;
        let mut seen = HashSet::new();
        for tag in children(element, "tag") {
            let (Some(key), Some(value)) = (tag.attribute("k"), tag.attribute("v")) else {
                continue;
            };
            if !self.columns.contains(key) {
                if self.columns.len() == MOST_COLUMNS {
                    let message = || format!("more than {MOST_COLUMNS} different tags");
                    let at: PlaceFn<'_> = &|| xml.place(element);
                    self.builder
                        .report(Code::Attribute, at, message, "The others are left out");
                    continue;
                }
                self.builder.check_text(key)?;
                self.columns.insert(key);
            }
            self.builder.check_text(value)?;
            if seen.insert(key) && key != "element" {
                self.builder
                    .set(Table::Paths, row, key, Value::Text(value))?;
            }
        }
        Ok(())
    }

    fn refuse(&mut self, element: Node<'d, 't>, code: Code, detail: &str) -> Result<(), ReadError> {
        let xml = self.xml;
        let remedy = "It is left out; correct it in the tool that wrote the file";
        let at: PlaceFn<'_> = &|| xml.place(element);
        self.builder.report(code, at, || detail.to_owned(), remedy);
        self.builder.check_text(id(element))?;
        self.builder.refuse(id(element), code, detail)
    }
}

fn is_lanelet(relation: Node<'_, '_>) -> bool {
    tag(relation, "type") == Some("lanelet")
}

fn id<'d>(element: Node<'d, '_>) -> &'d str {
    element.attribute("id").unwrap_or_default()
}
