//! Fillets: an arc instead of a corner, between two nodes on its tangent points.
//!
//! ```text
//!   a ---- N          a --- N .        N moves to the first tangent point, a new node M comes to
//!          |     ->           `        the second one, and a new path goes from N to M.
//!          b                   M
//!                              |
//!                              b
//! ```
//!
//! Two nodes keep the network right: both paths keep their properties, the arc has a speed of its
//! own, and no reference to N breaks.

use std::sync::Arc;

use guideway_layout::{Direction, Member};
use guideway_scene::Insertion;
use guideway_spline::Runs;
use guideway_spline::construct::{self, ConstructError};

use super::arms::{Arm, ArmPath};
use super::error::ShapeError;
use super::plan::{Plan, properties_of};
use crate::change::Change;
use crate::document::Document;
use crate::edit::lengths::{length_m, stated_lengths_m};
use crate::elements::Elements;

/// Largest distance between an arc and its cubics, in meters.
pub(super) const ARC_TOLERANCE_M: f64 = 1e-6;

/// Share of the largest radius that the error recommends.
const LARGEST_SHARE: f64 = 0.999;

impl Document {
    /// Rounds the corner at a node where two tracks meet, each one a path or the two ways of it.
    /// The node moves to the first tangent point, the other one gets a new node, and an arc
    /// connects them: one path for each way in which vehicles drive around the corner, with the
    /// properties of the path before it. Selects the arcs and returns their rows.
    ///
    /// # Errors
    /// When there are fewer or more tracks, no corner, no way around it, a station at the node, the
    /// radius does not fit (the error names the largest one that does), or as for other edits.
    pub fn fillet_at(&mut self, node: u32, radius_m: f64) -> Result<Vec<u32>, ShapeError> {
        let arms = self.two_arms_at(node)?;
        self.refuse_station_at(node)?;
        let [first, second] = &arms;
        let rounded = construct::fillet(&first.runs.reversed(), &second.runs, radius_m);
        let name = |arm: &Arm| self.layout().paths.id(arm.paths[0].row as usize).to_owned();
        let rounded = rounded.and_then(|rounded| match rounded {
            found if found.before.is_empty() || found.after.is_empty() => {
                let (radius, largest) = (radius_m, radius_m);
                Err(ConstructError::TooLarge { radius, largest })
            }
            found => Ok(found),
        });
        let rounded = rounded.map_err(|reason| ShapeError::Curve {
            path: name(first),
            reason: leave_rests(reason),
        })?;
        let ways = ways_around(&arms);
        if ways.is_empty() {
            let node = self.layout().nodes.id(node).to_owned();
            let (first, second) = (name(first), name(second));
            return Err(ShapeError::HeadToHead {
                first,
                second,
                node,
            });
        }
        let (changes, rows) = self.rounded(node, &arms, &rounded, &ways);
        self.perform("fillet", changes)?;
        self.selection = Arc::new(Elements::of_paths(rows.iter().copied()));
        Ok(rows)
    }

    fn rounded(
        &self,
        node: u32,
        arms: &[Arm; 2],
        rounded: &construct::Fillet,
        ways: &[Way],
    ) -> (Vec<Change>, Vec<u32>) {
        let mut plan = Plan::new(self);
        let mut arc = Runs::default();
        rounded.arc.push(ARC_TOLERANCE_M, &mut arc);
        let other = match arc.end() {
            Some(end_m) => plan.add_node(arms[1].paths[0].row, end_m),
            None => node,
        };
        if let Some(start_m) = arc.start() {
            plan.place_node(node, start_m);
        }
        // The rests lead away from the corner.
        let rests = [rounded.before.reversed(), rounded.after.clone()];
        for ((arm, rest), at) in arms.iter().zip(&rests).zip([node, other]) {
            for path in &arm.paths {
                let mut ends = plan.ends_of(path.row);
                ends[usize::from(!path.begins)] = Some(at);
                plan.set_ends(path.row, ends);
                let runs = if path.begins {
                    rest.clone()
                } else {
                    rest.reversed()
                };
                plan.set_curve(path.row, runs);
            }
        }
        let mut rows = Vec::with_capacity(ways.len());
        for way in ways {
            let id = self.layout().paths.id(way.from.row as usize);
            let id = plan.path_names.unique(&format!("{id} arc"));
            let (runs, [start, end]) = if way.is_backward {
                (arc.reversed(), [other, node])
            } else {
                (arc.clone(), [node, other])
            };
            let length_m = length_m(&runs);
            let row = plan.insert(Insertion {
                id,
                runs,
                start_node: Some(start),
                end_node: Some(end),
                direction: way.direction,
                ..properties_of(self, way.from.row)
            });
            for (vehicle_type, _) in stated_lengths_m(self, way.from.row) {
                plan.set_length_m(row, vehicle_type, length_m);
            }
            let own = Member::Path(way.from.row);
            plan.add_member(own, Member::Path(row));
            rows.push(row);
        }
        (plan.changes(), rows)
    }
}

/// A reason whose largest radius leaves a rest of both paths, for a path needs a length.
fn leave_rests(reason: ConstructError) -> ConstructError {
    match reason {
        ConstructError::TooLarge { radius, largest } => ConstructError::TooLarge {
            radius,
            largest: LARGEST_SHARE * largest,
        },
        other => other,
    }
}

/// A way around a corner.
struct Way {
    /// The path before the corner.
    from: ArmPath,
    direction: Direction,
    /// It leads from the second arm to the first one.
    is_backward: bool,
}

/// The ways in which vehicles drive from one arm to the other one.
fn ways_around([first, second]: &[Arm; 2]) -> Vec<Way> {
    let mut ways = Vec::new();
    for a in &first.paths {
        for b in &second.paths {
            let (there, back) = (a.arrives && b.leaves, b.arrives && a.leaves);
            if there || back {
                ways.push(Way {
                    from: if there { *a } else { *b },
                    direction: if there && back {
                        Direction::Both
                    } else {
                        Direction::Forward
                    },
                    is_backward: !there,
                });
            }
        }
    }
    ways
}
