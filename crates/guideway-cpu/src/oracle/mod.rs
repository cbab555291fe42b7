//! Method `oracle`: the reference renderer that tests compare all others with. Brute force in
//! `f64`, simple enough to verify by reading.
//!
//! A pixel is the mean of 16 x 16 samples. Paths are composited sample by sample, from the lowest
//! draw rank to the highest; a path covers a sample that is within its radius of a chord of its
//! curve; in density, one within the radius of an end counts half. The oracle has no index and
//! shares no code with other methods, not even the spline mathematics.
//!
//! Cost: O(paths x pixels in the box of each path).

mod band;
mod chords;
mod stroke;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use guideway_layout::RunPoints;
use guideway_layout::clock::Instant;
use guideway_scene::{
    Budget, Cancel, EditOutcome, Frame, Method, MethodInfo, Preparation, Prepared, RenderError,
    Report, Shading, Stage, Style, View, density, elapsed_ms,
};
use guideway_scene::{Coloring, Edit, Gesture, Scene};
use guideway_spline::{Bounds, Point};

use band::Band;
use chords::Chords;
use stroke::{Stroke, open_ends};

const NAME: &str = "oracle";

/// Most bytes of samples of a band, unless one row of pixels takes more. Derived: a small part of
/// the default budget, and large enough that few paths are drawn in several bands.
const BAND_BYTES: u64 = 48 << 20;

/// The reference method: exact to 1/256 of the area of a pixel, and slow.
#[derive(Clone, Copy, Debug, Default)]
pub struct Oracle;

impl Method for Oracle {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: NAME,
            summary: "reference: exact to 1/256 of a pixel's area, by brute force; slow",
            device: "CPU, one thread".to_owned(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let memory_bytes = budget.memory_bytes;
        Ok(Box::new(PreparedOracle {
            scene,
            at_rest: None,
            memory_bytes,
            preparation: Preparation::default(),
        }))
    }
}

struct PreparedOracle {
    /// As shown.
    scene: Arc<Scene>,
    /// The scene without the gesture that is shown, if there is one.
    at_rest: Option<Arc<Scene>>,
    memory_bytes: u64,
    /// Empty: the oracle prepares nothing.
    preparation: Preparation,
}

impl Prepared for PreparedOracle {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let started = Instant::now();
        let rows_per_band = self.rows_per_band(view)?;
        let strokes = self.strokes(view, style, cancel)?;
        let culled_ms = elapsed_ms(started);

        frame.resize(view.size());
        let (width, height) = (view.size().width(), view.size().height());
        let mut counts = match style.shading {
            Shading::Color => Vec::new(),
            Shading::Density(_) => vec![0.0; view.size().pixels()],
        };
        let (mut lines, mut bands, mut band_bytes) = (0, 0, 0);
        for first_row in (0..height).step_by(rows_per_band as usize) {
            let rows = rows_per_band.min(height - first_row);
            let mut band = Band::new(first_row, rows, width, style.background);
            for (order, stroke) in (1..).zip(&strokes) {
                cancel.check()?;
                lines += self.draw(view, stroke, order, &mut band);
            }
            let pixels = (first_row * width) as usize..((first_row + rows) * width) as usize;
            match style.shading {
                Shading::Color => band.write_colors(&mut frame.pixels_mut()[pixels]),
                Shading::Density(_) => band.write_counts(&mut counts[pixels]),
            }
            band_bytes = band_bytes.max(band.heap_bytes());
            bands += 1;
        }
        let legend = match style.shading {
            Shading::Color => None,
            Shading::Density(tone) => Some(density::shade(&counts, tone, style.background, frame)),
        };

