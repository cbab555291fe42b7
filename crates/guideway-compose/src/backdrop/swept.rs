//! Swept areas: finds the convex polygons that vehicles sweep, draws and writes them.

use std::io;
use std::sync::atomic::{AtomicU64, Ordering};

use guideway_cpu::{Areas, lay_areas};
use guideway_envelope::{ConvexPolygon, EnvelopeSource, MIN_TOLERANCE_M, NoEnvelope};
use guideway_layout::Layout;
use guideway_scene::{Budget, Frame, RenderError, Rgba, Scene, Strip, View};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use crate::ComposeError;
use crate::page::Page;

/// Color of all swept areas. It is composited once where areas overlap.
const COLOR: Rgba = Rgba {
    r: 0xF2,
    g: 0x8C,
    b: 0x28,
    a: 0x55,
};

/// Most that a polygon may exceed its area by, in pixels: less than anyone sees.
const TOLERANCE_PX: f64 = 0.25;

/// Most polygons of the height of the picture. Measured: as many take about a second to fill.
const MOST_HEIGHTS: f64 = 20_000.0;

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
    /// Polygons in the picture.
    pub polygons: u64,
    /// Most that a polygon exceeds its area by, in meters.
    pub tolerance_m: f64,
}

/// Swept areas in a view: per path the convex polygons that the view shows.
pub(super) struct VisibleAreas {
    areas: Vec<Vec<ConvexPolygon>>,
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
    draw(&visible.polygons(), &Strip::whole(view), &mut frame);
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
    /// Sweeps the vehicle along paths and keeps the polygons near the view. Where they take more
    /// than the budget, they are coarser: a vehicle that turns on the spot sweeps very many.
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
        let mut tolerance_m = (TOLERANCE_PX / view.px_per_m()).max(MIN_TOLERANCE_M);
        let coarsest_m = f64::from(view.size().height().max(view.size().width())) / view.px_per_m();
        let by_path = loop {
            let cost = Cost::new(view, budget);
            let by_path = polygons_by_path(layout, rows, vehicle, (view, tolerance_m), &cost);
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
        for polygons in by_path {
            visible.add(polygons);
        }
        visible.report.require_any()?;
        Ok(visible)
    }

    fn add(&mut self, polygons: Result<Vec<ConvexPolygon>, NoEnvelope>) {
        let report = &mut self.report;
        match polygons {
            Ok(polygons) if polygons.is_empty() => report.outside += 1,
            Ok(polygons) => {
                report.drawn += 1;
                report.polygons += polygons.len() as u64;
                self.areas.push(polygons);
            }
            Err(reason) => report.without[reason as usize] += 1,
        }
    }

    /// All polygons, for the rasterizer.
    pub(super) fn polygons(&self) -> Areas {
        let mut areas = Areas::default();
        let polygons = self.areas.iter().flatten();
        polygons.for_each(|polygon| areas.push(polygon.points()));
        areas
    }

    /// Writes the areas as a group.
    pub(super) fn write(&self, view: &View, page: &mut impl Page) -> io::Result<()> {
        let on_page = |polygon: &ConvexPolygon| -> Vec<Point<f64>> {
            let corners = polygon.points().iter();
            corners.map(|&p| view.pixel_from_world(p)).collect()
        };
        let areas = self.areas.iter();
        let areas: Vec<Vec<_>> = areas
            .map(|polygons| polygons.iter().map(on_page).collect())
            .collect();
        page.areas("swept areas", COLOR, &areas)
    }
}

/// The polygons of each path within a view, to a tolerance in meters.
fn polygons_by_path(
    layout: &Layout,
    rows: &[u32],
    vehicle: EnvelopeSource,
    (view, tolerance_m): (&View, f64),
    cost: &Cost,
) -> Vec<Result<Vec<ConvexPolygon>, NoEnvelope>> {
    let shown = view.world_bounds();
    let of_path = |&path: &u32| {
        let sweep = vehicle.sweep(layout, path as usize)?;
        let mut polygons = Vec::new();
        if cost.check().is_ok() {
            sweep.polygons(tolerance_m, Some(shown), &mut |polygon| {
                if cost.add(polygon) {
                    polygons.push(polygon.clone());
                }
            });
        }
        Ok(polygons)
    };
    rows.par_iter().map(of_path).collect()
}

/// The cost of the polygons so far: bytes, and rows of pixels.
struct Cost<'v> {
    view: &'v View,
    bytes: AtomicU64,
    rows_px: AtomicU64,
    max_bytes: u64,
    max_rows_px: u64,
}

impl<'v> Cost<'v> {
    fn new(view: &'v View, budget: &Budget) -> Self {
        Self {
            view,
            bytes: AtomicU64::new(0),
            rows_px: AtomicU64::new(0),
            // The rasterizer has a copy.
            max_bytes: budget.memory_bytes / 2,
            max_rows_px: (MOST_HEIGHTS * f64::from(view.size().height())) as u64,
        }
    }

    /// Adds a polygon. Returns `false` if all polygons together cost too much.
    fn add(&self, polygon: &ConvexPolygon) -> bool {
        let bytes = size_of::<ConvexPolygon>() + size_of_val(polygon.points());
        let Bounds { min, max } = polygon.bounds();
        let [top, bottom] = [max, min].map(|corner| self.view.pixel_from_world(corner).y);
        let height = f64::from(self.view.size().height());
        // Casts saturate.
        let rows_px = (bottom.min(height) - top.max(0.0)).max(0.0) as u64 + 1;
        self.bytes.fetch_add(bytes as u64, Ordering::Relaxed);
        self.rows_px.fetch_add(rows_px, Ordering::Relaxed);
        self.check().is_ok()
    }

    fn check(&self) -> Result<(), RenderError> {
        let bytes = self.bytes.load(Ordering::Relaxed);
        if bytes <= self.max_bytes && self.rows_px.load(Ordering::Relaxed) <= self.max_rows_px {
            return Ok(());
        }
        Err(RenderError::Budget {
            method: "envelope",
            what: "swept areas",
            needed_bytes: 2 * bytes,
            budget_bytes: 2 * self.max_bytes,
        })
    }
}

impl SweptReport {
    /// Fails when paths were swept and none has an area: the picture would not show that.
    fn require_any(&self) -> Result<(), ComposeError> {
        let reasons = NoEnvelope::ALL.into_iter();
        let most_frequent = reasons.max_by_key(|&reason| self.without[reason as usize]);
        match most_frequent {
            Some(reason) if self.drawn + self.outside == 0 && self.without[reason as usize] > 0 => {
                Err(ComposeError::NoEnvelope { reason })
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests;
