//! Finds crowds: pictures in which the number of paths per pixel says more than their colors.

use std::ops::Range;
use std::sync::Arc;

use guideway_formats::Progress;
use guideway_scene::{
    Cancel, Frame, FrameSize, Method, RenderError, Report, Rgba, Shading, Style, View,
};
use guideway_spline::Bounds;

use crate::center_lines::{PARTS, rows_of_part, walk};
use crate::{ComposeError, Picture};

/// Least number of paths that are a crowd.
const MANY_PATHS: u64 = 10_000;
/// Most pixels of a picture that is judged by center lines: of 16 MiB. It takes longer than a part
/// of the paths to mark them.
const MOST_PIXELS: usize = 1 << 24;
/// Least half width of a stroke, in pixels, that shows in every pixel that its center line crosses:
/// it covers a sixth of the pixel even where the line cuts off a corner.
const LEAST_RADIUS_PX: f64 = 0.25;
/// Least difference of a color from the background, in one channel, of which a sixth is seen.
const LEAST_CONTRAST: u8 = 64;

/// Pixels of a picture that show more than the background.
#[derive(Default)]
pub(crate) struct Covered {
    pixels: u64,
    /// The box around them; `None` without any.
    columns: Option<Range<usize>>,
    rows: Option<Range<usize>>,
    /// Rows that were looked at.
    seen: usize,
}

impl Covered {
    /// Adds the next rows of the picture.
    pub(crate) fn add(&mut self, frame: &Frame, background: Rgba) {
        let bare = background.to_u32().to_be_bytes();
        let width = frame.size().width() as usize;
        for row in frame.pixels().chunks_exact(width) {
            let is_covered = |pixel: &[u8; 4]| *pixel != bare;
            if let Some(first) = row.iter().position(is_covered) {
                let last = row.iter().rposition(is_covered).unwrap_or(first);
                let pixels = row[first..=last].iter().filter(|pixel| is_covered(pixel));
                self.pixels += pixels.count() as u64;
                widen(&mut self.columns, first..last + 1);
                widen(&mut self.rows, self.seen..self.seen + 1);
            }
            self.seen += 1;
        }
    }

    /// Returns `true` if this many paths are a crowd: they cover more than half of the box around
    /// them.
    fn is_crowd(&self, paths: u64) -> bool {
        let sides = [&self.columns, &self.rows].map(|range| range.as_ref().map_or(0, Range::len));
        paths >= MANY_PATHS && self.pixels * 2 > sides[0] as u64 * sides[1] as u64
    }

    /// Suggests density shading for a crowd.
    pub(crate) fn density_hint(&self, report: &Report, style: &Style) -> Option<String> {
        let is_crowd = self.is_crowd(report.drawn) && style.shading == Shading::Color;
        let note = "paths cover most of the picture; `--shade density` shows how many overlap";
        is_crowd.then(|| note.to_owned())
    }
}

/// Returns `true` if a whole picture of this many paths is a crowd: they cover more than half of
/// the box around them, so their density says more than their colors.
pub fn is_crowd(picture: &Frame, background: Rgba, paths: u64) -> bool {
    if paths < MANY_PATHS {
        return false;
    }
    let mut covered = Covered::default();
    covered.add(picture, background);
    covered.is_crowd(paths)
}

/// Extends a range by another one.
fn widen(range: &mut Option<Range<usize>>, by: Range<usize>) {
    *range = Some(match range.take() {
        Some(range) => range.start.min(by.start)..range.end.max(by.end),
        None => by,
    });
}

impl Picture {
    /// Returns `true` if many paths cover more than half of the box around them, so that their
    /// density says more than their colors.
    ///
    /// If a part of the center lines leaves no doubt, nothing is drawn; else, if there are many
    /// paths, the paths alone are.
    ///
    /// # Errors
    /// See [`Picture::render`].
    pub fn is_crowded(
        &self,
        method: &dyn Method,
        progress: &dyn Progress,
    ) -> Result<bool, ComposeError> {
        if (self.scene.draw_order().len() as u64) < MANY_PATHS {
            return Ok(false);
        }
        let view = self.view()?;
        if self.is_surely_crowded(&view) {
            return Ok(true);
        }
        let style = Style {
            shading: Shading::Color,
            ..self.style
        };
        let mut prepared = method.prepare(Arc::clone(&self.scene), &self.budget)?;
        let mut frame = Frame::new(FrameSize::new(1, 1)?);
        let (mut drawn, mut covered) = (0, Covered::default());
        for strip in view.strips(prepared.strip_pixels()) {
            if progress.cancelled() {
                return Err(RenderError::Cancelled.into());
            }
            let report = prepared.render_strip(&strip, &style, &Cancel::default(), &mut frame)?;
            drawn += report.drawn;
            covered.add(&frame, style.background);
        }
        Ok(covered.is_crowd(drawn))
    }

