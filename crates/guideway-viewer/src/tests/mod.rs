//! Tests that drive the whole application by mouse and keys, without a window.

mod arranging;
mod background;
mod chrome;
mod complete_edits;
mod content;
mod drag;
mod drawing;
mod file_names;
mod files;
mod findings;
mod first_layout;
mod floor_plans;
#[cfg(target_os = "linux")]
mod full_disk;
mod german;
mod groups;
mod lane_network;
mod layers;
mod levels;
mod methods;
mod network;
mod panels;
mod partial_redraw;
mod projects;
mod properties;
mod random_input;
mod random_run;
mod recovery;
mod route;
mod safety;
pub(crate) mod services;
mod soak;
mod table;
mod test_window;
mod touch;
mod welcome;
mod workflows;
