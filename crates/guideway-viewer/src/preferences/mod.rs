//! Preferences: look, place of the window and width of the side panel, from one run to the next.
//!
//! | part | owns | file |
//! |---|---|---|
//! | [`Preferences`] | all remembered values | `values` |
//! | [`WindowPlace`] | size and position of the window | `window_place` |
//! | [`PreferencesFile`] | the file in the state folder | `file` |
//! | [`write_state`] | files of the state folder, written atomically | `state_folder` |

mod file;
mod state_folder;
mod values;
mod window_place;

pub(crate) use file::PreferencesFile;
pub(crate) use state_folder::write_state;
pub(crate) use values::Preferences;
pub(crate) use window_place::{MIN_SIZE, WindowPlace};
