//! LIF texts of one edge for tests.

use guideway_layout::Layout;

use crate::common::read;

/// Returns a layout of two nodes, 10 m apart, and one edge with the given properties.
pub(crate) fn edge_with(properties: &str) -> String {
    format!(
        r#"{{"layouts": [{{"layoutId": "L", "nodes": [
            {{"nodeId": "A", "nodePosition": {{"x": 0, "y": 0}}}},
            {{"nodeId": "B", "nodePosition": {{"x": 10, "y": 0}}}}],
          "edges": [{{"edgeId": "E", "startNodeId": "A", "endNodeId": "B",
            "vehicleTypeEdgeProperties": [{properties}]}}]}}]}}"#
    )
}

/// Reads a layout of one edge with the given trajectory.
pub(crate) fn trajectory(content: &str) -> Layout {
    read(&edge_with(&format!(
        r#"{{"vehicleTypeId": "V", "trajectory": {{{content}}}}}"#
    )))
}

/// Control points of an arch between the nodes.
pub(crate) const ARCH: &str =
    r#""controlPoints": [{"x":0,"y":0},{"x":0,"y":5},{"x":10,"y":5},{"x":10,"y":0}]"#;
