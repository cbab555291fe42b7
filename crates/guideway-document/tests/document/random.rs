//! A long day of editing: whatever is done, undone and done again, nothing is lost.

use guideway_document::{Combine, Document, PointRef};
use guideway_scene::PathState;
use guideway_spline::{Affine, Bounds, Point};
use proptest::prelude::*;

use crate::site::{document, p, scene_of};

#[derive(Clone, Debug)]
enum Act {
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

fn act() -> impl Strategy<Value = Act> {
    prop_oneof![
        (place(), place()).prop_map(|(a, b)| Act::SelectBox(a, b)),
        (0..12u32).prop_map(Act::SelectRow),
        place().prop_map(Act::Move),
        (-3.0..3.0).prop_map(Act::Turn),
        Just(Act::Mirror),
        (1..3u32).prop_map(Act::Copy),
        Just(Act::Delete),
        Just(Act::Refine),
        (0..12u32, place()).prop_map(|(node, to)| Act::MoveNode(node, to)),
        (0..12u32, 0..6usize, place())
            .prop_map(|(path, point, to)| Act::MovePoint(path, point, to)),
        (0..12u32, 0..6usize).prop_map(|(path, point)| Act::InsertPoint(path, point)),
        (0..12u32, 0..6usize).prop_map(|(path, point)| Act::RemovePoint(path, point)),
        prop::collection::vec(place(), 0..5).prop_map(Act::Draw),
        Just(Act::Hide),
        Just(Act::ShowAll),
        Just(Act::Undo),
        Just(Act::Redo),
    ]
}

fn perform(document: &mut Document, act: &Act) {
    let center = p(1.0, 2.0);
    let at = |path, point| PointRef {
        path,
        run: 0,
        point,
    };
    // What cannot be done is refused, and must change nothing: the end of the test would tell.
    let _ = match act {
        Act::SelectBox(a, b) => {
            if let Some(bounds) = Bounds::of_points([*a, *b]) {
                document.select_in(bounds, true, Combine::Replace);
            }
            Ok(())
        }
        Act::SelectRow(row) => {
            document.select([*row].into_iter().collect(), Combine::Add);
            Ok(())
        }
        Act::Move(by) => document.transform_selection("move", Affine::translation(*by)),
        Act::Turn(angle) => document.transform_selection("turn", Affine::rotation(*angle, center)),
        Act::Mirror => document.transform_selection("mirror", Affine::mirror(center, center)),
        // Doubling for ever would fill any memory.
        Act::Copy(_) if document.scene().row_count() > 500 => Ok(()),
        Act::Copy(count) => document.copy_selection(*count, center),
        Act::Delete => document.delete_selection(),
        Act::Refine if document.layout().paths.geometry().point_count() > 20_000 => Ok(()),
        Act::Refine => document.refine_selection(),
        Act::MoveNode(node, to) => document.move_node(*node, *to),
        Act::MovePoint(path, point, to) => document.move_point(at(*path, *point), *to),
        Act::InsertPoint(path, point) => document.insert_point(at(*path, *point)),
        Act::RemovePoint(path, point) => document.remove_point(at(*path, *point)),
        Act::Draw(points) => document.draw_path("drawn".into(), points, 0.5),
        Act::Hide => {
            document.hide_selection();
            Ok(())
        }
        Act::ShowAll => {
            document.show_all();
            Ok(())
        }
        Act::Undo => {
            document.undo();
            Ok(())
        }
        Act::Redo => {
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
    fn everything_can_be_undone_and_done_again(acts in prop::collection::vec(act(), 1..150)) {
        let mut document = document(8);
        let untouched = content(&document);
        // A renderer that has a scene of its own and hears of edits alone.
        let mut replica = scene_of(document.to_layout());
        for act in &acts {
            perform(&mut document, act);
            for edit in document.take_news() {
                replica.edit(&edit).unwrap();
            }
            let all_shown = |&row: &u32| document.scene().state(row) == PathState::Shown;
            prop_assert!(document.selection().iter().all(|row| all_shown(&row)));
        }
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
