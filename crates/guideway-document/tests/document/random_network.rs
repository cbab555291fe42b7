//! Random operations on random networks: nothing is torn or orphaned, and undo, redo and the
//! journal give the same model.

use guideway_document::{
    Document, Elements, JournalEntry, Neighbors, NewEdge, PathSet, PointRef, PropertyRef, replay,
};
use guideway_layout::{CompareOptions, Direction, Layout, Level, NewPath, Value, differences};
use guideway_scene::Table;
use guideway_spline::{Affine, Point, Runs};
use proptest::prelude::*;

use crate::random_groups::{GroupAction, group_action};
use crate::site::{document_of, p};

/// Distance of stations from their nodes in a new network, in meters.
const OFFSET_M: f64 = 1.0;
const TOLERANCE_M: f64 = 1e-6;

#[derive(Clone, Debug)]
enum Action {
    Set(Table, Vec<u32>, &'static str, bool, Option<i8>),
    Rename(Table, u32, u8),
    CreateNode(Point<f64>),
    CreateEdge(u32, u32),
    CreateStation(Vec<u32>),
    Reverse(Vec<u32>),
    Direct(Vec<u32>, bool),
    SetTypes(Table, Vec<u32>, Vec<&'static str>),
    SetLevel([Vec<u32>; 3], Option<u32>),
    Delete([Vec<u32>; 3], bool),
    Transform([Vec<u32>; 3], f64, Point<f64>, bool),
    MoveNode(u32, Point<f64>),
    MovePoint(u32, usize, Point<f64>),
    InsertPoint(u32, usize),
    RemovePoint(u32, usize),
    Draw(Vec<Point<f64>>),
    Copy([Vec<u32>; 3], u32, Point<f64>),
    Paste([Vec<u32>; 3], Point<f64>),
    Group(GroupAction),
    Undo,
    Redo,
}

fn place() -> impl Strategy<Value = Point<f64>> {
    (-20.0..20.0, -20.0..20.0).prop_map(|(x, y)| p(x, y))
}

fn table() -> impl Strategy<Value = Table> {
    prop::sample::select(vec![Table::Paths, Table::Nodes, Table::Stations])
}

fn rows() -> impl Strategy<Value = Vec<u32>> {
    prop::collection::vec(0..14u32, 0..5)
}

fn elements() -> impl Strategy<Value = [Vec<u32>; 3]> {
    [rows(), rows(), rows()]
}

fn types() -> impl Strategy<Value = Vec<&'static str>> {
    prop::sample::subsequence(vec!["tug", "fork", "crane"], 0..=3)
}

fn action() -> impl Strategy<Value = Action> {
    let column = prop::sample::select(vec!["maxSpeed", "note", "theta", "lanes"]);
    let set = (table(), rows(), column, any::<bool>(), any::<Option<i8>>());
    let point = || (0..14u32, 0..5usize);
    prop_oneof![
        4 => set.prop_map(|(of, rows, name, per_type, v)| Action::Set(of, rows, name, per_type, v)),
        1 => (table(), 0..14u32, any::<u8>()).prop_map(|(of, row, id)| Action::Rename(of, row, id)),
        1 => place().prop_map(Action::CreateNode),
        1 => (0..14u32, 0..14u32).prop_map(|(a, b)| Action::CreateEdge(a, b)),
        1 => rows().prop_map(Action::CreateStation),
        1 => rows().prop_map(Action::Reverse),
        1 => (rows(), any::<bool>()).prop_map(|(rows, both)| Action::Direct(rows, both)),
        1 => (table(), rows(), types()).prop_map(|(of, rows, t)| Action::SetTypes(of, rows, t)),
        1 => (elements(), prop::option::of(0..3u32)).prop_map(|(e, l)| Action::SetLevel(e, l)),
        1 => (elements(), any::<bool>()).prop_map(|(e, with)| Action::Delete(e, with)),
        3 => (elements(), -3.0..3.0, place(), any::<bool>())
            .prop_map(|(e, angle, by, detach)| Action::Transform(e, angle, by, detach)),
        2 => (0..14u32, place()).prop_map(|(node, to)| Action::MoveNode(node, to)),
        2 => (point(), place()).prop_map(|((path, i), to)| Action::MovePoint(path, i, to)),
        1 => point().prop_map(|(path, i)| Action::InsertPoint(path, i)),
        1 => point().prop_map(|(path, i)| Action::RemovePoint(path, i)),
        1 => prop::collection::vec(place(), 0..4).prop_map(Action::Draw),
        1 => (elements(), 1..3u32, place()).prop_map(|(e, n, by)| Action::Copy(e, n, by)),
        1 => (elements(), place()).prop_map(|(e, by)| Action::Paste(e, by)),
        3 => group_action().prop_map(Action::Group),
        2 => Just(Action::Undo),
        1 => Just(Action::Redo),
    ]
}

/// A network of some nodes, paths between them, and a station at each third node.
fn network() -> impl Strategy<Value = Layout> {
    let nodes = prop::collection::vec(place(), 3..9);
    let path = (0..9usize, 0..9usize, place(), types(), any::<bool>());
    (nodes, prop::collection::vec(path, 1..12)).prop_map(|(nodes, paths)| {
        let mut layout = Layout::default();
        for id in ["ground", "upper"] {
            layout.levels.push(Level {
                id: id.into(),
                ..Level::default()
            });
        }
        for (row, &at_m) in nodes.iter().enumerate() {
            let node = layout.nodes.push(&format!("n{row}"), at_m, Some(0));
            if row % 3 == 0 {
                let at_m = Some(at_m + p(0.0, OFFSET_M));
                layout
                    .stations
                    .push(&format!("s{row}"), at_m, vec![node], Some(0));
            }
        }
        layout
            .stations
            .push("rack", Some(nodes[0]), vec![0, 1], None);
        for (row, (a, b, bend, types, both)) in paths.into_iter().enumerate() {
            let (a, b) = (a % nodes.len(), b % nodes.len());
            let mut runs = Runs::default();
            runs.push_bezier(&[nodes[a], bend, bend, nodes[b]]);
            let path = layout.paths.push(&NewPath {
                id: &format!("p{row}"),
                runs: &runs,
                start_node: Some(a as u32),
                end_node: Some(b as u32),
                direction: if both {
                    Direction::Both
                } else {
                    Direction::Forward
                },
                level: Some(0),
                vehicle_types: &types,
            });
            layout
                .paths
                .attributes
                .set(path, "lanes", Value::Int(row as i64));
        }
        layout
    })
}

fn perform(document: &mut Document, action: &Action) {
    // Most rows exist; the largest ones do not.
    let row = |of: Table, row: u32| {
        let existing: Vec<u32> = document.existing(of).collect();
        let found = existing.get(row as usize % existing.len().max(1)).copied();
        found.filter(|_| row < 13).unwrap_or(99_999)
    };
    let set = |of: Table, rows: &[u32]| rows.iter().map(|&r| row(of, r)).collect::<PathSet>();
    let of = |[paths, nodes, stations]: &[Vec<u32>; 3]| Elements {
        paths: set(Table::Paths, paths),
        nodes: set(Table::Nodes, nodes),
        stations: set(Table::Stations, stations),
        ..Elements::default()
    };
    let at = |path, point| PointRef {
        path: row(Table::Paths, path),
        run: 0,
        point,
    };
    let is_large = document.scene().row_count() > 300;
    // Rejected operations must change nothing; the comparisons of the test detect it.
    match action {
        Action::Set(of, rows, name, per_type, value) => {
            let property = PropertyRef {
                of: *of,
                name,
                vehicle_type: per_type.then_some("tug"),
            };
            let text = value.map(|v| v.to_string());
            let value = match (*name, &text, value) {
                ("note", Some(text), _) => Some(Value::Text(text)),
                ("lanes", _, Some(v)) => Some(Value::Int(i64::from(*v))),
                (_, _, Some(v)) => Some(Value::Float(f64::from(*v) / 8.0)),
                _ => None,
            };
            let rows = set(*of, rows);
            drop(document.set_property(property, &rows, value));
        }
        Action::Rename(of, at, id) => {
            let at = row(*of, *at);
            drop(document.rename(*of, at, &format!("r{id}")));
        }
        Action::CreateNode(at_m) => drop(document.create_node(None, *at_m, Some(1))),
        Action::CreateEdge(start_node, end_node) => {
            let edge = NewEdge {
                start_node: row(Table::Nodes, *start_node),
                end_node: row(Table::Nodes, *end_node),
                ..NewEdge::default()
            };
            drop(document.create_edge(&edge));
        }
        Action::CreateStation(nodes) => {
            let nodes: Vec<u32> = set(Table::Nodes, nodes).iter().collect();
            drop(document.create_station(None, &nodes, None, None));
        }
        Action::Reverse(rows) => {
            let rows = set(Table::Paths, rows);
            drop(document.reverse(&rows));
        }
        Action::Direct(rows, both) => {
            let direction = if *both {
                Direction::Both
            } else {
                Direction::Forward
            };
            let rows = set(Table::Paths, rows);
            drop(document.set_direction(&rows, direction));
        }
        Action::SetTypes(of, rows, types) => {
            let rows = set(*of, rows);
            drop(document.set_vehicle_types(*of, &rows, types));
        }
        Action::SetLevel(elements, level) => {
            let elements = of(elements);
            drop(document.set_level(&elements, *level));
        }
        Action::Delete(elements, with) => {
            let elements = of(elements);
            drop(document.delete(&elements, *with));
        }
        Action::Transform(elements, angle, by, detach) => {
            let neighbors = if *detach {
                Neighbors::Detach
            } else {
                Neighbors::Follow
            };
            let elements = Elements {
                // A station that is moved alone may leave its nodes.
                stations: PathSet::new(),
                ..of(elements)
            };
            let by = Affine::rotation(*angle, *by);
            drop(document.transform("turn", &elements, by, neighbors));
        }
        Action::MoveNode(node, to_m) => {
            let node = row(Table::Nodes, *node);
            drop(document.move_node(node, *to_m));
        }
        Action::MovePoint(path, point, to_m) => {
            let point = at(*path, *point);
            drop(document.move_point(point, *to_m));
        }
        Action::InsertPoint(path, point) => {
            let point = at(*path, *point);
            drop(document.insert_point(point));
        }
        Action::RemovePoint(path, point) => {
            let point = at(*path, *point);
            drop(document.remove_point(point));
        }
        Action::Draw(points) => drop(document.draw_path("drawn".into(), points, 4.0)),
        Action::Copy(..) | Action::Paste(..) if is_large => {}
        Action::Copy(elements, count, by) => {
            let elements = of(elements);
            drop(document.copy(&elements, *count, *by));
        }
        Action::Paste(elements, by) => {
            if let Ok(clip) = document.clip(&of(elements)) {
                drop(document.paste(&clip, Affine::translation(*by), None));
            }
        }
        Action::Group(action) => action.perform(document),
        Action::Undo => drop(document.undo()),
        Action::Redo => drop(document.redo()),
    }
}

/// The first element that is torn off or orphaned, as text; `None` without one.
fn fault(document: &Document) -> Option<String> {
    let layout = document.layout();
    for row in document.existing(Table::Paths) {
        let path = layout.paths.get(row as usize);
        let (start, end) = path.ends()?;
        for (node, at_m) in [(path.start_node(), start), (path.end_node(), end)] {
            let Some(node) = node else { continue };
            let gap_m = document.node_position_m(node).distance(at_m);
            if !document.scene().exists(Table::Nodes, node) || gap_m > TOLERANCE_M {
                return Some(format!("path {row} is {gap_m} m from node {node}"));
            }
            if !document.index().paths_at(node).any(|path| path == row) {
                return Some(format!("the index lacks path {row} at node {node}"));
            }
        }
    }
    for row in document.existing(Table::Stations) {
        let nodes = layout.stations.nodes(row);
        if let Some(node) = nodes
            .iter()
            .find(|&&n| !document.scene().exists(Table::Nodes, n))
        {
            return Some(format!("station {row} has the removed node {node}"));
        }
        let ([node], true) = (nodes, layout.stations.id(row).starts_with('s')) else {
            continue;
        };
        let at_m = layout.stations.position_m(row)?;
        let away_m = document.node_position_m(*node).distance(at_m);
        // A created station is at its first node, and may lose it.
        let is_first = layout.stations.id(row).starts_with("station");
        if !is_first && away_m > OFFSET_M + TOLERANCE_M {
            return Some(format!("station {row} is {away_m} m from node {node}"));
        }
    }
    let saved = document.to_layout();
    let is_known = |node: Option<u32>| node.is_none_or(|n| (n as usize) < saved.nodes.len());
    let are_known = |path: guideway_layout::PathRef<'_>| {
        is_known(path.start_node()) && is_known(path.end_node())
    };
    (!saved.paths.iter().all(are_known)).then(|| "a path has an unknown node".to_owned())
}

