//! Outlines: center lines of selected or hovered paths, or grid cells where there are too many.

use guideway_layout::PathRef;
use guideway_scene::View;
use guideway_spline::{Bounds, Point, uniform};

use crate::PathSet;
use crate::document::Document;

/// Most points of all lines together: drawn in a few milliseconds per frame.
const MAX_POINTS: usize = 60_000;
/// Side of a grid cell.
const CELL_PX: f64 = 6.0;
/// Largest deviation of a line from its curve.
const TOLERANCE_PX: f64 = 0.25;
/// Deepest bisection of a segment: below the resolution of `f64`.
const MAX_HALVINGS: u32 = 48;

/// Highlighted paths, to draw over a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// Center lines of the paths near the view, as polylines in pixels.
    Lines(Vec<Vec<Point<f64>>>),
    /// With too many paths for lines: the upper left corners of the grid cells that contain the
    /// center of a path's box, and the side of a cell, in pixels.
    Cells(Vec<Point<f64>>, f64),
}

/// Outlines paths of a document.
pub fn outline(document: &Document, paths: &PathSet, view: &View) -> Outline {
    let mut flattener = Flattener::new(view);
    // Every path adds at least one point: more paths than points need no further test.
    let near = paths_near(document, paths, flattener.near, MAX_POINTS + 1);
    let mut exceeds_limit = near.len() > MAX_POINTS;
    let mut paths_left = near.iter();
    while let Some(&path) = paths_left.next().filter(|_| !exceeds_limit) {
        flattener.add_path(document.layout().paths.get(path as usize));
        exceeds_limit = flattener.points > MAX_POINTS;
    }
    if exceeds_limit {
        return Outline::Cells(cells(document, paths, view), CELL_PX);
    }
    Outline::Lines(flattener.lines)
}

/// Outlines one path of any layout.
pub fn path_outline(path: PathRef<'_>, view: &View) -> Outline {
    let mut flattener = Flattener::new(view);
    flattener.add_path(path);
    Outline::Lines(flattener.lines)
}

/// Up to `limit` of `paths` that may be near a box. Many paths are looked up in the index instead
/// of one by one; a few are all returned.
pub(super) fn paths_near(
    document: &Document,
    paths: &PathSet,
    bounds: Bounds<f64>,
    limit: usize,
) -> Vec<u32> {
    const FEW: u64 = 2_000;
    if paths.len() <= FEW {
        return paths.iter().collect();
    }
    let near = document.index().paths_in(bounds);
    near.filter(|&path| paths.contains(path))
        .take(limit)
        .collect()
}

/// Corners of the grid cells that contain the center of a path's box.
fn cells(document: &Document, paths: &PathSet, view: &View) -> Vec<Point<f64>> {
    let visible = view.world_bounds();
    let near = document
        .index()
        .boxes_in(visible)
        .filter(|(path, _)| paths.contains(*path));
    let centers = near
        .map(|(_, bounds)| bounds.center())
        .filter(|&center| visible.contains(center));
    let size = view.size();
    let columns = (f64::from(size.width()) / CELL_PX) as usize + 1;
    let rows = (f64::from(size.height()) / CELL_PX) as usize + 1;
    let mut is_taken = vec![false; columns * rows];
    for center in centers {
        let pixel = view.pixel_from_world(center) * (1.0 / CELL_PX);
        // Rounding may put a center on the border outside.
        let (column, row) = (
            (pixel.x as usize).min(columns - 1),
            (pixel.y as usize).min(rows - 1),
        );
        is_taken[row * columns + column] = true;
    }
    let corner = |at: usize| Point::new((at % columns) as f64, (at / columns) as f64) * CELL_PX;
    let taken = is_taken
        .iter()
        .enumerate()
        .filter(|(_, is_taken)| **is_taken);
    taken.map(|(at, _)| corner(at)).collect()
}

/// Flattens segments to lines near the view only: zoomed in, a path is thousands of pixels long.
struct Flattener<'a> {
    view: &'a View,
    /// The view with a margin.
    near: Bounds<f64>,
    /// Longest line: screen coordinates are `f32`.
    max_length_m: f64,
    lines: Vec<Vec<Point<f64>>>,
    points: usize,
    last_m: Option<Point<f64>>,
}

impl<'a> Flattener<'a> {
    fn new(view: &'a View) -> Self {
        let visible = view.world_bounds();
        let size_m = visible.size().norm();
        Self {
            view,
            near: visible.inflated(size_m / 16.0),
            max_length_m: size_m,
            lines: Vec::new(),
            points: 0,
            last_m: None,
        }
    }

    fn add_path(&mut self, path: PathRef<'_>) {
        for segment in path.runs().flat_map(|run| run.segments()) {
            self.add_segment(&segment, MAX_HALVINGS);
        }
    }

    fn add_segment(&mut self, segment: &[Point<f64>; 4], halvings_left: u32) {
        if self.points > MAX_POINTS {
            return;
        }
        let [start, first, second, end] = uniform::to_bezier(segment);
        let hull = [start, first, second, end].map(|p| Bounds { min: p, max: p });
        let is_near = |hull: Bounds<f64>| hull.intersects(self.near);
        if !hull.into_iter().reduce(Bounds::union).is_some_and(is_near) {
            return;
        }
        // The distance of a cubic from its chord is at most 3/4 of the larger distance of an inner
        // Bezier point from the point at 1/3 or 2/3 of the chord.
        let off = |p: Point<f64>, t| p.distance(start.lerp(end, t));
        let off_m = off(first, 1.0 / 3.0).max(off(second, 2.0 / 3.0));
        let is_flat = off_m * self.view.px_per_m() <= TOLERANCE_PX;
        if halvings_left == 0 || (is_flat && start.distance(end) <= self.max_length_m) {
            self.add_line(start, end);
            return;
        }
        for half in uniform::halves(segment) {
            self.add_segment(&half, halvings_left - 1);
        }
    }

    fn add_line(&mut self, start: Point<f64>, end: Point<f64>) {
        // Consecutive halves meet up to rounding.
        let joins = |last: Point<f64>| last.distance(start) * self.view.px_per_m() < TOLERANCE_PX;
        let pixel = |p| self.view.pixel_from_world(p);
        match self.lines.last_mut() {
            Some(line) if self.last_m.is_some_and(joins) => line.push(pixel(end)),
            _ => {
                self.lines.push(vec![pixel(start), pixel(end)]);
                self.points += 1;
            }
        }
        self.points += 1;
        self.last_m = Some(end);
    }
}
