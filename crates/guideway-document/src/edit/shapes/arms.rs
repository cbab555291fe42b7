//! [`Arm`]: the paths at a node that lie on one curve, such as the two ways of a track.

use guideway_layout::Direction;
use guideway_spline::construct::{Parameter, nearest_parameter, point_at};
use guideway_spline::{Point, Runs};

use super::error::ShapeError;
use super::split::JOIN_M;
use crate::document::Document;
use crate::edit::curves::runs_of;

/// Accuracy of the place nearest to a point, in meters.
const NEAREST_M: f64 = 1e-6;

/// A curve that leaves a node, and the paths on it.
pub(super) struct Arm {
    /// The curve, away from the node.
    pub(super) runs: Runs,
    pub(super) paths: Vec<ArmPath>,
}

/// A path of an arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct ArmPath {
    pub(super) row: u32,
    /// The path begins at the node.
    pub(super) begins: bool,
    /// Vehicles drive along it to the node.
    pub(super) arrives: bool,
    /// Vehicles drive along it from the node.
    pub(super) leaves: bool,
}

impl Document {
    /// The two arms at a node.
    ///
    /// # Errors
    /// When the paths at the node lie on fewer or more curves, or one is a loop.
    pub(super) fn two_arms_at(&self, node: u32) -> Result<[Arm; 2], ShapeError> {
        self.check_node(node)?;
        let mut arms: Vec<Arm> = Vec::new();
        for row in self.existing_paths_at(node) {
            let path = self.layout().paths.get(row as usize);
            if path.start_node() == path.end_node() {
                let path = path.id().to_owned();
                return Err(ShapeError::Loop { path });
            }
            let begins = path.start_node() == Some(node);
            let is_two_way = path.direction() == Direction::Both;
            let own = ArmPath {
                row,
                begins,
                arrives: !begins || is_two_way,
                leaves: begins || is_two_way,
            };
            let runs = runs_of(path);
            let runs = if begins { runs } else { runs.reversed() };
            match arms.iter_mut().find(|arm| is_same_curve(&arm.runs, &runs)) {
                Some(arm) => arm.paths.push(own),
                None => arms.push(Arm {
                    runs,
                    paths: vec![own],
                }),
            }
        }
        let count = arms.len();
        arms.try_into().map_err(|_| ShapeError::NotTwo {
            node: self.layout().nodes.id(node).to_owned(),
            count,
        })
    }
}

/// Compares two curves at their ends and in the middle of each segment.
fn is_same_curve(a: &Runs, b: &Runs) -> bool {
    let is_on = |of: &Runs, place_m: Point<f64>| {
        let nearest = nearest_parameter(of, place_m, NEAREST_M);
        nearest.is_some_and(|(_, nearest)| nearest.distance <= JOIN_M)
    };
    let middles = |runs: &Runs| -> Vec<Point<f64>> {
        let numbers = runs.iter().enumerate().flat_map(|(run, points)| {
            (0..points.len() - 3).map(move |segment| Parameter {
                run,
                segment,
                t: 0.5,
            })
        });
        numbers.filter_map(|at| point_at(runs, at)).collect()
    };
    let meet = |a: Option<Point<f64>>, b: Option<Point<f64>>| match (a, b) {
        (Some(a), Some(b)) => a.distance(b) <= JOIN_M,
        _ => false,
    };
    meet(a.start(), b.start())
        && meet(a.end(), b.end())
        && middles(a).into_iter().all(|place| is_on(b, place))
        && middles(b).into_iter().all(|place| is_on(a, place))
}
