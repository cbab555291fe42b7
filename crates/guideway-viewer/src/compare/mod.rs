//! The comparison of the active file with another open one: what is gone, new and changed.

mod changed;
mod comparison;

pub(crate) use changed::{ChangeKind, Changed};
pub(crate) use comparison::Comparison;
