//! Curves between two nodes: arcs and splines that may continue an adjacent path.

use guideway_scene::Table;
use guideway_spline::bezier::{end_direction, start_direction};
use guideway_spline::construct::{self, ConstructError, Spacing, interpolate};
use guideway_spline::{Point, Runs, uniform};

use super::error::ShapeError;
use super::fillet::ARC_TOLERANCE_M;
use crate::PathSet;
use crate::document::Document;
use crate::edit::curves::runs_of;

/// The curve of a path to create.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The arc of a circle that continues an adjacent path of the first node, given by its row.
    Arc {
        /// Row of the adjacent path.
        along: u32,
    },
    /// The arc of a circle through a point.
    ArcThrough(Point<f64>),
    /// The curve without kinks through points between the nodes, in meters. It continues adjacent
    /// paths of the first and of the last node, if they are given.
    Spline {
        /// The points, in order.
        through: Vec<Point<f64>>,
        /// Rows of the adjacent paths.
        along: [Option<u32>; 2],
    },
}

impl Document {
    /// The curve of a path to create between two nodes, for
    /// [`NewEdge::curve`](crate::NewEdge::curve).
    ///
    /// # Errors
    /// When a node does not exist, an adjacent path does not exist or touch its node, or there is
    /// no such curve.
    pub fn curve_between(&self, nodes: [u32; 2], shape: &Shape) -> Result<Runs, ShapeError> {
        self.check_rows_exist(Table::Nodes, &nodes.into_iter().collect())?;
        let [start, end] = nodes.map(|node| self.node_position_m(node));
        match shape {
            Shape::Spline { through, along } => {
                let mut points = vec![start];
                points.extend_from_slice(through);
                points.push(end);
                let onward = |side: usize| along[side].map(|path| self.onward(path, nodes[side]));
                // The last node's path goes on against the end of the new one.
                let arrives = onward(1).transpose()?.map(|direction| -direction);
                interpolate(
                    &points,
                    Spacing::default(),
                    [onward(0).transpose()?, arrives],
                )
                .map_err(|reason| self.curve_error(nodes, reason))
            }
            Shape::Arc { along } => {
                let direction = self.onward(*along, nodes[0])?;
                self.pushed(nodes, construct::Arc::from_tangent(start, direction, end))
            }
            Shape::ArcThrough(through) => {
                self.pushed(nodes, construct::Arc::through([start, *through, end]))
            }
        }
    }

    fn pushed(
        &self,
        nodes: [u32; 2],
        arc: Result<construct::Arc, ConstructError>,
    ) -> Result<Runs, ShapeError> {
        let mut runs = Runs::default();
        let arc = arc.map_err(|reason| self.curve_error(nodes, reason))?;
        arc.push(ARC_TOLERANCE_M, &mut runs);
        Ok(runs)
    }

    fn curve_error(&self, nodes: [u32; 2], reason: ConstructError) -> ShapeError {
        let [start, end] = nodes.map(|node| self.layout().nodes.id(node));
        let path = format!("{start}--{end}");
        ShapeError::Curve { path, reason }
    }

    /// Direction in which a path at a node goes on beyond the node.
    pub(super) fn onward(&self, row: u32, node: u32) -> Result<Point<f64>, ShapeError> {
        self.check_rows_exist(Table::Paths, &PathSet::from_iter([row]))?;
        let path = self.layout().paths.get(row as usize);
        let runs = runs_of(path);
        let direction = if path.end_node() == Some(node) {
            let last = runs.segments().last().map(uniform::to_bezier);
            last.and_then(|bezier| end_direction(&bezier))
        } else if path.start_node() == Some(node) {
            let first = runs.segments().next().map(uniform::to_bezier);
            first
                .and_then(|bezier| start_direction(&bezier))
                .map(|direction| -direction)
        } else {
            let node = self.layout().nodes.id(node).to_owned();
            let path = path.id().to_owned();
            return Err(ShapeError::NotAtNode { path, node });
        };
        direction.ok_or_else(|| ShapeError::Curve {
            path: path.id().to_owned(),
            reason: ConstructError::NoDirection,
        })
    }
}
