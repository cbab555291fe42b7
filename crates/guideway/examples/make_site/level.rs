//! One level of the site under construction: nodes, edges, stations.

use serde_json::{Value, json};

use super::trajectory::{Way, Xy, add, trajectory};

/// Vehicle types.
pub(crate) const STACKER: &str = "stacker-1200";
pub(crate) const TUGGER: &str = "tugger-3000";
pub(crate) const BOTH: &[&str] = &[STACKER, TUGGER];

/// A level of the site.
#[derive(Default)]
pub(crate) struct Level {
    pub(crate) nodes: Vec<(String, Xy)>,
    pub(crate) edges: Vec<Value>,
    pub(crate) stations: Vec<Value>,
}

impl Level {
    /// The id of the node at a point; adds the node if there is none.
    pub(crate) fn node(&mut self, prefix: &str, at: Xy) -> String {
        if let Some((id, _)) = self.nodes.iter().find(|(_, p)| close(*p, at)) {
            return id.clone();
        }
        let id = format!("{prefix}-{:03}", self.nodes.len() + 1);
        self.nodes.push((id.clone(), at));
        id
    }

    /// Adds an edge.
    pub(crate) fn edge(
        &mut self,
        prefix: &str,
        from: Xy,
        to: Xy,
        way: &Way,
        max_speed: f64,
        types: &[&str],
    ) {
        let (start, end) = (self.node(prefix, from), self.node(prefix, to));
        let trajectory = trajectory(from, to, way);
        let properties = types.iter().map(|vehicle_type| {
            json!({
                "vehicleTypeId": vehicle_type,
                "vehicleOrientation": 0.0,
                "orientationType": "TANGENTIAL",
                "rotationAllowed": false,
                "rotationAtStartNodeAllowed": "NONE",
                "rotationAtEndNodeAllowed": "NONE",
                "maxSpeed": max_speed,
                "trajectory": trajectory,
            })
        });
        self.edges.push(json!({
            "edgeId": format!("{start}--{end}"),
            "startNodeId": start,
            "endNodeId": end,
            "vehicleTypeEdgeProperties": properties.collect::<Vec<_>>(),
        }));
    }

    /// Adds a straight edge to the end of a spur, where vehicles turn around, and one back.
    pub(crate) fn both_ways(&mut self, prefix: &str, a: Xy, b: Xy, max_speed: f64, types: &[&str]) {
        self.edge(prefix, a, b, &Way::Straight, max_speed, types);
        self.edge(prefix, b, a, &Way::Straight, max_speed, types);
        let [.., inward, outward] = self.edges.as_mut_slice() else {
            return;
        };
        for (edge, rule) in [
            (inward, "rotationAtEndNodeAllowed"),
            (outward, "rotationAtStartNodeAllowed"),
        ] {
            let properties = edge["vehicleTypeEdgeProperties"].as_array_mut();
            for of_type in properties.into_iter().flatten() {
                of_type[rule] = json!("BOTH");
            }
        }
    }

    /// Adds a station with its node.
    pub(crate) fn station(&mut self, name: &str, at: Xy, height: f64) {
        let node = self.node(name, at);
        self.stations.push(json!({
            "stationId": name,
            "stationName": name,
            "interactionNodeIds": [node],
            "stationHeight": height,
            "stationPosition": { "x": at.0, "y": at.1 },
        }));
    }

    /// Adds a straight lane through its stops, from the first to the last.
    pub(crate) fn lane(&mut self, prefix: &str, mut stops: Vec<Xy>, max_speed: f64) {
        let (first, last) = (stops[0], stops[stops.len() - 1]);
        let along = (last.0 - first.0, last.1 - first.1);
        stops.sort_by(|a, b| {
            let along = |p: &Xy| p.0 * along.0 + p.1 * along.1;
            along(a).total_cmp(&along(b))
        });
        stops.dedup_by(|a, b| close(*a, *b));
        for pair in stops.windows(2) {
            self.edge(prefix, pair[0], pair[1], &Way::Straight, max_speed, BOTH);
        }
    }

    /// Adds a bay to the right of a lane at `at`: a swing in, straight to the end, and back out.
    /// Returns the points where it leaves and joins the lane.
    pub(crate) fn bay(
        &mut self,
        name: &str,
        at: Xy,
        travel: Xy,
        depth: f64,
        height: f64,
    ) -> [Xy; 2] {
        let right = (travel.1, -travel.0);
        let swing = 6.0;
        let before = add(at, travel, -swing);
        let after = add(at, travel, swing);
        let mouth = add(at, right, depth - 4.0);
        let end = add(at, right, depth);
        let inward = (right.0 * 5.0, right.1 * 5.0);
        let forward = (travel.0 * 5.0, travel.1 * 5.0);
        let outward = (-inward.0, -inward.1);
        self.edge(name, before, mouth, &Way::Swing(forward, inward), 0.8, BOTH);
        self.both_ways(name, mouth, end, 0.3, BOTH);
        self.edge(name, mouth, after, &Way::Swing(outward, forward), 0.8, BOTH);
        self.station(name, end, height);
        [before, after]
    }
}

fn close(a: Xy, b: Xy) -> bool {
    (a.0 - b.0).hypot(a.1 - b.1) < 1e-6
}
