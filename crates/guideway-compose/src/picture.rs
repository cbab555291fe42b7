//! The description of a picture: scene, backdrop, decorations, style and viewport.

use std::sync::Arc;

use guideway_document::Index;
use guideway_document::decorations::DecorationStyle;
use guideway_png::PngHeader;
use guideway_scene::{Budget, DrawList, FrameSize, RenderError, Scene, Style, View};
use guideway_spline::{Bounds, Point};

use crate::backdrop::Backdrop;
use crate::decorations::{Decorations, PlacedCorners, PlacedDecorations, place, place_corners};

/// Everything that a picture shows. All fields are public: start with [`Picture::new`] and set
/// those that differ.
#[derive(Clone)]
pub struct Picture {
    /// The paths.
    pub scene: Arc<Scene>,
    /// Levels to show side by side at one scale, in place of the paths; empty for one picture.
    pub levels: Vec<LevelPart>,
    /// Size and detail.
    pub viewport: Viewport,
    /// Box that a viewport fits, in meters; `None` for all layers.
    pub frame_m: Option<Bounds<f64>>,
    /// Line widths, shading and background of the paths.
    pub style: Style,
    /// Opacity of the paths, from 0 to 1.
    pub opacity: f64,
    /// The layers below the paths.
    pub backdrop: Backdrop,
    /// Shapes over the paths, in pixels, such as the marks of a window.
    pub overlay: DrawList,
    /// Grid, marks, legend, title and scale bar, derived from the scene and the view.
    pub decorations: Decorations,
    /// The index of the layout, by which marks are found; `None` builds one where there are marks.
    /// Many pictures of a layout share one.
    pub index: Option<Arc<Index>>,
    /// Memory and threads of the render method.
    pub budget: Budget,
}

/// A level beside others.
#[derive(Clone)]
pub struct LevelPart {
    /// The paths of the level.
    pub scene: Arc<Scene>,
    /// Its title.
    pub title: String,
}

/// Size of a picture and the detail that it shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Size in pixels.
    pub size: FrameSize,
    /// World point at the center, in meters; `None` centers all layers.
    pub center_m: Option<Point<f64>>,
    /// Pixels per meter; `None` fits all layers.
    pub px_per_m: Option<f64>,
}

impl Viewport {
    /// A viewport that fits all layers.
    pub fn fit(size: FrameSize) -> Self {
        Self {
            size,
            center_m: None,
            px_per_m: None,
        }
    }

    /// The viewport that shows exactly `view`.
    pub fn of(view: &View) -> Self {
        Self {
            size: view.size(),
            center_m: Some(view.center_m()),
            px_per_m: Some(view.px_per_m()),
        }
    }
}

impl Picture {
    /// A picture that fits the scene, on white, without decorations.
    pub fn new(scene: Arc<Scene>, size: FrameSize) -> Self {
        Self {
            scene,
            levels: Vec::new(),
            viewport: Viewport::fit(size),
            frame_m: None,
            style: Style::default(),
            opacity: 1.0,
            backdrop: Backdrop::default(),
            overlay: DrawList::default(),
            decorations: Decorations::default(),
            index: None,
            budget: Budget::default(),
        }
    }

    /// The view that the viewport selects. Where it fits all layers, a title keeps a band at the
    /// top to itself, and so does a legend for which no corner is free, there or on the left, and a
    /// scale bar at the bottom.
    /// Levels side by side have views of their own.
    ///
    /// # Errors
    /// When center or scale are out of range: see [`View::new`].
    pub fn view(&self) -> Result<View, RenderError> {
        let Viewport {
            size,
            center_m,
            px_per_m,
        } = self.viewport;
        if let (Some(center_m), Some(px_per_m)) = (center_m, px_per_m) {
            return View::new(size, center_m, px_per_m);
        }
        let (view, covered_px) = self.view_above(0.0)?;
        match covered_px {
            Some(height_px) => Ok(self.view_above(height_px)?.0),
            None => Ok(view),
        }
    }

