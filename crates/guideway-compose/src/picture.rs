//! The description of a picture: scene, backdrop, decorations, style and viewport.

use std::sync::Arc;

use guideway_document::decorations::DecorationStyle;
use guideway_scene::{Budget, DrawList, FrameSize, RenderError, Scene, Style, View};
use guideway_spline::{Bounds, Point};

use crate::backdrop::Backdrop;
use crate::decorations::{Decorations, PlacedDecorations, place, title_band_px};

/// Everything that a picture shows. All fields are public: start with [`Picture::new`] and set
/// those that differ.
#[derive(Clone)]
pub struct Picture {
    /// The paths.
    pub scene: Arc<Scene>,
    /// Size and detail.
    pub viewport: Viewport,
    /// Line widths, shading and background of the paths.
    pub style: Style,
    /// The layers below the paths.
    pub backdrop: Backdrop,
    /// Shapes over the paths, in pixels, such as the marks of a window.
    pub overlay: DrawList,
    /// Grid, marks, legend, title and scale bar, derived from the scene and the view.
    pub decorations: Decorations,
    /// Memory and threads of the render method.
    pub budget: Budget,
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
            viewport: Viewport::fit(size),
            style: Style::default(),
            backdrop: Backdrop::default(),
            overlay: DrawList::default(),
            decorations: Decorations::default(),
            budget: Budget::default(),
        }
    }

    /// The view that the viewport selects. Where it fits all layers, a title keeps a band at the
    /// top to itself.
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
        let bounds = [self.scene.bounds(), self.backdrop.bounds(&self.scene)];
        let bounds = bounds.into_iter().flatten().reduce(Bounds::union);
        let title_px = title_band_px(&self.decorations, &self.decoration_style());
        let free_height = (f64::from(size.height()) - title_px).max(1.0) as u32;
        let all = View::fit(FrameSize::new(size.width(), free_height)?, bounds)?;
        let px_per_m = px_per_m.unwrap_or(all.px_per_m());
        // The free part of the picture is below its middle by half of the band.
        let up_m = f64::from(size.height() - free_height) / 2.0 / px_per_m;
        let middle_m = all.center_m() + Point::new(0.0, up_m);
        View::new(size, center_m.unwrap_or(middle_m), px_per_m)
    }

    /// Colors and sizes of the decorations.
    pub(crate) fn decoration_style(&self) -> DecorationStyle {
        DecorationStyle::for_picture(self.viewport.size, self.style.background)
    }

    /// The decorations as draw lists for a view.
    pub(crate) fn place_decorations(&self, view: &View) -> PlacedDecorations {
        let style = self.decoration_style();
        place(&self.decorations, &self.scene, view, &self.style, &style)
    }
}

#[cfg(test)]
mod tests {
    use guideway_layout::{Layout, NewPath};
    use guideway_scene::SceneOptions;
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
        let band_px = title_band_px(&picture.decorations, &picture.decoration_style());
        let top = view.pixel_from_world(picture.scene.bounds().unwrap().max);
        assert!(top.y > band_px && band_px > 10.0, "{top:?}, {band_px}");
    }
}
