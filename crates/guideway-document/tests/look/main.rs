//! Finding, choosing, measuring and marking paths, without any window.

mod find;
mod marks;
mod query;
mod site;
