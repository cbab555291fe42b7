//! Routes: the fastest way, turns, errors, and growth.

use guideway_growth::exponent;
use guideway_layout::{Direction, Layout, NewPath, Value};
use guideway_network::{RouteError, RouteOptions, Router};
use guideway_spline::{Point, Runs};
use proptest::prelude::*;

use crate::sketch::{case, network, split};

fn add(layout: &mut Layout, from: u32, to: u32, direction: Direction, speed: f64) {
    let mut runs = Runs::default();
    runs.push_line(layout.nodes.position_m(from), layout.nodes.position_m(to));
    let row = layout.paths.push(&NewPath {
        id: &format!("{from}-{to}"),
        runs: &runs,
        start_node: Some(from),
        end_node: Some(to),
        direction,
        ..NewPath::default()
    });
    layout
        .paths
        .attributes
        .set(row, "maxSpeed", Value::Float(speed));
}

/// A grid of two-way streets, one meter apart; speeds repeat.
fn grid(side: u32) -> Layout {
    let mut layout = Layout::default();
    for row in 0..side * side {
        let at = Point::new(f64::from(row % side), f64::from(row / side));
        layout.nodes.push(&format!("n{row}"), at, None);
    }
    for row in 0..side * side {
        let speed = 0.5 + f64::from(row % 7) * 0.25;
        if row % side + 1 < side {
            add(&mut layout, row, row + 1, Direction::Both, speed);
        }
        if row + side < side * side {
            add(&mut layout, row, row + side, Direction::Both, speed);
        }
    }
    layout
}

fn route(layout: &Layout, from: &str, to: &str) -> Result<guideway_network::Route, RouteError> {
    let router = Router::new(layout, None, &RouteOptions::default())?;
    router.route(&router.place(from)?, &router.place(to)?)
}

#[test]
fn longer_way_at_higher_speed_wins() {
    let mut layout = Layout::default();
    for (id, x, y) in [("a", 0.0, 0.0), ("b", 10.0, 0.0), ("c", 5.0, 1.0)] {
        layout.nodes.push(id, Point::new(x, y), None);
    }
    add(&mut layout, 0, 1, Direction::Forward, 1.0);
    add(&mut layout, 0, 2, Direction::Forward, 2.0);
    add(&mut layout, 2, 1, Direction::Both, 2.0);
    let found = route(&layout, "a", "b").unwrap();
    let paths: Vec<u32> = found.rows.iter().map(|row| row.path).collect();
    assert_eq!(paths, [1, 2]);
    let leg_m = 26f64.sqrt();
    assert!((found.length_m - 2.0 * leg_m).abs() < 1e-3);
    // The turn at c is 22.6 degrees, at 0.5 rad/s.
    let turn_rad = 2.0 * 0.2f64.atan();
    assert!((found.rows[1].turn_rad - turn_rad).abs() < 1e-9);
    assert!(
        (found.time_s - (leg_m + turn_rad / 0.5)).abs() < 1e-3,
        "{found:?}"
    );
    assert_eq!(route(&layout, "a", "a").unwrap().rows, []);
    // Against the path from b to c.
    assert!(route(&layout, "b", "c").unwrap().rows[0].is_backward);
    let turned = route(&layout, "b", "c").unwrap().layout(&layout);
    assert_eq!(turned.paths.get(0).ends().unwrap().0, Point::new(10.0, 0.0));
    assert_eq!(
        turned.nodes.id(turned.paths.get(0).start_node().unwrap()),
        "b"
    );
}

#[test]
fn forbidden_turns_are_not_taken_and_are_named() {
    let Some(layout) = case("corner.lif.json") else {
        return;
    };
    let router = Router::new(&layout, Some("V"), &RouteOptions::default()).unwrap();
    let [a, c] = ["A", "C"].map(|name| router.place(name).unwrap());
    let error = router.route(&a, &c).unwrap_err().to_string();
    assert!(
        error.contains("rotation is forbidden at node \"B\""),
        "{error}"
    );
}

#[test]
fn stations_out_of_reach_and_unknown_names_are_errors() {
    let Some(layout) = case("dead.lif.json") else {
        return;
    };
    let router = Router::new(&layout, Some("agv"), &RouteOptions::default()).unwrap();
    let place = |name| router.place(name).unwrap();
    let error = router
        .route(&place("PICK"), &place("DROP"))
        .unwrap_err()
        .to_string();
    assert!(error.contains("\"agv\" reach 1 of 6 nodes"), "{error}");
    assert_eq!(
        router
            .route(&place("a"), &place("DROP"))
            .unwrap()
            .rows
            .len(),
        2
    );
    assert!(matches!(
        router.place("Z"),
        Err(RouteError::UnknownPlace { .. })
    ));
    let other = Router::new(&layout, Some("tug"), &RouteOptions::default());
    assert!(
        other
            .err()
            .unwrap()
            .to_string()
            .contains("the layout has agv")
    );
    let open = Router::new(&layout, None, &RouteOptions::default());
    assert!(
        open.err()
            .unwrap()
            .to_string()
            .contains("no vehicle type is given")
    );
}

