//! Swept areas: finds the outlines of what vehicles sweep along paths, draws and writes them.

use std::io;
use std::sync::atomic::{AtomicU64, Ordering};

use guideway_cpu::{Areas, lay_areas};
use guideway_envelope::{EnvelopeSource, MIN_TOLERANCE_M, NoEnvelope};
use guideway_layout::Layout;
use guideway_scene::{Budget, Frame, RenderError, Rgba, Scene, Strip, View};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use crate::ComposeError;
use crate::page::Page;

use outline::OutlineBuilder;

mod outline;

/// Color of all swept areas. It is composited once where areas overlap.
const COLOR: Rgba = Rgba {
    r: 0xF2,
    g: 0x8C,
    b: 0x28,
    a: 0x55,
};

/// Most that a polygon may exceed its area by, in pixels: less than anyone sees.
const TOLERANCE_PX: f64 = 0.25;

/// Most polygons of a picture. A site of 326 paths has 24,000; a vehicle that turns on the spot
/// along thousands of paths has any number. Derived: to unite them takes ten seconds of one core,
/// measured along arcs of millimeters with a vehicle of 2 m.
const MOST_POLYGONS: u64 = 100_000;

/// Bytes per corner while outlines are united. Derived: edges, their parts and events, on several
/// threads. The number of threads does not count, lest the picture depend on it.
const UNION_BYTES: u64 = 1024;

/// The areas that one vehicle sweeps along paths.
#[derive(Clone, Debug, PartialEq)]
pub struct SweptAreas {
    /// The vehicle, or the areas that the file itself gives.
    pub vehicle: EnvelopeSource,
    /// Rows of the paths; `None` for all paths of the scene.
    pub rows: Option<Vec<u32>>,
}

/// Number of paths with and without a swept area.
#[derive(Clone, Debug)]
pub struct SweptReport {
    /// The vehicle.
    pub vehicle: EnvelopeSource,
    /// Paths whose area is in the picture.
    pub drawn: u64,
    /// Paths whose area lies outside of the view.
    pub outside: u64,
    /// Paths without an area, by reason: the order of [`NoEnvelope::ALL`].
    pub without: [u64; NoEnvelope::ALL.len()],
    /// Paths whose area is in doubt: their orientation is probably in degrees.
    pub doubtful: u64,
    /// Convex polygons, of which the outlines in the picture are united.
    pub polygons: u64,
    /// Most that a polygon exceeds its area by, in meters.
    pub tolerance_m: f64,
}

/// Swept areas in a view: per path the contours of its outline, in meters.
pub(super) struct VisibleAreas {
    areas: Vec<Vec<Vec<Point<f64>>>>,
    pub(super) report: SweptReport,
}

/// Draws the swept areas of paths on a transparent background.
///
/// # Errors
/// When none of the paths has a swept area.
pub fn draw_swept_areas(
    layout: &Layout,
    rows: &[u32],
    vehicle: EnvelopeSource,
    view: &View,
) -> Result<Frame, ComposeError> {
    let mut frame = Frame::new(view.size());
    let visible = VisibleAreas::new(layout, rows, vehicle, view, &Budget::default())?;
    draw(&visible.outlines(), &Strip::whole(view), &mut frame);
    Ok(frame)
}

/// Bounding box of the swept areas of all paths that a scene shows; `None` if none has one.
pub(super) fn bounds(scene: &Scene, vehicle: EnvelopeSource) -> Option<Bounds<f64>> {
    let paths = scene.draw_order().par_iter();
    let boxes =
        paths.filter_map(|&path| Some(vehicle.sweep(scene.layout(), path as usize).ok()?.bounds()));
    boxes.reduce_with(Bounds::union)
}

/// Composites swept areas over a frame of the strip's size.
pub(super) fn draw(areas: &Areas, strip: &Strip, frame: &mut Frame) {
    lay_areas(areas, strip, COLOR, frame);
}

impl VisibleAreas {
    /// Sweeps the vehicle along paths and unites the polygons of each near the view. Where they
    /// take more than the budget, they are coarser: a vehicle that turns on the spot sweeps very
    /// many.
    ///
    /// # Errors
    /// When none of the paths has a swept area, or the coarsest polygons exceed the budget.
    pub(super) fn new(
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
        budget: &Budget,
    ) -> Result<Self, ComposeError> {
        Self::within(layout, rows, vehicle, view, (budget, MOST_POLYGONS))
    }

    /// As [`Self::new`], within a budget and a number of polygons.
    fn within(
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
        (budget, max_polygons): (&Budget, u64),
    ) -> Result<Self, ComposeError> {
        let mut tolerance_m = (TOLERANCE_PX / view.px_per_m()).max(MIN_TOLERANCE_M);
        let coarsest_m = f64::from(view.size().height().max(view.size().width())) / view.px_per_m();
        // Counting polygons takes far less time than uniting them.
        let count =
            |tolerance_m| has_too_many(layout, rows, vehicle, (view, tolerance_m), max_polygons);
        while tolerance_m <= coarsest_m && count(tolerance_m) {
            tolerance_m *= 2.0;
        }
        let by_path = loop {
            let cost = Cost::new(budget, max_polygons);
            let by_path = outlines_by_path(layout, rows, vehicle, (view, tolerance_m), &cost);
            match cost.check() {
                Ok(()) => break by_path,
                Err(error) if tolerance_m > coarsest_m => return Err(error.into()),
                Err(_) => tolerance_m *= 2.0,
            }
        };
        let mut visible = Self {
            areas: Vec::with_capacity(by_path.len()),
            report: SweptReport {
                vehicle,
                drawn: 0,
                outside: 0,
                without: [0; NoEnvelope::ALL.len()],
                doubtful: vehicle.doubtful(layout),
                polygons: 0,
                tolerance_m,
            },
        };
        for outline in by_path {
            visible.add(outline);
        }
        visible.report.require_any()?;
        Ok(visible)
    }

