//! Bends: the tightest radius of a path.

use guideway_layout::PathRef;
use guideway_spline::{Point, uniform};

/// Places per cubic where the curvature is measured.
const SAMPLES: u32 = 16;

/// Curvature in 1/m below which a path is straight.
const STRAIGHT: f64 = 1e-6;

/// Radius in meters and place of the tightest bend, at 17 places per cubic; `None` if the path is
/// straight. Kinks have no radius.
pub(crate) fn tightest(path: PathRef<'_>) -> Option<(f64, Point<f64>)> {
    let mut worst = (STRAIGHT, None);
    for segment in path.runs().flat_map(|run| run.segments()) {
        for sample in 0..=SAMPLES {
            let t = f64::from(sample) / f64::from(SAMPLES);
            let curvature = uniform::curvature(&segment, t).abs();
            if curvature.is_finite() && curvature > worst.0 {
                worst = (curvature, Some(uniform::point(&segment, t)));
            }
        }
    }
    worst.1.map(|at| (1.0 / worst.0, at))
}
