//! Tests that drive the whole application by mouse and keys, without a window.

mod background;
mod content;
mod drag;
mod files;
mod findings;
mod layers;
mod methods;
mod panels;
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
mod workflows;
