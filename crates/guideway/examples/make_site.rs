//! Writes `site.lif.json`, the example site: `cargo run --example make_site > crates/guideway/examples/site.lif.json`.
//! With two numbers it writes as many of its halls side by side, and rows of them.
//!
//! A distribution hall of our own design: two ring lanes in opposite directions, high-bay aisles, docks,
//! chargers, parking, a production loop, and a mezzanine as a second layout.

use std::fmt::Write as _;
use std::io::{self, Write};
use std::process::ExitCode;

use serde_json::{Value, json};

type Xy = (f64, f64);

const STACKER: &str = "stacker-1200";
const TUGGER: &str = "tugger-3000";
const BOTH: &[&str] = &[STACKER, TUGGER];

/// Weight of the middle control point of a quarter circle of degree 2.
const QUARTER: f64 = std::f64::consts::FRAC_1_SQRT_2;

#[derive(Default)]
struct Level {
    nodes: Vec<(String, Xy)>,
    edges: Vec<Value>,
    stations: Vec<Value>,
}

/// How an edge goes from its start to its end.
enum Way {
    Straight,
    /// A quarter circle around this corner.
    Corner(Xy),
    /// A cubic that leaves and arrives in these directions; longer ones swing wider.
    Swing(Xy, Xy),
    /// A cubic B-spline with these points between its ends.
    Winding(Vec<Xy>),
}

impl Level {
    /// The node at a point, made if it is new.
    fn node(&mut self, prefix: &str, at: Xy) -> String {
        if let Some((id, _)) = self.nodes.iter().find(|(_, p)| close(*p, at)) {
            return id.clone();
        }
        let id = format!("{prefix}-{:03}", self.nodes.len() + 1);
        self.nodes.push((id.clone(), at));
        id
    }

