//! The state that an element inherits from the elements around it.

use guideway_spline::Affine;

use super::style::Style;
use super::viewport::Viewport;

/// Inherited state of an element.
#[derive(Clone, Copy)]
pub(super) struct ElementContext<'p> {
    pub(super) meters_from_user: Affine,
    pub(super) viewport: Viewport,
    pub(super) style: Style,
    /// Label or identifier of the enclosing group.
    pub(super) group: Option<&'p str>,
    /// The identifiers of the enclosing `use` elements, each followed by a slash.
    pub(super) id_prefix: &'p str,
    /// Nesting depth, references included.
    pub(super) depth: usize,
}
