//! Feature source: the parts of a feature that its geometry does not hold.

use super::columns::Named;
use super::extension::Extension;
use super::properties::Properties;

/// A feature on its way to an element.
pub(super) struct Source<'f, 'a> {
    pub(super) id: String,
    /// Properties that become columns.
    pub(super) columns: Vec<Named<'f>>,
    pub(super) properties: &'f Properties<'a>,
    pub(super) extension: Extension<'a>,
}
