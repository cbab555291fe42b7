//! A layout looked at and edited, without any window.

mod find;
mod findings;
mod marks;
mod operations;
mod query;
mod random;
mod selection;
mod site;
