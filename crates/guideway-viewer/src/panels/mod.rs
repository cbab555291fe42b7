//! The panels of the window: menu bar, drawing bar, status bar, side panel, dialogs.
//!
//! Panels own the state of their own fields only. They read the other parts and return
//! [`Action`](crate::action::Action)s.

mod command_state;
pub(crate) mod dialogs;
mod display_panel;
mod drawing_bar;
mod files_panel;
mod find_panel;
mod findings_panel;
mod icons;
mod menu_bar;
mod new_edges;
mod path_panel;
mod properties;
mod render_panel;
mod selection_panel;
mod side_panel;
mod status_bar;
mod toolbar;
mod welcome;

pub(crate) use command_state::CommandState;
pub(crate) use drawing_bar::DrawingBar;
pub(crate) use findings_panel::FindingsPanel;
pub(crate) use menu_bar::{MenuBar, command_list};
pub(crate) use new_edges::NewEdgesPanel;
pub(crate) use properties::PropertiesPanel;
pub(crate) use side_panel::SidePanel;
pub(crate) use status_bar::StatusBar;
pub(crate) use welcome::Welcome;