    /// Returns `true` if the pixels on center lines alone make a crowd, in any order of the paths:
    /// strokes cover at least these, and no pixel beyond the box of the curves.
    ///
    /// Cost: O(control points + pixels on center lines) of a part of the paths.
    fn is_surely_crowded(&self, view: &View) -> bool {
        let (scene, style) = (&*self.scene, &self.style);
        let radius_px = |own_m| style.line_rule.radius_px(own_m, view.px_per_m());
        let has_own_widths = scene.layout().paths.width_m().is_some();
        let least_px = radius_px(Some(0.0)).min(radius_px(None));
        let widest_px = radius_px(has_own_widths.then_some(f32::MAX)).max(radius_px(None));
        let Some(bounds) = scene.bounds() else {
            return false;
        };
        let is_small = view.size().pixels() <= MOST_PIXELS;
        if !is_small || least_px < LEAST_RADIUS_PX || !self.stand_out() {
            return false;
        }
        let [width, height] = [view.size().width(), view.size().height()].map(|px| px as usize);
        let around = pixels_around(bounds, view, widest_px);
        let mut is_marked = vec![false; width * height];
        let (mut pixels, mut paths) = (0, 0);
        let order = scene.draw_order();
        for part in 0..PARTS {
            for &path in rows_of_part(order.len(), part).flat_map(|rows| &order[rows]) {
                let mut is_seen = false;
                walk(
                    scene.layout().paths.get(path as usize),
                    view,
                    1.0,
                    |x, y| {
                        if x < width && y < height {
                            is_seen = true;
                            let was_marked = std::mem::replace(&mut is_marked[y * width + x], true);
                            pixels += u64::from(!was_marked);
                        }
                    },
                );
                paths += u64::from(is_seen);
                if paths >= MANY_PATHS && 2 * pixels > around {
                    return true;
                }
            }
            // Each further part adds about as many pixels as the first one, or fewer.
            if 2 * pixels * PARTS as u64 <= around {
                return false;
            }
        }
        false
    }

    /// Returns `true` if each path shows wherever it covers a good part of a pixel.
    fn stand_out(&self) -> bool {
        let Rgba { r, g, b, .. } = self.style.background;
        let stands_out = |color: Rgba| {
            let differences =
                [(color.r, r), (color.g, g), (color.b, b)].map(|(a, b)| a.abs_diff(b));
            color.is_opaque() && differences.into_iter().any(|by| by >= LEAST_CONTRAST)
        };
        match self.scene.common_color() {
            Some(color) => stands_out(color),
            None => {
                let paths = self.scene.draw_order().iter();
                paths.map(|&path| self.scene.color(path)).all(stands_out)
            }
        }
    }
}

