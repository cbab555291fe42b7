//! The description of one render method: its name, its options and how it starts.

use guideway_scene::Method;

/// An option of a method, written after its name: `grid+scan`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodOption {
    /// The text after the `+`.
    pub name: &'static str,
    /// One line on its effect.
    pub summary: &'static str,
}

/// Why a method does not start.
pub(super) enum StartError {
    /// Its options are invalid.
    Options(String),
    /// The computer lacks a device or a driver, or this build lacks the method.
    Unavailable(String),
}

/// A method of the registry.
pub(super) struct Entry {
    pub(super) name: &'static str,
    pub(super) summary: &'static str,
    /// True if it draws every scene completely, so that `auto` may select it.
    pub(super) is_general: bool,
    pub(super) implementation: Implementation,
}

/// The code of a method.
pub(super) struct Implementation {
    pub(super) options: &'static [MethodOption],
    /// Starts the method with the options after its name.
    pub(super) start: fn(&str) -> Result<Box<dyn Method>, StartError>,
}
