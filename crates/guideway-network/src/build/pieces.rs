//! Pieces: cuts curves at their cuts, and drops pieces that vanish or are drawn twice.

use std::collections::HashMap;

use guideway_spline::Point;
use guideway_spline::bezier::{Bezier, SAME_M, move_end, move_start, point, split};

use super::drawn::{Curve, Drawn, polygon_m};
use super::junctions::Cut;
use super::weld::{Nodes, WALK};
use super::{BuildError, BuildOptions, BuildReport};

/// Pieces between the same two nodes that are compared with a new one.
const MAX_COMPARED: usize = 16;

/// A part of a curve between two nodes.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Row of its curve.
    pub(super) curve: u32,
    pub(super) beziers: Vec<Bezier>,
    pub(super) start: u32,
    pub(super) end: u32,
    /// The curve was neither cut nor moved.
    pub(super) is_whole: bool,
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
    cuts.sort_by(|a, b| a.part.cmp(&b.part).then(a.t.total_cmp(&b.t)));
    let reach_m = options.weld_m.max(SAME_M);
    let mut cuts = cuts.into_iter().peekable();
    let mut pieces = Vec::with_capacity(drawn.curves.len() + cuts.len());
    for (row, curve) in drawn.curves.iter().enumerate() {
        let own = std::iter::from_fn(|| cuts.next_if(|cut| cut.part.curve as usize == row));
        let own: Vec<Cut> = own.collect();
        let before = pieces.len();
        cut_curve(row as u32, curve, &own, nodes, &mut pieces);
        let made = pieces.len() - before;
        let vanishes = |piece: &Piece| {
            let length_m: f64 = piece.beziers.iter().map(polygon_m).sum();
            piece.start == piece.end && length_m <= WALK * reach_m
        };
        let vanished = pieces.extract_if(before.., |piece| vanishes(piece)).count();
        report.vanished += vanished as u64;
        report.cut += u64::from(made - vanished > 1);
    }
    drop_repeated(drawn, options, &mut pieces, report);
    Ok(pieces)
}

/// Appends the pieces of one curve, whose cuts are in order.
fn cut_curve(row: u32, curve: &Curve, cuts: &[Cut], nodes: &Nodes, pieces: &mut Vec<Piece>) {
    let new = |start: u32| Piece {
        curve: row,
        beziers: Vec::new(),
        start,
        end: start,
        is_whole: false,
    };
    let mut cuts = cuts.iter().peekable();
    let mut piece = new(nodes.of_end[2 * row as usize]);
    for (number, bezier) in curve.beziers.iter().enumerate() {
        let (mut rest, mut done) = (*bezier, 0.0);
        while let Some(cut) = cuts.next_if(|cut| cut.part.bezier as usize == number) {
            // The parameter within the rest of the cubic.
            let t = if done < 1.0 {
                (cut.t - done) / (1.0 - done)
            } else {
                0.0
            };
            let [left, right] = split(&rest, t.clamp(0.0, 1.0));
            (rest, done) = (right, cut.t);
            if polygon_m(&left) > SAME_M {
                piece.beziers.push(left);
            }
            piece.end = cut.node;
            push(std::mem::replace(&mut piece, new(cut.node)), nodes, pieces);
        }
        if polygon_m(&rest) > SAME_M {
            piece.beziers.push(rest);
        }
    }
    piece.end = nodes.of_end[2 * row as usize + 1];
    let is_uncut = piece.beziers.len() == curve.beziers.len();
    let ends_m = [piece.start, piece.end].map(|node| nodes.positions_m[node as usize]);
    let is_whole = is_uncut && !curve.is_changed;
    piece.is_whole = is_whole && (0..2).all(|side| ends_m[side as usize] == curve.end(side));
    push(piece, nodes, pieces);
}

/// Appends a piece whose ends are at its nodes; a piece without length has none.
fn push(mut piece: Piece, nodes: &Nodes, pieces: &mut Vec<Piece>) {
    let position = |node: u32| nodes.positions_m[node as usize];
    let (start, end) = (position(piece.start), position(piece.end));
    if let Some(first) = piece.beziers.first_mut()
        && first[0] != start
    {
        move_start(first, start);
    }
    if let Some(last) = piece.beziers.last_mut()
        && last[3] != end
    {
        move_end(last, end);
    }
    if !piece.beziers.is_empty() {
        pieces.push(piece);
    }
}

/// Drops pieces that lie on another one between the same nodes, under the same rule.
fn drop_repeated(
    drawn: &Drawn,
    options: &BuildOptions,
    pieces: &mut Vec<Piece>,
    report: &mut BuildReport,
) {
    let tolerance_m = options.weld_m.max(10.0 * SAME_M);
    let mut known: HashMap<(u32, u32), Vec<u32>> = HashMap::with_capacity(pieces.len());
    let mut is_repeated = vec![false; pieces.len()];
    for (row, piece) in pieces.iter().enumerate() {
        let key = (piece.start.min(piece.end), piece.start.max(piece.end));
        let others = known.entry(key).or_default();
        let rule = |piece: &Piece| drawn.curves[piece.curve as usize].rule;
        let same = others.iter().take(MAX_COMPARED).any(|&other| {
            let other = &pieces[other as usize];
            let is_same_way = options.two_way || other.start == piece.start;
            rule(other) == rule(piece) && is_same_way && is_same_curve(other, piece, tolerance_m)
        });
        if same {
            is_repeated[row] = true;
        } else {
            others.push(row as u32);
        }
    }
    let mut flags = is_repeated.iter();
    pieces.retain(|_| !flags.next().copied().unwrap_or(false));
    report.repeated += is_repeated.iter().filter(|repeated| **repeated).count() as u64;
}

/// Compares two pieces at three places between their ends.
fn is_same_curve(a: &Piece, b: &Piece, tolerance_m: f64) -> bool {
    let samples = |piece: &Piece| [0.25, 0.5, 0.75].map(|share| at_share(&piece.beziers, share));
    let (of_a, mut of_b) = (samples(a), samples(b));
    let is_near = |of_b: &[Point<f64>; 3]| {
        of_a.iter()
            .zip(of_b)
            .all(|(p, q)| p.distance(*q) <= tolerance_m)
    };
    if is_near(&of_b) {
        return true;
    }
    of_b.reverse();
    is_near(&of_b)
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
