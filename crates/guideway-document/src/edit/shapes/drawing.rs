//! Drawings: paths through points, with the nodes at which they begin and end, in one step.
//!
//! ```text
//!   lines:  P --- P --- P      a node at each point, a path between two
//!   arc:    P  .-' p '-.  P    a node at the first two points; the third one lies on the arc
//!   curve:  P ~ p ~ p ~ P      a node at the first and at the last point
//!   bezier: P  c   c  P        a node at every third point; those between are control points
//! ```

use std::sync::Arc;

use guideway_layout::{Direction, Layout, NewPath};
use guideway_scene::{Edit, Insertion, NewNode, Table, TableEdit};
use guideway_spline::bezier::unit;
use guideway_spline::construct::{self, ConstructError, Spacing, interpolate};
use guideway_spline::{Point, Runs};

use super::error::ShapeError;
use super::fillet::ARC_TOLERANCE_M;
use super::split::JOIN_M;
use super::template::EdgeTemplate;
use crate::change::Change;
use crate::document::Document;
use crate::elements::Elements;

/// Least cosine between the direction of a path and that to the next point, for a curve that
/// continues it: a little more than a right angle, so that a curve may turn off.
const LEAST_COSINE: f64 = -0.2;

/// The curve between the points of a drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DrawnCurve {
    /// A line from each point to the next one.
    Lines,
    /// An arc from the first to the second point, through the third one. Without a third point, it
    /// continues a path at the first one, or ends as a path at the second one begins.
    Arc,
    /// An arc from the first to the second point with a radius in meters: to the left, or to the
    /// right if it is negative.
    ArcOfRadius(f64),
    /// Cubic Bezier curves: the first point and every third one after it are ends, the two between
    /// are control points. A single one between the last ends is that of a quadratic curve.
    Bezier,
    /// A curve without kinks through all points. It continues a path at the first point, and a
    /// path at the last point continues it, where one leads there.
    Smooth,
}

/// A drawing by a person: points, and the curve between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// The points, in meters. Points at a node are that node.
    pub points_m: Vec<Point<f64>>,
    /// The curve between them.
    pub curve: DrawnCurve,
    /// The properties of the paths.
    pub template: EdgeTemplate,
}

impl Drawing {
    /// The points at which paths begin and end, in meters.
    pub fn ends_m(&self) -> Vec<Point<f64>> {
        let points = &self.points_m;
        match self.curve {
            DrawnCurve::Lines => points.clone(),
            DrawnCurve::Arc | DrawnCurve::ArcOfRadius(_) => {
                points.iter().take(2).copied().collect()
            }
            DrawnCurve::Bezier => bezier_ends(points.len()).map(|at| points[at]).collect(),
            DrawnCurve::Smooth => points
                .first()
                .into_iter()
                .chain(points.last())
                .copied()
                .collect(),
        }
    }
}

/// Places where paths begin and end, and the curves between consecutive ones.
struct Track {
    places: Vec<Place>,
    curves: Vec<Runs>,
    level: Option<u32>,
}

/// A position, and the node there.
#[derive(Clone, Copy)]
struct Place {
    at_m: Point<f64>,
    node: Option<u32>,
}

impl Document {
    /// The level of what is drawn from a node, or from none: the one that is shown, that of the
    /// node, or the first one.
    pub fn drawing_level(&self, node: Option<u32>) -> Option<u32> {
        let of_node = || self.layout().nodes.level(node?);
        let first = || (!self.layout().levels.is_empty()).then_some(0);
        self.level().or_else(of_node).or_else(first)
    }

    /// The paths that [`Self::draw`] would add, without names and nodes.
    ///
    /// # Errors
    /// When there is no such curve.
    pub fn preview(&self, drawing: &Drawing) -> Result<Layout, ShapeError> {
        let mut layout = Layout::default();
        for runs in &self.track(drawing)?.curves {
            layout.paths.push(&NewPath {
                runs,
                ..NewPath::default()
            });
        }
        Ok(layout)
    }

