//! Arcs of ellipses: an affine map of the unit circle.

use guideway_spline::{Affine, Point, Runs, arc_to_runs};

/// Appends the arc of the unit circle from the angle `start` on, mapped; so a circle of any center and
/// radius, or an ellipse. Angles in radians. False if it would be farther than `most_m` in any direction.
///
/// A uniform B-spline is mapped by mapping its control points. The map stretches no direction more than by
/// (|x|^2 + |y|^2)^(1/2), and so does not the error either.
pub(crate) fn append_arc(
    map: Affine,
    start: f64,
    sweep: f64,
    tolerance_m: f64,
    most_m: f64,
    runs: &mut Runs,
) -> bool {
    let stretch = map.x.norm().hypot(map.y.norm());
    // Seen before it is drawn: the farther away, the more pieces.
    if !(stretch <= 2.0 * most_m && start.is_finite() && sweep.is_finite()) {
        return false;
    }
    let mut unit = Runs::default();
    let tolerance = tolerance_m / stretch.max(tolerance_m);
    arc_to_runs(
        Point::new(0.0, 0.0),
        1.0,
        start,
        sweep,
        tolerance,
        &mut unit,
    );
    for run in unit.iter() {
        let mapped: Vec<Point<f64>> = run.iter().map(|&p| map.apply(p)).collect();
        runs.push(&mapped);
    }
    true
}
