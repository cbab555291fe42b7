//! Splits: pieces of paths between new nodes.

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use guideway_layout::Member;
use guideway_scene::{PathState, Table};
use guideway_spline::construct::{Parameter, cut_all, nearest_parameter};
use guideway_spline::{Bounds, Point, Runs};

use super::error::ShapeError;
use super::plan::Plan;
use crate::PathSet;
use crate::change::Change;
use crate::document::Document;
use crate::edit::curves::{runs_of, with_moved_ends};
use crate::edit::lengths::{length_m, stated_lengths_m};
use crate::elements::Elements;

/// Distance within which places are one node, in meters.
pub(super) const JOIN_M: f64 = 1e-3;

/// Accuracy of the place nearest to a point, in meters.
const NEAREST_M: f64 = 1e-9;

impl Document {
    /// Splits those of the paths that pass within `reach_m` of a point, each at its nearest place.
    /// Places within a millimeter get one node, also where a node or an end of another path is.
    /// Selects the pieces and returns their nodes.
    ///
    /// The pieces keep the properties of the path and its place in blocks; their names are
    /// numbered.
    ///
    /// # Errors
    /// When no path is near, the place is an end of a path, or as for other edits.
    pub fn split_at(
        &mut self,
        paths: &PathSet,
        at_m: Point<f64>,
        reach_m: f64,
    ) -> Result<Vec<u32>, ShapeError> {
        self.check_paths(paths)?;
        let mut cuts = Cuts::new(self);
        let (mut is_near, mut at_end) = (false, None);
        for path in paths.iter() {
            let runs = runs_of(self.layout().paths.get(path as usize));
            let Some((at, nearest)) = nearest_parameter(&runs, at_m, NEAREST_M) else {
                continue;
            };
            if nearest.distance <= reach_m {
                is_near = true;
                if !cuts.add(path, &runs, at, nearest.point) {
                    at_end = Some(path);
                }
            }
        }
        if !is_near {
            return Err(ShapeError::NothingNear { at: at_m, reach_m });
        }
        if let Some(path) = at_end.filter(|_| cuts.count == 0) {
            let path = self.layout().paths.id(path as usize).to_owned();
            return Err(ShapeError::AtEnd { path });
        }
        let (changes, pieces, nodes) = cuts.finish();
        self.perform("split", changes)?;
        self.selection = Arc::new(Elements::of_paths(pieces));
        Ok(nodes)
    }
}

impl Document {
    /// Splits all shown paths that pass within a millimeter of a point, so that what is drawn from
    /// there is connected. Returns their node; `None` if no path passes there between its ends.
    ///
    /// # Errors
    /// As for other edits.
    pub fn split_shown_at(&mut self, at_m: Point<f64>) -> Result<Option<u32>, ShapeError> {
        let spot = Bounds {
            min: at_m,
            max: at_m,
        };
        let near = self.index.paths_in(spot.inflated(JOIN_M));
        let is_shown = |path: &u32| self.scene.state(*path) == PathState::Shown;
        let paths: PathSet = near.filter(is_shown).collect();
        if paths.is_empty() {
            return Ok(None);
        }
        match self.split_at(&paths, at_m, JOIN_M) {
            Ok(nodes) => Ok(nodes.first().copied()),
            Err(ShapeError::NothingNear { .. } | ShapeError::AtEnd { .. }) => Ok(None),
            Err(error) => Err(error),
        }
    }
}

/// Cuts of paths at nodes.
pub(super) struct Cuts<'d> {
    plan: Plan<'d>,
    /// New nodes by cells of a millimeter on a level.
    places: HashMap<([i64; 2], Option<u32>), Vec<u32>>,
    /// Curves, with their ends on new nodes, and cuts.
    of_path: BTreeMap<u32, (Runs, Vec<(Parameter, u32)>)>,
    /// Number of cuts.
    pub(super) count: usize,
}

impl<'d> Cuts<'d> {
    pub(super) fn new(document: &'d Document) -> Self {
        Self {
            plan: Plan::new(document),
            places: HashMap::new(),
            of_path: BTreeMap::new(),
            count: 0,
        }
    }

    /// Cuts a path at a place. At its end there is nothing to cut: an end without a node gets one,
    /// and the result is false.
    pub(super) fn add(
        &mut self,
        path: u32,
        runs: &Runs,
        at: Parameter,
        place_m: Point<f64>,
    ) -> bool {
        let mut ends = self.plan.ends_of(path);
        let corners = [runs.start(), runs.end()];
        let is_here = |corner: &Option<Point<f64>>| {
            corner.is_some_and(|corner| corner.distance(place_m) <= JOIN_M)
        };
        if let Some(side) = corners.iter().position(is_here) {
            if ends[side].is_none() {
                ends[side] = Some(self.node_at(path, place_m));
                self.plan.set_ends(path, ends);
                self.put_end_on_node(path, runs, side);
            }
            return false;
        }
        let node = self.node_at(path, place_m);
        let (_, cuts) = self
            .of_path
            .entry(path)
            .or_insert_with(|| (runs.clone(), Vec::new()));
        cuts.push((at, node));
        self.count += 1;
        true
    }

