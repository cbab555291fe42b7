//! [`StepError`]: the reason why a step fails.

use guideway_document::{OperationError, ShapeError};
use guideway_layout::UserError;
use guideway_scene::EditError;

/// The reason why a step fails.
#[derive(Debug)]
pub(super) struct StepError {
    /// Name of the member that is wrong, if one is.
    member: Option<&'static str>,
    what: String,
    pub(super) remedy: String,
}

impl StepError {
    pub(super) fn of_member(
        member: &'static str,
        what: impl Into<String>,
        remedy: impl Into<String>,
    ) -> Self {
        Self {
            member: Some(member),
            what: what.into(),
            remedy: remedy.into(),
        }
    }

    /// The error after `step 7`.
    pub(super) fn describe(&self, step: &str) -> String {
        match self.member {
            Some(member) => format!("(`{step}`), member `{member}`: {}", self.what),
            None => format!("(`{step}`): {}", self.what),
        }
    }
}

impl From<OperationError> for StepError {
    fn from(error: OperationError) -> Self {
        // A message ends with its remedy, which has no names and values.
        let text = error.to_string();
        let parts = text.rsplit_once("; ");
        let (what, remedy) = match parts.filter(|(_, remedy)| !remedy.contains('`')) {
            Some((what, remedy)) => (what.to_owned(), sentence(remedy)),
            None => (text, "Correct the step".to_owned()),
        };
        Self {
            member: None,
            what,
            remedy,
        }
    }
}

impl From<ShapeError> for StepError {
    fn from(error: ShapeError) -> Self {
        let UserError {
            message: what,
            remedy,
            ..
        } = error.into();
        Self {
            member: None,
            what,
            remedy,
        }
    }
}

impl From<EditError> for StepError {
    fn from(error: EditError) -> Self {
        OperationError::from(error).into()
    }
}

/// The text with a capital letter.
fn sentence(text: &str) -> String {
    let mut chars = text.chars();
    let first = chars.next().map(|c| c.to_uppercase().to_string());
    first.unwrap_or_default() + chars.as_str()
}
