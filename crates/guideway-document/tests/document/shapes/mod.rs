//! Edits of shapes: paths stay on their nodes, and keep their properties.

mod drawing;
mod ends;
mod growth;
mod network;
mod nodes;
mod pieces;
mod random;
