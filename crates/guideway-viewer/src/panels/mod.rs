//! The panels of the window: menu bar, drawing bar, status bar, side panel, bottom panel, dialogs.
//!
//! Panels own the state of their own fields only. They read the other parts and return
//! [`Action`](crate::action::Action)s.

mod bottom_panel;
mod command_state;
mod compare_panel;
pub(crate) mod dialogs;
mod digits;
mod display_panel;
mod drawing_bar;
mod find_panel;
mod findings_panel;
mod group_list;
mod icons;
mod layers_panel;
mod menu_bar;
mod network_panel;
mod new_edges;
mod properties;
mod render_panel;
mod route_panel;
mod selection_panel;
mod side_panel;
mod slider;
mod status_bar;
mod still_part;
mod table;
mod text_focus;
mod toolbar;
mod welcome;

/// The last layouts of the bars at the top.
#[derive(Default)]
pub(crate) struct StillBars {
    pub(crate) menus: StillPart<MenuKey>,
    pub(crate) drawing: StillPart<DrawingKey>,
}

use drawing_bar::DrawingKey;
use menu_bar::MenuKey;
use still_part::StillPart;

pub(crate) use bottom_panel::{BottomPanel, BottomView};
pub(crate) use command_state::CommandState;
pub(crate) use drawing_bar::DrawingBar;
pub(crate) use findings_panel::FindingsPanel;
#[cfg(test)]
pub(crate) use findings_panel::title_of;
pub(crate) use menu_bar::{MenuBar, command_list};
pub(crate) use new_edges::NewEdgesPanel;
pub(crate) use properties::PropertiesPanel;
pub(crate) use side_panel::{SidePanel, SideTab, SideTabs};
pub(crate) use status_bar::StatusBar;
pub(crate) use welcome::Welcome;
