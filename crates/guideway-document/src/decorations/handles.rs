use guideway_scene::View;
use guideway_spline::Point;

use super::MAX_MARKED;
use super::outline::near;
use crate::{Document, PointRef};

/// A control point that can be taken hold of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// Which one.
    pub point: PointRef,
    /// Where it is, in pixels.
    pub at_px: Point<f64>,
    /// Whether the one before is of the same run, so that a line leads here from it.
    pub follows: bool,
}

/// The control points of the selected paths near a view, run by run; none if there are more than
/// [`MAX_MARKED`].
pub fn handles(document: &Document, view: &View) -> Vec<Handle> {
    let seen = view.world_bounds();
    let mut handles = Vec::new();
    // A path has a control point at least, so very many need not be tried.
    let mut near = near(document, document.selection(), seen, MAX_MARKED + 1);
    if near.len() > MAX_MARKED {
        return Vec::new();
    }
    near.sort_unstable();
    for row in near {
        let path = document.layout().paths.get(row as usize);
        if !path.hull_bounds().is_some_and(|hull| hull.intersects(seen)) {
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
            handles.extend(points.iter().enumerate().map(handle));
        }
    }
    handles
}
