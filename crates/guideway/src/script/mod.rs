//! Edits a layout by a list of steps in JSON: the scripts of `guideway edit`.
//!
//! | module | input | output |
//! |---|---|---|
//! | `read` | JSON | its steps, or where it is wrong |
//! | `apply` | steps, a layout | the edited layout, and what each step touched |
//! | `step`, `error` | | the kinds of steps, what they have touched, and their errors |
//! | `members` | a step | its members as numbers, points, names |
//! | `selection` | `all`, names or a query | rows of the document |
//! | `steps` | a step, a document | the edited document |
//! | `page` | the kinds of steps | the table of the help and of the page |

mod apply;
mod error;
mod members;
mod page;
mod read;
mod selection;
mod step;
mod steps;

pub use apply::{Applied, AppliedStep};
pub use page::help;
pub use read::Script;
pub use step::{SHOWN_NAMES, Touched};
