//! Notices to the user.

/// A sentence for the user, about an edit or a journal.
pub(crate) type Notice = String;
