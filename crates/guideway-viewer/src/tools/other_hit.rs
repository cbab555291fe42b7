//! A path under the pointer in a file that is not the active one.

use guideway_document::Hit;

/// A path under the pointer in another than the active file.
#[derive(Clone, Debug)]
pub(crate) struct OtherHit {
    /// Index of the file.
    pub(crate) file: usize,
    pub(crate) hit: Hit,
}
