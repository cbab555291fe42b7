//! Tests of the document without a window.

mod find;
mod findings;
mod history;
mod marks;
mod nodes;
mod operations;
mod query;
mod random;
mod selection;
mod site;
