//! Commands that arrange the selected paths and nodes: split, join, reverse, straighten, align.

use std::collections::BTreeMap;

use guideway_document::{AlignTo, Document, PathSet, ShapeError};
use guideway_layout::{Direction, UserError};
use guideway_scene::Table;
use guideway_spline::Point;

use crate::command::Command;
use crate::editing::EditTask;
use crate::language::t;

/// Distance from a path at which it is split at its middle, in meters.
const ON_PATH_M: f64 = 1e-3;

/// The pointer and the distance within which it means a path, in meters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PointerPlace {
    pub(crate) at_m: Point<f64>,
    pub(crate) reach_m: f64,
}

/// The edit of a command that arranges the selection; `None` for other commands.
pub(crate) fn arrange_command(command: Command, pointer: Option<PointerPlace>) -> Option<EditTask> {
    let edit = match command {
        Command::Split => EditTask::edit(move |document: &mut Document| {
            let paths = selected_paths(document)?;
            split(document, &paths, pointer).map_err(UserError::from)
        }),
        Command::SplitCrossings => of_paths(|document, paths| {
            let split = document.split_at_crossings(paths);
            split.map(drop).map_err(UserError::from)
        }),
        Command::Join => EditTask::edit(|document: &mut Document| {
            for node in corners(document)? {
                document.join_at(node)?;
            }
            Ok::<(), UserError>(())
        }),
        Command::Reverse => of_paths(|document, paths| {
            let reversed = document.reverse(paths);
            reversed.map_err(|error| UserError::from(ShapeError::from(error)))
        }),
        Command::OneWay => direction(Direction::Forward),
        Command::TwoWay => direction(Direction::Both),
        Command::Straighten => {
            of_paths(|document, paths| document.straighten(paths).map_err(UserError::from))
        }
        Command::AlignX => align(AlignTo::X),
        Command::AlignY => align(AlignTo::Y),
        _ => return None,
    };
    Some(edit)
}

fn of_paths(
    edit: impl FnOnce(&mut Document, &PathSet) -> Result<(), UserError> + Send + 'static,
) -> EditTask {
    EditTask::edit(move |document: &mut Document| {
        let paths = selected_paths(document)?;
        edit(document, &paths)
    })
}

fn direction(direction: Direction) -> EditTask {
    of_paths(move |document, paths| {
        let set = document.set_direction(paths, direction);
        set.map_err(|error| UserError::from(ShapeError::from(error)))
    })
}

fn align(to: AlignTo) -> EditTask {
    EditTask::edit(move |document: &mut Document| {
        let nodes = selected_nodes(document);
        document.align_nodes(&nodes, to).map_err(UserError::from)
    })
}

/// Splits the paths at the pointer, or each at its middle if the pointer is at none of them.
fn split(
    document: &mut Document,
    paths: &PathSet,
    pointer: Option<PointerPlace>,
) -> Result<(), ShapeError> {
    if let Some(PointerPlace { at_m, reach_m }) = pointer {
        match document.split_at(paths, at_m, reach_m) {
            Err(ShapeError::NothingNear { .. }) => {}
            other => return other.map(drop),
        }
    }
    for path in paths {
        let of_path = document.layout().paths.get(path as usize);
        if let Some(middle_m) = of_path.point_at(of_path.length_m() / 2.0) {
            document.split_at(&PathSet::from_iter([path]), middle_m, ON_PATH_M)?;
        }
    }
    Ok(())
}

/// The selected paths.
///
/// # Errors
/// When none is selected.
pub(super) fn selected_paths(document: &Document) -> Result<PathSet, UserError> {
    match document.selection().is_empty() {
        true => Err(ShapeError::NoPath.into()),
        false => Ok(document.selection().clone()),
    }
}

/// The selected nodes, and those at which selected paths end.
pub(super) fn selected_nodes(document: &Document) -> Vec<u32> {
    let ends = counted_ends(document).into_keys();
    let nodes = ends.chain(document.selected().nodes.iter());
    nodes.collect::<PathSet>().iter().collect()
}

/// The nodes at which several selected paths meet, of these only the selected ones if any is; else
/// the selected nodes.
///
/// # Errors
/// When there are none.
pub(super) fn corners(document: &Document) -> Result<Vec<u32>, UserError> {
    let selected = &document.selected().nodes;
    let ends = counted_ends(document).into_iter();
    let meet: PathSet = (ends.filter(|(_, count)| *count > 1))
        .map(|(node, _)| node)
        .collect();
    let both = selected & &meet;
    let choices = [both, selected.clone(), meet];
    let chosen = choices.into_iter().find(|nodes| !nodes.is_empty());
    let nodes: Vec<u32> = chosen.unwrap_or_default().iter().collect();
    if nodes.is_empty() {
        let message = t("no node is selected, and no two selected paths meet");
        return Err(UserError::new(
            "selection",
            message,
            t("Select a node, or the two paths at it"),
        ));
    }
    Ok(nodes)
}

/// The end nodes of the selected paths, with the number of selected paths there.
fn counted_ends(document: &Document) -> BTreeMap<u32, usize> {
    let mut counts = BTreeMap::new();
    for row in document.selection() {
        let path = document.layout().paths.get(row as usize);
        for node in [path.start_node(), path.end_node()].into_iter().flatten() {
            if document.scene().exists(Table::Nodes, node) {
                *counts.entry(node).or_default() += 1;
            }
        }
    }
    counts
}
