//! Trajectories of edges as LIF NURBS: lines, quarter circles, cubics.

use serde_json::{Value, json};

/// A point or a direction, in meters.
pub(crate) type Xy = (f64, f64);

/// Weight of the middle control point of a quarter circle of degree 2.
const QUARTER: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The course of an edge from its start to its end.
pub(crate) enum Way {
    /// A line.
    Straight,
    /// A quarter circle around this corner.
    Corner(Xy),
    /// A cubic with these tangents at its start and end; longer ones swing wider.
    Swing(Xy, Xy),
    /// A cubic B-spline with these control points between its ends.
    Winding(Vec<Xy>),
}

/// The point at a distance in a direction.
pub(crate) fn add(p: Xy, direction: Xy, by: f64) -> Xy {
    (p.0 + direction.0 * by, p.1 + direction.1 * by)
}

/// The trajectory of an edge.
pub(crate) fn trajectory(from: Xy, to: Xy, way: &Way) -> Value {
    let point = |(x, y): Xy, weight: f64| {
        let round = |v: f64| (v * 1e4).round() / 1e4;
        json!({ "x": round(x), "y": round(y), "weight": weight })
    };
    match way {
        Way::Straight => json!({
            "degree": 1,
            "knotVector": [0.0, 0.0, 1.0, 1.0],
            "controlPoints": [point(from, 1.0), point(to, 1.0)],
        }),
        Way::Corner(corner) => json!({
            "degree": 2,
            "knotVector": [0.0, 0.0, 0.0, 1.0, 1.0, 1.0],
            "controlPoints": [point(from, 1.0), point(*corner, QUARTER), point(to, 1.0)],
        }),
        Way::Swing(leave, arrive) => {
            let inner = [add(from, *leave, 1.0), add(to, *arrive, -1.0)];
            json!({
                "degree": 3,
                "knotVector": [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
                "controlPoints": [
                    point(from, 1.0), point(inner[0], 1.0), point(inner[1], 1.0), point(to, 1.0),
                ],
            })
        }
        Way::Winding(inner) => {
            let spans = inner.len() - 1;
            let inside = (1..spans).map(|i| i as f64 / spans as f64);
            let knots: Vec<f64> = [0.0; 4].into_iter().chain(inside).chain([1.0; 4]).collect();
            let ends = (point(from, 1.0), point(to, 1.0));
            let inner = inner.iter().map(|&p| point(p, 1.0));
            let points: Vec<Value> = std::iter::once(ends.0)
                .chain(inner)
                .chain([ends.1])
                .collect();
            json!({ "degree": 3, "knotVector": knots, "controlPoints": points })
        }
    }
}
