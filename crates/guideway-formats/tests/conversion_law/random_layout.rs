//! Random layouts with every feature of the model.

use guideway_layout::{
    Block, Direction, GeoOrigin, Layout, Level, Member, NewPath, OwnStyle, Quantity, Value,
    VehicleType, WrittenCurve, Zone,
};
use guideway_spline::{Point, Runs, bezier_to_runs, polyline_to_runs};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Names with spaces, quotes, other scripts, and a name that is empty.
const NAMES: [&str; 6] = ["A", "Halle 2", "Tor \"7\"", "通道", "a<b>&c", "x/y, z"];

/// Returns the layout of a seed.
pub(crate) fn random_layout(seed: u64) -> Layout {
    let mut random = Random(Pcg64Mcg::seed_from_u64(seed));
    let mut layout = Layout::default();
    for level in 0..random.below(3) {
        layout.levels.push(Level {
            id: format!("L{level}"),
            name: random.sometimes(|r| r.name()),
            elevation_m: random.sometimes(|r| r.number()),
            ..Level::default()
        });
    }
    random.add_nodes(&mut layout);
    random.add_paths(&mut layout);
    random.add_stations(&mut layout);
    random.add_groups(&mut layout);
    layout
}

struct Random(Pcg64Mcg);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        (self.0.next_u64() % count as u64) as usize
    }

    fn chance(&mut self, one_in: usize) -> bool {
        self.below(one_in) == 0
    }

    fn sometimes<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        self.chance(2).then(|| make(self))
    }

    fn name(&mut self) -> String {
        NAMES[self.below(NAMES.len())].to_owned()
    }

    /// A number with three decimals, as people write them.
    fn number(&mut self) -> f64 {
        (self.below(200_000) as f64 - 100_000.0) / 1000.0
    }

    fn point(&mut self) -> Point<f64> {
        Point::new(self.number(), self.number())
    }

    fn level(&mut self, layout: &Layout) -> Option<u32> {
        let count = layout.levels.len();
        (count > 0 && !self.chance(8)).then(|| self.below(count) as u32)
    }

    fn add_nodes(&mut self, layout: &mut Layout) {
        for node in 0..self.below(8) {
            let (at, level) = (self.point(), self.level(layout));
            let types: &[&str] = if self.chance(6) { &["tug"] } else { &[] };
            let row = layout
                .nodes
                .push_for_types(&format!("n{node}"), at, level, types);
            if self.chance(3) {
                let name = self.name();
                layout
                    .nodes
                    .attributes
                    .set(row as usize, "name", Value::Text(&name));
            }
            if self.chance(4) {
                let angle = self.number() / 100.0;
                let attributes = &mut layout.nodes.attributes;
                attributes.set_quantity(row as usize, "theta", angle, Quantity::Angle);
            }
        }
    }

    fn curve(&mut self, from: Point<f64>, to: Point<f64>) -> (Runs, Option<WrittenCurve>) {
        let mut runs = Runs::default();
        match self.below(4) {
            0 => runs.push_line(from, to),
            1 => drop(polyline_to_runs(&[from, self.point(), to], &mut runs)),
            2 => {
                let points = [from, self.point(), self.point(), to];
                bezier_to_runs(&points, 1e-6, &mut runs).expect("four finite points");
            }
            _ => {
                runs.push_line(from, to);
                let middle = from.lerp(to, 0.5);
                let written = WrittenCurve {
                    degree: 2,
                    knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
                    points_m: vec![from, middle, to],
                    weights: Some(vec![1.0, 2.0, 1.0]),
                };
                return (runs, Some(written));
            }
        }
        (runs, None)
    }

    fn add_paths(&mut self, layout: &mut Layout) {
        for path in 0..self.below(8) {
            let nodes = layout.nodes.len();
            let mut end = || (nodes > 0 && !self.chance(6)).then(|| self.below(nodes) as u32);
            let ends = [end(), end()];
            let points = ends.map(|node| match node {
                Some(node) => layout.nodes.position_m(node),
                None => self.point(),
            });
            let (runs, written) = self.curve(points[0], points[1]);
            let types: &[&str] = [&[][..], &["tug"], &["fork", "tug"]][self.below(3)];
            let direction = match self.chance(3) {
                true => Direction::Both,
                false => Direction::Forward,
            };
            let row = layout.paths.push(&NewPath {
                id: &format!("e{path}"),
                runs: &runs,
                start_node: ends[0],
                end_node: ends[1],
                direction,
                level: self.level(layout),
                vehicle_types: types,
            });
            if let Some(written) = written {
                layout.paths.set_written_curve(row, written);
            }
            self.add_properties(layout, row);
            if self.chance(5) {
                let style = OwnStyle {
                    width_m: self.sometimes(|_| 0.5),
                    color_rgba: self.sometimes(|_| 0xFF00_00FF),
                };
                layout.paths.set_own_style(row, style);
            }
        }
    }

    fn add_properties(&mut self, layout: &mut Layout, row: usize) {
        let speed = self.below(3000) as f64 / 1000.0;
        let entries = layout.paths.vehicle_types().entries(row);
        if entries.len() > 1 && self.chance(2) {
            let attributes = &mut layout.paths.vehicle_types_mut().attributes;
            for (i, entry) in entries.enumerate() {
                let speed = speed + i as f64;
                attributes.set_quantity(entry, "maxSpeed", speed, Quantity::Speed);
            }
        } else if self.chance(2) {
            let attributes = &mut layout.paths.attributes;
            attributes.set_quantity(row, "maxSpeed", speed, Quantity::Speed);
        }
        let attributes = &mut layout.paths.attributes;
        if self.chance(4) {
            attributes.set(row, "rotationAllowed", Value::Bool(self.chance(2)));
        }
        if self.chance(5) {
            attributes.set(row, "serial", Value::Int(i64::MAX - self.below(9) as i64));
        }
        if self.chance(6) {
            let actions = r#"[{"actionType":"beep","blockingType":"NONE"}]"#;
            attributes.set(row, "actions", Value::Json(actions));
        }
        if self.chance(6) {
            let name = self.name();
            attributes.set(row, "name", Value::Text(&name));
        }
    }

    fn add_stations(&mut self, layout: &mut Layout) {
        for station in 0..self.below(4) {
            let nodes = layout.nodes.len();
            let at_nodes = match nodes {
                0 => Vec::new(),
                nodes => vec![self.below(nodes) as u32],
            };
            let at = self.sometimes(Self::point);
            let level = self.level(layout);
            let row = layout
                .stations
                .push(&format!("s{station}"), at, at_nodes, level);
            if self.chance(2) {
                let attributes = &mut layout.stations.attributes;
                attributes.set_quantity(row as usize, "height", 1.2, Quantity::Length);
                attributes.set(row as usize, "kind", Value::Text("PICK"));
            }
        }
    }

    fn add_groups(&mut self, layout: &mut Layout) {
        if self.chance(3) {
            let mut tug = VehicleType {
                id: "tug".into(),
                ..VehicleType::default()
            };
            tug.attributes
                .set_quantity(0, "maxSpeed", 1.5, Quantity::Speed);
            layout.vehicle_types.push(tug);
        }
        // One without properties, which paths and nodes may name or not.
        if self.chance(3) {
            let id = ["fork", "crane"][self.below(2)].to_owned();
            layout.vehicle_types.push(VehicleType {
                id,
                ..VehicleType::default()
            });
        }
        if !layout.paths.is_empty() && self.chance(3) {
            layout.blocks.push(Block {
                id: "b1".into(),
                members: vec![Member::Path(self.below(layout.paths.len()) as u32)],
                ..Block::default()
            });
        }
        if self.chance(4) {
            layout.zones.push(Zone {
                id: "z1".into(),
                outline_m: (0..3).map(|_| self.point()).collect(),
                level: self.level(layout),
                ..Zone::default()
            });
        }
        if self.chance(4) {
            let name = self.name();
            layout.attributes.set(0, "project", Value::Text(&name));
        }
        if self.chance(8) {
            layout.geo_origin = Some(GeoOrigin {
                longitude_deg: 11.6,
                latitude_deg: 48.1,
            });
        }
    }
}
