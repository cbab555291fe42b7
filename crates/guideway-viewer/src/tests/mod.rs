//! Tests that drive the whole application by mouse and keys, without a window.

mod arranging;
mod background;
mod chrome;
mod content;
mod drag;
mod drawing;
mod file_names;
mod files;
mod findings;
mod floor_plans;
mod first_layout;
mod levels;
mod methods;
mod projects;
mod properties;
mod random_input;
mod random_run;
mod recovery;
mod safety;
pub(crate) mod services;
mod soak;
mod test_window;
mod touch;
mod welcome;
mod workflows;
