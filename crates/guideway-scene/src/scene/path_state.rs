//! [`PathState`]: whether a path is drawn.

/// Visibility of a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathState {
    /// Drawn.
    #[default]
    Shown,
    /// Not drawn, but part of the layout; reports count it as hidden.
    Hidden,
    /// No longer part of the layout. Its row stays, so that no other row changes.
    Removed,
}