    /// Moves the end of a path, which has no cut yet, onto its new node.
    fn put_end_on_node(&mut self, path: u32, runs: &Runs, side: usize) {
        let ends = self.plan.ends_of(path);
        let new = || (runs.clone(), Vec::new());
        let (runs, _) = self.of_path.entry(path).or_insert_with(new);
        let mut by = [Point::new(0.0, 0.0); 2];
        if let (Some(node), Some(end)) = (ends[side], [runs.start(), runs.end()][side]) {
            by[side] = self.plan.node_position_m(node) - end;
        }
        *runs = with_moved_ends(runs, by[0], by[1]);
    }

    /// The node at a place, which is new if there is none on the level of the path.
    fn node_at(&mut self, path: u32, place_m: Point<f64>) -> u32 {
        let document = self.plan.document;
        let level = document.layout().paths.get(path as usize).level();
        let [x, y] = [place_m.x, place_m.y].map(|v| (v / JOIN_M).floor() as i64);
        let cells = (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| [x, y]));
        let known = cells
            .filter_map(|cell| self.places.get(&(cell, level)))
            .flatten();
        let is_here = |node: &u32| self.plan.node_position_m(*node).distance(place_m) <= JOIN_M;
        let area = Bounds {
            min: place_m,
            max: place_m,
        };
        let is_on_level = |node: &u32| Table::Nodes.level(document.layout(), *node) == level;
        let old = document
            .index
            .nodes_in(area.inflated(JOIN_M))
            .filter(is_on_level);
        if let Some(node) = known.copied().chain(old).find(is_here) {
            return node;
        }
        let node = self.plan.add_node(path, place_m);
        self.places.entry(([x, y], level)).or_default().push(node);
        node
    }

    /// The changes that make all cuts, the rows of all pieces, and the nodes.
    pub(super) fn finish(mut self) -> (Vec<Change>, PathSet, Vec<u32>) {
        let (mut pieces, mut nodes) = (PathSet::new(), PathSet::new());
        for (path, (runs, mut cuts)) in std::mem::take(&mut self.of_path) {
            cuts.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal));
            nodes.extend(cuts.iter().map(|(_, node)| *node));
            pieces.extend(self.cut(path, &runs, &cuts));
        }
        (self.plan.changes(), pieces, nodes.into_iter().collect())
    }

    /// Replaces a path by its pieces. Returns their rows.
    fn cut(&mut self, path: u32, runs: &Runs, cuts: &[(Parameter, u32)]) -> Vec<u32> {
        let parameters: Vec<Parameter> = cuts.iter().map(|(at, _)| *at).collect();
        let joints = cuts.iter().map(|(_, node)| Some(*node));
        let starts = std::iter::once(None).chain(joints.clone());
        let pieces = cut_all(runs, &parameters).into_iter();
        let pieces = pieces.zip(starts.zip(joints.chain([None])));
        // Two cuts at one place leave a piece without length between them.
        let has_length = |(piece, (start, end)): &(Runs, (Option<u32>, Option<u32>))| {
            !piece.is_empty() && (start != end || length_m(piece) > 2.0 * JOIN_M)
        };
        let pieces: Vec<_> = pieces.filter(has_length).collect();
        let plan = &mut self.plan;
        if pieces.len() < 2 {
            plan.set_curve(path, runs.clone());
            return vec![path];
        }
        let whole = plan.ends_of(path);
        let names = plan.piece_names(path, pieces.len());
        let (whole_m, stated) = (length_m(runs), stated_lengths_m(plan.document, path));
        let mut rows = Vec::with_capacity(pieces.len());
        for ((piece, (start, end)), name) in pieces.into_iter().zip(names) {
            let share = length_m(&piece) / whole_m;
            let by = |joint: Option<u32>, from: Option<Point<f64>>| match (joint, from) {
                (Some(node), Some(from)) => plan.node_position_m(node) - from,
                _ => Point::new(0.0, 0.0),
            };
            let piece = with_moved_ends(&piece, by(start, piece.start()), by(end, piece.end()));
            let node = |joint: Option<u32>, own: Option<u32>| joint.or(own);
            let ends = [node(start, whole[0]), node(end, whole[1])];
            let row = if rows.is_empty() {
                plan.set_curve(path, piece);
                plan.set_ends(path, ends);
                plan.set_id(path, name);
                path
            } else {
                plan.add_path(path, name, piece, ends)
            };
            for (vehicle_type, stated_m) in &stated {
                plan.set_length_m(row, vehicle_type.clone(), stated_m * share);
            }
            rows.push(row);
        }
        let members = rows.iter().map(|row| Member::Path(*row)).collect();
        plan.replace_member(Member::Path(path), members);
        rows
    }
}
