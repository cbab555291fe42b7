//! Reverse pairs: two paths on the same line in opposite directions, shown as one two-way lane.

use std::collections::HashMap;

use guideway_layout::PathRef;
use guideway_scene::PathState;
use guideway_spline::{Bounds, Point, uniform};

use crate::document::Document;
use crate::pick::{Hit, nearest};

/// Largest distance between the two paths of a pair, in meters: a millimeter is below the precision
/// of site surveys.
const TOLERANCE_M: f64 = 1e-3;
/// Number of points along a path that are compared with the other one.
const SAMPLES: usize = 5;

/// Pairs of paths on the same line in opposite directions.
#[derive(Clone, Debug, Default)]
pub struct ReversePairs(HashMap<u32, u32>);

impl ReversePairs {
    /// Finds the pairs among the given paths. A path is in one pair at most, with the first match.
    pub fn among(document: &Document, paths: &[u32]) -> Self {
        let layout = document.layout();
        let ends = |row: u32| layout.paths.get(row as usize).ends();
        let mut unpaired: HashMap<[i64; 4], Vec<u32>> = HashMap::new();
        let mut pairs = HashMap::new();
        for &path in paths {
            let Some((start, end)) = ends(path) else {
                continue;
            };
            let candidates = unpaired.get_mut(&end_key(end, start));
            let found = candidates.and_then(|others| {
                let is_reverse = |&other: &u32| lies_on(document, path, other);
                let at = others.iter().position(is_reverse)?;
                Some(others.swap_remove(at))
            });
            match found {
                Some(other) => {
                    pairs.insert(path, other);
                    pairs.insert(other, path);
                }
                None => unpaired.entry(end_key(start, end)).or_default().push(path),
            }
        }
        Self(pairs)
    }

    /// The other path of a pair.
    pub fn of(&self, path: u32) -> Option<u32> {
        self.0.get(&path).copied()
    }
}

impl Document {
    /// The reverse path of the path under the pointer, if there is one among the first
    /// `max_candidates` shown paths near the hit.
    pub fn reverse_path_at(&self, hit: &Hit, max_candidates: usize) -> Option<u32> {
        let spot = Bounds {
            min: hit.point_m,
            max: hit.point_m,
        };
        let near = self.index().paths_in(spot.inflated(TOLERANCE_M));
        let shown = near.filter(|&path| self.scene().state(path) == PathState::Shown);
        let mut near: Vec<u32> = shown.take(max_candidates).collect();
        near.sort_unstable();
        ReversePairs::among(self, &near).of(hit.path)
    }
}

/// Ends of a path in units of the tolerance, as a hash key.
fn end_key(start: Point<f64>, end: Point<f64>) -> [i64; 4] {
    [start.x, start.y, end.x, end.y].map(|v| (v / TOLERANCE_M).round() as i64)
}

/// Returns `true` if samples along one path lie on the other.
fn lies_on(document: &Document, path: u32, other: u32) -> bool {
    let layout = document.layout();
    let [path, back] = [path, other].map(|row| -> PathRef<'_> { layout.paths.get(row as usize) });
    let points = |path: PathRef<'_>| path.runs().flat_map(|run| run.iter()).collect::<Vec<_>>();
    let (forward, back) = (points(path), points(back));
    let are_near = |(a, b): (&Point<f64>, &Point<f64>)| a.distance(*b) <= TOLERANCE_M;
    if forward.len() == back.len() && forward.iter().zip(back.iter().rev()).all(are_near) {
        return true;
    }
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let mut samples =
        (0..SAMPLES).map(|i| (i as f64 + 0.5) / SAMPLES as f64 * segments.len() as f64);
    samples.all(|along| {
        let segment = (along as usize).min(segments.len() - 1);
        let point = uniform::point(&segments[segment], along - segment as f64);
        nearest(layout, other, point, TOLERANCE_M / 4.0)
            .is_some_and(|on| on.distance_m <= TOLERANCE_M)
    })
}
