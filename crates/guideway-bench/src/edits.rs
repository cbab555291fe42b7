//! Builds the gestures and edits of [`crate::Motion::Edit`]: a share of the paths moves, and the
//! next frame moves them back.

use std::cell::OnceCell;
use std::sync::Arc;

use guideway_layout::OwnStyle;
use guideway_scene::{Coloring, Edit, EditError, Gesture, PathState, RenderError, Scene};
use guideway_spline::{Affine, Point};
use serde::{Deserialize, Serialize};

/// Shift of a moved path, in meters. Exact in `f32`, so that the second move restores the first
/// position.
const BY_M: Point<f64> = Point { x: 0.5, y: 0.25 };

/// The paths that [`crate::Motion::Edit`] moves per frame, and the kind of edit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moves {
    /// Share of all paths, from 0 to 1.
    pub share: f64,
    /// Way in which they move.
    pub way: Way,
}

/// Way in which paths change from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Way {
    /// One map shows all of them elsewhere, as during a drag. A method that shows no gestures
    /// moves them as by [`Self::Drop`].
    #[default]
    Gesture,
    /// One transform edits all of them, as at the end of a drag.
    Drop,
    /// Each gets its own new curve.
    Apart,
    /// They do not move: they are removed, and the next frame undoes that.
    Remove,
    /// They do not move: they get another color and width, and the next frame undoes that.
    Restyle,
    /// They do not move: the scene takes other colors, as by another column, and the next frame its
    /// own.
    Recolor,
}

/// A change of a prepared scene.
#[derive(Clone, Copy, Debug)]
pub enum Change<'a> {
    /// An edit.
    Edit(&'a Edit),
    /// Other colors.
    Coloring(&'a Coloring),
}

impl Change<'_> {
    /// Applies the change to a scene.
    ///
    /// # Errors
    /// When the scene refuses the edit.
    pub fn apply(self, scene: &mut Scene) -> Result<(), EditError> {
        match self {
            Self::Edit(edit) => return scene.edit(edit),
            Self::Coloring(coloring) => scene.recolor(coloring),
        }
        Ok(())
    }
}

/// Changes of a kind, and their inverses.
#[derive(Clone, Debug)]
enum ThereAndBack {
    Edits([Edit; 2]),
    Colorings([Coloring; 2]),
}

/// A change and its inverse; frames apply them alternately.
#[derive(Clone, Debug)]
pub struct Edits {
    /// `None` if all frames are edits.
    gestures: Option<[Gesture; 2]>,
    there_and_back: ThereAndBack,
    path_count: usize,
    before: Arc<Scene>,
    /// Built on the first request.
    after: OnceCell<Arc<Scene>>,
}

impl Edits {
    /// Moves a share of the paths, evenly spaced in row order, and at least one.
    pub fn new(scene: &Arc<Scene>, moves: Moves) -> Self {
        let paths = evenly_spaced(scene.row_count(), moves.share);
        let edits = match moves.way {
            Way::Apart => move_separately(scene, &paths),
            Way::Gesture | Way::Drop => [BY_M, BY_M * -1.0].map(|by_m| Edit::Transform {
                paths: Arc::clone(&paths),
                by: Affine::translation(by_m),
            }),
            Way::Remove => [PathState::Removed, PathState::Shown]
                .map(|state| Edit::SetStates(paths.iter().map(|&row| (row, state)).collect())),
            Way::Restyle | Way::Recolor => restyle(scene, &paths),
        };
        Self {
            gestures: (moves.way == Way::Gesture).then(|| gestures(&paths)),
            there_and_back: match moves.way {
                Way::Recolor => ThereAndBack::Colorings(colorings(scene, &edits[0])),
                _ => ThereAndBack::Edits(edits),
            },
            path_count: paths.len(),
            before: Arc::clone(scene),
            after: OnceCell::new(),
        }
    }

    /// Number of paths per edit.
    pub fn path_count(&self) -> usize {
        self.path_count
    }

    /// The gesture of frame number `frame`, unless it is an edit.
    pub fn gesture(&self, frame: usize) -> Option<&Gesture> {
        Some(&self.gestures.as_ref()?[frame % 2])
    }

    /// The change of frame number `frame`.
    pub fn change(&self, frame: usize) -> Change<'_> {
        match &self.there_and_back {
            ThereAndBack::Edits(edits) => Change::Edit(&edits[frame % 2]),
            ThereAndBack::Colorings(colorings) => Change::Coloring(&colorings[frame % 2]),
        }
    }

    /// The edited scene of frame number `frame`, for a method that cannot edit in place.
    ///
    /// # Errors
    /// When the scene refuses the edit.
    pub fn scene(&self, frame: usize) -> Result<&Arc<Scene>, RenderError> {
        if frame % 2 == 1 {
            return Ok(&self.before);
        }
        if let Some(after) = self.after.get() {
            return Ok(after);
        }
        let mut after = Scene::clone(&self.before);
        let changed = self.change(0).apply(&mut after);
        changed.map_err(RenderError::Edit)?;
        Ok(self.after.get_or_init(|| Arc::new(after)))
    }
}

