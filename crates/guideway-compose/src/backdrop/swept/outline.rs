//! Unites the convex polygons along a path to one outline: contours in pixels of a picture, outer
//! ones and holes in opposite directions.
//!
//! Neighbors along the path are united first, then groups of twice the size, and so on: few edges
//! cross each other in each step.

use std::mem;

use guideway_envelope::ConvexPolygon;
use guideway_scene::View;
use guideway_spline::{Bounds, Point};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay::{Overlay, ShapeType};
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::i_float::int::point::IntPoint;

type P = Point<f64>;
type GridContour = Vec<IntPoint<i32>>;

/// Steps per pixel of the grid on which polygons are united: 16 per sample. The longest picture has
/// 2^16 pixels, and the grid 2^30 steps.
const STEPS_PER_PX: f64 = 256.0;
/// Pixels beyond the edges of a picture at which polygons are cut off.
const MARGIN_PX: f64 = 2.0;
/// Polygons that are united at once.
const BATCH: usize = 8;
/// Most that the simplified outline may be off, in pixels and as a share of the mean width.
const SIMPLER_PX: f64 = 0.125;
const SIMPLER_OF_WIDTH: f64 = 0.0625;

/// Unites polygons one by one.
pub(super) struct OutlineBuilder<'v> {
    view: &'v View,
    batch: Vec<GridContour>,
    /// United so far, in the order of the path: number of batches and contours. Each has more
    /// batches than the next.
    united: Vec<(usize, Vec<GridContour>)>,
    /// Most corners that were united at once.
    most_corners: usize,
}

impl<'v> OutlineBuilder<'v> {
    pub(super) fn new(view: &'v View) -> Self {
        Self {
            view,
            batch: Vec::new(),
            united: Vec::new(),
            most_corners: 0,
        }
    }

    /// Adds the part of a polygon that lies in the picture.
    pub(super) fn add(&mut self, polygon: &ConvexPolygon) {
        let contour = on_grid(polygon, self.view);
        if contour.len() < 3 {
            return;
        }
        self.batch.push(contour);
        if self.batch.len() == BATCH {
            self.unite_batch();
        }
    }

    /// Most corners that were united at once, which the memory grows with.
    pub(super) fn most_corners(&self) -> usize {
        self.most_corners
    }

    /// The contours, in pixels.
    pub(super) fn finish(mut self) -> Vec<Vec<P>> {
        self.unite_batch();
        let mut all = Vec::new();
        while let Some((_, before)) = self.united.pop() {
            all = self.unite(before, all);
        }
        all.iter().map(|contour| simplified(contour)).collect()
    }

    fn unite_batch(&mut self) {
        let batch = mem::take(&mut self.batch);
        let mut last = (1, self.unite(batch, Vec::new()));
        while let Some((batches, before)) = self.united.pop_if(|(batches, _)| *batches <= last.0) {
            last = (batches + last.0, self.unite(before, last.1));
        }
        self.united.push(last);
    }

    /// The union of contours that go around areas in one direction and around holes in the other.
    fn unite(
        &mut self,
        mut contours: Vec<GridContour>,
        others: Vec<GridContour>,
    ) -> Vec<GridContour> {
        contours.extend(others);
        if contours.len() < 2 {
            return contours;
        }
        let corners = contours.iter().map(Vec::len).sum();
        self.most_corners = self.most_corners.max(corners);
        let mut overlay = Overlay::<i32>::new(corners);
        overlay.add_source(&contours, ShapeType::Subject);
        let shapes = overlay.overlay(OverlayRule::Subject, FillRule::NonZero);
        shapes.into_iter().flatten().collect()
    }
}

/// A polygon on the grid, cut off beyond the picture. Its corners are counter-clockwise where y
/// points upwards, as in the contours of a union.
fn on_grid(polygon: &ConvexPolygon, view: &View) -> GridContour {
    let size = view.size();
    let picture = Bounds {
        min: Point::default(),
        max: Point::new(f64::from(size.width()), f64::from(size.height())),
    };
    let corners = polygon.points().iter().rev();
    let corners = corners.map(|&p| view.pixel_from_world(p)).collect();
    let corners = cut_off(corners, picture.inflated(MARGIN_PX));
    // Casts saturate.
    let on_grid = |v: f64| (v * STEPS_PER_PX).round() as i32;
    let corners = corners.iter();
    let mut contour: GridContour = corners
        .map(|p| IntPoint::new(on_grid(p.x), on_grid(p.y)))
        .collect();
    contour.dedup();
    contour
}