    /// The view above a band at the bottom, and the height of the scale bar if paths are below it.
    fn view_above(&self, bottom_px: f64) -> Result<(View, Option<f64>), RenderError> {
        let Viewport {
            size,
            center_m,
            px_per_m,
        } = self.viewport;
        let bounds = [self.scene.bounds(), self.backdrop.bounds(&self.scene)];
        let bounds = bounds.into_iter().flatten().reduce(Bounds::union);
        let bounds = self.frame_m.or(bounds);
        let style = self.decoration_style();
        let title_px = self.decorations.title_band_px(&style);
        let plain = self.fit([0.0, title_px, bottom_px], px_per_m, bounds)?;
        if center_m.is_some() || px_per_m.is_some() {
            let center_m = center_m.unwrap_or(plain.center_m());
            let view = View::new(size, center_m, plain.px_per_m())?;
            return Ok((view, covered_bar_px(&self.place_corners(&view))));
        }
        let corners = self.place_corners(&plain);
        match &corners.legend {
            Some(legend) if legend.covered > 0 => {
                let gap_px = style.line_px() / 2.0;
                let room = legend.bounds.size() + Point::new(gap_px, gap_px);
                let beside = self.fit([room.x, title_px, bottom_px], None, bounds)?;
                let below = self.fit([0.0, title_px + room.y, bottom_px], None, bounds)?;
                let view = match beside.px_per_m() >= below.px_per_m() {
                    true => beside,
                    false => below,
                };
                Ok((view, covered_bar_px(&self.place_corners(&view))))
            }
            _ => Ok((plain, covered_bar_px(&corners))),
        }
    }

    /// Legend and scale bar in a view.
    fn place_corners(&self, view: &View) -> PlacedCorners {
        let colors = (&*self.scene, self.style.shading);
        place_corners(&self.decorations, colors, view, &self.decoration_style())
    }

    /// The header of a PNG file of the picture. Levels side by side have no common place.
    ///
    /// # Errors
    /// See [`Picture::view`].
    pub fn png_header(&self) -> Result<PngHeader, RenderError> {
        let title = self.decorations.title.as_deref();
        let mut header = PngHeader::new(title, self.decoration_style().px_per_point);
        if self.levels.is_empty() {
            header.push_place(&self.view()?);
        }
        Ok(header)
    }

    /// The view that fits `bounds` into the picture without bands on the left, at the top and at
    /// the bottom, or centers it there at a scale.
    fn fit(
        &self,
        [left_px, top_px, bottom_px]: [f64; 3],
        px_per_m: Option<f64>,
        bounds: Option<Bounds<f64>>,
    ) -> Result<View, RenderError> {
        let size = self.viewport.size;
        let free = |px: u32, band_px: f64| (f64::from(px) - band_px).max(1.0) as u32;
        let width = free(size.width(), left_px);
        let height = free(size.height(), top_px + bottom_px);
        let all = View::fit(FrameSize::new(width, height)?, bounds)?;
        // The free part of the picture is beside its middle by half of the bands.
        let band = Point::new(
            -f64::from(size.width() - width),
            f64::from(size.height() - height) - 2.0 * bottom_px,
        );
        let px_per_m = px_per_m.unwrap_or(all.px_per_m());
        View::new(size, all.center_m() + band * (0.5 / px_per_m), px_per_m)
    }

    /// Colors and sizes of the decorations.
    pub(crate) fn decoration_style(&self) -> DecorationStyle {
        let background = self.style.background;
        match self.decorations.px_per_point {
            Some(px_per_point) => DecorationStyle::new(background, px_per_point),
            None => DecorationStyle::for_picture(self.viewport.size, background),
        }
    }

    /// The decorations as draw lists for a view.
    pub(crate) fn place_decorations(&self, view: &View) -> PlacedDecorations {
        let style = self.decoration_style();
        let scene = (&*self.scene, self.index.as_ref());
        place(&self.decorations, scene, view, &self.style, &style)
    }
}

/// Height of a scale bar that paths are below, in pixels.
fn covered_bar_px(corners: &PlacedCorners) -> Option<f64> {
    let bar = corners.bar.as_ref().filter(|bar| bar.covered > 0);
    bar.map(|bar| bar.bounds.size().y)
}

#[cfg(test)]
mod tests {
    use guideway_document::decorations::Corner;
    use guideway_layout::{Layout, NewPath, Value};
    use guideway_scene::{ColorBy, SceneOptions};
    use guideway_spline::Runs;

    use super::*;

    fn size() -> FrameSize {
        FrameSize::new(640, 480).unwrap()
    }

    fn picture() -> Picture {
        let mut runs = Runs::default();
        runs.push_line(Point::new(0.0, 0.0), Point::new(12.0, 8.0));
        let mut layout = Layout::default();
        layout.paths.push(&NewPath {
            id: "a",
            runs: &runs,
            ..NewPath::default()
        });
        let scene = Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap();
        Picture::new(Arc::new(scene), size())
    }