        let drawn = strokes.len() as u64;
        let stroke_bytes = strokes.capacity() * size_of::<Stroke>();
        let count_bytes = counts.capacity() * size_of::<f32>();
        Ok(Report {
            stages: vec![
                Stage::host("cull", culled_ms),
                Stage::host("sample", elapsed_ms(started) - culled_ms),
            ],
            lines,
            peak_bytes: (band_bytes + stroke_bytes + count_bytes) as u64,
            bands,
            density: legend,
            ..Report::of(NAME, &self.scene, drawn)
        })
    }

    fn edit(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        self.show_gesture(None)?;
        let scene = Arc::make_mut(&mut self.scene);
        scene.edit(edit).map_err(RenderError::Edit)?;
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
    }

    fn recolor(&mut self, coloring: &Coloring) -> Result<EditOutcome, RenderError> {
        if !self.scene.accepts(coloring) {
            return Ok(EditOutcome::NotInPlace);
        }
        self.show_gesture(None)?;
        Arc::make_mut(&mut self.scene).recolor(coloring);
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
    }

    fn show_gesture(&mut self, gesture: Option<&Gesture>) -> Result<EditOutcome, RenderError> {
        if let Some(at_rest) = self.at_rest.take() {
            self.scene = at_rest;
        }
        if let Some(gesture) = gesture {
            let mut shown = Scene::clone(&self.scene);
            shown.edit(&gesture.edit()).map_err(RenderError::Edit)?;
            self.at_rest = Some(std::mem::replace(&mut self.scene, Arc::new(shown)));
        }
        Ok(EditOutcome::InPlace { moved_bytes: 0 })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}

impl PreparedOracle {
    /// Number of rows of pixels that fit into the memory of a band.
    fn rows_per_band(&self, view: &View) -> Result<u32, RenderError> {
        let row_bytes = Band::BYTES_PER_PIXEL * u64::from(view.size().width());
        if row_bytes > self.memory_bytes {
            return Err(RenderError::Budget {
                method: NAME,
                what: "the samples of one row of pixels",
                needed_bytes: row_bytes,
                budget_bytes: self.memory_bytes,
            });
        }
        let rows = BAND_BYTES.min(self.memory_bytes) / row_bytes;
        Ok(rows.clamp(1, u64::from(view.size().height())) as u32)
    }

    /// The paths whose boxes meet the picture, in draw order.
    fn strokes(
        &self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Vec<Stroke>, RenderError> {
        let picture_px = Bounds {
            min: Point::new(0.0, 0.0),
            max: Point::new(
                f64::from(view.size().width()),
                f64::from(view.size().height()),
            ),
        };
        let mut strokes = Vec::new();
        for &path in self.scene.draw_order() {
            cancel.check()?;
            let path_ref = self.scene.layout().paths.get(path as usize);
            let points = path_ref.runs().flat_map(RunPoints::iter);
            let points_px = points.map(|p| view.pixel_from_world(p));
            let width_m = self.scene.width_m(path);
            let radius_px = style.line_rule.radius_px(width_m, view.px_per_m());
            let bounds_px = Bounds::of_points(points_px).map(|hull| hull.inflated(radius_px));
            if let Some(bounds_px) = bounds_px.filter(|bounds| bounds.intersects(picture_px)) {
                strokes.push(Stroke {
                    path,
                    color: self.scene.color(path),
                    radius_px,
                    bounds_px,
                    ends_px: open_ends(path_ref, view),
                });
            }
        }
        Ok(strokes)
    }

    /// Composites one path over the samples of a band; returns the number of its chords.
    fn draw(&self, view: &View, stroke: &Stroke, order: u32, band: &mut Band) -> u64 {
        if !stroke.bounds_px.intersects(band.bounds_px()) {
            return 0;
        }
        let chords = Chords {
            near_px: band.bounds_px().inflated(stroke.radius_px),
            max_length_px: stroke.radius_px.max(1.0),
        };
        let mut lines = 0;
        let path = self.scene.layout().paths.get(stroke.path as usize);
        for segment in path.runs().flat_map(|run| run.segments()) {
            let control_px = segment.map(|p| view.pixel_from_world(p));
            chords.of_segment(&control_px, &mut |start, end| {
                band.cover(start, end, stroke, order);
                lines += 1;
            });
        }
        lines
    }
}
