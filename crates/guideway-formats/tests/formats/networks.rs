//! Random layouts with every feature of the model, and a comparison of whole layouts.

use guideway_layout::{
    Attribute, Attributes, Block, Code, Direction, GeoOrigin, Layout, Level, Member, NewPath,
    OwnStyle, PathRef, Quantity, TypeEntries, Value, Values, VehicleType, WrittenCurve, Zone,
};
use guideway_spline::{Point, Runs};

/// Pseudo-random numbers: xorshift64, the same in every run.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        for _ in 0..8 {
            random.below(2);
        }
        random
    }

    pub(crate) fn below(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below as u64) as usize
    }

    fn chance(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }

    fn maybe<T>(&mut self, value: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.chance(2).then(|| value(self))
    }

    fn pick<T: Copy>(&mut self, of: &[T]) -> T {
        of[self.below(of.len())]
    }

    fn row(&mut self, rows: usize) -> Option<u32> {
        let row = self.below(rows + 1);
        (row < rows).then_some(row as u32)
    }

    fn number(&mut self) -> f64 {
        let number = self.below(1 << 20) as f64 / 1024.0 - 500.0;
        number + 1.0 / (1 + self.below(9)) as f64
    }

    fn point(&mut self) -> Point<f64> {
        Point::new(self.number(), self.number())
    }

    fn points(&mut self, from: usize, more: usize) -> Vec<Point<f64>> {
        let count = from + self.below(more);
        (0..count).map(|_| self.point()).collect()
    }
}

/// Texts that a file must not confuse.
const TEXTS: [&str; 12] = [
    "",
    "a",
    "b",
    "a",
    "level",
    "NaN",
    "null",
    "x\0y",
    "Größe \u{1F980}",
    "1",
    " ",
    "a.b",
];

/// Names of attributes, some of which are those of columns with a meaning.
const NAMES: [&str; 14] = [
    "maxSpeed",
    "maxSpeed",
    "name",
    "level",
    "id",
    "of",
    "x_m",
    "guideway.element",
    "actions",
    "attribute.level",
    "attribute",
    "curve",
    "direction",
    "rank",
];

/// A layout whose elements, properties and references are random.
pub(crate) fn network(seed: u64) -> Layout {
    let random = &mut Random::new(seed);
    let mut layout = Layout::default();
    for _ in 0..random.below(4) {
        layout.levels.push(Level {
            id: random.pick(&TEXTS).to_owned(),
            name: random.maybe(|r| r.pick(&TEXTS).to_owned()),
            elevation_m: random.maybe(Random::number),
            attributes: attributes(random, 1),
            source: None,
        });
    }
    let levels = layout.levels.len();
    for _ in 0..random.below(6) {
        let (id, level) = (random.pick(&TEXTS), random.row(levels));
        let types = types(random);
        layout
            .nodes
            .push_for_types(id, random.point(), level, &types);
    }
    let nodes = layout.nodes.len();
    layout.nodes.attributes = attributes(random, nodes);
    set_entries(random, layout.nodes.vehicle_types_mut());
    for _ in 0..random.below(4) {
        let served = (0..random.below(4))
            .filter_map(|_| random.row(nodes))
            .collect();
        let (id, level) = (random.pick(&TEXTS), random.row(levels));
        let position = random.maybe(Random::point);
        layout.stations.push(id, position, served, level);
    }
    layout.stations.attributes = attributes(random, layout.stations.len());
    paths(random, &mut layout);
    for _ in 0..random.below(3) {
        layout.vehicle_types.push(VehicleType {
            id: random.pick(&TEXTS).to_owned(),
            attributes: attributes(random, 1),
        });
        layout.zones.push(Zone {
            id: random.pick(&TEXTS).to_owned(),
            outline_m: random.points(0, 6),
            level: random.row(levels),
            attributes: attributes(random, 1),
        });
        let members = (0..random.below(5))
            .filter_map(|_| member(random, &layout))
            .collect();
        layout.blocks.push(Block {
            id: random.pick(&TEXTS).to_owned(),
            members,
            attributes: attributes(random, 1),
        });
        let code = random.pick(Code::ALL);
        layout
            .refused
            .push(random.pick(&TEXTS), code, random.pick(&TEXTS));
    }
    layout.attributes = attributes(random, 1);
    layout.geo_origin = random.maybe(|r| GeoOrigin {
        longitude_deg: r.number() / 3.0,
        latitude_deg: r.number() / 7.0,
    });
    layout
}

