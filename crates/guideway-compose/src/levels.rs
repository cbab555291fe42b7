//! Several levels side by side: one picture per level, at one scale, in a grid.

use std::path::Path;
use std::sync::Arc;

use guideway_formats::Progress;
use guideway_scene::{Frame, FrameSize, Method, RenderError, Rgba, Scene};
use guideway_spline::{Bounds, Point};

use crate::{ComposeError, Picture, Rendered, save_png_by};

/// A level beside others.
#[derive(Clone)]
pub struct LevelPart {
    /// The paths of the level.
    pub scene: Arc<Scene>,
    /// Its title.
    pub title: String,
}

/// The columns and rows of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Grid {
    columns: u32,
    rows: u32,
}

impl Grid {
    /// The grid of parts in which a site of this extent is largest.
    fn new(parts: u32, size: FrameSize, extent_m: Point<f64>) -> Self {
        let grids = (1..=parts.max(1)).map(|columns| Self {
            columns,
            rows: parts.max(1).div_ceil(columns),
        });
        let scale = |grid: &Self| {
            let [width, height] = grid.part_px(size).map(f64::from);
            let fit = (width / extent_m.x).min(height / extent_m.y);
            if fit.is_finite() {
                fit
            } else {
                width.min(height)
            }
        };
        let best = grids.reduce(|best, other| match scale(&other) > scale(&best) {
            true => other,
            false => best,
        });
        best.unwrap_or(Self {
            columns: 1,
            rows: 1,
        })
    }

    /// Width and height of a part in pixels; zero if the picture has fewer pixels than parts.
    fn part_px(self, size: FrameSize) -> [u32; 2] {
        [size.width() / self.columns, size.height() / self.rows]
    }
}

impl Picture {
    /// Renders levels side by side into a PNG file, atomically: the first one in the upper left
    /// corner. Everything else is that of this picture. Every part shows the place that holds all
    /// levels.
    ///
    /// # Errors
    /// See [`Picture::render`]; also when the picture exceeds the memory or is too small for its
    /// parts.
    pub fn save_levels_png(
        &self,
        parts: &[LevelPart],
        method: &dyn Method,
        path: impl AsRef<Path>,
        progress: &dyn Progress,
    ) -> Result<Rendered, ComposeError> {
        let size = self.viewport.size;
        // The picture is in memory as a whole.
        let needed_bytes = 4 * size.pixels() as u64;
        if needed_bytes > self.budget.memory_bytes {
            let error = RenderError::Budget {
                method: method.info().name,
                what: "levels side by side",
                needed_bytes,
                budget_bytes: self.budget.memory_bytes,
            };
            return Err(error.into());
        }
        let texts: Vec<_> = self.png_texts()?.into_iter().take(1).collect();
        let (frame, rendered) = self.render_levels(parts, method, progress)?;
        save_png_by::<_, ComposeError>(path, size, &texts, |sink| sink(&frame))?;
        Ok(rendered)
    }

    fn render_levels(
        &self,
        parts: &[LevelPart],
        method: &dyn Method,
        progress: &dyn Progress,
    ) -> Result<(Frame, Rendered), ComposeError> {
        let size = self.viewport.size;
        let shown = parts.iter().filter_map(|part| part.scene.bounds());
        let plan = self
            .backdrop
            .floor_plan
            .as_ref()
            .and_then(|plan| plan.bounds());
        let frame_m = shown.chain(plan).reduce(Bounds::union);
        let extent_m = frame_m.map_or(Point::default(), |bounds| bounds.size());
        let grid = Grid::new(parts.len() as u32, size, extent_m);
        let [width, height] = grid.part_px(size);
        let part_size = FrameSize::new(width, height)?;
        let mut frame = Frame::new(size);
        frame.pixels_mut().fill(pixel(self.style.background));
        let mut all = None::<Rendered>;
        for (i, part) in parts.iter().enumerate() {
            let mut picture = self.clone();
            picture.scene = Arc::clone(&part.scene);
            picture.viewport.size = part_size;
            picture.frame_m = self.frame_m.or(frame_m);
            picture.decorations.title = Some(part.title.clone());
            let (of_part, rendered) = picture.render_frame(method, progress)?;
            let (column, row) = (i as u32 % grid.columns, i as u32 / grid.columns);
            copy(&of_part, &mut frame, column * width, row * height);
            match &mut all {
                Some(all) => {
                    all.report.drawn += rendered.report.drawn;
                    all.report.culled += rendered.report.culled;
                    all.report.notes.extend(rendered.report.notes);
                    all.render_ms += rendered.render_ms;
                }
                None => all = Some(rendered),
            }
        }
        match all {
            Some(mut all) => {
                let report = &mut all.report;
                let shown = report.drawn + report.culled + report.refused;
                report.hidden = report.total.saturating_sub(shown);
                report.notes.dedup();
                Ok((frame, all))
            }
            None => self.render_frame(method, progress),
        }
    }
}