    fn add(&mut self, outline: Result<Outline, NoEnvelope>) {
        let report = &mut self.report;
        match outline {
            Ok(outline) if outline.polygons == 0 => report.outside += 1,
            Ok(outline) => {
                report.drawn += 1;
                report.polygons += outline.polygons;
                self.areas.push(outline.contours);
            }
            Err(reason) => report.without[reason as usize] += 1,
        }
    }

    /// All outlines, for the rasterizer.
    pub(super) fn outlines(&self) -> Areas {
        let mut areas = Areas::default();
        let contours = self.areas.iter();
        contours.for_each(|contours| areas.push_outline(contours.iter().map(Vec::as_slice)));
        areas
    }

    /// Writes the areas as a group.
    pub(super) fn write(&self, view: &View, page: &mut impl Page) -> io::Result<()> {
        let on_page = |contour: &Vec<Point<f64>>| -> Vec<Point<f64>> {
            let corners = contour.iter();
            corners.map(|&p| view.pixel_from_world(p)).collect()
        };
        let areas = self.areas.iter();
        let areas: Vec<Vec<_>> = areas
            .map(|contours| contours.iter().map(on_page).collect())
            .collect();
        page.areas("swept areas", COLOR, &areas)
    }
}

/// The area of a path in a view: the number of its convex polygons, and their union.
#[derive(Default)]
struct Outline {
    polygons: u64,
    contours: Vec<Vec<Point<f64>>>,
}

/// Returns `true` if the areas within a view have more polygons than a picture may have.
fn has_too_many(
    layout: &Layout,
    rows: &[u32],
    vehicle: EnvelopeSource,
    (view, tolerance_m): (&View, f64),
    max_polygons: u64,
) -> bool {
    let shown = view.world_bounds();
    let count = AtomicU64::new(0);
    let may_add = |path: u32| {
        if let Ok(sweep) = vehicle.sweep(layout, path as usize) {
            let mut polygons = 0;
            sweep.polygons(tolerance_m, Some(shown), &mut |_| polygons += 1);
            count.fetch_add(polygons, Ordering::Relaxed);
        }
        count.load(Ordering::Relaxed) <= max_polygons
    };
    !rows.par_iter().all(|&path| may_add(path))
}

/// The outline of each path within a view, of polygons to a tolerance in meters.
fn outlines_by_path(
    layout: &Layout,
    rows: &[u32],
    vehicle: EnvelopeSource,
    (view, tolerance_m): (&View, f64),
    cost: &Cost,
) -> Vec<Result<Outline, NoEnvelope>> {
    let shown = view.world_bounds();
    let of_path = |&path: &u32| {
        let sweep = vehicle.sweep(layout, path as usize)?;
        let mut outline = Outline::default();
        if cost.check().is_err() {
            return Ok(outline);
        }
        let mut builder = OutlineBuilder::new(view);
        sweep.polygons(tolerance_m, Some(shown), &mut |polygon| {
            outline.polygons += 1;
            if cost.add_polygon(builder.most_corners()) {
                builder.add(polygon);
            }
        });
        let contours = builder.finish().into_iter();
        let in_meters = |p: Point<f64>| view.world_from_pixel(p);
        outline.contours = contours
            .map(|contour| contour.into_iter().map(in_meters).collect())
            .collect();
        cost.add_outline(&outline.contours);
        Ok(outline)
    };
    rows.par_iter().map(of_path).collect()
}

/// The cost of the outlines so far: their bytes, those of the largest union, and polygons.
struct Cost {
    bytes: AtomicU64,
    union_bytes: AtomicU64,
    polygons: AtomicU64,
    max_bytes: u64,
    max_polygons: u64,
}

impl Cost {
    fn new(budget: &Budget, max_polygons: u64) -> Self {
        Self {
            bytes: AtomicU64::new(0),
            union_bytes: AtomicU64::new(0),
            polygons: AtomicU64::new(0),
            max_bytes: budget.memory_bytes,
            max_polygons,
        }
    }

    /// Adds a polygon of a path, of which this number of corners was united at once. Returns
    /// `false` if all together costs too much.
    fn add_polygon(&self, most_corners: usize) -> bool {
        let union = UNION_BYTES * most_corners as u64;
        self.union_bytes.fetch_max(union, Ordering::Relaxed);
        self.polygons.fetch_add(1, Ordering::Relaxed);
        self.check().is_ok()
    }

    fn add_outline(&self, contours: &[Vec<Point<f64>>]) {
        let of_contour =
            |corners: &Vec<Point<f64>>| size_of_val(corners) + size_of_val(&corners[..]);
        let bytes: usize = contours.iter().map(of_contour).sum();
        // The rasterizer has a copy.
        self.bytes.fetch_add(2 * bytes as u64, Ordering::Relaxed);
    }

    fn check(&self) -> Result<(), RenderError> {
        let load = |count: &AtomicU64| count.load(Ordering::Relaxed);
        let bytes = load(&self.bytes) + load(&self.union_bytes);
        if bytes <= self.max_bytes && load(&self.polygons) <= self.max_polygons {
            return Ok(());
        }
        Err(RenderError::Budget {
            method: "envelope",
            what: "swept areas",
            needed_bytes: bytes,
            budget_bytes: self.max_bytes,
        })
    }
}

impl SweptReport {
    /// Fails when paths were swept and none has an area: the picture would not show that.
    fn require_any(&self) -> Result<(), ComposeError> {
        match NoEnvelope::most_frequent(&self.without) {
            Some(reason) if self.drawn + self.outside == 0 => {
                Err(ComposeError::NoEnvelope { reason })
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
