//! Fixes: edits that resolve a finding, each one undoable step.
//!
//! | file | input | output |
//! |---|---|---|
//! | `propose` | a finding's code and element | the [`Fix`]es that may resolve it |
//! | `gaps` | a node | the nearest node that no path connects with it |
//! | `perform` | a [`Fix`] | the edit of the document |

mod gaps;
mod perform;
mod propose;

use crate::PathSet;
use crate::elements::Elements;

pub use perform::FixError;
pub use propose::{fix_all, fixes, has_fixes};

/// An edit that resolves a finding.
#[derive(Clone, Debug, PartialEq)]
pub enum Fix {
    /// Moves the ends of paths onto their nodes.
    AttachEnds(PathSet),
    /// Makes one node of all ends of paths that lie within a distance.
    Weld {
        /// Rows of the paths.
        paths: PathSet,
        /// Largest distance of two ends, in meters.
        tolerance_m: f64,
    },
    /// Creates a two-way path between two nodes with the properties of a path there.
    Connect {
        /// Rows of the nodes.
        nodes: [u32; 2],
        /// Row of the path whose properties it gets.
        like: Option<u32>,
    },
    /// Makes paths two-way.
    MakeTwoWay(PathSet),
    /// Exchanges start and end of paths.
    Reverse(PathSet),
    /// Deletes elements.
    Delete(Elements),
    /// Gives a path, node or station another identifier.
    Rename {
        /// The element.
        element: crate::Element,
        /// Its new identifier.
        id: String,
    },
}

/// A fix and the text that offers it.
#[derive(Clone, Debug, PartialEq)]
pub struct ProposedFix {
    /// An imperative sentence without a period.
    pub label: String,
    /// The edit.
    pub fix: Fix,
}
