//! The remembered values, as they stand in the file.

use serde::{Deserialize, Serialize};

use super::window_place::WindowPlace;
use crate::display_settings::DisplaySettings;

/// Narrowest and widest remembered side panel, in points.
const PANEL_WIDTHS: [f32; 2] = [180.0, 2000.0];

/// Everything that the window remembers. Values that the file lacks have their defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub(crate) struct Preferences {
    /// Width of the side panel, in points.
    pub(crate) panel_width: f32,
    /// True if the side panel is shown; `None` lets the width of the window decide.
    pub(crate) side_panel: Option<bool>,
    pub(crate) look: DisplaySettings,
    pub(crate) window: WindowPlace,
}

impl Default for Preferences {
    fn default() -> Self {
        Self {
            panel_width: 320.0,
            side_panel: None,
            look: DisplaySettings::default(),
            window: WindowPlace::default(),
        }
    }
}

impl Preferences {
    /// The same with all numbers in their ranges: a file may hold any.
    pub(super) fn in_range(mut self) -> Self {
        let [least, most] = PANEL_WIDTHS;
        if !(least..=most).contains(&self.panel_width) {
            self.panel_width = Self::default().panel_width;
        }
        self.look = self.look.in_range();
        self.window = self.window.in_range();
        self
    }
}
