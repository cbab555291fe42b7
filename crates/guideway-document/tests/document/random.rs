//! A long day of editing: whatever is done, undone and done again, nothing is lost.

use std::sync::mpsc;

use guideway_document::{Document, JournalEntry, PointRef, SelectMode, replay};
use guideway_scene::PathState;
use guideway_spline::{Affine, Bounds, Point};
use proptest::prelude::*;

use crate::site::{document, p, scene_of};

#[derive(Clone, Debug)]
enum Deed {
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

fn deed() -> impl Strategy<Value = Deed> {
    prop_oneof![
        (place(), place()).prop_map(|(a, b)| Deed::SelectBox(a, b)),
        (0..12u32).prop_map(Deed::SelectRow),
        place().prop_map(Deed::Move),
        (-3.0..3.0).prop_map(Deed::Turn),
        Just(Deed::Mirror),
        (1..3u32).prop_map(Deed::Copy),
        Just(Deed::Delete),
        Just(Deed::Refine),
        (0..12u32, place()).prop_map(|(node, to)| Deed::MoveNode(node, to)),
        (0..12u32, 0..6usize, place())
            .prop_map(|(path, point, to)| Deed::MovePoint(path, point, to)),
        (0..12u32, 0..6usize).prop_map(|(path, point)| Deed::InsertPoint(path, point)),
        (0..12u32, 0..6usize).prop_map(|(path, point)| Deed::RemovePoint(path, point)),
        prop::collection::vec(place(), 0..5).prop_map(Deed::Draw),
        Just(Deed::Hide),
        Just(Deed::ShowAll),
        Just(Deed::Undo),
        Just(Deed::Redo),
    ]
}

fn perform(document: &mut Document, deed: &Deed) {
    let center = p(1.0, 2.0);
    let at = |path, point| PointRef {
        path,
        run: 0,
        point,
    };
    // What cannot be done is refused, and must change nothing: the end of the test would tell.
    let _ = match deed {
        Deed::SelectBox(a, b) => {
            if let Some(bounds) = Bounds::of_points([*a, *b]) {
                document.select_in(bounds, true, SelectMode::Replace);
            }
            Ok(())
        }
        Deed::SelectRow(row) => {
            document.select([*row].into_iter().collect(), SelectMode::Add);
            Ok(())
        }
        Deed::Move(by) => document.transform_selection("move", Affine::translation(*by)),
        Deed::Turn(angle) => document.transform_selection("turn", Affine::rotation(*angle, center)),
        Deed::Mirror => document.transform_selection("mirror", Affine::mirror(center, center)),
        // Doubling for ever would fill any memory.
        Deed::Copy(_) if document.scene().row_count() > 500 => Ok(()),
        Deed::Copy(count) => document.copy_selection(*count, center),
        Deed::Delete => document.delete_selection(),
        Deed::Refine if document.layout().paths.geometry().point_count() > 20_000 => Ok(()),
        Deed::Refine => document.refine_selection(),
        Deed::MoveNode(node, to) => document.move_node(*node, *to),
        Deed::MovePoint(path, point, to) => document.move_point(at(*path, *point), *to),
        Deed::InsertPoint(path, point) => document.insert_point(at(*path, *point)),
        Deed::RemovePoint(path, point) => document.remove_point(at(*path, *point)),
        Deed::Draw(points) => document.draw_path("drawn".into(), points, 0.5),
        Deed::Hide => {
            document.hide_selection();
            Ok(())
        }
        Deed::ShowAll => {
            document.show_all();
            Ok(())
        }
        Deed::Undo => {
            document.undo();
            Ok(())
        }
        Deed::Redo => {
            document.redo();
            Ok(())
        }
    };
}

/// All that is saved of the paths and nodes.
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
    fn everything_can_be_undone_and_done_again(deeds in prop::collection::vec(deed(), 1..150)) {
        let mut document = document(8);
        let untouched = content(&document);
        // A renderer that has a scene of its own and hears of edits alone.
        let mut replica = scene_of(document.to_layout());
        let (tell, told) = mpsc::channel();
        document.on_edit(move |edit| tell.send(edit.clone()).unwrap());
        for deed in &deeds {
            perform(&mut document, deed);
            for edit in told.try_iter() {
                replica.edit(&edit).unwrap();
            }
            let all_shown = |&row: &u32| document.scene().state(row) == PathState::Shown;
            prop_assert!(document.selection().iter().all(|row| all_shown(&row)));
        }
        // What a journal gives back is what was done: whole, and as far as it goes where it was cut off.
        let acts = document.take_journal_entries();
        let journal: Vec<u8> = acts.iter().flat_map(JournalEntry::to_record).collect();
        let mut recovered = crate::site::document(8);
        prop_assert_eq!(replay(&journal, &mut recovered, |_| true).bytes, journal.len());
        prop_assert_eq!(content(&recovered), content(&document));
        let mut cut = crate::site::document(8);
        let half = &journal[..journal.len() / 2];
        prop_assert!(replay(half, &mut cut, |_| true).bytes <= half.len());
        let mut stopped = crate::site::document(8);
        let done = replay(&journal, &mut stopped, |done| done.entries < 2);
        prop_assert_eq!(done.entries, acts.len().min(2));
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
    fn no_bytes_are_a_journal_that_breaks_it(
        deeds in prop::collection::vec(deed(), 1..10),
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
        noise in prop::collection::vec(any::<u8>(), 0..100),
    ) {
        let mut document = document(8);
        deeds.iter().for_each(|deed| perform(&mut document, deed));
        let mut journal: Vec<u8> = document.take_journal_entries().iter().flat_map(JournalEntry::to_record).collect();
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