/// The differences between two layouts, exactly.
fn difference(a: &Layout, b: &Layout) -> Vec<guideway_layout::Difference> {
    let exact = CompareOptions {
        tolerance_m: 0.0,
        relative_tolerance: 0.0,
    };
    let mut found = differences(a, b, &exact);
    found.extend(differences(b, a, &exact));
    found
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn operations_undo_redo_and_replay_to_the_same_network(
        layout in network(),
        actions in prop::collection::vec(action(), 1..60),
    ) {
        let mut document = document_of(layout.clone());
        for action in &actions {
            perform(&mut document, action);
            let fault = fault(&document);
            prop_assert!(fault.is_none(), "{action:?}: {fault:?}");
        }
        let entries = document.take_journal_entries();
        let journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
        let mut recovered = document_of(layout.clone());
        prop_assert_eq!(replay(&journal, &mut recovered, |_| true).bytes, journal.len());
        let end = document.to_layout();
        prop_assert_eq!(difference(&end, &recovered.to_layout()), []);
        let steps = std::iter::from_fn(|| document.undo()).count();
        prop_assert_eq!(difference(&layout, &document.to_layout()), []);
        for _ in 0..steps {
            document.redo();
        }
        prop_assert_eq!(difference(&end, &document.to_layout()), []);
    }
}

#[test]
fn a_rejected_paste_leaves_the_journal_in_step() {
    let mut layout = Layout::default();
    layout.nodes.push("a", p(0.0, 0.0), None);
    let mut runs = Runs::default();
    // The node is within reach after the paste, the curve is not.
    runs.push_line(p(0.0, 0.0), p(6e8, 0.0));
    layout.paths.push(&NewPath {
        id: "far",
        runs: &runs,
        start_node: Some(0),
        ..NewPath::default()
    });
    let mut document = document_of(layout.clone());
    let far = document.clip(&Elements::of_paths([0])).unwrap();
    let by = Affine::translation(p(6e8, 0.0));
    assert!(document.paste(&far, by, None).is_err());
    let node = document.create_node(Some("b"), p(1.0, 1.0), None).unwrap();
    document.move_node(node, p(2.0, 2.0)).unwrap();
    assert_eq!(document.to_layout().nodes.len(), 2);
    let entries = document.take_journal_entries();
    let journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
    let mut recovered = document_of(layout);
    replay(&journal, &mut recovered, |_| true);
    assert_eq!(
        difference(&document.to_layout(), &recovered.to_layout()),
        []
    );
    assert_eq!(recovered.node_position_m(node), p(2.0, 2.0));
}
