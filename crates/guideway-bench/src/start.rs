//! Starts a method: from its name with options to the method, or to the reason why it cannot run.

use std::fmt::Display;

use guideway_scene::Method;

/// Starts a method from its name and options, such as `grid+scan`.
pub type Start<'a> = &'a dyn Fn(&str) -> Result<Box<dyn Method>, StartError>;

/// A method cannot run on this computer. The text is a full sentence: the reason and the remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct StartError(String);

impl StartError {
    /// Takes the text of another error.
    pub fn new(reason: impl Display) -> Self {
        Self(reason.to_string())
    }
}
