//! Errors of operations on a document.

use guideway_scene::EditError;

/// The reason why an operation changes nothing, with a remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OperationError {
    /// The scene rejects a change.
    #[error(transparent)]
    Rejected(#[from] EditError),
    /// Another element of the table has the identifier.
    #[error("another {what} is called `{id}`; choose a name that no {what} has")]
    IdTaken {
        /// `path`, `node`, `station`, `level` or `vehicle type`.
        what: &'static str,
        /// The requested identifier.
        id: String,
    },
    /// An identifier is empty.
    #[error("a {what} needs a name of at least one character")]
    EmptyId {
        /// `path`, `node` or `station`.
        what: &'static str,
    },
    /// No node has the identifier.
    #[error("no node is called `{node}`; Find lists the names that there are")]
    UnknownNode {
        /// The requested identifier.
        node: String,
    },
    /// A value does not fit its property.
    #[error("`{property}` takes {expected}, not `{value}`")]
    WrongValue {
        /// Name of the property.
        property: String,
        /// The values that it takes.
        expected: String,
        /// The given value.
        value: String,
    },
    /// Elements of this kind do not have the property.
    #[error("`{property}` is no property of a {what}; it belongs to a {of}")]
    WrongElement {
        /// Name of the property.
        property: String,
        /// `path`, `node` or `station`.
        what: &'static str,
        /// The elements that have it.
        of: String,
    },
    /// A path is not open to the vehicle type whose property is set.
    #[error(
        "the path `{path}` has no entry for the vehicle type `{vehicle_type}`; set its vehicle \
         types first, or set the property for all types"
    )]
    NoEntry {
        /// Identifier of the path.
        path: String,
        /// The vehicle type.
        vehicle_type: String,
    },
    /// Paths that stay begin or end at a deleted node.
    #[error(
        "the node `{node}` has {count} paths that stay, such as `{path}`; delete them too, or let \
         the deletion take the paths of its nodes along"
    )]
    NodeInUse {
        /// Identifier of the node.
        node: String,
        /// Identifier of a path there.
        path: String,
        /// Number of the paths that stay.
        count: usize,
    },
    /// A level that is to be deleted has elements that are to be kept.
    #[error(
        "the level `{level}` has {paths} paths, {nodes} nodes, {stations} stations and {zones} \
         zones; move them to another level, or delete them too"
    )]
    LevelInUse {
        /// Identifier of the level.
        level: String,
        /// Number of its paths.
        paths: u64,
        /// Number of its nodes.
        nodes: u64,
        /// Number of its stations.
        stations: u64,
        /// Number of its zones.
        zones: usize,
    },
    /// The elements of a deleted level would move to itself.
    #[error("the elements of the level `{level}` cannot move to itself; choose another level")]
    SameLevel {
        /// Identifier of the level.
        level: String,
    },
    /// There is no such vehicle type.
    #[error("no vehicle type is called `{name}`; name one that exists, or create it first")]
    UnknownVehicleType {
        /// The requested name.
        name: String,
    },
    /// A vehicle type that is to be deleted is in use, or has properties.
    #[error(
        "{paths} paths and {nodes} nodes name the vehicle type `{name}`, and it has {properties} \
         properties of its own; give them another type, or take it off them"
    )]
    VehicleTypeInUse {
        /// Name of the vehicle type.
        name: String,
        /// Number of the paths that it may use.
        paths: usize,
        /// Number of the nodes with an entry for it.
        nodes: usize,
        /// Number of its properties.
        properties: usize,
    },
    /// A deleted vehicle type would be replaced by itself.
    #[error("the vehicle type `{name}` cannot replace itself; choose another one")]
    SameVehicleType {
        /// Name of the vehicle type.
        name: String,
    },
    /// A path would be open to all vehicle types without the only one that may use it.
    #[error(
        "without the vehicle type `{name}` the path `{path}` would be open to all types; give it \
         another type first, or replace the type by another one"
    )]
    OpensPath {
        /// Identifier of the path.
        path: String,
        /// Name of the vehicle type.
        name: String,
    },
    /// A straight path would have no length.
    #[error(
        "a straight path from `{start}` to `{end}` has no length; choose two nodes at different \
         places"
    )]
    NoLength {
        /// Identifier of the first node.
        start: String,
        /// Identifier of the last node.
        end: String,
    },
    /// A pasted element is on a level that the document does not have.
    #[error("the document has no level `{level}`; name the level onto which to paste")]
    UnknownLevel {
        /// Identifier of the level in the source.
        level: String,
    },
    /// A pasted column has another type or unit than that of the document.
    #[error(
        "`{column}` has {there} in the source and {here} in this document; rename or convert one \
         of them first"
    )]
    OtherColumn {
        /// Name of the column.
        column: String,
        /// Type and unit in the source.
        there: String,
        /// Type and unit in the document.
        here: String,
    },
}