    fn edge(&mut self, prefix: &str, from: Xy, to: Xy, way: &Way, max_speed: f64, types: &[&str]) {
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

    fn both_ways(&mut self, prefix: &str, a: Xy, b: Xy, max_speed: f64, types: &[&str]) {
        self.edge(prefix, a, b, &Way::Straight, max_speed, types);
        self.edge(prefix, b, a, &Way::Straight, max_speed, types);
    }

    fn station(&mut self, name: &str, at: Xy, height: f64) {
        let node = self.node(name, at);
        self.stations.push(json!({
            "stationId": name,
            "stationName": name,
            "interactionNodeIds": [node],
            "stationHeight": height,
            "stationPosition": { "x": at.0, "y": at.1 },
        }));
    }

    /// A lane along its stops, in the order of travel.
    fn lane(&mut self, prefix: &str, mut stops: Vec<Xy>, max_speed: f64) {
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

    /// A bay to the right of a lane at `at`: in by a swing, straight to the end, and out the same way.
    /// Returns where it leaves and joins the lane.
    fn bay(&mut self, name: &str, at: Xy, travel: Xy, depth: f64, height: f64) -> [Xy; 2] {
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

fn add(p: Xy, direction: Xy, by: f64) -> Xy {
    (p.0 + direction.0 * by, p.1 + direction.1 * by)
}

fn trajectory(from: Xy, to: Xy, way: &Way) -> Value {
    let point = |(x, y): Xy, weight: f64| {
        let round = |v: f64| (v * 1e4).round() / 1e4;
        json!({ "x": round(x), "y": round(y), "weight": weight })
    };
    match way {
        Way::Straight => json!({
            "degree": 1,
            "knotVector": [0.0, 0.0, 1.0, 1.0],
            "controlPoints": [point(from, 1.0), point(to, 1.0)],
        }),
        Way::Corner(corner) => json!({
            "degree": 2,
            "knotVector": [0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            "controlPoints": [point(from, 1.0), point(*corner, QUARTER), point(to, 1.0)],
        }),
        Way::Swing(leave, arrive) => {
            let inner = [add(from, *leave, 1.0), add(to, *arrive, -1.0)];
            json!({
                "degree": 3,
                "knotVector": [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
                "controlPoints": [
                    point(from, 1.0), point(inner[0], 1.0), point(inner[1], 1.0), point(to, 1.0),
                ],
            })
        }
        Way::Winding(inner) => {
            let spans = inner.len() - 1;
            let inside = (1..spans).map(|i| i as f64 / spans as f64);
            let knots: Vec<f64> = [0.0; 4].into_iter().chain(inside).chain([1.0; 4]).collect();
            let ends = (point(from, 1.0), point(to, 1.0));
            let inner = inner.iter().map(|&p| point(p, 1.0));
            let points: Vec<Value> = std::iter::once(ends.0)
                .chain(inner)
                .chain([ends.1])
                .collect();
            json!({ "degree": 3, "knotVector": knots, "controlPoints": points })
        }
    }
}

/// The ground floor: 145 by 77 meters.
fn hall() -> Level {
    let mut hall = Level::default();
    const EAST: Xy = (1.0, 0.0);
    const WEST: Xy = (-1.0, 0.0);
    const SOUTH: Xy = (0.0, -1.0);
    // The two rings drive on the right: the outer one anticlockwise, the inner one clockwise.
    let mut outer_south = vec![(22.0, 14.0), (121.0, 14.0)];
    let mut outer_north = vec![(121.0, 63.0), (22.0, 63.0)];
    let mut outer_west = vec![(14.0, 55.0), (14.0, 22.0)];
    let mut inner_south = vec![(121.0, 17.0), (22.0, 17.0)];
    let mut inner_north = vec![(22.0, 60.0), (121.0, 60.0)];
    let mut inner_east = vec![(126.0, 55.0), (126.0, 22.0)];

    for dock in 0..8 {
        let at = (36.0 + 10.0 * f64::from(dock), 14.0);
        outer_south.extend(hall.bay(&format!("dock-{}", dock + 1), at, EAST, 12.0, 1.2));
    }
    for charger in 0..5 {
        let at = (72.0 - 7.0 * f64::from(charger), 63.0);
        outer_north.extend(hall.bay(&format!("charger-{}", charger + 1), at, WEST, 10.0, 0.0));
    }
    for parking in 0..3 {
        let at = (14.0, 48.0 - 9.0 * f64::from(parking));
        outer_west.extend(hall.bay(&format!("parking-{}", parking + 1), at, SOUTH, 12.0, 0.0));
    }
    for aisle in 0..9 {
        let name = format!("aisle-{}", aisle + 1);
        let [down, up] = aisle_edges(&mut hall, &name, 28.0 + 6.5 * f64::from(aisle));
        inner_south.extend(down);
        inner_north.extend(up);
    }
    cross_roads(&mut hall);
    outer_south.extend([(87.0, 14.0), (94.0, 14.0)]);
    inner_south.extend([(97.0, 17.0), (84.0, 17.0)]);
    inner_north.extend([(84.0, 60.0), (97.0, 60.0)]);
    outer_north.extend([(94.0, 63.0), (87.0, 63.0)]);
    let [leaves, joins] = production(&mut hall);
    inner_east.push(leaves);
    inner_south.push(joins);

    hall.lane("ring", outer_south, 2.0);
    hall.lane("ring", vec![(129.0, 22.0), (129.0, 55.0)], 2.0);
    hall.lane("ring", outer_north, 2.0);
    hall.lane("ring", outer_west, 2.0);
    hall.lane("ring", inner_south, 1.6);
    hall.lane("ring", vec![(17.0, 22.0), (17.0, 55.0)], 1.6);
    hall.lane("ring", inner_north, 1.6);
    hall.lane("ring", inner_east, 1.6);
    for (from, corner, to) in [
        ((121.0, 14.0), (129.0, 14.0), (129.0, 22.0)),
        ((129.0, 55.0), (129.0, 63.0), (121.0, 63.0)),
        ((22.0, 63.0), (14.0, 63.0), (14.0, 55.0)),
        ((14.0, 22.0), (14.0, 14.0), (22.0, 14.0)),
        ((22.0, 17.0), (17.0, 17.0), (17.0, 22.0)),
        ((17.0, 55.0), (17.0, 60.0), (22.0, 60.0)),
        ((121.0, 60.0), (126.0, 60.0), (126.0, 55.0)),
        ((126.0, 22.0), (126.0, 17.0), (121.0, 17.0)),
    ] {
        hall.edge("ring", from, to, &Way::Corner(corner), 1.2, BOTH);
    }
    hall
}

/// An aisle with five picking places, and where it meets the lanes below and above.
fn aisle_edges(hall: &mut Level, name: &str, x: f64) -> [[Xy; 2]; 2] {
    let turn = 3.0;
    let (low, high) = ((x, 17.0 + turn), (x, 60.0 - turn));
    let [low_in, low_out] = [(x + turn, 17.0), (x - turn, 17.0)];
    let [high_in, high_out] = [(x - turn, 60.0), (x + turn, 60.0)];
    let stackers: &[&str] = &[STACKER];
    let corners = [
        (low_in, low),
        (low, low_out),
        (high_in, high),
        (high, high_out),
    ];
    for (from, to) in corners {
        let corner = (x, if from.1 < 30.0 { 17.0 } else { 60.0 });
        hall.edge(name, from, to, &Way::Corner(corner), 0.8, stackers);
    }
    let places: Vec<Xy> = (0..5).map(|i| (x, 26.0 + 6.25 * f64::from(i))).collect();
    let stops: Vec<Xy> = std::iter::once(low)
        .chain(places.clone())
        .chain([high])
        .collect();
    for pair in stops.windows(2) {
        hall.both_ways(name, pair[0], pair[1], 1.0, stackers);
    }
    for (i, place) in places.iter().enumerate() {
        hall.station(&format!("{name}-rack-{}", i + 1), *place, 6.5);
    }
    [[low_in, low_out], [high_in, high_out]]
}

/// Two one-way roads through the middle, which also lead from one ring to the other.
fn cross_roads(hall: &mut Level) {
    let name = "cross";
    let (north, south) = ([(92.0, 22.0), (92.0, 55.0)], [(89.0, 55.0), (89.0, 22.0)]);
    let up = (0.0, 5.0);
    let (east, west, down) = ((5.0, 0.0), (-5.0, 0.0), (0.0, -5.0));
    let turns = [
        ((87.0, 14.0), north[0], east, up),
        ((97.0, 17.0), north[0], west, up),
        (north[1], (97.0, 60.0), up, east),
        (north[1], (87.0, 63.0), up, west),
        ((94.0, 63.0), south[0], west, down),
        ((84.0, 60.0), south[0], east, down),
        (south[1], (84.0, 17.0), down, west),
        (south[1], (94.0, 14.0), down, east),
    ];
    for (from, to, leave, arrive) in turns {
        hall.edge(name, from, to, &Way::Swing(leave, arrive), 0.8, BOTH);
    }
    hall.edge(name, north[0], north[1], &Way::Straight, 1.6, BOTH);
    hall.edge(name, south[0], south[1], &Way::Straight, 1.6, BOTH);
}

/// The tugger's way past the machines, from the inner ring in the east to that in the south.
fn production(hall: &mut Level) -> [Xy; 2] {
    let tuggers: &[&str] = &[TUGGER];
    let (leaves, joins) = ((126.0, 53.0), (106.0, 17.0));
    let machines = [
        (112.0, 49.0),
        (103.0, 43.0),
        (114.0, 37.0),
        (112.0, 30.0),
        (103.0, 30.0),
    ];
    let between: [&[Xy]; 6] = [
        &[(126.0, 50.0), (123.0, 49.0), (118.0, 49.0)],
        &[(106.0, 49.0), (97.0, 49.0), (97.0, 43.0), (100.0, 43.0)],
        &[(107.0, 43.0), (107.0, 37.0), (110.0, 37.0)],
        &[(119.0, 37.0), (122.0, 37.0), (122.0, 30.0), (117.0, 30.0)],
        &[(109.0, 30.0), (106.0, 30.0)],
        &[(97.0, 30.0), (97.0, 22.0), (112.0, 26.0), (114.0, 17.0)],
    ];
    let mut from = leaves;
    for (i, inner) in between.iter().enumerate() {
        let to = machines.get(i).copied().unwrap_or(joins);
        hall.edge(
            "machine",
            from,
            to,
            &Way::Winding(inner.to_vec()),
            0.6,
            tuggers,
        );
        from = to;
    }
    for (i, machine) in machines.iter().enumerate() {
        hall.station(&format!("machine-{}", i + 1), *machine, 0.9);
    }
    [leaves, joins]
}

/// The upper floor, above the offices in the north-east, reached by the lift.
fn mezzanine() -> Level {
    let mut floor = Level::default();
    let tuggers: &[&str] = &[TUGGER];
    let corners = [(84.0, 69.0), (120.0, 69.0), (120.0, 77.0), (84.0, 77.0)];
    let toward = |a: Xy, b: Xy| {
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        add(a, ((b.0 - a.0) / length, (b.1 - a.1) / length), 3.0)
    };
    for i in 0..4 {
        let [here, next, after] = [corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]];
        let (start, end) = (toward(here, next), toward(next, here));
        floor.edge("mezzanine", start, end, &Way::Straight, 1.2, tuggers);
        let way = Way::Corner(next);
        floor.edge("mezzanine", end, toward(next, after), &way, 0.6, tuggers);
    }
    floor.station("lift", (117.0, 69.0), 4.5);
    floor
}

fn layout(id: &str, name: &str, level: &Level) -> Value {
    let nodes = level.nodes.iter().map(|(node, (x, y))| {
        let types = BOTH.iter().map(|t| json!({ "vehicleTypeId": t }));
        json!({
            "nodeId": node,
            "mapId": id,
            "nodePosition": { "x": x, "y": y },
            "vehicleTypeNodeProperties": types.collect::<Vec<_>>(),
        })
    });
    json!({
        "layoutId": id,
        "layoutName": name,
        "layoutVersion": "1",
        "layoutLevelId": id,
        "nodes": nodes.collect::<Vec<_>>(),
        "edges": level.edges,
        "stations": level.stations,
    })
}

/// JSON with a line for each node, edge and station, so that the file can be read and compared.
fn lines(file: &Value) -> String {
    let mut text = format!(
        "{{\n\"metaInformation\": {},\n\"layouts\": [",
        file["metaInformation"]
    );
    for (i, layout) in file["layouts"].as_array().into_iter().flatten().enumerate() {
        text += if i == 0 { "\n{" } else { ",\n{" };
        for (j, (key, value)) in layout.as_object().into_iter().flatten().enumerate() {
            let comma = if j == 0 { "" } else { "," };
            // Writing to a string cannot fail.
            let _ = write!(text, "{comma}\n\"{key}\": ");
            match value.as_array() {
                None => text += &value.to_string(),
                Some(rows) => {
                    let rows: Vec<String> = rows.iter().map(Value::to_string).collect();
                    text += &format!("[\n{}\n]", rows.join(",\n"));
                }
            }
        }
        text += "\n}";
    }
    text + "\n]\n}"
}

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Option<Vec<u32>> = args.iter().map(|arg| arg.parse().ok()).collect();
    let site = match numbers.as_deref() {
        Some([]) => site(),
        Some(&[columns, rows]) if columns > 0 && rows > 0 => campus(columns, rows),
        _ => {
            eprintln!(
                "write nothing, or how many halls lie side by side and how many one above the other, such as `20 16`"
            );
            return ExitCode::from(2);
        }
    };
    match io::stdout().write_all(site.as_bytes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("the site cannot be written: {problem}");
            ExitCode::FAILURE
        }
    }
}

/// The whole file.
pub(crate) fn site() -> String {
    file(&layouts())
}

/// Many such halls in rows, each with names of its own.
pub(crate) fn campus(columns: u32, rows: u32) -> String {
    /// From one hall to the next, in meters.
    const STEP: Xy = (150.0, 95.0);
    let hall = layouts();
    let mut all = hall.clone();
    for (layout, hall) in all.iter_mut().zip(&hall) {
        for list in ["nodes", "edges", "stations"] {
            let places = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
            let placed = places.flat_map(|(column, row)| {
                let by = (STEP.0 * f64::from(column), STEP.1 * f64::from(row));
                let items = hall[list].as_array().into_iter().flatten();
                items.map(move |item| placed(item, &format!("{column}.{row} "), by))
            });
            layout[list] = placed.collect();
        }
    }
    file(&all)
}

/// The same elsewhere, under other names.
fn placed(value: &Value, prefix: &str, by: Xy) -> Value {
    let named = |value: &Value| format!("{prefix}{}", value.as_str().unwrap_or_default()).into();
    match value {
        Value::Array(items) => items.iter().map(|item| placed(item, prefix, by)).collect(),
        Value::Object(members) => {
            let members = members.iter().map(|(name, value)| {
                let value = match (name.as_str(), value) {
                    ("x", Value::Number(x)) => json!(x.as_f64().unwrap_or_default() + by.0),
                    ("y", Value::Number(y)) => json!(y.as_f64().unwrap_or_default() + by.1),
                    ("interactionNodeIds", Value::Array(nodes)) => {
                        nodes.iter().map(named).collect()
                    }
                    (
                        "nodeId" | "startNodeId" | "endNodeId" | "edgeId" | "stationId"
                        | "stationName",
                        id,
                    ) => named(id),
                    (_, value) => placed(value, prefix, by),
                };
                (name.clone(), value)
            });
            Value::Object(members.collect())
        }
        other => other.clone(),
    }
}

fn layouts() -> [Value; 2] {
    [
        layout("hall", "Hall", &hall()),
        layout("mezzanine", "Mezzanine", &mezzanine()),
    ]
}

fn file(layouts: &[Value]) -> String {
    let file = json!({
        "metaInformation": {
            "projectIdentification": "Guideway example site",
            "creator": "Guideway",
            "exportTimestamp": "2025-06-01T08:00:00Z",
            "lifVersion": "1.0.0",
        },
        "layouts": layouts,
    });
    lines(&file) + "\n"
}
