//! Objects of an order: converts the rows of a layout to the header, nodes and edges, and counts
//! the values that they hold.

use std::borrow::Cow;
use std::collections::HashMap;
use std::time::SystemTime;

use guideway_layout::{Attributes, Layout, Value};
use guideway_spline::Point;

use super::held::{Form, Held};
use super::members::{DERIVED, EDGE, HEADER, Member, NODE, OTHER, PASSES, POSITION, SEQUENCE};
use super::route::{Route, RouteEdge, RoutePlace, passes};
use super::version::Version;
use crate::json::{Members, Tree};
use crate::trajectory::TRAJECTORY_COLUMN;
use crate::trajectory_writer::TrajectoryWriter;

/// Table whose values are counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Part {
    Layout,
    Nodes,
    Paths,
}

/// Converts the rows of a layout.
pub(super) struct Objects<'r, 'a> {
    pub(super) layout: &'a Layout,
    pub(super) route: &'r Route<'a>,
    pub(super) form: Form,
    /// True for a layout read from an order of any version.
    pub(super) is_order: bool,
    pub(super) trajectories: TrajectoryWriter<'a>,
    node: Vec<Member>,
    position: Vec<Member>,
    edge: Vec<Member>,
    /// Values per column that a reader gets back.
    pub(super) held: HashMap<(Part, &'static str), usize>,
}

impl<'r, 'a> Objects<'r, 'a> {
    pub(super) fn new(layout: &'a Layout, route: &'r Route<'a>, version: Version) -> Self {
        let source = Version::of_layout(layout);
        let is_as_written = source == Some(version);
        Self {
            layout,
            route,
            form: Form {
                version,
                is_as_written,
            },
            is_order: source.is_some(),
            trajectories: TrajectoryWriter {
                layout,
                has_weights_from_1: false,
                is_as_written,
            },
            node: version.members(NODE),
            position: version.members(POSITION),
            edge: version.members(EDGE),
            held: HashMap::new(),
        }
    }

    /// The members of the root object without nodes and edges.
    pub(super) fn header(&mut self, exported: SystemTime) -> Members<'a> {
        let layout = self.layout;
        let mut header: Members<'a> = Vec::new();
        for member in self.form.version.members(HEADER) {
            let value = layout.attributes.value(0, member.column);
            let is_replaced = member.name == "version" && !self.form.is_as_written;
            let held = value.filter(|_| !is_replaced);
            let held = held.and_then(|value| self.form.convert(&member, value, ""));
            if let Some(held) = held {
                self.count(Part::Layout, member.column, &held);
                header.push((member.name.into(), held.tree));
            }
        }
        let exported = humantime::format_rfc3339_millis(exported).to_string();
        let text = |text: &str| Tree::Text(text.to_owned().into());
        for (name, value) in [
            ("headerId", Tree::Raw("0".into())),
            ("timestamp", text(&exported)),
            ("version", text(self.form.version.stated())),
            ("manufacturer", text("")),
            ("serialNumber", text("")),
            ("orderId", text("order")),
            ("orderUpdateId", Tree::Raw("0".into())),
        ] {
            let is_needed = !self.form.is_as_written || name == "version";
            if is_needed && header.iter().all(|(known, _)| known != name) {
                header.push((name.into(), value));
            }
        }
        self.merge_other(header, Part::Layout, &layout.attributes, 0)
    }

    /// The nodes of the route, as texts.
    pub(super) fn nodes(&mut self) -> Vec<String> {
        let route = self.route;
        let places = route.places.iter();
        places.map(|place| self.place(place).to_text()).collect()
    }

