//! Moves nodes onto a line, or to even distances along one; the ends of their paths follow.

use guideway_spline::Point;

use super::error::ShapeError;
use crate::document::Document;

/// The line onto which nodes move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlignTo {
    /// The vertical line through their mean: all get one x.
    X,
    /// The horizontal line through their mean: all get one y.
    Y,
    /// The line with the least squares of distances from them.
    Line,
}

impl Document {
    /// Moves nodes onto a line, each to the nearest place there.
    ///
    /// # Errors
    /// When there are fewer than two nodes, they lie at one place, or a node is unknown.
    pub fn align_nodes(&mut self, nodes: &[u32], to: AlignTo) -> Result<(), ShapeError> {
        let (nodes, places_m) = self.places_of(nodes, 2)?;
        let center = mean(&places_m);
        let direction = match to {
            AlignTo::X => Point::new(0.0, 1.0),
            AlignTo::Y => Point::new(1.0, 0.0),
            AlignTo::Line => main_direction(&places_m).ok_or(ShapeError::OnePlace)?,
        };
        let on_line = |p: &Point<f64>| center + direction * direction.dot(*p - center);
        let to = nodes.into_iter().zip(places_m.iter().map(on_line));
        let to: Vec<_> = to.collect();
        Ok(self.move_nodes("align", &to)?)
    }

    /// Moves nodes along the line that fits them best, to even distances: the first and the last
    /// one stay, or that end which is nearer to the first given node stays and the others follow at
    /// `spacing_m`. The distances from the line stay.
    ///
    /// # Errors
    /// When there are fewer than three nodes, or two with a spacing, the nodes lie at one place,
    /// the spacing is not positive, or a node is unknown.
    pub fn distribute_nodes(
        &mut self,
        nodes: &[u32],
        spacing_m: Option<f64>,
    ) -> Result<(), ShapeError> {
        if let Some(value) = spacing_m.filter(|m| !m.is_finite() || *m <= 0.0) {
            let name = "spacing";
            return Err(ShapeError::Length { name, value });
        }
        let (nodes, places_m) = self.places_of(nodes, if spacing_m.is_some() { 2 } else { 3 })?;
        let direction = main_direction(&places_m).ok_or(ShapeError::OnePlace)?;
        let along = |p: &Point<f64>| direction.dot(*p - places_m[0]);
        let mut order: Vec<(f64, u32, Point<f64>)> = nodes
            .into_iter()
            .zip(&places_m)
            .map(|(node, place)| (along(place), node, *place))
            .collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        if spacing_m.is_some() && order[0].0 < -order[order.len() - 1].0 {
            order.reverse();
        }
        let (first, last) = (order[0].0, order[order.len() - 1].0);
        let step_m = match spacing_m {
            Some(spacing_m) => spacing_m * (last - first).signum(),
            None => (last - first) / (order.len() - 1) as f64,
        };
        let to = order
            .into_iter()
            .enumerate()
            .map(|(i, (from, node, place))| {
                let by = first + step_m * i as f64 - from;
                (node, place + direction * by)
            });
        let to: Vec<_> = to.collect();
        Ok(self.move_nodes("distribute", &to)?)
    }

    /// The distinct nodes and their positions.
    fn places_of(
        &self,
        nodes: &[u32],
        least: usize,
    ) -> Result<(Vec<u32>, Vec<Point<f64>>), ShapeError> {
        let mut distinct: Vec<u32> = Vec::with_capacity(nodes.len());
        let mut known = crate::PathSet::new();
        for &node in nodes {
            self.check_node(node)?;
            if known.insert(node) {
                distinct.push(node);
            }
        }
        let actual = distinct.len();
        if actual < least {
            return Err(ShapeError::TooFewNodes { actual, least });
        }
        let places_m = distinct.iter().map(|&node| self.node_position_m(node));
        let places_m = places_m.collect();
        Ok((distinct, places_m))
    }
}

fn mean(points: &[Point<f64>]) -> Point<f64> {
    // Relative to the first one, so that far from the origin no digits are lost.
    let origin = points[0];
    let sum = points
        .iter()
        .fold(Point::new(0.0, 0.0), |sum, p| sum + (*p - origin));
    origin + sum * (1.0 / points.len() as f64)
}

/// Unit direction of the line with the least squares of distances from points; `None` if they lie
/// at one place. Source: Pearson 1901, On lines and planes of closest fit to systems of points in
/// space.
fn main_direction(points: &[Point<f64>]) -> Option<Point<f64>> {
    let center = mean(points);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for from_center in points.iter().map(|p| *p - center) {
        xx += from_center.x * from_center.x;
        xy += from_center.x * from_center.y;
        yy += from_center.y * from_center.y;
    }
    let angle_rad = 0.5 * (2.0 * xy).atan2(xx - yy);
    let (sin, cos) = angle_rad.sin_cos();
    (xx + yy > 0.0).then_some(Point::new(cos, sin))
}
