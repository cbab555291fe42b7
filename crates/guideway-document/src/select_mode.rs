//! Combination of two selections.

/// Combination of a new selection with the present one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SelectMode {
    /// Replaces the present selection.
    #[default]
    Replace,
    /// Adds to the present selection.
    Add,
    /// Removes from the present selection.
    Remove,
}