    /// The edges of the route, as texts.
    pub(super) fn edges(&mut self) -> Vec<String> {
        let route = self.route;
        let ends = route.places.windows(2);
        let edges = route.edges.iter().zip(ends);
        let text = |(edge, ends): (&RouteEdge, &[RoutePlace<'a>])| {
            self.edge(edge, [&ends[0], &ends[1]]).to_text()
        };
        edges.map(text).collect()
    }

    fn place(&mut self, place: &RoutePlace<'a>) -> Tree<'a> {
        let mut node: Members<'a> = vec![("nodeId".into(), Tree::Text(place.id.clone()))];
        let x_y = [("x", place.position_m.x), ("y", place.position_m.y)];
        let mut position: Members<'a> = Vec::new();
        position.extend(x_y.map(|(name, value)| (name.into(), Tree::Number(value))));
        if let Some(pass) = place.pass {
            return pass_of(node, position, place, pass);
        }
        let sequence = Tree::Raw(place.sequence.to_string().into());
        node.push((SEQUENCE.into(), sequence));
        if let Some(row) = place.node {
            self.add_node_members(&mut node, &mut position, place, row);
        }
        self.add_required(&mut node);
        if !place.is_derived {
            add_map(&mut position, place);
            node.push(("nodePosition".into(), Tree::Object(position)));
        }
        match (place.node, place.is_repeated) {
            (Some(row), false) => {
                let attributes = &self.layout.nodes.attributes;
                Tree::Object(self.merge_other(node, Part::Nodes, attributes, row))
            }
            _ => Tree::Object(node),
        }
    }

    fn add_node_members(
        &mut self,
        node: &mut Members<'a>,
        position: &mut Members<'a>,
        place: &RoutePlace<'a>,
        row: usize,
    ) {
        let attributes = &self.layout.nodes.attributes;
        let owner = format!("node-{}", place.sequence);
        let lists = [(&self.node, node), (&self.position, position)];
        let mut all_held = Vec::new();
        for (members, object) in lists {
            for member in members {
                let value = attributes.value(row, member.column);
                let held = value.and_then(|value| self.form.convert(member, value, &owner));
                if let Some(held) = held {
                    all_held.push((member.column, held.is_changed));
                    object.push((member.name.into(), held.tree));
                }
            }
        }
        if place.is_repeated {
            return;
        }
        let own = attributes.value(row, SEQUENCE);
        all_held.push((SEQUENCE, own != Some(Value::Int(place.sequence as i64))));
        all_held.push((DERIVED, !place.is_derived));
        let passes = passes(self.layout, row as u32);
        let written = self.route.places.iter();
        let written = written.filter(|p| p.node == Some(row) && p.pass.is_some());
        all_held.push((PASSES, passes.is_empty() || written.count() != passes.len()));
        for (column, is_changed) in all_held {
            if !is_changed {
                *self.held.entry((Part::Nodes, column)).or_default() += 1;
            }
        }
    }

    /// An edge of the route, between two places.
    fn edge(&mut self, edge: &RouteEdge, ends: [&RoutePlace<'a>; 2]) -> Tree<'a> {
        let (layout, row) = (self.layout, edge.row);
        let paths = &layout.paths;
        let path = paths.get(row);
        let sequence = Tree::Raw(edge.sequence.to_string().into());
        let mut object: Members<'a> = vec![
            ("edgeId".into(), Tree::Text(path.id().into())),
            (SEQUENCE.into(), sequence),
        ];
        if self.form.version == Version::V2 {
            let [start, end] = ends.map(|place| Tree::Text(place.id.clone()));
            object.push(("startNodeId".into(), start));
            object.push(("endNodeId".into(), end));
        }
        if paths.attributes.value(row, SEQUENCE) == Some(Value::Int(edge.sequence as i64)) {
            *self.held.entry((Part::Paths, SEQUENCE)).or_default() += 1;
        }
        let owner = format!("edge-{}", edge.sequence);
        for member in self.edge.clone() {
            let Some(value) = paths.value(row, member.column) else {
                continue;
            };
            let Some(held) = self.form.convert(&member, value, &owner) else {
                continue;
            };
            if paths.attributes.value(row, member.column).is_some() {
                self.count(Part::Paths, member.column, &held);
            }
            push(&mut object, member.name, held.tree);
        }
        self.add_rotation(&mut object, row);
        self.complete_corridor(&mut object);
        self.add_required(&mut object);
        let mut positions = ends.map(|place| place.position_m);
        if ends.iter().any(|place| place.is_derived) {
            // The positions of the nodes follow from the trajectory.
            positions = [Point::new(f64::NAN, f64::NAN); 2];
        }
        if let Some(trajectory) = self.trajectories.trajectory(path, positions, false) {
            object.push(("trajectory".into(), trajectory));
        }
        if self.form.is_as_written && paths.attributes.value(row, TRAJECTORY_COLUMN).is_some() {
            let held = self.held.entry((Part::Paths, TRAJECTORY_COLUMN));
            *held.or_default() += 1;
        }
        Tree::Object(self.merge_other(object, Part::Paths, &paths.attributes, row))
    }

    /// Adds the permission to rotate from the member of the other version, which negates it.
    fn add_rotation(&self, object: &mut Members<'a>, row: usize) {
        let names = ["rotationAllowed", "reachOrientationBeforeEntering"];
        let [name, other] = match self.form.version {
            Version::V2 => names,
            Version::V3 => [names[1], names[0]],
        };
        if object.iter().any(|(known, _)| known == name) {
            return;
        }
        if let Some(Value::Bool(value)) = self.layout.paths.value(row, other) {
            object.push((name.into(), Tree::Bool(!value)));
        }
    }

    /// Adds the widths that a corridor requires; a width of 0 permits no deviation.
    fn complete_corridor(&self, object: &mut Members<'a>) {
        if self.form.is_as_written {
            return;
        }
        let corridor = object.iter_mut().find(|(name, _)| name == "corridor");
        let Some((_, Tree::Object(members))) = corridor else {
            return;
        };
        for name in ["leftWidth", "rightWidth"] {
            if members.iter().all(|(known, _)| known != name) {
                members.push((name.into(), Tree::Number(0.0)));
            }
        }
    }

    /// Adds the members that nodes and edges require.
    fn add_required(&self, object: &mut Members<'a>) {
        if self.form.is_as_written {
            return;
        }
        let actions = Tree::Array(Vec::new());
        for (name, value) in [("released", Tree::Bool(true)), ("actions", actions)] {
            if object.iter().all(|(known, _)| known != name) {
                object.push((name.into(), value));
            }
        }
    }

    /// Adds the members of a file that the format does not define.
    fn merge_other(
        &mut self,
        object: Members<'a>,
        part: Part,
        attributes: &'a Attributes,
        row: usize,
    ) -> Members<'a> {
        let mut tree = Tree::Object(object);
        if let (true, Some(Value::Json(text))) = (self.is_order, attributes.value(row, OTHER)) {
            tree.merge(text);
            *self.held.entry((part, OTHER)).or_default() += 1;
        }
        match tree {
            Tree::Object(members) => members,
            _ => Vec::new(),
        }
    }

    fn count(&mut self, part: Part, column: &'static str, held: &Held<'_>) {
        if !held.is_changed {
            *self.held.entry((part, column)).or_default() += 1;
        }
    }
}

/// Adds a member; `group.name` lies in a nested object.
fn push<'a>(object: &mut Members<'a>, name: &'static str, value: Tree<'a>) {
    let Some((group, name)) = name.split_once('.') else {
        object.push((name.into(), value));
        return;
    };
    match object.iter_mut().find(|(known, _)| known == group) {
        Some((_, Tree::Object(members))) => members.push((name.into(), value)),
        _ => {
            let nested = Tree::Object(vec![(name.into(), value)]);
            object.push((group.into(), nested));
        }
    }
}

/// A further pass of a node, with its own members in their order.
fn pass_of<'a>(
    mut node: Members<'a>,
    mut position: Members<'a>,
    place: &RoutePlace<'a>,
    pass: &'a str,
) -> Tree<'a> {
    let mut is_placed = false;
    let Tree::Object(members) = Tree::opened(pass) else {
        return Tree::Object(node);
    };
    for (name, value) in members {
        let value = match (name.as_ref(), value) {
            ("nodePosition", Tree::Raw(Cow::Borrowed(text))) => {
                if let Tree::Object(rest) = Tree::opened(text) {
                    position.extend(rest);
                }
                is_placed = true;
                add_map(&mut position, place);
                Tree::Object(std::mem::take(&mut position))
            }
            (_, value) => value,
        };
        node.push((name, value));
    }
    if !is_placed && !place.is_derived {
        add_map(&mut position, place);
        node.push(("nodePosition".into(), Tree::Object(position)));
    }
    Tree::Object(node)
}

fn add_map<'a>(position: &mut Members<'a>, place: &RoutePlace<'a>) {
    if let Some(map) = place.map {
        position.push(("mapId".into(), Tree::Text(map.into())));
    }
}