/// The part of a convex polygon within a box.
///
/// Source: Sutherland and Hodgman (1974).
fn cut_off(mut corners: Vec<P>, Bounds { min, max }: Bounds<f64>) -> Vec<P> {
    let depths: [fn(P, P, P) -> f64; 4] = [
        |p, min, _| p.x - min.x,
        |p, _, max| max.x - p.x,
        |p, min, _| p.y - min.y,
        |p, _, max| max.y - p.y,
    ];
    for depth in depths {
        let depth = |p: P| depth(p, min, max);
        if corners.iter().all(|&p| depth(p) >= 0.0) {
            continue;
        }
        let mut kept = Vec::with_capacity(corners.len() + 1);
        for (i, &p) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            let (here, there) = (depth(p), depth(next));
            if here >= 0.0 {
                kept.push(p);
            }
            if (here >= 0.0) != (there >= 0.0) {
                kept.push(p.lerp(next, here / (here - there)));
            }
        }
        corners = kept;
    }
    corners
}

/// A contour in pixels without the corners that no one sees.
fn simplified(contour: &[IntPoint<i32>]) -> Vec<P> {
    let corners = contour.iter();
    let corners: Vec<P> = corners
        .map(|p| Point::new(f64::from(p.x), f64::from(p.y)) * (1.0 / STEPS_PER_PX))
        .collect();
    let next = corners.iter().cycle().skip(1);
    let (twice_area, length) = corners
        .iter()
        .zip(next)
        .fold((0.0, 0.0), |(area, length), (&a, &b)| {
            (area + a.cross(b), length + (b - a).norm())
        });
    // The width of a band of this area and outline.
    let width_px = f64::abs(twice_area) / length;
    let tolerance_px = SIMPLER_PX.min(SIMPLER_OF_WIDTH * width_px);
    let simpler = without_needless(&corners, tolerance_px);
    // Nothing is left of an area below the tolerance.
    if simpler.len() < 3 { corners } else { simpler }
}

/// Keeps corners so that each other one is within a tolerance of the line between its neighbors.
///
/// From the last kept corner, the others are seen as discs; a line of sight that meets all of them
/// exists as long as the angles that they cover have one in common.
///
/// ```text
///                 _( )_
///   kept o-----( )-----( )----> a line that meets all
/// ```
///
/// Source: Zhao and Saalfeld, Linear-time sleeve-fitting polyline simplification (1997).
/// Cost: O(n).
fn without_needless(corners: &[P], tolerance: f64) -> Vec<P> {
    let Some(&first) = corners.first() else {
        return Vec::new();
    };
    let mut kept = vec![first];
    let mut cone = Cone::from(first);
    let mut last = first;
    for &p in corners[1..].iter().chain([&first]) {
        if !cone.takes(p, tolerance) {
            kept.push(last);
            cone = Cone::from(last);
            // A cone takes the first corner always.
            cone.takes(p, tolerance);
        }
        last = p;
    }
    kept
}

/// The directions from a corner that meet the discs around the corners since.
struct Cone {
    from: P,
    /// The direction from which angles count, once a corner is out of the tolerance.
    ahead: Option<P>,
    least: f64,
    most: f64,
    /// Distance of the farthest corner.
    far: f64,
}

impl Cone {
    fn from(from: P) -> Self {
        Self {
            from,
            ahead: None,
            least: f64::NEG_INFINITY,
            most: f64::INFINITY,
            far: 0.0,
        }
    }

