//! Collects everything that the canvas shows into a picture request.

use std::path::Path;
use std::sync::Arc;

use guideway_compose::OtherScene;
use guideway_document::decorations::{
    Corner, DecorationStyle, hide_covered_texts, marks, scale_bar,
};
use guideway_layout::{UserError, shown_path};
use guideway_scene::{DrawList, FrameSize, RenderError, Style, View};

use crate::backdrop::{FloorPlanLayer, SweptAreasLayer};
use crate::canvas::{legends, shown_legends};
use crate::display_settings::DisplaySettings;
use crate::files::{Layer, OpenFiles};
use crate::language::say;
use crate::services::{AppServices, Job, PictureRequest};

/// Everything that the canvas shows.
pub(crate) struct PictureContent<'a> {
    pub(crate) view: View,
    /// Pixels of the picture per point of the screen.
    pub(crate) px_per_point: f64,
    pub(crate) settings: &'a DisplaySettings,
    pub(crate) files: &'a OpenFiles,
    pub(crate) floor_plan: &'a FloorPlanLayer,
    pub(crate) swept_areas: &'a SweptAreasLayer,
}

impl PictureContent<'_> {
    /// The request for this picture; `None` if no document is visible.
    pub(crate) fn request(&self) -> Option<PictureRequest> {
        let settings = self.settings;
        let scene = |layer: &Layer| {
            Some(OtherScene {
                scene: Arc::new(layer.document()?.scene().clone()),
                line_rule: settings.line_rule(layer.widths, self.px_per_point),
                opacity: f64::from(layer.look.opacity),
            })
        };
        let with_paths = self.files.visible().filter(|layer| layer.look.has_paths);
        let mut scenes: Vec<_> = with_paths.filter_map(scene).collect();
        let top = scenes.pop()?;
        let active = self.files.active().filter(|layer| layer.is_visible);
        let document = active.and_then(Layer::document);
        // Counts of density are known after rendering: their legend is that of the topmost scene.
        let shown = match settings.shows_density() {
            true => Vec::new(),
            false => shown_legends(self.files, settings),
        };
        let legends = match shown.len() > 1 {
            true => legends(&shown, self.view.size(), &self.decoration_style()),
            false => Vec::new(),
        };
        Some(PictureRequest {
            scene: top.scene,
            opacity: top.opacity,
            others: scenes,
            view: self.view,
            px_per_point: self.px_per_point,
            style: Style {
                background: settings.background(),
                ..settings.style(top.line_rule)
            },
            floor_plan: self.floor_plan.visible().cloned(),
            floor_plan_opacity: f64::from(self.floor_plan.drawn_opacity()),
            swept: document.and_then(|document| self.swept_areas.areas(document)),
            grid: settings.grid(&self.view, self.px_per_point),
            marks: self.marks(&legends),
            has_legend: legends.is_empty(),
        })
    }

    fn decoration_style(&self) -> DecorationStyle {
        self.settings.decoration_style(self.px_per_point)
    }

    /// Arrows, symbols and labels of all visible files, the scale bar, and these legends.
    fn marks(&self, legends: &[DrawList]) -> DrawList {
        let style = self.decoration_style();
        let of_layer = |layer: &Layer| {
            let document = layer.document()?;
            let line_rule = self.settings.line_rule(layer.widths, self.px_per_point);
            let options = self.settings.mark_options(line_rule, self.px_per_point);
            let options = layer.look.mark_options(options, Some(document));
            let marks = marks(document, &self.view, &options);
            let marks = marks.draw(&style, |at_px| at_px);
            Some(marks.faded(f64::from(layer.look.opacity)))
        };
        let mut drawings: Vec<_> = self.files.visible().filter_map(of_layer).collect();
        hide_covered_texts(&mut drawings);
        let mut list = DrawList::default();
        drawings.push(scale_bar(&self.view, &style, Corner::LowerLeft));
        for drawing in drawings.into_iter().chain(legends.iter().cloned()) {
            list.append(drawing);
        }
        list
    }
}