fn paths(random: &mut Random, layout: &mut Layout) {
    let (levels, nodes) = (layout.levels.len(), layout.nodes.len());
    let mut runs = Runs::default();
    for _ in 0..random.below(7) {
        runs.clear();
        for _ in 0..random.pick(&[0, 1, 1, 1, 2, 3]) {
            runs.push(&random.points(4, 4));
        }
        let types = types(random);
        layout.paths.push(&NewPath {
            id: random.pick(&TEXTS),
            runs: &runs,
            start_node: random.row(nodes),
            end_node: random.row(nodes),
            direction: random.pick(&[Direction::Forward, Direction::Both]),
            level: random.row(levels),
            vehicle_types: &types,
        });
    }
    let count = layout.paths.len();
    layout.paths.attributes = attributes(random, count);
    set_entries(random, layout.paths.vehicle_types_mut());
    for path in 0..count {
        let style = OwnStyle {
            width_m: random.maybe(|r| r.below(9) as f32 / 7.0),
            color_rgba: random.maybe(|r| 1 + r.below(1 << 31) as u32),
        };
        if random.chance(2) {
            layout.paths.set_own_style(path, style);
        }
        if random.chance(3) {
            let points_m = random.points(1, 5);
            let weights = random.maybe(|r| points_m.iter().map(|_| r.number()).collect());
            let curve = WrittenCurve {
                degree: 1 + random.below(5) as u32,
                knots: random.points(0, 4).into_iter().map(|p| p.x).collect(),
                points_m,
                weights,
            };
            layout.paths.set_written_curve(path, curve);
        }
    }
    if random.chance(3) {
        let ranks = (0..count).map(|_| random.below(9) as i32 - 4).collect();
        layout.paths.set_rank(ranks);
    }
}

fn types(random: &mut Random) -> Vec<&'static str> {
    let count = random.pick(&[0, 0, 1, 2, 3]);
    (0..count).map(|_| random.pick(&TEXTS)).collect()
}

fn set_entries(random: &mut Random, entries: &mut TypeEntries) {
    let count = match entries.len() {
        0 => 0,
        elements => entries.entries(elements - 1).end,
    };
    entries.attributes = attributes(random, count);
}

fn member(random: &mut Random, layout: &Layout) -> Option<Member> {
    Some(match random.below(3) {
        0 => Member::Path(random.row(layout.paths.len())?),
        1 => Member::Node(random.row(layout.nodes.len())?),
        _ => Member::Station(random.row(layout.stations.len())?),
    })
}

/// Columns of random names and types with values in some of `rows` rows.
fn attributes(random: &mut Random, rows: usize) -> Attributes {
    let mut attributes = Attributes::default();
    for _ in 0..random.pick(&[0, 1, 2, 4]) {
        let rows = 0..random.below(rows + 1);
        let values = match random.below(6) {
            0 => Values::Bool(rows.map(|_| random.maybe(|r| r.chance(2))).collect()),
            1 => {
                let ints = [i64::MIN, i64::MAX, 0, (1 << 53) + 1, 7];
                Values::Int(rows.map(|_| random.maybe(|r| r.pick(&ints))).collect())
            }
            2 | 3 => {
                let odd = [f64::NAN, f64::INFINITY, -0.0, 1e300];
                let number = |r: &mut Random| {
                    if r.chance(4) {
                        r.pick(&odd)
                    } else {
                        r.number()
                    }
                };
                Values::Float(rows.map(|_| random.maybe(number)).collect())
            }
            4 => Values::Text(rows.map(|_| random.maybe(|r| r.pick(&TEXTS))).collect()),
            _ => {
                let json = ["[]", "{\"a\": 1}", "[1, 2.50]", "null"];
                Values::Json(rows.map(|_| random.maybe(|r| r.pick(&json))).collect())
            }
        };
        let mut attribute = Attribute::new(random.pick(&NAMES), values);
        if random.chance(4) {
            attribute.quantity = Some(random.pick(Quantity::ALL));
        }
        attributes.insert(attribute);
    }
    attributes
}

