//! The window in which layouts are looked at and edited.
