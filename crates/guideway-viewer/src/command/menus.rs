//! The menus: which commands each has, in which order and groups.

use super::Command::{self, *};

/// One menu of the menu bar.
pub(crate) struct Menu {
    pub(crate) name: &'static str,
    /// Its commands; a line separates the groups.
    pub(crate) groups: &'static [&'static [Command]],
}

/// The menus, from left to right.
pub(crate) const MENUS: [Menu; 6] = [
    Menu {
        name: "File",
        groups: &[
            &[Open, OpenRecent, Reload],
            &[Save, SaveAs],
            &[ExportPng, ExportSvg, CopyPicture],
            &[FloorPlan],
            &[Close, Quit],
        ],
    },
    Menu {
        name: "Edit",
        groups: &[
            &[Undo, Redo],
            &[SelectAll, Deselect, Find],
            &[Duplicate, Delete],
            &[RotateLeft, FlipHorizontal, FlipVertical],
            &[Refine],
        ],
    },
    Menu {
        name: "View",
        groups: &[
            &[ZoomToAll, ZoomToSelection, ZoomIn, ZoomOut],
            &[Back, Forward],
            &[PanLeft, PanRight, PanUp, PanDown],
            &[NextFile],
            &[SidePanel, Table],
        ],
    },
    Menu {
        name: "Show",
        groups: &[
            &[Arrows, Symbols, Labels, Grid, SweptAreas],
            &[Density, ThesisRule, Dark],
            &[Hide, Isolate, ShowAll],
        ],
    },
    Menu {
        name: "Tool",
        groups: &[
            &[ToolSelect, ToolPoints, ToolDraw, ToolMeasure],
            &[Route, Compare],
            &[FinishPath, Cancel],
        ],
    },
    Menu {
        name: "Help",
        groups: &[&[Shortcuts]],
    },
];

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;
    use crate::command::SHORTCUTS;

    #[test]
    fn each_command_with_a_shortcut_is_in_exactly_one_menu() {
        let groups = MENUS.iter().flat_map(|menu| menu.groups);
        let listed: Vec<Command> = groups.flat_map(|group| group.iter().copied()).collect();
        for (command, _) in SHORTCUTS {
            let count = listed.iter().filter(|other| *other == command).count();
            assert_eq!(count, 1, "{}", command.label());
        }
        let labels: HashSet<&str> = listed.iter().map(|command| command.label()).collect();
        assert_eq!(labels.len(), listed.len(), "labels differ");
    }
}
