//! Which paths are where: exactly, by the distance of their curves, not by samples.

use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use guideway_scene::PathState;
use guideway_scene::{NO_PATH, RenderError};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use super::flatten::{clip, flatten};
use super::index::Index;
use super::shot::Shot;
use super::sight::{Sight, Sights};

/// Both ends of a line, in pixels.
type Line = [Point<f64>; 2];

/// A part of the picture, and what may lie there.
pub(super) struct Question<'a> {
    pub(super) shot: &'a Shot<'a>,
    pub(super) index: &'a Index,
    pub(super) sights: &'a Sights,
}

impl Question<'_> {
    /// See [`guideway_scene::Prepared::top_paths`].
    pub(super) fn top_paths(&self) -> Result<Vec<u32>, RenderError> {
        let [width, height] = {
            let size = self.shot.view.size();
            [size.width(), size.height()].map(|side| side as usize)
        };
        let ranks = self.index.ranks.as_deref();
        // One more than the rank. The greatest stays, in whatever order they come.
        let tops: Vec<AtomicU32> = (0..width * height).map(|_| AtomicU32::new(0)).collect();
        self.for_each_line(&|path, radius_px, line| {
            let rank = ranks.map_or(path, |ranks| ranks[path as usize]);
            for_each_pixel(line, radius_px, [width, height], |column, row| {
                tops[row * width + column].fetch_max(rank + 1, Ordering::Relaxed);
            });
        })?;
        let order = self.shot.scene.draw_order();
        let path = |top: AtomicU32| match top.into_inner().checked_sub(1) {
            Some(rank) if ranks.is_some() => order[rank as usize],
            Some(row) => row,
            None => NO_PATH,
        };
        Ok(tops.into_iter().map(path).collect())
    }

    /// See [`guideway_scene::Prepared::paths_in`].
    pub(super) fn paths_in(&self) -> Result<Vec<u32>, RenderError> {
        let picture = self.shot.picture_px();
        let rows = self.shot.scene.row_count();
        let is_there: Vec<AtomicBool> = (0..rows).map(|_| AtomicBool::new(false)).collect();
        self.for_each_line(&|path, radius_px, line| {
            if distance(line, picture) < radius_px {
                is_there[path as usize].store(true, Ordering::Relaxed);
            }
        })?;
        let found = (0..)
            .zip(is_there)
            .filter(|(_, is_there)| is_there.load(Ordering::Relaxed));
        Ok(found.map(|(path, _)| path).collect())
    }

    /// Calls `work` with the lines of all paths that may be there, in parallel, each with its path and half the
    /// width of that.
    fn for_each_line(&self, work: &(impl Fn(u32, f64, Line) + Sync)) -> Result<(), RenderError> {
        let (shot, picture) = (self.shot, self.shot.picture_px());
        let geometry = shot.scene.layout().paths.geometry();
        let seen = shot.seen_px();
        let lines_of = |pixels: &mut Vec<Point<f64>>, sight: &Sight| {
            shot.cancel.check()?;
            for &path in self.index.paths_of(sight.cluster) {
                if shot.scene.state(path) != PathState::Shown {
                    continue;
                }
                let radius_px = shot.radius_px(path);
                for run in geometry.runs(path as usize) {
                    pixels.clear();
                    pixels.extend(run.iter().map(|p| shot.view.pixel_from_world(p)));
                    let hull = Bounds::of_points(pixels.iter().copied());
                    if hull.is_some_and(|hull| hull.inflated(radius_px).intersects(picture)) {
                        flatten(pixels, seen, &mut |start, end| {
                            work(path, radius_px, [start, end]);
                        });
                    }
                }
            }
            Ok(())
        };
        self.sights.par_iter().try_for_each_init(Vec::new, lines_of)
    }
}

/// Calls `found` with the column and the row of each pixel that a stroke covers any part of.
fn for_each_pixel(
    line: Line,
    radius_px: f64,
    [width, height]: [usize; 2],
    mut found: impl FnMut(usize, usize),
) {
    // A float below zero becomes 0: that is the clamp to the picture.
    let pixels = |least: f64, most: f64, side: usize| {
        (least - radius_px).floor() as usize..((most + radius_px).ceil() as usize).min(side)
    };
    let [a, b] = line;
    for row in pixels(a.y.min(b.y), a.y.max(b.y), height) {
        let top = row as f64;
        let near = Bounds {
            min: Point::new(f64::NEG_INFINITY, top - radius_px),
            max: Point::new(f64::INFINITY, top + 1.0 + radius_px),
        };
        let Some((a, b)) = clip(a, b, near) else {
            continue;
        };
        for column in pixels(a.x.min(b.x), a.x.max(b.x), width) {
            let left = column as f64;
            let pixel = Bounds {
                min: Point::new(left, top),
                max: Point::new(left + 1.0, top + 1.0),
            };
            if distance(line, pixel) < radius_px {
                found(column, row);
            }
        }
    }
}

/// Distance of a line from a box: 0 where they meet, else that of an end from the box or of a corner from the line.
fn distance([a, b]: Line, from: Bounds<f64>) -> f64 {
    if clip(a, b, from).is_some() {
        return 0.0;
    }
    let (min, max) = (from.min, from.max);
    let to_box =
        |p: Point<f64>| p.distance(Point::new(p.x.clamp(min.x, max.x), p.y.clamp(min.y, max.y)));
    let along = b - a;
    let square = along.dot(along);
    let to_line = |p: Point<f64>| {
        let part = if square > 0.0 {
            (p - a).dot(along) / square
        } else {
            0.0
        };
        p.distance(a + along * part.clamp(0.0, 1.0))
    };
    let corners = [
        (min.x, min.y),
        (max.x, min.y),
        (min.x, max.y),
        (max.x, max.y),
    ];
    let of_corners = corners.map(|(x, y)| to_line(Point::new(x, y)));
    of_corners
        .into_iter()
        .fold(to_box(a).min(to_box(b)), f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_to_the_nearest_of_ends_and_corners() {
        let at = |x, y| Point::new(x, y);
        let unit = Bounds {
            min: at(0.0, 0.0),
            max: at(1.0, 1.0),
        };
        for (line, expected) in [
            ([at(-1.0, 0.5), at(2.0, 0.5)], 0.0),
            ([at(0.2, 0.2), at(0.3, 0.3)], 0.0),
            ([at(3.0, 0.5), at(9.0, 7.0)], 2.0),
            ([at(0.0, 3.0), at(3.0, 0.0)], 0.5_f64.sqrt()),
            ([at(4.0, 5.0), at(4.0, 5.0)], 5.0),
        ] {
            assert!((distance(line, unit) - expected).abs() < 1e-12, "{line:?}");
        }
    }
}
