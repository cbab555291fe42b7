//! The panels of the window: menu bar, status bar, side panel, bottom panel, dialogs.
//!
//! Panels own the state of their own fields only. They read the other parts and return
//! [`Action`](crate::action::Action)s.

mod bottom_panel;
mod compare_panel;
pub(crate) mod dialogs;
mod display_panel;
mod find_panel;
mod findings_panel;
mod layers_panel;
mod menu_bar;
mod properties;
mod render_panel;
mod route_panel;
mod selection_panel;
mod side_panel;
mod status_bar;
mod table;

pub(crate) use bottom_panel::{BottomPanel, BottomView};
pub(crate) use findings_panel::FindingsPanel;
pub(crate) use menu_bar::MenuBar;
pub(crate) use properties::PropertiesPanel;
pub(crate) use side_panel::{SidePanel, SideTab, SideTabs};
pub(crate) use status_bar::StatusBar;
