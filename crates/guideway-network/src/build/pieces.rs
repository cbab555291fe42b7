//! Pieces: cuts curves at their cuts, and drops pieces that vanish or are drawn twice.

use guideway_spline::Point;
use guideway_spline::bezier::{Bezier, SAME_M, move_end, move_start, part, point};
use rayon::prelude::*;

use super::drawn::{Curve, Drawn, polygon_m};
use super::junctions::Cut;
use super::weld::{Nodes, WALK};
use super::{BuildError, BuildOptions, BuildReport};

/// Pieces between the same two nodes that are compared with a new one.
const MAX_COMPARED: usize = 16;

/// Curves that a task of a thread cuts.
const TASK_CURVES: usize = 4096;

/// A place on a curve.
#[derive(Clone, Copy, Debug)]
struct Place {
    bezier: u32,
    t: f64,
}

/// A part of a curve between two nodes. A drawing has many more pieces than lines, so a piece has
/// the places of its ends, and its cubics are computed where they are needed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    /// Row of its curve.
    pub(super) curve: u32,
    pub(super) start: u32,
    pub(super) end: u32,
    /// The curve was neither cut nor moved.
    pub(super) is_whole: bool,
    from: Place,
    to: Place,
}

impl Piece {
    /// Replaces the cubics in `out` by those of the piece, whose ends are at its nodes: no
    /// cubic if it has no length.
    pub(super) fn copy_beziers(&self, drawn: &Drawn, nodes: &Nodes, out: &mut Vec<Bezier>) {
        let curve = &drawn.curves[self.curve as usize];
        out.clear();
        for row in self.from.bezier..=self.to.bezier {
            let is_at = |place: Place| row == place.bezier;
            let from = if is_at(self.from) { self.from.t } else { 0.0 };
            let to = if is_at(self.to) { self.to.t } else { 1.0 };
            let part = part(&curve.beziers[row as usize], from, to);
            if polygon_m(&part) > SAME_M {
                out.push(part);
            }
        }
        let [start, end] = [self.start, self.end].map(|node| nodes.positions_m[node as usize]);
        if let Some(first) = out.first_mut()
            && first[0] != start
        {
            move_start(first, start);
        }
        if let Some(last) = out.last_mut()
            && last[3] != end
        {
            move_end(last, end);
        }
    }
}

/// The pieces of some curves.
#[derive(Default)]
struct Made {
    pieces: Vec<Piece>,
    /// Pieces that were shorter than the weld distance.
    vanished: u64,
    /// Curves of more than one piece.
    cut: u64,
}

pub(super) fn cut(
    drawn: &Drawn,
    nodes: &Nodes,
    mut cuts: Vec<Cut>,
    options: &BuildOptions,
    report: &mut BuildReport,
) -> Result<Vec<Piece>, BuildError> {
    if cuts.len() + drawn.curves.len() > options.max_pieces {
        let limit = options.max_pieces;
        return Err(BuildError::Pieces { limit });
    }
    cuts.par_sort_by(|a, b| a.part.cmp(&b.part).then(a.t.total_cmp(&b.t)));
    let of_task = |(task, curves): (usize, &[Curve])| {
        let first = (task * TASK_CURVES) as u32;
        let mut cuts = &cuts[cuts.partition_point(|cut| cut.part.curve < first)..];
        let (mut made, mut beziers) = (Made::default(), Vec::new());
        for (row, curve) in (first..).zip(curves) {
            let own = cuts.partition_point(|cut| cut.part.curve == row);
            let (own, rest) = cuts.split_at(own);
            cuts = rest;
            cut_curve(
                row,
                curve,
                own,
                (drawn, nodes, options),
                &mut beziers,
                &mut made,
            );
        }
        made
    };
    let tasks = drawn.curves.par_chunks(TASK_CURVES).enumerate();
    let made: Vec<Made> = tasks.map(of_task).collect();
    drop(cuts);
    let mut pieces = Vec::with_capacity(made.iter().map(|made| made.pieces.len()).sum());
    for made in made {
        pieces.extend(made.pieces);
        report.vanished += made.vanished;
        report.cut += made.cut;
    }
    drop_repeated(drawn, nodes, options, &mut pieces, report);
    Ok(pieces)
}