fn pixel(color: Rgba) -> [u8; 4] {
    color.to_u32().to_be_bytes()
}

/// Copies a frame into a larger one, its upper left pixel to (left, top).
fn copy(from: &Frame, to: &mut Frame, left: u32, top: u32) {
    let (width, to_width) = (from.size().width() as usize, to.size().width() as usize);
    let rows = from.pixels().chunks_exact(width);
    let targets = to.pixels_mut().chunks_exact_mut(to_width);
    for (row, target) in rows.zip(targets.skip(top as usize)) {
        target[left as usize..][..width].copy_from_slice(row);
    }
}

#[cfg(test)]
mod tests {
    use guideway_cpu::Cpu;
    use guideway_layout::{Layout, Level, NewPath};
    use guideway_scene::SceneOptions;
    use guideway_spline::Runs;

    use super::*;
    use crate::NoProgress;

    /// A line per level, the second one 10 m above the first one.
    fn parts() -> Vec<LevelPart> {
        let mut layout = Layout::default();
        for (level, y) in [(0, 0.0), (1, 10.0)] {
            layout.levels.push(Level {
                id: format!("L{level}"),
                ..Level::default()
            });
            let mut runs = Runs::default();
            runs.push_line(Point::new(0.0, y), Point::new(20.0, y));
            layout.paths.push(&NewPath {
                runs: &runs,
                level: Some(level),
                ..NewPath::default()
            });
        }
        let layout = Arc::new(layout);
        let part = |level: &str| {
            let options = SceneOptions {
                level: Some(level.to_owned()),
                ..SceneOptions::default()
            };
            LevelPart {
                scene: Arc::new(Scene::new(Arc::clone(&layout), &options).unwrap()),
                title: level.to_owned(),
            }
        };
        vec![part("L0"), part("L1")]
    }

    #[test]
    fn each_level_has_its_part_at_one_scale() {
        let parts = parts();
        let size = FrameSize::new(400, 600).unwrap();
        let picture = Picture::new(Arc::clone(&parts[0].scene), size);
        let (frame, rendered) = picture.render_levels(&parts, &Cpu, &NoProgress).unwrap();
        // One above the other: each is 20 m wide.
        let is_dark = |y: usize| frame.pixels()[y * 400 + 200] != [255; 4];
        let lines = |rows: std::ops::Range<usize>| {
            let dark: Vec<usize> = rows.filter(|y| is_dark(*y)).collect();
            (dark[0], dark[dark.len() - 1])
        };
        // Below the titles, whose band is at most 40 pixels high.
        let (lower, upper) = (lines(45..300), lines(345..600));
        assert!(lower.1 - lower.0 < 4 && upper.1 - upper.0 < 4);
        let px_per_m = rendered.view.px_per_m();
        let apart = (lower.0 - (upper.0 - 300)) as f64;
        assert!((apart - 10.0 * px_per_m).abs() < 2.0, "{apart}");
        let report = &rendered.report;
        assert_eq!((report.drawn, report.total, report.hidden), (2, 2, 0));
    }

    #[test]
    fn grid_suits_the_site() {
        let size = FrameSize::new(1920, 1080).unwrap();
        let grid = |parts, x, y| {
            let Grid { columns, rows } = Grid::new(parts, size, Point::new(x, y));
            (columns, rows)
        };
        assert_eq!(grid(2, 10.0, 10.0), (2, 1));
        assert_eq!(grid(2, 100.0, 10.0), (1, 2));
        assert_eq!(grid(5, 10.0, 10.0), (3, 2));
        assert_eq!(grid(1, 0.0, 0.0), (1, 1));
    }
}
