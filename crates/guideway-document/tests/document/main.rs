//! A layout looked at and edited, without any window.

mod find;
mod marks;
mod operations;
mod query;
mod random;
mod selection;
mod site;