/// Lists the differences of two layouts, apart from findings, provenance, the order of columns, and
/// columns without values. It is stricter than `guideway_layout::differences`: numbers are equal
/// exactly, and types, units and the order of rows count.
pub(crate) fn differences(a: &Layout, b: &Layout) -> Vec<String> {
    let mut found = Vec::new();
    let mut compare = |what: &str, a: String, b: String| {
        if a != b {
            found.push(format!("{what}: {a} / {b}"));
        }
    };
    compare(
        "paths",
        all(a.paths.iter(), |p| path(a, p)),
        all(b.paths.iter(), |p| path(b, p)),
    );
    compare("nodes", nodes(a), nodes(b));
    compare("stations", stations(a), stations(b));
    let refused = |l: &Layout| format!("{:?}", l.refused.iter().collect::<Vec<_>>());
    compare("refused paths", refused(a), refused(b));
    let levels = |l: &Layout| {
        all(l.levels.iter(), |l| {
            let of_level = values(&l.attributes, 0);
            format!("{:?} {:?} {:?} {of_level}", l.id, l.name, l.elevation_m)
        })
    };
    compare("levels", levels(a), levels(b));
    let types = |l: &Layout| {
        all(l.vehicle_types.iter(), |t| {
            format!("{:?} {}", t.id, values(&t.attributes, 0))
        })
    };
    compare("vehicle types", types(a), types(b));
    let blocks = |l: &Layout| {
        all(l.blocks.iter(), |b| {
            format!("{:?} {:?} {}", b.id, b.members, values(&b.attributes, 0))
        })
    };
    compare("blocks", blocks(a), blocks(b));
    let zones = |l: &Layout| {
        all(l.zones.iter(), |z| {
            let of_zone = values(&z.attributes, 0);
            format!("{:?} {:?} {:?} {of_zone}", z.id, z.outline_m, z.level)
        })
    };
    compare("zones", zones(a), zones(b));
    compare(
        "layout properties",
        values(&a.attributes, 0),
        values(&b.attributes, 0),
    );
    let origin = |l: &Layout| format!("{:?}", l.geo_origin);
    compare("geo origin", origin(a), origin(b));
    found
}

fn all<T>(items: impl Iterator<Item = T>, text: impl Fn(T) -> String) -> String {
    items.map(|item| text(item) + "\n").collect()
}

fn path(layout: &Layout, path: PathRef<'_>) -> String {
    let row = path.row();
    let runs: Vec<Vec<Point<f64>>> = path.runs().map(|run| run.iter().collect()).collect();
    let refers = (
        path.start_node(),
        path.end_node(),
        path.direction(),
        path.level(),
    );
    let paths = &layout.paths;
    let drawn = (paths.own_style(row), paths.rank().map(|ranks| ranks[row]));
    let curve = paths.written_curve(row);
    let of_path = values(&paths.attributes, row);
    let types = entries(paths.vehicle_types(), row);
    format!(
        "{:?} {runs:?} {refers:?} {drawn:?} {curve:?} {of_path} {types}",
        path.id()
    )
}

fn nodes(layout: &Layout) -> String {
    let nodes = &layout.nodes;
    all(0..nodes.len() as u32, |node| {
        let own = (nodes.id(node), nodes.position_m(node), nodes.level(node));
        let of_node = values(&nodes.attributes, node as usize);
        format!(
            "{own:?} {of_node} {}",
            entries(nodes.vehicle_types(), node as usize)
        )
    })
}

fn stations(layout: &Layout) -> String {
    let stations = &layout.stations;
    all(0..stations.len() as u32, |s| {
        let own = (
            stations.id(s),
            stations.position_m(s),
            stations.nodes(s),
            stations.level(s),
        );
        format!("{own:?} {}", values(&stations.attributes, s as usize))
    })
}

fn entries(entries: &TypeEntries, element: usize) -> String {
    let entry = |entry| {
        format!(
            "{:?} {}",
            entries.type_of(entry),
            values(&entries.attributes, entry)
        )
    };
    all(entries.entries(element), entry)
}

/// The values of a row with their names, types and units, in the order of the names.
fn values(attributes: &Attributes, row: usize) -> String {
    let cell = |column: &Attribute| {
        let value: Value<'_> = column.values.get(row)?;
        Some(format!("{:?}={value:?} {:?}", column.name, column.quantity))
    };
    let mut cells: Vec<String> = attributes.iter().filter_map(cell).collect();
    cells.sort();
    cells.join(", ")
}
