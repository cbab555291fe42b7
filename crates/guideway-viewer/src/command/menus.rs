//! The menus: which commands each has, in which order and groups.

use super::Command::{self, *};

/// One menu of the menu bar.
pub(crate) struct Menu {
    pub(crate) name: &'static str,
    /// Its commands; a line separates the groups.
    pub(crate) groups: &'static [&'static [Command]],
}

/// The menus, from left to right.
pub(crate) const MENUS: [Menu; 7] = [
    Menu {
        name: "File",
        groups: &[
            &[NewLayout, Open, OpenRecent, Reload],
            &[Save, SaveAs, SaveProject],
            &[ExportPng, ExportSvg, ExportPdf, CopyPicture],
            &[FloorPlan, PlaceFloorPlan],
            &[Close, Quit],
        ],
    },
    Menu {
        name: "Edit",
        groups: &[
            &[Undo, Redo],
            &[Cut, Copy, Paste, Duplicate, Array, Delete],
            &[SelectAll, Deselect, Find],
            &[Rename, MoveToLevel, NewLevel, NewVehicleType],
            &[RotateLeft, FlipHorizontal, FlipVertical],
            &[Refine],
            &[Settings],
        ],
    },
    Menu {
        name: "Arrange",
        groups: &[
            &[Fillet, Split, SplitCrossings, Join, Weld],
            &[Reverse, OneWay, TwoWay],
            &[Straighten, AlignX, AlignY, Distribute],
        ],
    },
    Menu {
        name: "View",
        groups: &[
            &[ZoomToAll, ZoomToSelection, ZoomToScale, ZoomIn, ZoomOut],
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
            &[ToolSelect, ToolPoints, ToolMeasure],
            &[ToolLine, ToolArc, ToolCurve, ToolBezier],
            &[ToolNode, ToolStation],
            &[Route, Compare, Network],
            &[FinishPath, Cancel],
        ],
    },
    Menu {
        name: "Help",
        groups: &[&[Shortcuts, ExampleSite], &[About]],
    },
];

/// The element that a context menu was opened on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum ContextPlace {
    Path,
    Node,
    Station,
    /// A level or a vehicle type in a list.
    Group,
    /// A path that is being drawn or measured.
    Draft,
    #[default]
    Empty,
}

impl ContextPlace {
    /// The commands of the context menu, in groups.
    pub(crate) fn groups(self) -> &'static [&'static [Command]] {
        match self {
            Self::Path => &[
                &[ZoomToSelection],
                &[Cut, Copy, Duplicate, Delete, Rename],
                &[Reverse, OneWay, TwoWay, Split, Fillet],
                &[RotateLeft, FlipHorizontal, FlipVertical, Refine],
                &[Hide, Isolate, ShowAll],
            ],
            Self::Node | Self::Station => {
                &[&[ZoomToSelection], &[Cut, Copy, Duplicate, Delete, Rename]]
            }
            Self::Group => &[
                &[ZoomToSelection],
                &[Cut, Copy, Paste, Duplicate, Delete, Rename],
            ],
            Self::Draft => &[&[FinishPath, Undo], &[Cancel]],
            Self::Empty => &[
                &[ToolSelect, ToolPoints, ToolLine, ToolMeasure],
                &[Paste],
                &[Undo, Redo],
                &[SelectAll, Deselect],
                &[ZoomToAll, Back],
                &[Grid, Arrows, Symbols, Labels, ShowAll],
            ],
        }
    }
}

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
