//! Random editing sessions: undo, redo, replicas and journals stay consistent.

use std::sync::mpsc;

use guideway_document::{Document, JournalEntry, PointRef, SceneChange, SelectMode, replay};
use guideway_scene::PathState;
use guideway_spline::{Affine, Bounds, Point};
use proptest::prelude::*;

use crate::site::{document, p, scene_of};

#[derive(Clone, Debug)]
enum Action {
    SelectBox(Point<f64>, Point<f64>),
    SelectRow(u32),
    Move(Point<f64>),
    Turn(f64),
    Mirror,
    Copy(u32),
    Delete,
    Refine,
    MoveNode(u32, Point<f64>),
    MovePoint(u32, usize, Point<f64>),
    InsertPoint(u32, usize),
    RemovePoint(u32, usize),
    Draw(Vec<Point<f64>>),
    Hide,
    ShowAll,
    Undo,
    Redo,
}

fn place() -> impl Strategy<Value = Point<f64>> {
    (-20.0..20.0, -20.0..20.0).prop_map(|(x, y)| p(x, y))
}

fn action() -> impl Strategy<Value = Action> {
    prop_oneof![
        (place(), place()).prop_map(|(a, b)| Action::SelectBox(a, b)),
        (0..12u32).prop_map(Action::SelectRow),
        place().prop_map(Action::Move),
        (-3.0..3.0).prop_map(Action::Turn),
        Just(Action::Mirror),
        (1..3u32).prop_map(Action::Copy),
        Just(Action::Delete),
        Just(Action::Refine),
        (0..12u32, place()).prop_map(|(node, to)| Action::MoveNode(node, to)),
        (0..12u32, 0..6usize, place())
            .prop_map(|(path, point, to)| Action::MovePoint(path, point, to)),
        (0..12u32, 0..6usize).prop_map(|(path, point)| Action::InsertPoint(path, point)),
        (0..12u32, 0..6usize).prop_map(|(path, point)| Action::RemovePoint(path, point)),
        prop::collection::vec(place(), 0..5).prop_map(Action::Draw),
        Just(Action::Hide),
        Just(Action::ShowAll),
        Just(Action::Undo),
        Just(Action::Redo),
    ]
}

fn perform(document: &mut Document, action: &Action) {
    let center = p(1.0, 2.0);
    let at = |path, point| PointRef {
        path,
        run: 0,
        point,
    };
    // Rejected edits must change nothing; the comparisons at the end of the test detect it.
    let _ = match action {
        Action::SelectBox(a, b) => {
            if let Some(bounds) = Bounds::of_points([*a, *b]) {
                document.select_in(bounds, true, SelectMode::Replace);
            }
            Ok(())
        }
        Action::SelectRow(row) => {
            document.select([*row].into_iter().collect(), SelectMode::Add);
            Ok(())
        }
        Action::Move(by) => document.transform_selection("move", Affine::translation(*by)),
        Action::Turn(angle) => {
            document.transform_selection("turn", Affine::rotation(*angle, center))
        }
        Action::Mirror => document.transform_selection("mirror", Affine::mirror(center, center)),
        // Repeated doubling would exhaust memory.
        Action::Copy(_) if document.scene().row_count() > 500 => Ok(()),
        Action::Copy(count) => document.copy_selection(*count, center),
        Action::Delete => document.delete_selection(),
        Action::Refine if document.layout().paths.geometry().point_count() > 20_000 => Ok(()),
        Action::Refine => document.refine_selection(),
        Action::MoveNode(node, to) => document.move_node(*node, *to),
        Action::MovePoint(path, point, to) => document.move_point(at(*path, *point), *to),
        Action::InsertPoint(path, point) => document.insert_point(at(*path, *point)),
        Action::RemovePoint(path, point) => document.remove_point(at(*path, *point)),
        Action::Draw(points) => document.draw_path("drawn".into(), points, 0.5),
        Action::Hide => {
            document.hide_selection();
            Ok(())
        }
        Action::ShowAll => {
            document.show_all();
            Ok(())
        }
        Action::Undo => {
            document.undo();
            Ok(())
        }
        Action::Redo => {
            document.redo();
            Ok(())
        }
    };
}