#[test]
fn built_case_has_a_route_to_its_station() {
    let Some(drawing) = case("net.dxf") else {
        return;
    };
    let layout = network(&drawing, &split()).layout;
    let found = route(&layout, "N1", "PICK-07").unwrap();
    assert_eq!(found.rows.len(), 4);
    assert!((found.length_m - 15.0).abs() < 1e-6 && (found.time_s - 15.0).abs() < 1e-6);
}

#[test]
fn bends_slow_vehicles_down() {
    let mut layout = Layout::default();
    layout.nodes.push("a", Point::new(4.0, 0.0), None);
    layout.nodes.push("b", Point::new(0.0, 4.0), None);
    layout.paths.push(&NewPath {
        runs: &crate::sketch::quarter(4.0),
        start_node: Some(0),
        end_node: Some(1),
        ..NewPath::default()
    });
    layout
        .paths
        .attributes
        .set(0, "maxSpeed", Value::Float(5.0));
    let options = RouteOptions {
        lateral_acceleration_m_s2: Some(1.0),
        ..RouteOptions::default()
    };
    let router = Router::new(&layout, None, &options).unwrap();
    let found = router
        .route(&router.place("a").unwrap(), &router.place("b").unwrap())
        .unwrap();
    // The speed in the bend is sqrt(1 * 4) = 2 m/s.
    let expected = std::f64::consts::FRAC_PI_2 * 4.0 / 2.0;
    assert!((found.time_s - expected).abs() < 1e-2, "{found:?}");
}

/// Times from a node to all others by relaxing every pair of arcs until nothing changes.
fn slow_time(layout: &Layout, from: u32, to: u32, options: &RouteOptions) -> f64 {
    let paths = &layout.paths;
    let mut arcs = Vec::new();
    for path in paths.iter() {
        let (a, b) = (path.start_node().unwrap(), path.end_node().unwrap());
        let Some(Value::Float(speed)) = paths.attributes.value(path.row(), "maxSpeed") else {
            continue;
        };
        let [p, q] = [a, b].map(|node| layout.nodes.position_m(node));
        let time = p.distance(q) / speed;
        arcs.push((a, b, time, q - p));
        if path.direction() == Direction::Both {
            arcs.push((b, a, time, p - q));
        }
    }
    let mut times: Vec<f64> = arcs
        .iter()
        .map(|a| if a.0 == from { a.2 } else { f64::INFINITY })
        .collect();
    for _ in 0..arcs.len() {
        for i in 0..arcs.len() {
            for j in 0..arcs.len() {
                if arcs[i].1 != arcs[j].0 {
                    continue;
                }
                // Two-way paths may be driven backward against their direction.
                let angle = |u: Point<f64>, v: Point<f64>| u.cross(v).abs().atan2(u.dot(v));
                let turn = angle(arcs[i].3, arcs[j].3);
                let turn = if turn <= options.turn_angle_rad {
                    0.0
                } else {
                    turn
                };
                let time = times[i] + turn / options.rotation_speed_rad_s + arcs[j].2;
                times[j] = times[j].min(time);
            }
        }
    }
    arcs.iter()
        .zip(&times)
        .filter(|(a, _)| a.1 == to)
        .map(|(_, t)| *t)
        .fold(f64::INFINITY, f64::min)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn search_is_as_fast_as_trying_all_ways(
        points in prop::collection::vec((0_i32..20, 0_i32..20), 6..9),
        edges in prop::collection::vec((0_usize..9, 0_usize..9, 1_u32..8), 4..16),
    ) {
        let mut layout = Layout::default();
        for (row, &(x, y)) in points.iter().enumerate() {
            let off = row as f64 * 0.01;
            let at = Point::new(f64::from(x) + off, f64::from(y));
            layout.nodes.push(&format!("n{row}"), at, None);
        }
        for (a, b, speed) in edges {
            let (a, b) = (a % points.len(), b % points.len());
            if a != b {
                add(&mut layout, a as u32, b as u32, Direction::Forward, f64::from(speed) * 0.3);
            }
        }
        let options = RouteOptions::default();
        let slow = slow_time(&layout, 0, 1, &options);
        match route(&layout, "n0", "n1") {
            Ok(found) => {
                prop_assert!((found.time_s - slow).abs() < 1e-3, "{} {}", found.time_s, slow);
                for pair in found.rows.windows(2) {
                    prop_assert_eq!(pair[0].to, pair[1].from);
                }
            }
            Err(_) => prop_assert!(slow.is_infinite(), "{}", slow),
        }
    }
}

#[test]
fn search_grows_almost_linearly() {
    let slope = exponent([30, 60, 120], |side| {
        let layout = grid(side as u32);
        let router = Router::new(&layout, None, &RouteOptions::default()).unwrap();
        let last = format!("n{}", side * side - 1);
        let places = ["n0", &last].map(|name| router.place(name).unwrap());
        let found = router.route(&places[0], &places[1]).unwrap();
        assert!(found.rows.len() >= 2 * (side - 1));
        found.turns_compared as f64
    });
    // The number of edges is the square of the side.
    assert!(slope / 2.0 < 1.3, "exponent {:.2}", slope / 2.0);
}
