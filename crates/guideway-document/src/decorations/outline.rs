use guideway_layout::PathRef;
use guideway_scene::View;
use guideway_spline::{Bounds, Point, uniform};

use crate::{Document, PathSet};

/// Most points of all lines together.
const MOST_POINTS: usize = 60_000;
/// Side of a cell, where there is too much for lines.
const CELL_PX: f64 = 6.0;
/// Greatest deviation of a line from its curve.
const TOLERANCE_PX: f64 = 0.25;
/// How often a segment is halved at most.
const MOST_HALVINGS: u32 = 48;

/// Chosen paths, to be drawn over a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// The center lines of the paths, in pixels, as far as they are near the view.
    Lines(Vec<Vec<Point<f64>>>),
    /// Where there are too many for lines: the upper left corners of the cells of a grid that the boxes of
    /// the paths have their middle in, and the side of a cell, in pixels.
    Cells(Vec<Point<f64>>, f64),
}

/// Outlines paths of a document.
pub fn outline(document: &Document, paths: &PathSet, view: &View) -> Outline {
    let mut pen = Pen::new(view);
    // A path takes a point at least, so very many need not be tried.
    let near = near(document, paths, pen.seen, MOST_POINTS + 1);
    let mut is_too_much = near.len() > MOST_POINTS;
    let mut paths_left = near.iter();
    while let Some(&path) = paths_left.next().filter(|_| !is_too_much) {
        pen.draw(document.layout().paths.get(path as usize));
        is_too_much = pen.points > MOST_POINTS;
    }
    if is_too_much {
        return Outline::Cells(cells(document, paths, view), CELL_PX);
    }
    Outline::Lines(pen.lines)
}

/// Outlines one path, of whatever layout.
pub fn path_outline(path: PathRef<'_>, view: &View) -> Outline {
    let mut pen = Pen::new(view);
    pen.draw(path);
    Outline::Lines(pen.lines)
}

/// Those of `paths` that may be near a box, `most` of them, without a look at each where they are many.
pub(super) fn near(
    document: &Document,
    paths: &PathSet,
    bounds: Bounds<f64>,
    most: usize,
) -> Vec<u32> {
    const FEW: u64 = 2_000;
    if paths.len() <= FEW {
        return paths.iter().collect();
    }
    let near = document.index().paths_in(bounds);
    near.filter(|&path| paths.contains(path))
        .take(most)
        .collect()
}

fn cells(document: &Document, paths: &PathSet, view: &View) -> Vec<Point<f64>> {
    let seen = view.world_bounds();
    let near = document
        .index()
        .boxes_in(seen)
        .filter(|(path, _)| paths.contains(*path));
    let middles = near
        .map(|(_, bounds)| bounds.center())
        .filter(|&middle| seen.contains(middle));
    let size = view.size();
    let columns = (f64::from(size.width()) / CELL_PX) as usize + 1;
    let rows = (f64::from(size.height()) / CELL_PX) as usize + 1;
    let mut is_taken = vec![false; columns * rows];
    for middle in middles {
        let pixel = view.pixel_from_world(middle) * (1.0 / CELL_PX);
        // A middle on the border may be rounded over it.
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

/// Draws segments as lines, and only what is near the view: at a great scale a path is as long as a street.
struct Pen<'a> {
    view: &'a View,
    /// The view, and some more on each side.
    seen: Bounds<f64>,
    /// No line longer than this goes to the screen, whose coordinates are `f32`.
    longest_m: f64,
    lines: Vec<Vec<Point<f64>>>,
    points: usize,
    last_m: Option<Point<f64>>,
}

impl<'a> Pen<'a> {
    fn new(view: &'a View) -> Self {
        let seen = view.world_bounds();
        let size_m = seen.size().norm();
        Self {
            view,
            seen: seen.inflated(size_m / 16.0),
            longest_m: size_m,
            lines: Vec::new(),
            points: 0,
            last_m: None,
        }
    }

    fn draw(&mut self, path: PathRef<'_>) {
        for segment in path.runs().flat_map(|run| run.segments()) {
            self.draw_segment(&segment, MOST_HALVINGS);
        }
    }

    fn draw_segment(&mut self, segment: &[Point<f64>; 4], halvings_left: u32) {
        if self.points > MOST_POINTS {
            return;
        }
        let [start, first, second, end] = uniform::to_bezier(segment);
        let hull = [start, first, second, end].map(|p| Bounds { min: p, max: p });
        let is_seen = |hull: Bounds<f64>| hull.intersects(self.seen);
        if !hull.into_iter().reduce(Bounds::union).is_some_and(is_seen) {
            return;
        }
        // A cubic is within 3/4 of the farther inner Bezier point from the points at thirds of its chord.
        let off = |p: Point<f64>, t| p.distance(start.lerp(end, t));
        let off_m = off(first, 1.0 / 3.0).max(off(second, 2.0 / 3.0));
        let is_flat = off_m * self.view.px_per_m() <= TOLERANCE_PX;
        if halvings_left == 0 || (is_flat && start.distance(end) <= self.longest_m) {
            self.line(start, end);
            return;
        }
        for half in uniform::halves(segment) {
            self.draw_segment(&half, halvings_left - 1);
        }
    }

    fn line(&mut self, start: Point<f64>, end: Point<f64>) {
        // Halves meet but for rounding.
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