/// Shows paths elsewhere, and where they are.
fn gestures(paths: &Arc<[u32]>) -> [Gesture; 2] {
    [Affine::translation(BY_M), Affine::IDENTITY].map(|by| Gesture {
        paths: Arc::clone(paths),
        by,
    })
}

/// New curves per path, shifted in four directions so that neighbors differ.
fn move_separately(scene: &Scene, paths: &Arc<[u32]>) -> [Edit; 2] {
    let rows = paths.iter().map(|&path| path as usize);
    let before = scene.layout().paths.geometry().select(rows);
    let Point { x, y } = BY_M;
    let directions = [(x, y), (-y, x), (-x, -y), (y, -x)].map(|(x, y)| Point::new(x, y));
    let mut after = before.clone();
    for curve in 0..after.path_count() {
        let shift = Affine::translation(directions[curve % directions.len()]);
        after.transform([curve], shift);
    }
    [after, before].map(|curves| Edit::Reshape {
        paths: Arc::clone(paths),
        curves: Arc::new(curves),
        written: Arc::default(),
    })
}

/// Another color and width for each path, and its own again.
fn restyle(scene: &Scene, paths: &[u32]) -> [Edit; 2] {
    let other = OwnStyle {
        width_m: Some(0.2),
        color_rgba: Some(0x2050_c0ff),
    };
    let own = |row: u32| scene.layout().paths.own_style(row as usize);
    [
        Edit::Restyle(paths.iter().map(|&row| (row, other)).collect()),
        Edit::Restyle(paths.iter().map(|&row| (row, own(row))).collect()),
    ]
}

/// The colors of a scene after an edit of its styles, and its own.
fn colorings(scene: &Scene, restyle: &Edit) -> [Coloring; 2] {
    let mut other = scene.clone();
    // Cannot fail: all rows exist.
    let _ = other.edit(restyle);
    [&other, scene].map(|scene| scene.coloring().clone())
}

/// A share of the rows, at even distances.
fn evenly_spaced(rows: usize, share: f64) -> Arc<[u32]> {
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
    fn moves_the_requested_share_only() {
        let before = Dataset::D1.scene(200);
        for (share, expected) in [(0.000_1, 1), (0.01, 2), (0.1, 20), (1.0, 200)] {
            for way in [Way::Gesture, Way::Apart] {
                let edits = Edits::new(&before, Moves { share, way });
                assert_eq!(edits.gesture(0).is_some(), way == Way::Gesture);
                assert_eq!(edits.path_count(), expected);
                let after = edits.scene(0).unwrap();
                let pairs = starts(&before).into_iter().zip(starts(after));
                let moved: Vec<(usize, Point<f64>)> = pairs
                    .map(|(a, b)| b - a)
                    .enumerate()
                    .filter(|(_, way)| *way != Point::new(0.0, 0.0))
                    .collect();
                assert_eq!(moved.len(), expected);
                for pair in moved.windows(2) {
                    assert_eq!(pair[1].0 - pair[0].0, 200 / expected);
                    let goes_along = pair[1].1.distance(pair[0].1) < 0.01;
                    assert_eq!(goes_along, way != Way::Apart);
                }
            }
        }
    }

    #[test]
    fn alternating_edits_restore_the_scene() {
        let scene = Dataset::D2.scene(100);
        for way in [Way::Drop, Way::Apart] {
            let moves = Moves { share: 1.0, way };
            let edits = Edits::new(&scene, moves);
            let mut edited = Scene::clone(&scene);
            edits.change(0).apply(&mut edited).unwrap();
            assert_eq!(starts(&edited), starts(edits.scene(0).unwrap()));
            let once = starts(&edited);
            for frame in 1..20 {
                edits.change(frame).apply(&mut edited).unwrap();
            }
            edits.change(20).apply(&mut edited).unwrap();
            assert_eq!(starts(&edited), once);
            assert_eq!(starts(edits.scene(1).unwrap()), starts(&scene));
        }
    }

    #[test]
    fn removal_and_styles_are_undone_by_the_next_frame() {
        let scene = Dataset::D1.scene(100);
        let looks = |scene: &Scene| -> Vec<_> {
            let rows = 0..scene.row_count() as u32;
            let look = |row| (scene.state(row), scene.color(row), scene.width_m(row));
            rows.map(look).collect()
        };
        for way in [Way::Remove, Way::Restyle, Way::Recolor] {
            let edits = Edits::new(&scene, Moves { share: 0.2, way });
            let mut edited = Scene::clone(&scene);
            edits.change(0).apply(&mut edited).unwrap();
            let changed = looks(&edited);
            let changed = changed.iter().zip(looks(&scene)).filter(|(a, b)| **a != *b);
            assert_eq!(changed.count(), 20, "{way:?}");
            edits.change(1).apply(&mut edited).unwrap();
            assert_eq!(looks(&edited), looks(&scene), "{way:?}");
        }
    }

    #[test]
    fn an_empty_scene_has_no_paths_to_move() {
        for way in [
            Way::Gesture,
            Way::Drop,
            Way::Apart,
            Way::Remove,
            Way::Restyle,
            Way::Recolor,
        ] {
            let moves = Moves { share: 0.5, way };
            assert_eq!(Edits::new(&Dataset::D1.scene(0), moves).path_count(), 0);
        }
    }
}
