//! Commands that edit, select or hide what is selected.

use std::f64::consts::FRAC_PI_2;

use guideway_document::{Document, Elements, PathSet, SelectMode};
use guideway_scene::{Table, View};
use guideway_spline::{Affine, Point};

use super::copied::paste;
use crate::command::Command;
use crate::editing::EditTask;
use crate::language::counted;

/// Offset of a duplicate on screen, in pixels: far enough to see both.
pub(crate) const DUPLICATE_OFFSET_PX: f64 = 24.0;

/// The edit of a command on the selection; `None` for other commands.
pub(crate) fn selection_command(command: Command, view: Option<&View>) -> Option<EditTask> {
    let edit = match command {
        Command::SelectAll => EditTask::view_change(Document::select_all),
        Command::Deselect => EditTask::view_change(|document| {
            document.select(PathSet::new(), SelectMode::Replace);
        }),
        Command::Hide => EditTask::view_change(Document::hide_selection),
        Command::Isolate => EditTask::view_change(Document::isolate_selection),
        Command::ShowAll => EditTask::view_change(Document::show_all),
        Command::Refine => EditTask::edit(Document::refine_selection),
        Command::Duplicate => {
            let offset_m = view.map_or(1.0, |view| DUPLICATE_OFFSET_PX / view.px_per_m());
            let step_m = Point::new(offset_m, -offset_m);
            EditTask::edit(move |document: &mut Document| duplicate(document, step_m))
        }
        Command::RotateLeft => transform("rotate", |center| Affine::rotation(FRAC_PI_2, center)),
        Command::FlipHorizontal => transform("flip", |center| {
            Affine::mirror(center, Point::new(0.0, 1.0))
        }),
        Command::FlipVertical => transform("flip", |center| {
            Affine::mirror(center, Point::new(1.0, 0.0))
        }),
        Command::Undo => step(Document::undo, "nothing to undo"),
        Command::Redo => step(Document::redo, "nothing to redo"),
        _ => return None,
    };
    Some(edit)
}

/// Copies the selection: elements a step beside their originals, levels with what is on them at
/// the same place.
fn duplicate(document: &mut Document, step_m: Point<f64>) -> Result<(), String> {
    if !document.selected().has_groups() {
        let copied = document.copy_selection(1, step_m);
        return copied.map_err(|error| error.to_string());
    }
    let clip = document.clip(document.selected());
    let clip = clip.map_err(|error| error.to_string())?;
    paste(document, &clip, Affine::IDENTITY).map_err(|error| error.to_string())
}

/// Transforms the selection about the center of its bounding box.
fn transform(name: &'static str, about: fn(Point<f64>) -> Affine) -> EditTask {
    EditTask::edit(
        move |document: &mut Document| match document.selection_bounds() {
            Some(bounds) => document.transform_selection(name, about(bounds.center())),
            None => Ok(()),
        },
    )
}

fn step(step: fn(&mut Document) -> Option<&'static str>, nothing: &'static str) -> EditTask {
    EditTask::edit(move |document| step(document).map(drop).ok_or(nothing))
}

/// The number of elements of each kind, such as `2 paths` and `1 station`.
pub(crate) fn counts(elements: &Elements) -> Vec<String> {
    let counts = Table::ALL.into_iter().filter_map(|of| {
        let count = elements.rows(of).len();
        (count > 0).then(|| counted(count, of.element()))
    });
    let groups = [
        (elements.levels.len(), "level"),
        (elements.vehicle_types.len() as u64, "vehicle type"),
    ];
    let groups = groups.into_iter().filter(|(count, _)| *count > 0);
    counts
        .chain(groups.map(|(count, what)| counted(count, what)))
        .collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;
    use std::time::Duration;

    use super::*;
    use crate::background::RepaintHandle;
    use crate::editing::{DocumentSlot, EditReturn};
    use crate::tests::services::lanes;

    #[test]
    fn rotates_the_selection_and_reports_an_empty_history() {
        let mut slot = DocumentSlot::default();
        slot.replace(Document::new(lanes(1).into(), &Default::default()).unwrap());
        let repaint: RepaintHandle = Arc::new(|| {});
        let (file, wait) = (Path::new("site.arrow"), Duration::from_secs(60));
        let mut run = |command| {
            let edit = selection_command(command, None).unwrap();
            slot.run(edit, wait, file, &repaint)
        };
        let undone = run(Command::Undo);
        assert!(matches!(undone, Some(EditReturn::Returned(Some(n))) if n == "nothing to undo"));
        run(Command::SelectAll);
        run(Command::RotateLeft);
        let document = slot.document().unwrap();
        let (start, end) = document.layout().paths.get(0).ends().unwrap();
        assert!((end.x - start.x).abs() < 1e-9 && (end.y - start.y - 10.0).abs() < 1e-9);
        assert_eq!(document.undo_redo_names().0, Some("rotate"));
    }

    #[test]
    fn other_commands_edit_nothing() {
        assert!(selection_command(Command::ZoomIn, None).is_none());
    }
}
