//! [`ShapeError`]: why an edit of shapes cannot be done, with place, limit and remedy.

use guideway_layout::{DisplayPosition, UserError};
use guideway_scene::EditError;
use guideway_spline::Point;
use guideway_spline::construct::ConstructError;

use crate::edit::error::OperationError;

/// Reason why an edit of shapes cannot be done. The document is unchanged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ShapeError {
    /// The scene rejects the edit.
    #[error(transparent)]
    Edit(#[from] EditError),
    /// A property does not take a value.
    #[error(transparent)]
    Property(#[from] OperationError),
    /// An arc needs more than two points.
    #[error("two points give no arc: no path at the first one leads on to the second one")]
    NoArc,
    /// There is no such curve.
    #[error("\"{path}\": {reason}")]
    Curve {
        /// Name of the path.
        path: String,
        /// Why not.
        reason: ConstructError,
    },
    /// A length is negative, zero or not finite.
    #[error("the {name} is {value} m; it must be a number above 0")]
    Length {
        /// Its name, such as `tolerance`.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// No path is given.
    #[error("no path is given")]
    NoPath,
    /// No given path is near a point.
    #[error("no path passes within {reach_m} m of {}", DisplayPosition(*.at))]
    NothingNear {
        /// The point, in meters.
        at: Point<f64>,
        /// Largest distance, in meters.
        reach_m: f64,
    },
    /// A path would be split at its end.
    #[error("the place is an end of path \"{path}\"")]
    AtEnd {
        /// Name of the path.
        path: String,
    },
    /// The given paths do not cross.
    #[error("the paths do not cross")]
    NoCrossing,
    /// The given paths cross too often.
    #[error("more than {limit} {what}: the paths are too many for one step")]
    TooMany {
        /// The counted things, such as `places cut`.
        what: &'static str,
        /// The limit.
        limit: usize,
    },
    /// Elements of two levels would become one.
    #[error("\"{first}\" and \"{second}\" are on different levels")]
    Levels {
        /// Name of one element.
        first: String,
        /// Name of the other one.
        second: String,
    },
    /// An edit needs two paths at a node.
    #[error("{count} paths meet at node \"{node}\"; the edit needs two")]
    NotTwo {
        /// Name of the node.
        node: String,
        /// Number of paths, or of the curves on which they lie.
        count: usize,
    },
    /// A path begins and ends at the same node.
    #[error("path \"{path}\" begins and ends at the same place")]
    Loop {
        /// Name of the path.
        path: String,
    },
    /// The second of two paths leads back to where the first one begins.
    #[error("path \"{path}\" leads back to where the other path begins")]
    TurnsBack {
        /// Name of the path.
        path: String,
    },
    /// Two paths have different properties.
    #[error("paths \"{first}\" and \"{second}\" differ in {}", .what.join(", "))]
    Differ {
        /// Name of one path.
        first: String,
        /// Name of the other one.
        second: String,
        /// Names of the properties.
        what: Vec<String>,
    },
    /// No vehicle drives from one path to the other.
    #[error(
        "no vehicle drives from \"{first}\" to \"{second}\" or back: both lead to, or from, node \
         \"{node}\""
    )]
    HeadToHead {
        /// Name of one path.
        first: String,
        /// Name of the other one.
        second: String,
        /// Name of the node.
        node: String,
    },
    /// A station is at a node that would go or move away from its paths.
    #[error("station \"{station}\" is at node \"{node}\"")]
    Station {
        /// Name of the station.
        station: String,
        /// Name of the node.
        node: String,
    },
    /// An edit needs more nodes.
    #[error("{actual} nodes are given; the edit needs at least {least}")]
    TooFewNodes {
        /// Number of nodes.
        actual: usize,
        /// Least number.
        least: usize,
    },
    /// Nodes lie at one place, which gives no direction.
    #[error("the nodes lie at one place, so that there is no direction")]
    OnePlace,
    /// A path does not touch a node, so that it gives no tangent there.
    #[error("path \"{path}\" neither begins nor ends at node \"{node}\"")]
    NotAtNode {
        /// Name of the path.
        path: String,
        /// Name of the node.
        node: String,
    },
}

impl From<ShapeError> for UserError {
    fn from(error: ShapeError) -> Self {
        let (code, remedy) = match &error {
            ShapeError::Edit(_) => ("edit", "Correct the reference or the position"),
            ShapeError::Property(_) => ("property", "Correct the value"),
            ShapeError::NoArc => ("curve", "Give a third point, or a radius such as r2"),
            ShapeError::Curve {
                reason: ConstructError::TooLarge { .. },
                ..
            } => (
                "radius",
                "Choose a smaller radius, or make the paths longer",
            ),
            ShapeError::Curve {
                reason: ConstructError::TooSmall { .. },
                ..
            } => (
                "radius",
                "Choose a larger radius, or move the points together",
            ),
            ShapeError::Curve { .. } => ("curve", "Correct the points or the directions"),
            ShapeError::Length { .. } => ("length", "Correct the value"),
            ShapeError::NoPath => ("selection", "Choose paths"),
            ShapeError::NothingNear { .. } => (
                "selection",
                "Choose a point nearer to a path, or a larger reach",
            ),
            ShapeError::AtEnd { .. } => ("end", "Choose a place between the ends"),
            ShapeError::NoCrossing => ("selection", "Choose paths that cross"),
            ShapeError::TooMany { .. } => ("cuts", "Choose fewer paths"),
            ShapeError::Levels { .. } => ("levels", "Choose elements of one level"),
            ShapeError::NotTwo { .. } => ("paths", "Choose a node with two paths"),
            ShapeError::Loop { .. } => ("loop", "Split the path first"),
            ShapeError::TurnsBack { .. } => ("loop", "Choose a node between two others"),
            ShapeError::Differ { .. } => ("differ", "Make the properties equal first"),
            ShapeError::HeadToHead { .. } => {
                ("direction", "Reverse one of the paths, or make it two-way")
            }
            ShapeError::Station { .. } => ("station", "Move the station to another node first"),
            ShapeError::TooFewNodes { .. } => ("nodes", "Choose more nodes"),
            ShapeError::OnePlace => ("nodes", "Choose nodes at different places"),
            ShapeError::NotAtNode { .. } => ("tangent", "Choose a path at the node"),
        };
        Self::new(code, error.to_string(), remedy)
    }
}