/// Appends the pieces of one curve, whose cuts are in order.
fn cut_curve(
    row: u32,
    curve: &Curve,
    cuts: &[Cut],
    (drawn, nodes, options): (&Drawn, &Nodes, &BuildOptions),
    beziers: &mut Vec<Bezier>,
    made: &mut Made,
) {
    let place = |bezier, t| Place { bezier, t };
    let [first, last] = [0, 1].map(|side| nodes.of_end[2 * row as usize + side]);
    let end = place(curve.beziers.len() as u32 - 1, 1.0);
    let stops = cuts
        .iter()
        .map(|cut| (place(cut.part.bezier, cut.t), cut.node));
    let (mut start, mut from, mut count) = (first, place(0, 0.0), 0);
    for (to, node) in stops.chain([(end, last)]) {
        let mut piece = Piece {
            curve: row,
            start: std::mem::replace(&mut start, node),
            end: node,
            is_whole: false,
            from: std::mem::replace(&mut from, to),
            to,
        };
        piece.copy_beziers(drawn, nodes, beziers);
        if beziers.is_empty() {
            continue;
        }
        let length_m: f64 = beziers.iter().map(polygon_m).sum();
        if piece.start == piece.end && length_m <= WALK * options.weld_m.max(SAME_M) {
            made.vanished += 1;
            continue;
        }
        let at = |node: u32| nodes.positions_m[node as usize];
        piece.is_whole = !curve.is_changed
            && beziers.len() == curve.beziers.len()
            && [at(piece.start), at(piece.end)] == [curve.end(0), curve.end(1)];
        count += 1;
        made.pieces.push(piece);
    }
    made.cut += u64::from(count > 1);
}

/// Drops pieces that lie on another one between the same nodes, under the same rule.
fn drop_repeated(
    drawn: &Drawn,
    nodes: &Nodes,
    options: &BuildOptions,
    pieces: &mut Vec<Piece>,
    report: &mut BuildReport,
) {
    let tolerance_m = options.weld_m.max(10.0 * SAME_M);
    let rows = pieces.par_iter().enumerate().map(|(row, piece)| {
        let (a, b) = (piece.start, piece.end);
        (a.min(b), a.max(b), row as u32)
    });
    let mut by_ends: Vec<(u32, u32, u32)> = rows.collect();
    by_ends.par_sort_unstable();
    let mut is_repeated = vec![false; pieces.len()];
    let (mut beziers, mut others) = (Vec::new(), Vec::new());
    for group in by_ends.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if group.len() == 1 {
            continue;
        }
        others.clear();
        for &(_, _, row) in group {
            let piece = pieces[row as usize];
            piece.copy_beziers(drawn, nodes, &mut beziers);
            let samples = [0.25, 0.5, 0.75].map(|share| at_share(&beziers, share));
            let rule = |piece: Piece| drawn.curves[piece.curve as usize].rule;
            let is_same = |(other, of_other): &(Piece, [Point<f64>; 3])| {
                let is_same_way = options.two_way || other.start == piece.start;
                rule(*other) == rule(piece)
                    && is_same_way
                    && is_same_curve(of_other, &samples, tolerance_m)
            };
            match others.iter().take(MAX_COMPARED).any(is_same) {
                true => is_repeated[row as usize] = true,
                false => others.push((piece, samples)),
            }
        }
    }
    let mut flags = is_repeated.iter();
    pieces.retain(|_| !flags.next().copied().unwrap_or(false));
    report.repeated += is_repeated.iter().filter(|repeated| **repeated).count() as u64;
}

/// Compares two pieces at three places between their ends, in both directions.
fn is_same_curve(a: &[Point<f64>; 3], b: &[Point<f64>; 3], tolerance_m: f64) -> bool {
    let is_near = |(p, q): (&Point<f64>, &Point<f64>)| p.distance(*q) <= tolerance_m;
    a.iter().zip(b).all(is_near) || a.iter().zip(b.iter().rev()).all(is_near)
}

/// The point at a share of the length, by the control polygons.
fn at_share(beziers: &[Bezier], share: f64) -> Point<f64> {
    let whole: f64 = beziers.iter().map(polygon_m).sum();
    let mut left = share * whole;
    for bezier in beziers {
        let length = polygon_m(bezier);
        if left <= length {
            return point(bezier, if length > 0.0 { left / length } else { 0.0 });
        }
        left -= length;
    }
    beziers[beziers.len() - 1][3]
}
