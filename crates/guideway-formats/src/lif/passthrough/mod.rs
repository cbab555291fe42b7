//! Passthrough of LIF members that the model does not hold, such as actions and descriptions: a
//! write to the same version keeps them, with the positions and curves of the layout.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | index | text of the file read | raw objects by level and identifier | `unmodeled`, `raw` |
//! | merge | raw object, new object | object as written | `merge` |
//! | count | raw objects | number of objects that another format loses | `count` |

mod count;
mod merge;
mod raw;
mod unmodeled;

pub(crate) use self::count::count_unmodeled;
pub(super) use self::merge::merge;
pub(super) use self::unmodeled::Unmodeled;