    /// Paths of two levels of speed along all sides of a site, with a legend.
    fn with_legend(side_m: Point<f64>) -> Picture {
        let mut layout = Layout::default();
        let corners = [
            Point::new(0.0, 0.0),
            Point::new(side_m.x, 0.0),
            side_m,
            Point::new(0.0, side_m.y),
        ];
        for (row, start) in corners.into_iter().enumerate() {
            let mut runs = Runs::default();
            runs.push_line(start, corners[(row + 1) % 4]);
            layout.paths.push(&NewPath {
                id: "side",
                runs: &runs,
                ..NewPath::default()
            });
            let kind = Value::Text(if row < 2 { "slow" } else { "fast" });
            layout.paths.attributes.set(row, "kind", kind);
        }
        let options = SceneOptions {
            color_by: Some(ColorBy {
                column: "kind".into(),
            }),
            ..SceneOptions::default()
        };
        let scene = Scene::new(Arc::new(layout), &options).unwrap();
        let mut picture = Picture::new(Arc::new(scene), size());
        picture.decorations.has_legend = true;
        picture
    }

    #[test]
    fn a_legend_hides_no_path() {
        for side_m in [
            Point::new(12.0, 8.0),
            Point::new(40.0, 8.0),
            Point::new(4.0, 90.0),
        ] {
            let picture = with_legend(side_m);
            let view = picture.view().unwrap();
            let bounds = view.world_bounds();
            assert!(bounds.contains(Point::new(0.0, 0.0)) && bounds.contains(side_m));
            let legend = picture.place_corners(&view).legend;
            assert_eq!(legend.unwrap().covered, 0, "{side_m:?}");
        }
    }

    #[test]
    fn a_scale_bar_hides_no_path() {
        let mut picture = with_legend(Point::new(12.0, 9.0));
        picture.decorations.has_legend = false;
        picture.decorations.has_scale_bar = true;
        let bar = |view: &View| picture.place_corners(view).bar.unwrap();
        assert!(bar(&picture.view_above(0.0).unwrap().0).covered > 0);
        let view = picture.view().unwrap();
        assert_eq!(bar(&view).covered, 0);
        let bounds = view.world_bounds();
        assert!(bounds.contains(Point::new(0.0, 0.0)) && bounds.contains(Point::new(12.0, 9.0)));
    }

    #[test]
    fn a_legend_over_a_fixed_view_takes_a_free_corner() {
        let mut picture = with_legend(Point::new(12.0, 8.0));
        picture.viewport.center_m = Some(Point::new(12.0, 8.0));
        picture.viewport.px_per_m = Some(20.0);
        let view = picture.view().unwrap();
        assert_eq!(view.px_per_m(), 20.0);
        let legend = picture.place_corners(&view).legend;
        assert_eq!(legend.unwrap().covered, 0);
    }

    #[test]
    fn a_legend_without_a_free_corner_takes_the_emptiest() {
        let mut picture = with_legend(Point::new(12.0, 8.0));
        let mut layout = Layout::clone(picture.scene.layout());
        // Three paths in each corner of the view, and one on the lower right.
        for (x, y, count) in [
            (0.0, 9.2, 3),
            (12.0, 9.2, 3),
            (12.0, -1.2, 1),
            (0.0, -1.2, 3),
        ] {
            for i in 0..count {
                let mut runs = Runs::default();
                let y = y + f64::from(i) * 0.01;
                runs.push_line(Point::new(x - 3.0, y), Point::new(x + 3.0, y));
                layout.paths.push(&NewPath {
                    runs: &runs,
                    ..NewPath::default()
                });
            }
        }
        let options = SceneOptions {
            color_by: Some(ColorBy {
                column: "kind".into(),
            }),
            ..SceneOptions::default()
        };
        picture.scene = Arc::new(Scene::new(Arc::new(layout), &options).unwrap());
        picture.viewport.center_m = Some(Point::new(6.0, 4.0));
        picture.viewport.px_per_m = Some(40.0);
        let view = picture.view().unwrap();
        let legend = picture.place_corners(&view).legend.unwrap();
        assert_eq!(
            (legend.corner, legend.covered > 0),
            (Corner::LowerRight, true)
        );
    }

    #[test]
    fn fit_without_title_is_fit_of_view() {
        let picture = picture();
        let fit = View::fit(size(), picture.scene.bounds()).unwrap();
        assert_eq!(picture.view().unwrap(), fit);
    }

    #[test]
    fn title_band_stays_free_of_paths() {
        let mut picture = picture();
        picture.decorations.title = Some("Hall 3".into());
        let view = picture.view().unwrap();
        let style = picture.decoration_style();
        let band_px = picture.decorations.title_band_px(&style);
        let top = view.pixel_from_world(picture.scene.bounds().unwrap().max);
        assert!(top.y > band_px && band_px > 10.0, "{top:?}, {band_px}");
    }
}
