//! Elliptic arcs: maps an arc of the unit circle by an affine map and appends it as B-spline runs.

use guideway_spline::{Affine, Point, Runs, arc_to_runs};

/// Appends the arc of the unit circle from angle `start` over `sweep` (radians), mapped by `map`:
/// an arc of any circle or ellipse. Returns false, and appends nothing, if the ellipse could reach
/// farther than `max_m` meters from its center.
///
/// Mapping the control points maps a uniform B-spline. The map stretches no direction by more than
/// (|x|^2 + |y|^2)^(1/2), the Frobenius norm, so that factor bounds the error as well.
pub(crate) fn append_arc(
    map: Affine,
    start: f64,
    sweep: f64,
    tolerance_m: f64,
    max_m: f64,
    runs: &mut Runs,
) -> bool {
    let stretch = map.x.norm().hypot(map.y.norm());
    // Checked before conversion: the number of segments grows with the radius.
    if !(stretch <= 2.0 * max_m && start.is_finite() && sweep.is_finite()) {
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
