use std::collections::HashMap;

use guideway_layout::PathRef;
use guideway_scene::PathState;
use guideway_spline::Point;

use crate::{Document, Hit, nearest};

/// How far two paths of a pair may be from each other, in meters.
const APART_M: f64 = 1e-3;
/// Places along a path that are compared with the other one.
const PLACES: usize = 5;

/// Pairs of paths that lie on each other and lead opposite ways: one lane, for people.
#[derive(Clone, Debug, Default)]
pub struct ReversePairs(HashMap<u32, u32>);

impl ReversePairs {
    /// The pairs among some paths of a document. A path has one twin at most, the first there is.
    pub fn among(document: &Document, paths: &[u32]) -> Self {
        let layout = document.layout();
        let ends = |row: u32| layout.paths.get(row as usize).ends();
        let mut alone: HashMap<[i64; 4], Vec<u32>> = HashMap::new();
        let mut twins = HashMap::new();
        for &path in paths {
            let Some((start, end)) = ends(path) else {
                continue;
            };
            let back = alone.get_mut(&place(end, start));
            let found = back.and_then(|others| {
                let is_twin = |&other: &u32| lies_on(document, path, other);
                let at = others.iter().position(is_twin)?;
                Some(others.swap_remove(at))
            });
            match found {
                Some(other) => {
                    twins.insert(path, other);
                    twins.insert(other, path);
                }
                None => alone.entry(place(start, end)).or_default().push(path),
            }
        }
        Self(twins)
    }

    /// The other path of a pair.
    pub fn of(&self, path: u32) -> Option<u32> {
        self.0.get(&path).copied()
    }
}

impl Document {
    /// The path that leads back where one leads that was pointed at; none if none lies on it. None if more than `most`
    /// paths may be near.
    pub fn reverse_path_at(&self, hit: &Hit, most: usize) -> Option<u32> {
        let spot = guideway_spline::Bounds {
            min: hit.point_m,
            max: hit.point_m,
        };
        let near = self.index().paths_in(spot.inflated(APART_M));
        let shown = near.filter(|&path| self.scene().state(path) == PathState::Shown);
        let mut near: Vec<u32> = shown.take(most).collect();
        near.sort_unstable();
        ReversePairs::among(self, &near).of(hit.path)
    }
}

/// Ends of a path, in steps of the greatest distance.
fn place(start: Point<f64>, end: Point<f64>) -> [i64; 4] {
    [start.x, start.y, end.x, end.y].map(|v| (v / APART_M).round() as i64)
}

/// Whether places along one path are on the other.
fn lies_on(document: &Document, path: u32, other: u32) -> bool {
    let layout = document.layout();
    let [path, back] = [path, other].map(|row| -> PathRef<'_> { layout.paths.get(row as usize) });
    let points = |path: PathRef<'_>| path.runs().flat_map(|run| run.iter()).collect::<Vec<_>>();
    let (there, back) = (points(path), points(back));
    let are_near = |(a, b): (&Point<f64>, &Point<f64>)| a.distance(*b) <= APART_M;
    if there.len() == back.len() && there.iter().zip(back.iter().rev()).all(are_near) {
        return true;
    }
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let mut places = (0..PLACES).map(|i| (i as f64 + 0.5) / PLACES as f64 * segments.len() as f64);
    places.all(|along| {
        let segment = (along as usize).min(segments.len() - 1);
        let point = guideway_spline::uniform::point(&segments[segment], along - segment as f64);
        nearest(layout, other, point, APART_M / 4.0).is_some_and(|on| on.distance_m <= APART_M)
    })
}
