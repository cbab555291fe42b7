//! Several levels side by side: one picture per level, at one scale, in a grid.

use std::sync::Arc;

use guideway_scene::{Frame, FrameSize, RenderError};
use guideway_spline::{Bounds, Point};

use crate::{LevelPart, Picture};

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
    /// The pictures of all levels, each with its upper left corner in pixels: the first one in the
    /// upper left corner. Every one shows the place that holds all levels, and is else as this one.
    ///
    /// # Errors
    /// When the picture is too small for its levels.
    pub(crate) fn of_levels(&self) -> Result<Vec<(Self, [u32; 2])>, RenderError> {
        let shown = self.levels.iter().filter_map(|level| level.scene.bounds());
        let plan = self
            .backdrop
            .floor_plan
            .as_ref()
            .and_then(|plan| plan.bounds());
        let frame_m = shown.chain(plan).reduce(Bounds::union);
        let extent_m = frame_m.map_or(Point::default(), |bounds| bounds.size());
        let grid = Grid::new(self.levels.len() as u32, self.viewport.size, extent_m);
        let [width, height] = grid.part_px(self.viewport.size);
        let size = FrameSize::new(width, height)?;
        let of_level = |(i, level): (u32, &LevelPart)| {
            let mut picture = self.clone();
            picture.levels = Vec::new();
            picture.scene = Arc::clone(&level.scene);
            picture.viewport.size = size;
            picture.frame_m = self.frame_m.or(frame_m);
            picture.decorations.title = Some(level.title.clone());
            let (column, row) = (i % grid.columns, i / grid.columns);
            (picture, [column * width, row * height])
        };
        Ok((0..).zip(&self.levels).map(of_level).collect())
    }
}

/// Copies a frame into a larger one, its upper left pixel to (left, top).
pub(crate) fn copy(from: &Frame, to: &mut Frame, [left, top]: [u32; 2]) {
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
    use guideway_formats::Progress;
    use guideway_layout::{Layout, Level, NewPath};
    use guideway_scene::{Scene, SceneOptions};
    use guideway_spline::Runs;

    use super::*;
    use crate::{NoProgress, VectorFormat};

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

    fn picture() -> Picture {
        let levels = parts();
        let size = FrameSize::new(400, 600).unwrap();
        let mut picture = Picture::new(Arc::clone(&levels[0].scene), size);
        picture.levels = levels;
        picture
    }

    #[test]
    fn each_level_has_its_part_at_one_scale() {
        let picture = picture();
        let (frame, rendered) = picture.render_frame(&Cpu, &NoProgress).unwrap();
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
    fn vector_graphics_have_a_clipped_part_per_level() {
        let written = |format| {
            let mut out = Vec::new();
            let written = picture().write_vector(format, &mut out, |problem| panic!("{problem}"));
            let report = written.unwrap().report;
            assert_eq!((report.drawn, report.total, report.hidden), (2, 2, 0));
            out
        };
        let svg = String::from_utf8(written(VectorFormat::Svg)).unwrap();
        for part in [
            r#"<svg x="0" y="0" width="400" height="300">"#,
            r#"<svg x="0" y="300" width="400" height="300">"#,
            ">L0</text>",
            ">L1</text>",
        ] {
            assert_eq!(svg.matches(part).count(), 1, "{part}: {svg}");
        }
        assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
        assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count());
        let pdf = written(VectorFormat::Pdf);
        assert!(pdf.starts_with(b"%PDF-1.6"));
    }

    #[test]
    fn progress_of_levels_is_one_scale() {
        struct Seen(std::sync::Mutex<Vec<f64>>);
        impl Progress for Seen {
            fn advance(&self, done: u64, total: u64) {
                self.0.lock().unwrap().push(done as f64 / total as f64);
            }
        }
        let seen = Seen(std::sync::Mutex::default());
        picture().render_frame(&Cpu, &seen).unwrap();
        let shares = seen.0.into_inner().unwrap();
        assert!(shares.is_sorted() && shares.len() > 1, "{shares:?}");
        assert_eq!(shares.last(), Some(&1.0));
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
