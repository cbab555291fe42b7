use std::sync::Arc;

use guideway_datasets::{GeneratedPath, RUN_POINTS, d1, d2};
use guideway_layout::{Geometry, Layout, Paths, RunPoints, TextColumn};
use guideway_scene::{Scene, SceneOptions};
use guideway_spline::Point;
use serde::{Deserialize, Serialize};

/// Seed of the datasets: every run measures the same paths.
const SEED: u64 = 1;

/// One of the two kinds of layout that the thesis measures with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dataset {
    /// The shape of a real site.
    D1,
    /// Curves over one field, until every pixel lies under many.
    D2,
}

impl Dataset {
    /// Both.
    pub const ALL: [Self; 2] = [Self::D1, Self::D2];

    /// `D1` or `D2`.
    pub fn name(self) -> &'static str {
        match self {
            Self::D1 => "D1",
            Self::D2 => "D2",
        }
    }

    /// A layout of so many paths.
    pub fn layout(self, paths: usize) -> Layout {
        match self {
            Self::D1 => collect(d1(paths, SEED)),
            Self::D2 => collect(d2(paths, SEED)),
        }
    }

    /// The same, black, ready to be prepared.
    pub fn scene(self, paths: usize) -> Arc<Scene> {
        plain_scene(self.layout(paths))
    }

    /// The same as [`Self::scene`] in less time, where a larger scene has it inside. D1 plans its halls for
    /// the whole number of paths, D2 throws one path after the other.
    pub(crate) fn part(self, larger: &Scene, paths: usize) -> Option<Arc<Scene>> {
        match self {
            Self::D1 => None,
            Self::D2 => Some(plain_scene(first(larger.layout(), paths))),
        }
    }
}

/// A scene with the layout's own colours and every path shown.
pub fn plain_scene(layout: Layout) -> Arc<Scene> {
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default());
    Arc::new(scene.expect("only a level or a column that was asked for can be missing"))
}

fn collect(paths: impl Iterator<Item = GeneratedPath>) -> Layout {
    let (mut ids, mut points, mut ends) = (TextColumn::default(), Vec::new(), Vec::new());
    for path in paths {
        ids.push(&path.id);
        points.extend_from_slice(&path.run);
        ends.push((ids.len() * RUN_POINTS) as u32);
    }
    Layout {
        paths: Paths::from_columns(ids, Geometry::from_f32(points, ends)),
        ..Layout::default()
    }
}

/// The first paths of a layout that [`collect`] has made.
fn first(layout: &Layout, paths: usize) -> Layout {
    let own = || layout.paths.iter().take(paths);
    let mut points = Vec::with_capacity(own().len() * RUN_POINTS);
    for run in own().flat_map(|path| path.runs()) {
        match run {
            RunPoints::F32(run) => points.extend_from_slice(run),
            RunPoints::F64(run) => points.extend(run.iter().map(|p| p.to_f32())),
        }
    }
    let ends = (1..=own().len()).map(|row| (row * RUN_POINTS) as u32);
    Layout {
        paths: Paths::from_columns(
            own().map(|path| path.id()).collect(),
            Geometry::from_f32(points, ends.collect()),
        ),
        ..Layout::default()
    }
}

/// A copy of a layout in which a share of the paths, evenly among all, lies elsewhere.
pub(crate) fn moved(layout: &Layout, share: f64, by_m: Point<f64>) -> Layout {
    let old = &layout.paths;
    let is_moved = |row: usize| (row as f64 * share).floor() < ((row + 1) as f64 * share).floor();
    let (mut points, mut run_ends, mut path_ends) = (Vec::new(), Vec::new(), Vec::new());
    let mut is_single = true;
    for path in old.iter() {
        let shift = if is_moved(path.row()) {
            by_m
        } else {
            Point::new(0.0, 0.0)
        };
        for run in path.runs() {
            is_single &= matches!(run, RunPoints::F32(_));
            points.extend(run.iter().map(|p| p + shift));
            run_ends.push(points.len() as u32);
        }
        path_ends.push(run_ends.len() as u32);
    }
    // In the precision of the original, so that a method reads as many bytes as before.
    let geometry = if is_single {
        Geometry::from_f32(points.iter().map(|p| p.to_f32()).collect(), run_ends)
    } else {
        Geometry::from_f64(points, run_ends)
    };
    let ids = old.iter().map(|path| path.id()).collect();
    let mut paths = Paths::from_columns(ids, geometry.with_path_ends(path_ends));
    if let Some(width_m) = old.width_m() {
        paths.set_width_m(width_m.to_vec());
    }
    if let Some(color_rgba) = old.color_rgba() {
        paths.set_color_rgba(color_rgba.to_vec());
    }
    if let Some(rank) = old.rank() {
        paths.set_rank(rank.to_vec());
    }
    Layout {
        paths,
        refused: layout.refused.clone(),
        ..Layout::default()
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::PathRef;

    use super::*;

    fn starts(layout: &Layout) -> Vec<Point<f64>> {
        let first = |row| layout.paths.get(row).ends().expect("a curve").0;
        (0..layout.paths.len()).map(first).collect()
    }

    #[test]
    fn datasets_have_as_many_paths_as_asked_for() {
        for dataset in Dataset::ALL {
            let scene = dataset.scene(123);
            assert_eq!(scene.draw_order().len(), 123);
            assert_eq!(scene.layout().paths.geometry().segment_count(), 123 * 8);
        }
    }

    #[test]
    fn a_part_of_a_scene_is_the_smaller_scene() {
        let larger = Dataset::D2.scene(300);
        let (part, whole) = (Dataset::D2.part(&larger, 123), Dataset::D2.scene(123));
        let of = |scene: &Scene| {
            let paths = scene.layout().paths.iter();
            let path = |p: PathRef<'_>| {
                let points = p.runs().flat_map(|run| run.iter().collect::<Vec<_>>());
                (p.id().to_owned(), points.collect::<Vec<_>>())
            };
            paths.map(path).collect::<Vec<_>>()
        };
        let part = part.unwrap();
        assert_eq!(of(&part), of(&whole));
        assert_eq!(part.bounds(), whole.bounds());
        let run = part.layout().paths.get(0).runs().next();
        assert!(matches!(run, Some(RunPoints::F32(_))));
        // Not so where all depends on the number of paths.
        assert!(Dataset::D1.part(&Dataset::D1.scene(300), 123).is_none());
    }

    #[test]
    fn the_share_that_was_asked_for_moves_and_nothing_else() {
        let mut before = Dataset::D1.layout(200);
        before.paths.set_rank((0..200).rev().collect());
        for (share, expected) in [(0.01, 2), (0.1, 20), (1.0, 200)] {
            let after = moved(&before, share, Point::new(2.0, -1.0));
            let pairs = starts(&before).into_iter().zip(starts(&after));
            let shifts: Vec<f64> = pairs.map(|(a, b)| a.distance(b)).collect();
            let far = shifts.iter().filter(|&&s| s > 2.2 && s < 2.3).count();
            let near = shifts.iter().filter(|&&s| s == 0.0).count();
            assert_eq!((far, near), (expected, 200 - expected));
            assert_eq!(after.paths.rank(), before.paths.rank());
            let run = after.paths.get(0).runs().next();
            assert!(matches!(run, Some(RunPoints::F32(_))));
        }
    }
}
