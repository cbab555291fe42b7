//! [`RouteError`]: why there is no route.

use guideway_layout::UserError;

/// Reason why a search finds no route.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RouteError {
    /// No station or node has a name.
    #[error("\"{name}\" is no station and no node; {known}")]
    UnknownPlace {
        /// The name.
        name: String,
        /// Near names, or some of the known ones.
        known: String,
    },
    /// Several nodes have a name.
    #[error("{count} nodes are named \"{name}\"")]
    Ambiguous {
        /// The name.
        name: String,
        /// Number of nodes.
        count: usize,
    },
    /// A station has no node.
    #[error("station \"{name}\" has no node")]
    NoNode {
        /// The station.
        name: String,
    },
    /// The layout does not have a vehicle type, or has several and none is given.
    #[error("{given}; the layout has {known}")]
    VehicleType {
        /// The name that was given.
        given: String,
        /// Some of the known types.
        known: String,
    },
    /// There is no way.
    #[error("no way leads from \"{from}\" to \"{to}\": {why}")]
    NoWay {
        /// Start.
        from: String,
        /// Goal.
        to: String,
        /// The obstacle.
        why: String,
    },
}

impl From<RouteError> for UserError {
    fn from(error: RouteError) -> Self {
        let (code, remedy) = match &error {
            RouteError::UnknownPlace { .. } => ("unknown-place", "Name a station or a node"),
            RouteError::Ambiguous { .. } => {
                ("unknown-place", "Rename the nodes, or name a station")
            }
            RouteError::NoNode { .. } => ("unknown-place", "Give the station a node"),
            RouteError::VehicleType { .. } => ("unknown-type", "Name one by --vehicle-type"),
            RouteError::NoWay { .. } => (
                "no-way",
                "`guideway check` lists separate parts, dead ends and forbidden turns",
            ),
        };
        Self::new(code, error.to_string(), remedy)
    }
}
