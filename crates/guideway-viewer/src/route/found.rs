//! A found route with everything that the window shows of it.

use guideway_document::{PathSet, Snapshot};
use guideway_envelope::{ConvexPolygon, EnvelopeSource};
use guideway_network::{Place, RouteOptions, RouteRow, Router};
use guideway_scene::Table;

use super::track::Track;
use crate::language::say;

/// Greatest distance of the shown swept area from the exact one, in meters.
const AREA_TOLERANCE_M: f64 = 0.02;

/// A start or a goal: a node, or a station with its nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RoutePlace {
    pub(crate) name: String,
    /// Rows of its nodes.
    pub(crate) nodes: Vec<u32>,
}

/// A step of a route.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RouteStep {
    /// The path, with its row in the document.
    pub(crate) row: RouteRow,
    pub(crate) path: String,
    /// The node where the vehicle leaves.
    pub(crate) to: String,
}

/// A route from one place to another one.
#[derive(Default)]
pub(crate) struct FoundRoute {
    pub(crate) steps: Vec<RouteStep>,
    /// Rows of its paths.
    pub(crate) paths: PathSet,
    pub(crate) length_m: f64,
    pub(crate) time_s: f64,
    pub(crate) track: Track,
    /// The area that the vehicle sweeps; empty if the vehicle has none there.
    pub(crate) area: Vec<ConvexPolygon>,
}

impl FoundRoute {
    /// The fastest route for a vehicle type; takes a second for a million paths.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub(super) fn search(
        snapshot: &Snapshot,
        vehicle_type: Option<&str>,
        [from, to]: [&RoutePlace; 2],
        vehicle: Option<EnvelopeSource>,
    ) -> Result<Self, String> {
        let layout = snapshot.to_layout();
        let rows_of = Rows::of(snapshot);
        let router = Router::new(&layout, vehicle_type, &RouteOptions::default());
        let router = router.map_err(|error| error.to_string())?;
        let place = |place: &RoutePlace| {
            let nodes = place.nodes.iter();
            let nodes: Vec<u32> = nodes
                .filter_map(|&node| rows_of.compact_node(node))
                .collect();
            let name = place.name.clone();
            match nodes.is_empty() {
                true => Err(say!("{name} has no node; choose another place", name)),
                false => Ok(Place { name, nodes }),
            }
        };
        let route = router.route(&place(from)?, &place(to)?);
        let route = route.map_err(|error| error.to_string())?;
        let alone = route.layout(&layout);
        let step = |row: &RouteRow| RouteStep {
            path: layout.paths.id(row.path as usize).to_owned(),
            to: layout.nodes.id(row.to).to_owned(),
            row: RouteRow {
                path: rows_of.path(row.path),
                ..row.clone()
            },
        };
        let steps: Vec<RouteStep> = route.rows.iter().map(step).collect();
        let mut area = Vec::new();
        for path in 0..alone.paths.len() {
            if let Some(Ok(sweep)) = vehicle.map(|vehicle| vehicle.sweep(&alone, path)) {
                sweep.polygons(AREA_TOLERANCE_M, None, &mut |polygon| {
                    area.push(polygon.clone());
                });
            }
        }
        Ok(Self {
            paths: steps.iter().map(|step| step.row.path).collect(),
            steps,
            length_m: route.length_m,
            time_s: route.time_s,
            track: Track::of(&alone),
            area,
        })
    }
}

/// Rows of a layout without removed elements, and those of its document.
struct Rows {
    paths: Vec<usize>,
    nodes: Vec<usize>,
}

impl Rows {
    fn of(snapshot: &Snapshot) -> Self {
        Self {
            paths: snapshot.kept(Table::Paths),
            nodes: snapshot.kept(Table::Nodes),
        }
    }

    fn path(&self, compact: u32) -> u32 {
        let row = self.paths.get(compact as usize);
        row.map_or(compact, |&row| row as u32)
    }

    fn compact_node(&self, node: u32) -> Option<u32> {
        let place = self.nodes.binary_search(&(node as usize));
        place.ok().map(|place| place as u32)
    }
}

#[cfg(test)]
mod tests {
    use guideway_document::{Document, Elements};
    use guideway_layout::{Layout, NewPath};
    use guideway_spline::{Point, Runs};

    use super::*;

    /// Paths along a line of nodes, 10 m apart, and one path that leads nowhere before them.
    fn line() -> Layout {
        let mut layout = Layout::default();
        let at = |i: u32| Point::new(10.0 * f64::from(i), 0.0);
        for i in 0..4 {
            layout.nodes.push(&format!("n{i}"), at(i), None);
        }
        for (id, a, b) in [("gone", 3, 0), ("a", 0, 1), ("b", 1, 2), ("c", 2, 3)] {
            let mut runs = Runs::default();
            runs.push_line(at(a), at(b));
            layout.paths.push(&NewPath {
                id,
                runs: &runs,
                start_node: Some(a),
                end_node: Some(b),
                ..NewPath::default()
            });
        }
        layout
    }

    fn place(name: &str, node: u32) -> RoutePlace {
        let (name, nodes) = (name.to_owned(), vec![node]);
        RoutePlace { name, nodes }
    }

    #[test]
    fn route_has_rows_of_the_document_and_a_swept_area() {
        let mut document = Document::new(line().into(), &Default::default()).unwrap();
        let first = Elements::of_paths([0]);
        document.delete(&first, false).unwrap();
        let (from, to) = (place("n0", 0), place("n2", 2));
        let vehicle = "2x1".parse().ok();
        let found = FoundRoute::search(&document.snapshot(), None, [&from, &to], vehicle).unwrap();
        assert_eq!(found.paths.iter().collect::<Vec<_>>(), [1, 2]);
        assert_eq!((found.length_m, found.time_s), (20.0, 20.0));
        assert_eq!(found.steps[1].to, "n2");
        assert!((found.track.length_m() - 20.0).abs() < 1e-9);
        assert!(!found.area.is_empty());
        // Nothing leads back.
        let back = FoundRoute::search(&document.snapshot(), None, [&to, &from], vehicle);
        let why = back.err().unwrap();
        assert!(why.contains("no way leads from \"n2\" to \"n0\""), "{why}");
        let wrong = FoundRoute::search(&document.snapshot(), Some("tug"), [&from, &to], None);
        assert!(wrong.is_err());
    }
}
