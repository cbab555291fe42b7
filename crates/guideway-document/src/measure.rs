//! Lengths and bends of paths.

use guideway_layout::{PathRef, RunPoints};
use guideway_spline::{run_length, segment_length, uniform};

/// Lengths are right to a tenth of a millimeter a run.
const LENGTH_TOLERANCE_M: f64 = 1e-4;

/// Length of a path along its curve, in meters.
pub fn length_m(path: PathRef<'_>) -> f64 {
    let runs = path.runs().map(|run| match run {
        RunPoints::F64(points) => run_length(points, LENGTH_TOLERANCE_M),
        RunPoints::F32(points) => run_length(points, LENGTH_TOLERANCE_M),
    });
    runs.sum()
}

/// How much a path is bent somewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// How far along the path, in meters.
    pub along_m: f64,
    /// Signed curvature in one over meters: positive where the path turns left. The radius is its inverse.
    pub curvature: f64,
}

/// Most samples of [`bends`].
pub const MAX_BENDS: usize = 4096;

/// The bend of a path at places from its start to its end: some a segment, the more the fewer there are,
/// and at most [`MAX_BENDS`]. Places where the curve stands still are left out.
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

/// The tightest radius of a path in meters, by its [`bends`]; infinite where it is straight.
pub fn tightest_radius_m(bends: &[Bend]) -> f64 {
    let most = bends
        .iter()
        .map(|bend| bend.curvature.abs())
        .fold(0.0, f64::max);
    1.0 / most
}