    /// Adds what is drawn: nodes where there are none, and the paths between them. Selects the
    /// paths, and returns them with the new nodes.
    ///
    /// # Errors
    /// When there is no such curve, a speed does not fit its column, or as for other edits.
    pub fn draw(&mut self, drawing: &Drawing) -> Result<Elements, ShapeError> {
        let track = self.track(drawing)?;
        let template = &drawing.template;
        let layout = self.layout();
        let types: Vec<String> = template.type_names().map(str::to_owned).collect();
        let mut names = [Table::Nodes, Table::Paths].map(|of| self.names(of));
        let first_node = layout.nodes.len() as u32;
        let mut new: Vec<NewNode> = Vec::new();
        let mut ends: Vec<(u32, String)> = Vec::new();
        for place in &track.places {
            let known = place
                .node
                .map(|node| (node, layout.nodes.id(node).to_owned()));
            let is_here = |node: &NewNode| node.position_m.distance(place.at_m) <= JOIN_M;
            let drawn = || {
                let number = new.iter().position(is_here)?;
                Some((first_node + number as u32, new[number].id.clone()))
            };
            let end = known.or_else(drawn).unwrap_or_else(|| {
                let id = names[0].unique("node");
                (first_node + new.len() as u32, id)
            });
            if end.0 == first_node + new.len() as u32 {
                new.push(NewNode {
                    id: end.1.clone(),
                    position_m: place.at_m,
                    level: track.level,
                    vehicle_types: types.clone(),
                    attributes_of: None,
                });
            }
            ends.push(end);
        }
        let path = |([start, end], runs): (&[(u32, String); 2], Runs)| Insertion {
            id: names[1].unique(&format!("{}--{}", start.1, end.1)),
            runs,
            start_node: Some(start.0),
            end_node: Some(end.0),
            direction: template.direction,
            level: track.level,
            vehicle_types: types.clone(),
            style: template.style,
            ..Insertion::default()
        };
        let paths: Vec<Insertion> = ends.array_windows().zip(track.curves).map(path).collect();
        let first_path = layout.paths.len() as u32;
        let rows = Elements {
            paths: (first_path..first_path + paths.len() as u32).collect(),
            nodes: (first_node..first_node + new.len() as u32).collect(),
            ..Elements::default()
        };
        let mut changes: Vec<Change> = Vec::new();
        if !new.is_empty() {
            changes.push(TableEdit::InsertNodes(new.into()).into());
        }
        changes.push(Edit::Insert(paths.into()).into());
        changes.extend(self.speeds(template, &rows.paths)?);
        changes.extend(self.further_properties(template, &rows.paths));
        self.perform("draw", changes)?;
        self.selection = Arc::new(Elements::of_paths(&rows.paths));
        Ok(rows)
    }

