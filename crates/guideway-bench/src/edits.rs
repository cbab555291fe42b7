use std::cell::OnceCell;
use std::sync::Arc;

use guideway_render::RenderError;
use guideway_scene::{Edit, Scene};
use guideway_spline::{Affine, Point};

/// How far [`crate::Motion::Edit`] moves a path, in metres. Exact in `f32`, so that there and back is where
/// it began.
const BY_M: Point<f64> = Point { x: 0.5, y: 0.25 };

/// An edit that every other frame takes back.
#[derive(Clone, Debug)]
pub(crate) struct Edits {
    there_and_back: [Edit; 2],
    before: Arc<Scene>,
    /// Made when the first method asks for it.
    after: OnceCell<Arc<Scene>>,
}

impl Edits {
    /// Moves a share of the paths, evenly among all, and one at the least.
    pub(crate) fn new(scene: &Arc<Scene>, share: f64) -> Self {
        let paths = spread(scene.row_count(), share);
        let by = |by_m| Edit::Transform {
            paths: Arc::clone(&paths),
            by: Affine::translation(by_m),
        };
        Self {
            there_and_back: [by(BY_M), by(BY_M * -1.0)],
            before: Arc::clone(scene),
            after: OnceCell::new(),
        }
    }

    /// Paths that each edit moves.
    pub(crate) fn path_count(&self) -> usize {
        self.there_and_back[0].paths().count()
    }

    /// What frame number `frame` changes.
    pub(crate) fn edit(&self, frame: usize) -> &Edit {
        &self.there_and_back[frame % 2]
    }

    /// The scene that frame number `frame` shows, for a method that cannot change the one that it has.
    pub(crate) fn scene(&self, frame: usize) -> Result<&Arc<Scene>, RenderError> {
        if frame % 2 == 1 {
            return Ok(&self.before);
        }
        if let Some(after) = self.after.get() {
            return Ok(after);
        }
        let mut after = Scene::clone(&self.before);
        after.edit(self.edit(0)).map_err(RenderError::Edit)?;
        Ok(self.after.get_or_init(|| Arc::new(after)))
    }
}

/// Rows at even distances.
fn spread(rows: usize, share: f64) -> Arc<[u32]> {
    let count = ((rows as f64 * share).round() as usize).max(1).min(rows);
    (0..count).map(|i| (i * rows / count) as u32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dataset;

    fn starts(scene: &Scene) -> Vec<Point<f64>> {
        let paths = scene.layout().paths.iter();
        paths.map(|path| path.ends().expect("a curve").0).collect()
    }

    #[test]
    fn the_share_that_was_asked_for_moves_and_nothing_else() {
        let before = Dataset::D1.scene(200);
        for (share, expected) in [(0.000_1, 1), (0.01, 2), (0.1, 20), (1.0, 200)] {
            let edits = Edits::new(&before, share);
            assert_eq!(edits.path_count(), expected);
            let after = edits.scene(0).unwrap();
            let pairs = starts(&before).into_iter().zip(starts(after));
            let moved_rows: Vec<usize> = pairs
                .enumerate()
                .filter(|(_, (a, b))| a != b)
                .map(|(row, _)| row)
                .collect();
            assert_eq!(moved_rows.len(), expected);
            let gaps = moved_rows.windows(2).map(|pair| pair[1] - pair[0]);
            assert!(gaps.into_iter().all(|gap| gap == 200 / expected));
        }
    }

    #[test]
    fn there_and_back_is_where_it_began() {
        let scene = Dataset::D2.scene(100);
        let edits = Edits::new(&scene, 1.0);
        let mut edited = Scene::clone(&scene);
        edited.edit(edits.edit(0)).unwrap();
        assert_eq!(starts(&edited), starts(edits.scene(0).unwrap()));
        let once = starts(&edited);
        for frame in 1..20 {
            edited.edit(edits.edit(frame)).unwrap();
        }
        edited.edit(edits.edit(20)).unwrap();
        assert_eq!(starts(&edited), once);
        assert_eq!(starts(edits.scene(1).unwrap()), starts(&scene));
    }

    #[test]
    fn an_empty_scene_has_nothing_to_move() {
        let edits = Edits::new(&Dataset::D1.scene(0), 0.5);
        assert_eq!(edits.path_count(), 0);
    }
}
