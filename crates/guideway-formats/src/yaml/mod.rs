//! YAML: parses untrusted text to a tree of values.

mod json;
mod merge;
mod node;
mod parse;

pub(crate) use node::YamlNode;
pub(crate) use parse::Yaml;