/// Writes a PNG of this width and returns a sentence for the user.
///
/// # Errors
/// When the size exceeds the limits of a frame, or rendering or writing fails.
pub(crate) fn png_picture(
    picture: PictureRequest,
    width_px: u32,
    method: &str,
    services: &dyn AppServices,
    job: &Job,
    path: &Path,
) -> Result<String, UserError> {
    let picture = scaled_to(picture, width_px)?;
    let result = services.export_png(&picture, method, job, path);
    let path = shown_path(path);
    if job.is_cancelled() && result.is_err() {
        return Ok(say!("The export of {path} was cancelled", path));
    }
    result?;
    let (width, height) = (picture.view.size().width(), picture.view.size().height());
    Ok(say!(
        "Wrote {path}, {width} x {height} pixels",
        path,
        width,
        height
    ))
}

/// The same part of the world at another width in pixels.
fn scaled_to(picture: PictureRequest, width_px: u32) -> Result<PictureRequest, RenderError> {
    let view = &picture.view;
    let factor = f64::from(width_px) / f64::from(view.size().width());
    let height_px = (f64::from(view.size().height()) * factor).round().max(1.0);
    let size = FrameSize::new(width_px, height_px as u32)?;
    let scaled = |other: OtherScene| OtherScene {
        line_rule: other.line_rule.scaled(factor),
        ..other
    };
    Ok(PictureRequest {
        view: View::new(size, view.center_m(), view.px_per_m() * factor)?,
        px_per_point: picture.px_per_point * factor,
        style: Style {
            line_rule: picture.style.line_rule.scaled(factor),
            ..picture.style
        },
        others: picture.others.into_iter().map(scaled).collect(),
        grid: picture.grid.scaled(factor),
        marks: picture.marks.scaled(factor),
        ..picture
    })
}

#[cfg(test)]
mod tests {
    use guideway_scene::{Rgba, Scene, SceneOptions};
    use guideway_spline::Point;

    use super::*;
    use crate::tests::services::lanes;

    fn picture(width: u32, height: u32) -> PictureRequest {
        let scene = Scene::new(Arc::new(lanes(1)), &SceneOptions::default()).unwrap();
        let size = FrameSize::new(width, height).unwrap();
        let mut grid = DrawList::default();
        grid.fill_rectangle(Rgba::BLACK, Point::new(1.0, 2.0), Point::new(3.0, 4.0));
        PictureRequest {
            scene: Arc::new(scene),
            opacity: 1.0,
            others: Vec::new(),
            view: View::new(size, Point::new(5.0, 6.0), 20.0).unwrap(),
            px_per_point: 1.0,
            style: Style::default(),
            floor_plan: None,
            floor_plan_opacity: 1.0,
            swept: None,
            grid,
            marks: DrawList::default(),
            has_legend: true,
        }
    }

    #[test]
    fn scaled_picture_shows_the_same_part_of_the_world() {
        let small = picture(400, 300);
        let large = scaled_to(small.clone(), 40_000).unwrap();
        let size = large.view.size();
        assert_eq!((size.width(), size.height()), (40_000, 30_000));
        assert_eq!(large.view.world_bounds(), small.view.world_bounds());
        let corner = large.grid.fills[0].polygons[0][2];
        assert_eq!(corner, Point::new(300.0, 400.0));
        let radius_px = |picture: &PictureRequest| {
            let rule = picture.style.line_rule;
            rule.radius_px(None, picture.view.px_per_m())
        };
        for px_per_m in [1.0, 20.0, 500.0] {
            let view = View::new(small.view.size(), Point::new(5.0, 6.0), px_per_m).unwrap();
            let small = PictureRequest {
                view,
                ..small.clone()
            };
            let large = scaled_to(small.clone(), 1_600).unwrap();
            assert_eq!(radius_px(&large), 4.0 * radius_px(&small), "lines too");
            assert_eq!(large.px_per_point, 4.0);
        }
    }

    #[test]
    fn rejects_a_picture_beyond_the_frame_limits() {
        let error = scaled_to(picture(100, 300), 65_535).err().unwrap();
        assert!(error.to_string().contains("65535"), "{error}");
    }
}
