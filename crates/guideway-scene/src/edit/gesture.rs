//! Gestures: paths that are shown as an affine map leaves them while a person drags, turns, mirrors
//! or scales them. No path changes before the edit that ends the gesture.

use std::sync::Arc;

use guideway_spline::{Affine, Bounds};

use super::check::{check_rows, hull_of, is_in_bounds};
use super::error::EditError;
use super::operation::Edit;
use crate::scene::Scene;

/// Paths and the map from where the scene has them to where they are shown.
#[derive(Clone, Debug, PartialEq)]
pub struct Gesture {
    /// Rows of paths, each once. Frames of one gesture share them.
    pub paths: Arc<[u32]>,
    /// The map of each control point.
    pub by: Affine,
}

impl Gesture {
    /// The edit that leaves the paths where they are shown.
    pub fn edit(&self) -> Edit {
        Edit::Transform {
            paths: Arc::clone(&self.paths),
            by: self.by,
        }
    }
}

/// The paths of a gesture, checked once for all of its maps.
#[derive(Clone, Debug)]
pub struct GesturePaths {
    paths: Arc<[u32]>,
    /// Box of their control points where the scene has them; `None` without points.
    hull: Option<Bounds<f64>>,
}

impl GesturePaths {
    /// Checks the paths of a gesture, in time proportional to their number.
    ///
    /// # Errors
    /// When the scene has no such row, or a row occurs twice.
    pub fn begin(scene: &Scene, gesture: &Gesture) -> Result<Self, EditError> {
        check_rows(scene, &gesture.paths)?;
        Ok(Self {
            paths: Arc::clone(&gesture.paths),
            hull: hull_of(scene, &gesture.paths),
        })
    }

    /// Returns `true` if a gesture has these paths.
    pub fn are_of(&self, gesture: &Gesture) -> bool {
        Arc::ptr_eq(&self.paths, &gesture.paths) || self.paths == gesture.paths
    }

    /// Accepts a map or returns the reason for rejecting it.
    ///
    /// # Errors
    /// When the box of the paths would exceed the coordinate limit.
    pub fn check(&self, by: Affine) -> Result<(), EditError> {
        let corners = self.hull.into_iter().flat_map(Bounds::corners);
        match by.is_finite() && is_in_bounds(corners.map(|p| by.apply(p))) {
            true => Ok(()),
            false => Err(EditError::FarGesture),
        }
    }
}
