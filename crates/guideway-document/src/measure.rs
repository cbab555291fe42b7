//! Lengths and curvatures of paths.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::construct::{parameter_at_length, point_at};
use guideway_spline::{Point, Runs, run_length, segment_length, uniform};

/// Largest error of the length of a run, in meters: a tenth of a millimeter.
const LENGTH_TOLERANCE_M: f64 = 1e-4;

/// Length of a path along its curve, in meters.
pub fn length_m(path: PathRef<'_>) -> f64 {
    let runs = path.runs().map(|run| match run {
        RunPoints::F64(points) => run_length(points, LENGTH_TOLERANCE_M),
        RunPoints::F32(points) => run_length(points, LENGTH_TOLERANCE_M),
    });
    runs.sum()
}

/// The point of a path halfway along its curve; `None` without a curve.
pub fn middle_m(path: PathRef<'_>) -> Option<Point<f64>> {
    let mut runs = Runs::default();
    path.copy_runs(&mut runs);
    let half_m = length_m(path) / 2.0;
    let middle = parameter_at_length(&runs, half_m, LENGTH_TOLERANCE_M)?;
    point_at(&runs, middle)
}

/// Curvature of a path at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Distance along the path, in meters.
    pub along_m: f64,
    /// Signed curvature in 1/m, positive for a left turn. Its inverse is the radius.
    pub curvature: f64,
}

/// Most samples of [`bends`].
pub const MAX_BENDS: usize = 4096;

/// Curvatures of a path from start to end: up to 32 samples per segment, and at most [`MAX_BENDS`]
/// in all. Skips points where the curvature is undefined.
pub fn bends(path: PathRef<'_>) -> Vec<Bend> {
    let segments = || path.runs().flat_map(|run| run.segments());
    let count = segments().count().max(1);
    let each = (MAX_BENDS / count).clamp(1, 32);
    let step = count.div_ceil(MAX_BENDS);
    let mut along_m = 0.0;
    let mut bends = Vec::new();
    for (index, segment) in segments().enumerate() {
        let segment_m = segment_length(&segment, LENGTH_TOLERANCE_M);
        if index % step == 0 {
            let samples = (0..each).map(|i| (i as f64 + 0.5) / each as f64);
            let bend = |t| Bend {
                along_m: along_m + t * segment_m,
                curvature: uniform::curvature(&segment, t),
            };
            bends.extend(samples.map(bend).filter(|bend| bend.curvature.is_finite()));
        }
        along_m += segment_m;
    }
    bends
}

/// Smallest radius among the [`bends`] of a path, in meters; infinite for a straight path.
pub fn tightest_radius_m(bends: &[Bend]) -> f64 {
    let most = bends
        .iter()
        .map(|bend| bend.curvature.abs())
        .fold(0.0, f64::max);
    1.0 / most
}
