//! Swept areas: finds the convex polygons that vehicles sweep, draws and writes them.

use std::io::{self, Write};

use guideway_cpu::{Areas, lay_areas};
use guideway_envelope::{ConvexPolygon, EnvelopeSource, MIN_TOLERANCE_M, NoEnvelope};
use guideway_formats::svg::SvgWriter;
use guideway_layout::Layout;
use guideway_scene::{Frame, Rgba, Scene, Strip, View};
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;

use crate::ComposeError;
use crate::vector::STEP_PX;

/// Color of all swept areas. It is composited once where areas overlap.
const COLOR: Rgba = Rgba {
    r: 0xF2,
    g: 0x8C,
    b: 0x28,
    a: 0x55,
};

/// Most that a polygon may exceed its area by, in pixels: less than anyone sees.
const TOLERANCE_PX: f64 = 0.25;

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
    let visible = VisibleAreas::new(layout, rows, vehicle, view)?;
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
    /// Sweeps the vehicle along paths and keeps the polygons near the view.
    ///
    /// # Errors
    /// When none of the paths has a swept area.
    pub(super) fn new(
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
    ) -> Result<Self, ComposeError> {
        let tolerance_m = (TOLERANCE_PX / view.px_per_m()).max(MIN_TOLERANCE_M);
        let shown = view.world_bounds();
        let by_path: Vec<_> = rows
            .par_iter()
            .map(|&path| {
                let sweep = vehicle.sweep(layout, path as usize)?;
                let mut polygons = Vec::new();
                sweep.polygons(tolerance_m, Some(shown), &mut |polygon| {
                    polygons.push(polygon.clone());
                });
                Ok(polygons)
            })
            .collect();
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

    /// Writes the areas as an SVG group.
    pub(super) fn write(
        &self,
        view: &View,
        page: &mut SvgWriter<'_, impl Write>,
    ) -> io::Result<()> {
        let on_page = |polygon: &ConvexPolygon| -> Vec<Point<f64>> {
            let corners = polygon.points().iter();
            corners.map(|&p| view.pixel_from_world(p)).collect()
        };
        let areas = self
            .areas
            .iter()
            .map(|polygons| polygons.iter().map(on_page));
        page.polygon_layer("swept areas", COLOR.to_u32(), STEP_PX, areas)
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
