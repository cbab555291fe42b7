//! The levels of the example site: the hall and the mezzanine.

use super::level::{BOTH, Level, STACKER, TUGGER};
use super::trajectory::{Way, Xy, add};

/// The ground floor: 145 by 77 meters.
pub(crate) fn hall() -> Level {
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

/// Adds an aisle with five picking places. Returns where it meets the lanes below and above.
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

/// Adds two one-way roads through the middle, which also connect both rings.
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

/// Adds the route of the tugger past the machines, from the inner ring in the east to the south.
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
pub(crate) fn mezzanine() -> Level {
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
