//! Places of the nodes and edges of an order in the text of its file.

use crate::json;

/// First bytes in the file of the nodes and edges of an order.
pub(super) struct Places {
    pub(super) nodes: Vec<usize>,
    pub(super) edges: Vec<usize>,
}

impl Places {
    /// The places of a message in the text of the file, and of the order that it wraps. An order
    /// inside a string has the place of its message.
    pub(super) fn of(text: &str, message: &str, order: &str) -> Self {
        let own = json::offset_in(text, order);
        let start = own.or_else(|| json::offset_in(text, message)).unwrap_or(0);
        let items = |key| {
            let items = json::root_items(order, key).unwrap_or_default().into_iter();
            items
                .map(|item| start + own.map_or(0, |_| item.start))
                .collect()
        };
        Self {
            nodes: items("nodes"),
            edges: items("edges"),
        }
    }
}
