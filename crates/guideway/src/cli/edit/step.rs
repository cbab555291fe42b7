//! [`StepKind`]: a kind of step, what a step has touched, and why it fails.

use guideway::document::{Document, Elements, OperationError};
use guideway::scene::{EditError, Table};

use super::members::Members;

/// A kind of step.
pub(super) struct StepKind {
    /// Value of `do`.
    pub(super) name: &'static str,
    pub(super) meaning: &'static str,
    pub(super) members: &'static [Member],
    /// A step for the example site.
    pub(super) example: &'static str,
    pub(super) perform: fn(&Members<'_>, &mut Document) -> Result<Touched, StepError>,
}

/// A member of a step.
pub(super) struct Member {
    pub(super) name: &'static str,
    /// Its form, such as `text` or `[x, y] in m`.
    pub(super) form: &'static str,
    pub(super) is_required: bool,
    pub(super) meaning: &'static str,
}

/// A member that a step needs.
pub(super) const fn required(
    name: &'static str,
    form: &'static str,
    meaning: &'static str,
) -> Member {
    Member {
        name,
        form,
        is_required: true,
        meaning,
    }
}

/// A member that a step may have.
pub(super) const fn optional(
    name: &'static str,
    form: &'static str,
    meaning: &'static str,
) -> Member {
    Member {
        is_required: false,
        ..required(name, form, meaning)
    }
}

/// The elements that a step touched, or made.
#[derive(Debug, Default)]
pub(super) struct Touched {
    elements: Elements,
    /// Their names, those of the first ones only.
    pub(super) names: Vec<String>,
}

impl Touched {
    /// Names that a step keeps: one more than a report lists.
    const MAX_NAMES: usize = super::SHOWN_NAMES + 1;

    pub(super) fn of(elements: Elements, document: &Document) -> Self {
        let layout = document.layout();
        let tables = [Table::Paths, Table::Nodes, Table::Stations];
        let names = tables.iter().flat_map(|&of| {
            let rows = elements.rows(of).iter();
            rows.map(move |row| of.id(layout, row).to_owned())
        });
        Self {
            names: names.take(Self::MAX_NAMES).collect(),
            elements,
        }
    }

    /// One element.
    pub(super) fn one(of: Table, row: u32, document: &Document) -> Self {
        let rows = [row].into_iter().collect();
        let mut elements = Elements::default();
        match of {
            Table::Paths => elements.paths = rows,
            Table::Nodes => elements.nodes = rows,
            Table::Stations => elements.stations = rows,
        }
        Self::of(elements, document)
    }

    pub(super) fn count(&self, of: Table) -> u64 {
        self.elements.rows(of).len()
    }
}

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
        // The message ends with the remedy.
        let text = error.to_string();
        let (what, remedy) = match text.split_once("; ") {
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
