//! The areas that vehicles sweep, under the paths.

use std::io::{self, Write};

use guideway::cpu::{Areas, lay_areas};
use guideway::envelope::{ConvexPolygon, EnvelopeSource, MIN_TOLERANCE_M, NoEnvelope};
use guideway::formats::svg::SvgWriter;
use guideway::layout::Layout;
use guideway::render::{Frame, Strip, View};
use guideway::scene::{Rgba, Scene};
use guideway::spline::{Bounds, Point};
use rayon::prelude::*;
use serde_json::{Value, json};

use crate::cli::{Failure, envelope, text};

/// The color of all areas together.
const COLOR: Rgba = Rgba {
    r: 0xF2,
    g: 0x8C,
    b: 0x28,
    a: 0x55,
};

/// How far they may be drawn too large, in pixels.
const TOLERANCE_PX: f64 = 0.25;

/// What became of the envelope of every path that is drawn.
#[derive(Debug)]
pub(crate) struct SweptReport {
    source: EnvelopeSource,
    drawn: u64,
    outside: u64,
    without: [u64; NoEnvelope::ALL.len()],
    polygons: u64,
    tolerance_m: f64,
}

/// Swept areas in a view: of each path the convex polygons that are seen.
pub(super) struct Swept {
    areas: Vec<Vec<ConvexPolygon>>,
    pub(super) report: SweptReport,
}

/// The box of all swept areas.
pub(super) fn bounds(scene: &Scene, source: EnvelopeSource) -> Option<Bounds<f64>> {
    let paths = scene.draw_order().par_iter();
    let boxes =
        paths.filter_map(|&path| Some(source.sweep(scene.layout(), path as usize).ok()?.bounds()));
    boxes.reduce_with(Bounds::union)
}

/// Draws swept areas over what is there.
pub(super) fn lay(areas: &Areas, strip: &Strip, frame: &mut Frame) {
    lay_areas(areas, strip, COLOR, frame);
}

/// Draws the swept areas of some paths in a view, over nothing.
#[cfg(feature = "viewer")]
pub(crate) fn draw(
    layout: &Layout,
    rows: &[u32],
    source: EnvelopeSource,
    view: &View,
) -> Result<Frame, Failure> {
    let mut frame = Frame::new(view.size());
    let swept = Swept::new(layout, rows, source, view)?;
    lay(&swept.areas(), &Strip::whole(view), &mut frame);
    Ok(frame)
}

impl Swept {
    /// # Errors
    /// When no path has an envelope.
    pub(super) fn new(
        layout: &Layout,
        rows: &[u32],
        source: EnvelopeSource,
        view: &View,
    ) -> Result<Self, Failure> {
        let tolerance_m = (TOLERANCE_PX / view.px_per_m()).max(MIN_TOLERANCE_M);
        let seen = view.world_bounds();
        let of_paths: Vec<_> = rows
            .par_iter()
            .map(|&path| {
                let sweep = source.sweep(layout, path as usize)?;
                let mut polygons = Vec::new();
                sweep.polygons(tolerance_m, Some(seen), &mut |polygon| {
                    polygons.push(polygon.clone());
                });
                Ok(polygons)
            })
            .collect();
        let mut swept = Self {
            areas: Vec::with_capacity(of_paths.len()),
            report: SweptReport {
                source,
                drawn: 0,
                outside: 0,
                without: [0; NoEnvelope::ALL.len()],
                polygons: 0,
                tolerance_m,
            },
        };
        for of_path in of_paths {
            swept.add(of_path);
        }
        let report = &swept.report;
        envelope::need_some(report.drawn + report.outside, &report.without)?;
        Ok(swept)
    }

    fn add(&mut self, of_path: Result<Vec<ConvexPolygon>, NoEnvelope>) {
        let report = &mut self.report;
        match of_path {
            Ok(polygons) if polygons.is_empty() => report.outside += 1,
            Ok(polygons) => {
                report.drawn += 1;
                report.polygons += polygons.len() as u64;
                self.areas.push(polygons);
            }
            Err(why) => report.without[why as usize] += 1,
        }
    }

    /// All polygons, as they are drawn.
    pub(super) fn areas(&self) -> Areas {
        let mut areas = Areas::default();
        let polygons = self.areas.iter().flatten();
        polygons.for_each(|polygon| areas.push(polygon.points()));
        areas
    }

    pub(super) fn write(
        &self,
        view: &View,
        step_px: f64,
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
        page.polygon_layer("swept areas", COLOR.to_u32(), step_px, areas)
    }
}

impl SweptReport {
    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "swept areas ({}): {} drawn as {}",
            envelope::name(self.source),
            text::count(self.drawn),
            text::counted(self.polygons, "polygon"),
        );
        if self.outside > 0 {
            text += &format!(", {} outside the view", text::count(self.outside));
        }
        text.push('\n');
        for line in envelope::lacking(&self.without) {
            text += &format!("note: {line}\n");
        }
        text
    }

    pub(super) fn json(&self) -> Value {
        let without = NoEnvelope::ALL
            .into_iter()
            .filter(|&why| self.without[why as usize] > 0);
        let without: Vec<Value> = without
            .map(|why| json!({ "paths": self.without[why as usize], "why": why.to_string() }))
            .collect();
        json!({
            "source": envelope::name(self.source),
            "drawn": self.drawn,
            "outside": self.outside,
            "without": without,
            "polygons": self.polygons,
            "tolerance_m": self.tolerance_m,
        })
    }
}