    /// The places and curves of a drawing.
    fn track(&self, drawing: &Drawing) -> Result<Track, ShapeError> {
        let mut places: Vec<Place> = Vec::new();
        for &at_m in &drawing.points_m {
            let node = self.node_near(at_m, JOIN_M);
            let at_m = node.map_or(at_m, |node| self.node_position_m(node));
            // A double click gives its point twice.
            if places.last().is_none_or(|last| last.at_m != at_m) {
                places.push(Place { at_m, node });
            }
        }
        let level = self.drawing_level(places.first().and_then(|place| place.node));
        let points: Vec<Point<f64>> = places.iter().map(|place| place.at_m).collect();
        let [first, .., last] = places[..] else {
            let actual = points.len();
            return Err(refused(ConstructError::TooFewPoints { actual }));
        };
        let (curves, places) = match drawing.curve {
            DrawnCurve::Lines => {
                let line = |[from, to]: &[Point<f64>; 2]| {
                    let mut line = Runs::default();
                    line.push_line(*from, *to);
                    line
                };
                (points.array_windows().map(line).collect(), places)
            }
            DrawnCurve::Arc | DrawnCurve::ArcOfRadius(_) => {
                let ends = [first, places[1]];
                let arc = match drawing.curve {
                    DrawnCurve::ArcOfRadius(radius_m) => {
                        construct::Arc::of_radius(points[0], points[1], radius_m)
                    }
                    _ => match points.get(2) {
                        Some(&through) => construct::Arc::through([points[0], through, points[1]]),
                        None => self.arc_at_tangent(ends)?,
                    },
                };
                let mut runs = Runs::default();
                arc.map_err(refused)?.push(ARC_TOLERANCE_M, &mut runs);
                (vec![runs], ends.to_vec())
            }
            DrawnCurve::Bezier => {
                let ends: Vec<usize> = bezier_ends(points.len()).collect();
                let curve = |[from, to]: &[usize; 2]| {
                    let mut runs = Runs::default();
                    match points[*from..=*to] {
                        [a, b, c, d] => runs.push_bezier(&[a, b, c, d]),
                        [a, b, c] => runs.push_quadratic(&[a, b, c]),
                        _ => runs.push_line(points[*from], points[*to]),
                    }
                    runs
                };
                let curves = ends.array_windows().map(curve).collect();
                (curves, ends.iter().map(|&at| places[at]).collect())
            }
            DrawnCurve::Smooth => {
                let tangents = [
                    self.tangent(first, points[1] - points[0], true)?,
                    self.tangent(last, last.at_m - points[points.len() - 2], false)?,
                ];
                let runs = interpolate(&points, Spacing::default(), tangents).map_err(refused)?;
                (vec![runs], vec![first, last])
            }
        };
        Ok(Track {
            places,
            curves,
            level,
        })
    }

    /// The arc that continues a path at the first place, or into one at the second place.
    fn arc_at_tangent(
        &self,
        [first, second]: [Place; 2],
    ) -> Result<Result<construct::Arc, ConstructError>, ShapeError> {
        let chord = second.at_m - first.at_m;
        if let Some(tangent) = self.tangent(first, chord, true)? {
            return Ok(construct::Arc::from_tangent(
                first.at_m,
                tangent,
                second.at_m,
            ));
        }
        let arrival = self
            .tangent(second, chord, false)?
            .ok_or(ShapeError::NoArc)?;
        // An arc makes the same angle with its chord at both ends.
        let along = unit(chord).unwrap_or(chord);
        let start = along * (2.0 * along.dot(arrival)) - arrival;
        Ok(construct::Arc::from_tangent(first.at_m, start, second.at_m))
    }

    /// The direction in which a path leads on from a place, or to it, if one does within about a
    /// right angle of `toward`.
    fn tangent(
        &self,
        place: Place,
        toward: Point<f64>,
        leads_on: bool,
    ) -> Result<Option<Point<f64>>, ShapeError> {
        let (Some(node), Some(toward)) = (place.node, unit(toward)) else {
            return Ok(None);
        };
        let mut best: Option<(f64, Point<f64>)> = None;
        for row in self.existing_paths_at(node) {
            let path = self.layout().paths.get(row as usize);
            let end = if leads_on {
                path.end_node()
            } else {
                path.start_node()
            };
            if end != Some(node) && path.direction() == Direction::Forward {
                continue;
            }
            let onward = self.onward(row, node)?;
            let Some(direction) = unit(if leads_on { onward } else { -onward }) else {
                continue;
            };
            let cosine = direction.dot(toward);
            if cosine >= LEAST_COSINE && best.is_none_or(|(other, _)| cosine > other) {
                best = Some((cosine, direction));
            }
        }
        Ok(best.map(|(_, direction)| direction))
    }
}

/// Numbers of the points at which Bezier curves begin and end: every third one, and the last one.
fn bezier_ends(points: usize) -> impl Iterator<Item = usize> {
    let last = points.saturating_sub(1);
    (0..points).filter(move |at| at.is_multiple_of(3) || *at == last)
}

fn refused(reason: ConstructError) -> ShapeError {
    ShapeError::Curve {
        path: "new path".to_owned(),
        reason,
    }
}
