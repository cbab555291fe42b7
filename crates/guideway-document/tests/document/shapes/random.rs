//! Random sessions of edits of shapes: undo, redo and journals stay consistent, nothing is torn.

use guideway_document::{
    AlignTo, Document, JournalEntry, NewEdge, SelectMode, Shape, ShapeError, replay,
};
use guideway_layout::{CompareOptions, Layout, differences};
use guideway_spline::Point;
use proptest::prelude::*;

use super::network::{check, network};
use crate::site::p;

#[derive(Clone, Debug)]
enum Action {
    Select(u32),
    SelectAll,
    Split(Point<f64>),
    SplitCrossings,
    Join(u32),
    Weld(f64),
    Straighten,
    Align(Vec<u32>, u8),
    Distribute(Vec<u32>, Option<f64>),
    Fillet(u32, f64),
    Create([u32; 2], u8, u32, Point<f64>),
    MoveNode(u32, Point<f64>),
    Undo,
    Redo,
}

fn place() -> impl Strategy<Value = Point<f64>> {
    (-5.0..25.0, -15.0..15.0).prop_map(|(x, y)| p(x, y))
}

fn action() -> impl Strategy<Value = Action> {
    let row = || 0..200u32;
    let nodes = || prop::collection::vec(row(), 1..5);
    prop_oneof![
        2 => row().prop_map(Action::Select),
        2 => Just(Action::SelectAll),
        3 => place().prop_map(Action::Split),
        1 => Just(Action::SplitCrossings),
        3 => row().prop_map(Action::Join),
        1 => (0.01..1.0).prop_map(Action::Weld),
        1 => Just(Action::Straighten),
        1 => (nodes(), 0..3u8).prop_map(|(nodes, to)| Action::Align(nodes, to)),
        1 => (nodes(), prop::option::of(0.1..9.0))
            .prop_map(|(nodes, by)| Action::Distribute(nodes, by)),
        3 => (row(), 0.1..5.0).prop_map(|(node, radius)| Action::Fillet(node, radius)),
        2 => ([row(), row()], 0..3u8, row(), place())
            .prop_map(|(nodes, shape, along, at)| Action::Create(nodes, shape, along, at)),
        1 => (row(), place()).prop_map(|(node, to)| Action::MoveNode(node, to)),
        2 => Just(Action::Undo),
        1 => Just(Action::Redo),
    ]
}

fn perform(document: &mut Document, action: &Action) -> Result<(), ShapeError> {
    // Repeated splits would slow the test down.
    let is_small = document.scene().row_count() < 150;
    let (paths, nodes) = (document.layout().paths.len(), document.layout().nodes.len());
    // One past the last row is unknown.
    let path = |row: u32| row % (paths as u32 + 1);
    let node = |row: u32| row % (nodes as u32 + 1);
    match action {
        Action::Select(row) => {
            document.select([path(*row)].into_iter().collect(), SelectMode::Replace);
        }
        Action::SelectAll => document.select_all(),
        Action::Split(at) if is_small => {
            drop(document.split_at(&document.selection().clone(), *at, 4.0)?);
        }
        Action::SplitCrossings if is_small => {
            drop(document.split_at_crossings(&document.selection().clone())?);
        }
        Action::Split(_) | Action::SplitCrossings => {}
        // The first node from a row on where paths can be joined.
        Action::Join(row) => {
            let rows = (0..nodes as u32).map(|next| node(row + next));
            let mut failed = Ok(());
            for row in rows {
                match document.join_at(row) {
                    Ok(_) => return Ok(()),
                    Err(error) => failed = Err(error),
                }
            }
            failed?;
        }
        Action::Weld(tolerance) => drop(document.weld(&document.selection().clone(), *tolerance)?),
        Action::Straighten => document.straighten(&document.selection().clone())?,
        Action::Align(nodes, to) => {
            let nodes: Vec<u32> = nodes.iter().map(|row| node(*row)).collect();
            let to = [AlignTo::X, AlignTo::Y, AlignTo::Line][usize::from(*to)];
            document.align_nodes(&nodes, to)?;
        }
        Action::Distribute(nodes, spacing) => {
            let nodes: Vec<u32> = nodes.iter().map(|row| node(*row)).collect();
            document.distribute_nodes(&nodes, *spacing)?;
        }
        Action::Fillet(row, radius) => drop(document.fillet_at(node(*row), *radius)?),
        Action::Create(nodes, shape, along, at) => {
            let along = path(*along);
            let shape = match shape {
                0 => Shape::Arc { along },
                1 => Shape::ArcThrough(*at),
                _ => Shape::Spline {
                    through: vec![*at],
                    along: [Some(along), None],
                },
            };
            let [start_node, end_node] = nodes.map(node);
            let edge = NewEdge {
                start_node,
                end_node,
                curve: Some(document.curve_between([start_node, end_node], &shape)?),
                ..NewEdge::default()
            };
            // The nodes exist, and a name is made.
            drop(document.create_edge(&edge));
        }
        Action::MoveNode(row, to) => document.move_node(node(*row), *to)?,
        Action::Undo => drop(document.undo()),
        Action::Redo => drop(document.redo()),
    }
    Ok(())
}

fn same(found: &Layout, expected: &Layout) -> Result<(), TestCaseError> {
    let found = differences(expected, found, &CompareOptions::default());
    prop_assert!(found.is_empty(), "{found:?}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn networks_stay_whole(actions in prop::collection::vec(action(), 1..40)) {
        let mut document = network();
        let untouched = document.to_layout();
        for action in &actions {
            let before = (document.state(), document.to_layout());
            let done = perform(&mut document, action);
            if let Err(torn) = check(&document) {
                return Err(TestCaseError::fail(format!("{torn} after {action:?}")));
            }
            if let Err(error) = done {
                prop_assert_eq!(document.state(), before.0, "{}", error);
                same(&document.to_layout(), &before.1)?;
            }
        }
        let end = document.to_layout();
        let entries = document.take_journal_entries();
        let journal: Vec<u8> = entries.iter().flat_map(JournalEntry::to_record).collect();
        let mut recovered = network();
        prop_assert_eq!(replay(&journal, &mut recovered, |_| true).bytes, journal.len());
        same(&recovered.to_layout(), &end)?;
        let steps = std::iter::from_fn(|| document.undo()).count();
        same(&document.to_layout(), &untouched)?;
        prop_assert!(!document.is_changed());
        for _ in 0..steps {
            document.redo();
        }
        same(&document.to_layout(), &end)?;
    }
}
