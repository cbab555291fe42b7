//! An element under the pointer in a file that is not the active one.

use guideway_document::{Element, Hit};

/// An element under the pointer in another than the active file.
#[derive(Clone, Debug)]
pub(crate) struct OtherHit {
    /// Index of the file.
    pub(crate) file: usize,
    pub(crate) target: HoverTarget,
}

/// An element under the pointer, which a click would select.
#[derive(Clone, Debug)]
pub(crate) enum HoverTarget {
    /// A station or a node.
    Symbol(Element),
    Path(Hit),
}
