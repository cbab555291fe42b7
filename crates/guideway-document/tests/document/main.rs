//! Tests of the document without a window.

mod copy;
mod find;
mod findings;
mod fixes;
mod group_selection;
mod groups;
mod growth;
mod history;
mod marks;
mod names;
mod network;
mod nodes;
mod operations;
mod properties;
mod query;
mod random;
mod random_groups;
mod random_network;
mod selection;
mod shapes;
mod site;
mod snapping;
