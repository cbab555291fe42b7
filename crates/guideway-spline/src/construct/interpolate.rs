//! Curves through points: cubics whose first and second derivatives agree at every point.
//!
//! With h_i the parameter range of piece i and d_i its chord divided by h_i, the derivatives m_i at
//! the points solve a tridiagonal system:
//!
//! ```text
//! h_i m_(i-1) + 2 (h_(i-1) + h_i) m_i + h_(i-1) m_(i+1) = 3 (h_i d_(i-1) + h_(i-1) d_i)
//! 2 m_0 + m_1 = 3 d_0        no curvature at a free start, and alike at a free end
//! ```
//!
//! Source: de Boor, A Practical Guide to Splines, chapter IV.

use super::ConstructError;
use super::arc::check_distinct;
use crate::bezier::unit;
use crate::{Point, Runs};

/// The parameter range of a piece between two points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// The distance of the points: even speed, and room for the curve where points are dense.
    ChordLength,
    /// The square root of the distance, which swings out less at corners. Source: Lee 1989.
    #[default]
    Centripetal,
}

/// The curve through all points in order, exactly. It begins and ends in the given directions
/// (vectors of any length), or without curvature.
///
/// # Errors
/// When there are fewer than two points, a point equals the next one, a direction has no length, or
/// a number is not finite.
pub fn interpolate(
    points: &[Point<f64>],
    spacing: Spacing,
    [start, end]: [Option<Point<f64>>; 2],
) -> Result<Runs, ConstructError> {
    let actual = points.len();
    if actual < 2 {
        return Err(ConstructError::TooFewPoints { actual });
    }
    check_distinct(points)?;
    let chords = points.array_windows().map(|[p, q]| *q - *p);
    let pieces: Vec<Piece> = chords.map(|chord| Piece::new(chord, spacing)).collect();
    // A given direction gets the speed of its chord.
    let given = |direction: Option<Point<f64>>, piece: &Piece| match direction {
        Some(vector) if !vector.is_finite() => Err(ConstructError::NotFinite),
        Some(vector) => {
            let unit = unit(vector).ok_or(ConstructError::NoDirection)?;
            Ok(Some(unit * piece.speed.norm()))
        }
        None => Ok(None),
    };
    let last = pieces.len() - 1;
    let ends = [given(start, &pieces[0])?, given(end, &pieces[last])?];
    let derivatives = derivatives(&pieces, ends);
    let mut runs = Runs::default();
    for (i, piece) in pieces.iter().enumerate() {
        let third = piece.range / 3.0;
        let (from, to) = (points[i], points[i + 1]);
        let (leaves, arrives) = (derivatives[i] * third, derivatives[i + 1] * third);
        runs.push_bezier(&[from, from + leaves, to - arrives, to]);
    }
    Ok(runs)
}

struct Piece {
    range: f64,
    /// The chord divided by the range.
    speed: Point<f64>,
}

impl Piece {
    fn new(chord: Point<f64>, spacing: Spacing) -> Self {
        let range = match spacing {
            Spacing::ChordLength => chord.norm(),
            Spacing::Centripetal => chord.norm().sqrt(),
        };
        Self {
            range,
            speed: chord * (1.0 / range),
        }
    }
}

/// A row of the system: factors of the derivatives before, at and after a point, and its right
/// side.
type Row = ([f64; 3], Point<f64>);

/// Derivatives at all points, by elimination without pivots: every row is dominated by its middle.
fn derivatives(pieces: &[Piece], [start, end]: [Option<Point<f64>>; 2]) -> Vec<Point<f64>> {
    let free = |speed: Point<f64>| ([1.0, 2.0, 1.0], speed * 3.0);
    let fixed = |derivative: Point<f64>| ([0.0, 1.0, 0.0], derivative);
    let first: Row = start.map_or_else(|| free(pieces[0].speed), fixed);
    let inner = pieces.array_windows().map(|[a, b]| -> Row {
        let factors = [b.range, 2.0 * (a.range + b.range), a.range];
        (factors, (a.speed * b.range + b.speed * a.range) * 3.0)
    });
    let last: Row = end.map_or_else(|| free(pieces[pieces.len() - 1].speed), fixed);
    // Each row becomes m_i = side - share m_(i+1).
    let (mut shares, mut solved) = (Vec::new(), Vec::new());
    for ([before, middle, after], side) in std::iter::once(first).chain(inner).chain([last]) {
        let known = shares.last().copied().zip(solved.last().copied());
        let (share, value) = known.unwrap_or((0.0, Point::new(0.0, 0.0)));
        let pivot = 1.0 / (middle - before * share);
        shares.push(after * pivot);
        solved.push((side - value * before) * pivot);
    }
    for i in (0..solved.len() - 1).rev() {
        solved[i] = solved[i] - solved[i + 1] * shares[i];
    }
    solved
}