    /// Adds a corner. Returns `false` if the line to it misses one of the corners before.
    fn takes(&mut self, p: P, tolerance: f64) -> bool {
        let way = p - self.from;
        let distance = way.norm();
        if distance + tolerance < self.far {
            // A line to it would end before the farthest corner.
            return false;
        }
        self.far = self.far.max(distance);
        if distance <= tolerance {
            return true;
        }
        let ahead = *self.ahead.get_or_insert(way);
        let angle = libm::atan2(ahead.cross(way), ahead.dot(way));
        if !(self.least..=self.most).contains(&angle) {
            return false;
        }
        let spread = libm::asin(tolerance / distance);
        self.least = self.least.max(angle - spread);
        self.most = self.most.min(angle + spread);
        true
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    fn view() -> View {
        View::new(FrameSize::new(100, 100).unwrap(), Point::default(), 10.0).unwrap()
    }

    fn square(x: f64, y: f64, side: f64) -> ConvexPolygon {
        let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        ConvexPolygon::hull(corners.map(|(a, b)| Point::new(x + a, y + b))).unwrap()
    }

    /// Twice the area of contours, in pixels: holes count negative.
    fn area(contours: &[Vec<P>]) -> f64 {
        let of = |contour: &Vec<P>| {
            let next = contour.iter().cycle().skip(1);
            let twice = contour.iter().zip(next).map(|(&a, &b)| a.cross(b));
            twice.sum::<f64>() / 2.0
        };
        contours.iter().map(of).sum()
    }

    fn outline(polygons: impl IntoIterator<Item = ConvexPolygon>) -> Vec<Vec<P>> {
        let view = view();
        let mut builder = OutlineBuilder::new(&view);
        polygons
            .into_iter()
            .for_each(|polygon| builder.add(&polygon));
        builder.finish()
    }

    #[test]
    fn overlaps_become_one_contour_and_rings_keep_their_hole() {
        assert!(outline([]).is_empty());
        assert_eq!(area(&outline([square(0.0, 0.0, 1.0)])), 100.0);
        let row = outline((0..37).map(|i| square(0.1 * f64::from(i), 0.0, 1.0)));
        assert_eq!((row.len(), row[0].len(), area(&row)), (1, 4, 460.0));
        let sides = [0.0, 1.0, 2.0, 3.0].map(|at| {
            [(at, 0.0), (3.0, at), (3.0 - at, 3.0), (0.0, 3.0 - at)].map(|(x, y)| square(x, y, 1.0))
        });
        let ring = outline(sides.into_iter().flatten());
        assert_eq!((ring.len(), area(&ring)), (2, 1200.0));
        // Two areas that do not meet.
        let two = outline([square(0.0, 0.0, 1.0), square(3.0, 0.0, 1.0)]);
        assert_eq!((two.len(), area(&two)), (2, 200.0));
    }

    #[test]
    fn what_lies_beyond_the_picture_is_cut_off() {
        let side = 100.0 + 2.0 * MARGIN_PX;
        assert_eq!(area(&outline([square(-1e7, -1e7, 2e7)])), side * side);
        assert!(outline([square(100.0, 0.0, 1.0)]).is_empty());
        let corner = area(&outline([square(4.0, 4.0, 1e6)]));
        assert_eq!(corner, (10.0 + MARGIN_PX).powi(2));
    }

    #[test]
    fn the_outline_of_a_disc_has_few_corners_and_its_area() {
        let turned = |i: u32| {
            let angle = f64::from(i) * std::f64::consts::TAU / 4000.0;
            let at = |x: f64, y: f64| {
                Point::new(
                    x * angle.cos() - y * angle.sin(),
                    x * angle.sin() + y * angle.cos(),
                )
            };
            ConvexPolygon::hull([at(-4.0, -0.5), at(4.0, -0.5), at(4.0, 0.5), at(-4.0, 0.5)])
        };
        let disc = outline((0..2000).filter_map(turned));
        let radius_px: f64 = 10.0 * 4.0_f64.hypot(0.5);
        assert!(disc.len() == 1 && disc[0].len() < 80, "{}", disc[0].len());
        let far = |p: &P| ((*p - Point::new(50.0, 50.0)).norm() - radius_px).abs();
        assert!(disc[0].iter().all(|p| far(p) < SIMPLER_PX));
        let error = area(&disc) / (std::f64::consts::PI * radius_px * radius_px) - 1.0;
        assert!(error.abs() < 0.006, "{error}");
    }

    /// All rectangles cross all others if they are united at once.
    #[test]
    fn time_grows_nearly_as_the_polygons_of_a_turn_on_the_spot() {
        let turns = |count: usize| -> Vec<ConvexPolygon> {
            let turned = |i: usize| {
                let angle = i as f64 * std::f64::consts::PI / count as f64;
                let ahead = Point::new(angle.cos(), angle.sin());
                let left = Point::new(-ahead.y, ahead.x);
                let corners = [(-4.0, -0.5), (4.0, -0.5), (4.0, 0.5), (-4.0, 0.5)];
                ConvexPolygon::hull(corners.map(|(x, y)| ahead * x + left * y)).unwrap()
            };
            (0..count).map(turned).collect()
        };
        let unite = |polygons: &Vec<ConvexPolygon>| {
            assert_eq!(outline(polygons.iter().cloned()).len(), 1);
        };
        let exponent = guideway_growth::exponent_of_time([500, 1000, 2000], turns, unite);
        // 1.2 to 1.55; united at once, the polygons take the square.
        assert!(exponent < 1.75, "{exponent}");
    }

    #[test]
    fn thin_areas_keep_their_width() {
        let strip = ConvexPolygon::hull(
            [(-4.0, 0.0), (4.0, 0.0), (4.0, 0.01), (-4.0, 0.01)].map(|(x, y)| Point::new(x, y)),
        );
        let strip = outline(strip);
        let error = area(&strip) / (80.0 * 0.1) - 1.0;
        assert!(error.abs() < 0.05, "{error}");
    }
}
