//! Generates the scenes of the datasets D1 and D2 from a number of paths.

use std::sync::Arc;

use guideway_datasets::{GeneratedPath, RUN_POINTS, d1, d2};
use guideway_layout::{Geometry, Layout, Paths, RunPoints, TextColumn};
use guideway_scene::{Scene, SceneOptions};
use serde::{Deserialize, Serialize};

/// Seed of the datasets; constant, so that every run measures the same paths.
const SEED: u64 = 1;

/// One of the two datasets of the thesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dataset {
    /// Halls with aisles, roads and docks, as on a real site.
    D1,
    /// Curves scattered over one field, with heavy overlap.
    D2,
}

impl Dataset {
    /// Both datasets.
    pub const ALL: [Self; 2] = [Self::D1, Self::D2];

    /// `D1` or `D2`.
    pub fn name(self) -> &'static str {
        match self {
            Self::D1 => "D1",
            Self::D2 => "D2",
        }
    }

    /// A layout with this number of paths.
    pub fn layout(self, paths: usize) -> Layout {
        match self {
            Self::D1 => collect(d1(paths, SEED)),
            Self::D2 => collect(d2(paths, SEED)),
        }
    }

    /// A scene with this number of black paths.
    pub fn scene(self, paths: usize) -> Arc<Scene> {
        plain_scene(self.layout(paths))
    }

    /// [`Self::scene`], copied from a larger scene if that contains it, which is faster. `None` for
    /// D1, whose halls depend on the number of paths; the paths of D2 do not.
    pub fn part(self, larger: &Scene, paths: usize) -> Option<Arc<Scene>> {
        match self {
            Self::D1 => None,
            Self::D2 => Some(plain_scene(first(larger.layout(), paths))),
        }
    }
}

/// A scene with the colors of the layout and all paths visible.
pub fn plain_scene(layout: Layout) -> Arc<Scene> {
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default());
    Arc::new(scene.expect("default options name no level and no column"))
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

/// The first paths of a layout that [`collect`] built.
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

#[cfg(test)]
mod tests {
    use guideway_layout::PathRef;

    use super::*;

    #[test]
    fn datasets_have_the_requested_number_of_paths() {
        for dataset in Dataset::ALL {
            let scene = dataset.scene(123);
            assert_eq!(scene.draw_order().len(), 123);
            assert_eq!(scene.layout().paths.geometry().segment_count(), 123 * 8);
        }
    }

    #[test]
    fn part_equals_the_smaller_scene() {
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
        // The halls of D1 depend on the number of paths.
        assert!(Dataset::D1.part(&Dataset::D1.scene(300), 123).is_none());
    }
}