/// Most pixels of the box around all pixels that strokes of a half width cover, within the picture.
fn pixels_around(bounds_m: Bounds<f64>, view: &View, radius_px: f64) -> u64 {
    let corners = [bounds_m.min, bounds_m.max].map(|corner| view.pixel_from_world(corner));
    let side = |a: f64, b: f64, px: u32| {
        let (least, most) = (a.min(b) - radius_px - 1.0, a.max(b) + radius_px + 1.0);
        let end = f64::from(px);
        (most.ceil().clamp(0.0, end) - least.floor().clamp(0.0, end)) as u64
    };
    let [a, b] = corners;
    side(a.x, b.x, view.size().width()) * side(a.y, b.y, view.size().height())
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use guideway_cpu::Cpu;
    use guideway_scene::{Budget, MethodInfo, Prepared, Scene, SceneOptions};
    use guideway_spline::Point;

    use super::*;
    use crate::NoProgress;
    use crate::test_layouts::{numbers, straight_ways};

    /// Method `cpu`, which counts how often it prepares a scene.
    #[derive(Default)]
    struct Counted(AtomicUsize);

    impl Method for Counted {
        fn info(&self) -> MethodInfo {
            Cpu.info()
        }

        fn prepare(
            &self,
            scene: Arc<Scene>,
            budget: &Budget,
        ) -> Result<Box<dyn Prepared>, RenderError> {
            self.0.fetch_add(1, Ordering::Relaxed);
            Cpu.prepare(scene, budget)
        }
    }

    /// A picture of 12,000 short paths at random places of a square of this side.
    fn scattered(side_m: f64, color: Rgba) -> Picture {
        let mut next = numbers();
        let ends = (0..12_000).map(|_| {
            let from = Point::new(next(), next()) * side_m;
            [from, from + Point::new(next() - 0.5, next() - 0.5)]
        });
        let layout = straight_ways(ends);
        let options = SceneOptions {
            color: Some(color),
            ..SceneOptions::default()
        };
        let scene = Scene::new(Arc::new(layout), &options).unwrap();
        Picture::new(Arc::new(scene), FrameSize::new(600, 450).unwrap())
    }

    #[test]
    fn a_crowd_beyond_doubt_is_not_drawn() {
        let drawn = |side_m: f64, color: Rgba| {
            let (picture, method) = (scattered(side_m, color), Counted::default());
            let is_crowded = picture.is_crowded(&method, &NoProgress).unwrap();
            (is_crowded, method.0.into_inner())
        };
        assert_eq!(drawn(8.0, Rgba::BLACK), (true, 0));
        // Too few pixels, paths like the paper, and paths that others shine through.
        assert_eq!(drawn(400.0, Rgba::BLACK), (false, 1));
        assert_eq!(drawn(8.0, Rgba::WHITE), (false, 1));
        let pale = Rgba {
            a: 200,
            ..Rgba::BLACK
        };
        assert_eq!(drawn(8.0, pale), (true, 1));
    }

    #[test]
    fn center_lines_never_make_a_crowd_of_what_is_none() {
        let mut sure = 0;
        for side_m in [8.0, 10.0, 12.0, 14.0, 16.0, 20.0, 30.0, 60.0, 200.0, 400.0] {
            let mut picture = scattered(side_m, Rgba::BLACK);
            for max_px in [0.5, 1.5, 3.0] {
                picture.style.line_rule = guideway_scene::LineRule::World {
                    width_m: 0.0,
                    min_px: max_px,
                    max_px,
                };
                let view = picture.view().unwrap();
                let (frame, rendered) = picture.render_frame(&Cpu, &NoProgress).unwrap();
                let mut covered = Covered::default();
                covered.add(&frame, Rgba::WHITE);
                let is_crowd = covered.is_crowd(rendered.report.drawn);
                let is_sure = picture.is_surely_crowded(&view);
                assert!(is_crowd || !is_sure, "{side_m} m, {max_px} px");
                sure += u32::from(is_sure);
            }
        }
        assert!((3..24).contains(&sure), "{sure} of 30 are sure");
    }

    /// Covered pixels of a picture of 20 rows in two parts.
    fn covered(is_covered: impl Fn(usize, usize) -> bool) -> Covered {
        let mut covered = Covered::default();
        for first in [0, 10] {
            let mut frame = Frame::new(FrameSize::new(20, 10).unwrap());
            for (i, pixel) in frame.pixels_mut().iter_mut().enumerate() {
                let is_covered = is_covered(i % 20, first + i / 20);
                *pixel = if is_covered { [0, 0, 0, 255] } else { [255; 4] };
            }
            covered.add(&frame, Rgba::WHITE);
        }
        covered
    }

    #[test]
    fn a_crowd_covers_more_than_half_of_the_box_around_it() {
        let is_inside = |x: usize, y: usize| (4..14).contains(&x) && (8..13).contains(&y);
        let block = covered(is_inside);
        assert!(block.is_crowd(MANY_PATHS), "margins do not count");
        assert!(!block.is_crowd(MANY_PATHS - 1));
        let sparse = covered(|x, y| is_inside(x, y) && (x + y) % 2 == 0);
        assert!(!sparse.is_crowd(MANY_PATHS));
        assert!(!covered(|_, _| false).is_crowd(MANY_PATHS));
    }
}