/// The saved paths and nodes as text.
fn content(document: &Document) -> String {
    let layout = document.to_layout();
    let mut text = String::new();
    for path in layout.paths.iter() {
        let points: Vec<_> = path.runs().flat_map(|run| run.iter()).collect();
        let ends = (path.start_node(), path.end_node());
        let speed = layout.paths.attributes.get("speed");
        let speed = speed.and_then(|a| a.values.get(path.row()).map(|v| v.to_string()));
        text += &format!("{} {points:?} {ends:?} {speed:?}\n", path.id());
    }
    for node in 0..layout.nodes.len() as u32 {
        text += &format!("{:?}\n", layout.nodes.position_m(node));
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn undo_redo_replica_and_journal_stay_consistent(
        actions in prop::collection::vec(action(), 1..150),
    ) {
        let mut document = document(8);
        let untouched = content(&document);
        // A renderer with its own scene that receives only the edits.
        let mut replica = scene_of(document.to_layout());
        let (sender, receiver) = mpsc::channel();
        document.on_edit(move |change| {
            let change = match change {
                SceneChange::Edit(edit) => Ok(edit.clone()),
                SceneChange::Replaced(scene) => Err(scene.clone()),
            };
            sender.send(change).unwrap();
        });
        for action in &actions {
            perform(&mut document, action);
            for change in receiver.try_iter() {
                match change {
                    Ok(edit) => replica.edit(&edit).unwrap(),
                    Err(scene) => replica = scene,
                }
            }
            let all_shown = |&row: &u32| document.scene().state(row) == PathState::Shown;
            prop_assert!(document.selection().iter().all(|row| all_shown(&row)));
        }
        // A whole journal recovers the document; a truncated one is replayed as far as it goes.
        let entries = document.take_journal_entries();
        let journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
        let mut recovered = crate::site::document(8);
        prop_assert_eq!(replay(&journal, &mut recovered, |_| true).bytes, journal.len());
        prop_assert_eq!(content(&recovered), content(&document));
        let mut cut = crate::site::document(8);
        let half = &journal[..journal.len() / 2];
        prop_assert!(replay(half, &mut cut, |_| true).bytes <= half.len());
        let mut stopped = crate::site::document(8);
        let done = replay(&journal, &mut stopped, |done| done.entries < 2);
        prop_assert_eq!(done.entries, entries.len().min(2));
        prop_assert_eq!(replica.draw_order(), document.scene().draw_order());
        for &row in replica.draw_order() {
            let points = |layout: &guideway_layout::Layout| -> Vec<_> {
                layout.paths.get(row as usize).runs().flat_map(|run| run.iter()).collect()
            };
            prop_assert_eq!(points(replica.layout()), points(document.layout()));
        }
        let end = content(&document);
        let steps = std::iter::from_fn(|| document.undo()).count();
        prop_assert_eq!(&content(&document), &untouched);
        prop_assert!(!document.is_changed());
        for _ in 0..steps {
            document.redo();
        }
        prop_assert_eq!(content(&document), end);
    }
}

proptest! {
    #[test]
    fn damaged_journals_are_replayed_without_panic(
        actions in prop::collection::vec(action(), 1..10),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
        noise in prop::collection::vec(any::<u8>(), 0..100),
    ) {
        let mut document = document(8);
        actions.iter().for_each(|action| perform(&mut document, action));
        let entries = document.take_journal_entries();
        let mut journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
        for (at, byte) in damage {
            if !journal.is_empty() {
                *at.get_mut(&mut journal) = byte;
            }
        }
        for bytes in [journal, noise] {
            let mut recovered = crate::site::document(8);
            prop_assert!(replay(&bytes, &mut recovered, |_| true).bytes <= bytes.len());
        }
    }
}
