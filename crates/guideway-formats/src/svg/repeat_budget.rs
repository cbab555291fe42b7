//! Bounds the work of `use` elements: each repetition of an element pays for its bytes.
//!
//! Without a bound, nested `use` elements in a file of a kilobyte expand to billions of shapes.

use guideway_layout::Code;
use roxmltree::Node;

use crate::xml_builder::XmlBuilder;

/// Bytes of elements that references may repeat in any file.
const BASE_BYTES: u64 = 16 << 20;

/// Further bytes of elements that references may repeat, per byte of the file.
const PER_BYTE: u64 = 16;

/// Cost of repeating any element, in bytes, so that empty groups are not free.
const ELEMENT_COST: u64 = 64;

/// Remaining bytes that references may repeat.
pub(super) struct RepeatBudget {
    left: u64,
    is_exhaustion_reported: bool,
}

impl RepeatBudget {
    pub(super) fn new(file_bytes: usize) -> Self {
        Self {
            left: BASE_BYTES + file_bytes as u64 * PER_BYTE,
            is_exhaustion_reported: false,
        }
    }

    /// Charges one more repetition of an element: its tag with all attributes, whose styles,
    /// transforms and path data are read again, and the identifiers before its own. Returns `false`
    /// if the budget is exhausted, with a finding the first time.
    pub(super) fn charge<'d, 't>(
        &mut self,
        base: &mut XmlBuilder<'_, 'd, 't>,
        node: Node<'d, 't>,
        id_prefix: &str,
    ) -> bool {
        let start = node.range().start;
        let end = node.attributes().next_back().map(|last| last.range().end);
        let bytes = end.map_or(0, |end| end - start) + id_prefix.len();
        let left = self.left.checked_sub(ELEMENT_COST + bytes as u64);
        if left.is_none() && !self.is_exhaustion_reported && !base.is_silent {
            self.is_exhaustion_reported = true;
            let message = || "references repeat too much for a file of this size".to_owned();
            let remedy = "It and all later repetitions are left out; use fewer references";
            base.report(Code::Implausible, node, message, remedy);
        }
        self.left = left.unwrap_or(0);
        left.is_some()
    }

    /// Returns `true` if nothing is left.
    pub(super) fn is_exhausted(&self) -> bool {
        self.left == 0
    }
}
