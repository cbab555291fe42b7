//! Handles: the clamped control points of selected paths, to drag in the window.

use guideway_scene::View;
use guideway_spline::Point;

use super::marks::MAX_MARKED;
use super::outline::paths_near;
use crate::document::Document;
use crate::edit::{PointRef, clamped};

/// A control point that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// The control point.
    pub point: PointRef,
    /// Its position, in pixels.
    pub at_px: Point<f64>,
    /// True if the previous handle is of the same run, so that a line connects the two.
    pub follows: bool,
}

/// The control points of the selected paths in a view, run by run; empty if there are more than
/// [`MAX_MARKED`].
pub fn handles(document: &Document, view: &View) -> Vec<Handle> {
    let visible = view.world_bounds();
    let mut handles = Vec::new();
    // Every path has at least one control point: more paths than handles need no further test.
    let mut near = paths_near(document, document.selection(), visible, MAX_MARKED + 1);
    if near.len() > MAX_MARKED {
        return Vec::new();
    }
    near.sort_unstable();
    for row in near {
        let path = document.layout().paths.get(row as usize);
        if !path
            .hull_bounds()
            .is_some_and(|hull| hull.intersects(visible))
        {
            continue;
        }
        for (run, points) in path.runs().enumerate() {
            let handle = |(point, at)| Handle {
                point: PointRef {
                    path: row,
                    run,
                    point,
                },
                at_px: view.pixel_from_world(at),
                follows: point > 0,
            };
            if handles.len() + points.len() > MAX_MARKED {
                return Vec::new();
            }
            let points: Vec<Point<f64>> = points.iter().collect();
            handles.extend(clamped(&points).into_iter().enumerate().map(handle));
        }
    }
    handles
}
