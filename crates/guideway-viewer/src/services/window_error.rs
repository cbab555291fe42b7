//! The code of errors that the window itself reports.

/// Value of [`UserError::code`](guideway_layout::UserError::code).
pub(crate) const WINDOW_ERROR: &str = "window";
