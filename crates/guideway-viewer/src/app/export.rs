//! Pictures of what is seen: as files, and for the clipboard.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_scene::{FrameSize, RenderError, Style, View};

use super::files::Saver;
use super::swept::swept_rows;
use super::{App, Layer};
use crate::services::{Job, PictureRequest, SweptAreas, WINDOW_ERROR};
use crate::work::renderer::color_image;
use crate::work::task::Task;
use guideway_layout::UserError;

impl App {
    pub(super) fn export_picture(&mut self, path: PathBuf, width_px: u32) {
        let Some(export) = self.exported() else {
            return;
        };
        if !self.is_free_to_write() {
            return;
        }
        let job = Arc::<Job>::default();
        let (services, method) = (Arc::clone(&self.services), self.drawing.method().to_owned());
        let watched = Arc::clone(&job);
        let task = Task::start(&self.wake, move || {
            let export = enlarged(export, width_px).map_err(|error| UserError {
                code: WINDOW_ERROR,
                message: error.to_string(),
                remedy: "Ask for a smaller picture".into(),
            })?;
            let saved = services.export_png(&export, &method, &watched, &path);
            let path = path.display();
            if watched.is_cancelled() && saved.is_err() {
                return Ok(format!("{path} was cancelled, and is not written"));
            }
            saved?;
            let (width, height) = (export.view.size().width(), export.view.size().height());
            Ok(format!("{path} is written, {width} x {height} pixels"))
        });
        self.saver = Some(Saver {
            task,
            layout_to: None,
            job: Some(job),
        });
    }

    pub(super) fn export_drawing(&mut self, path: PathBuf) {
        let Some(export) = self.exported() else {
            return;
        };
        if !self.is_free_to_write() {
            return;
        }
        let services = Arc::clone(&self.services);
        let task = Task::start(&self.wake, move || {
            services.export_svg(&export, &path)?;
            Ok(format!("{} is written", path.display()))
        });
        self.saver = Some(Saver {
            task,
            layout_to: None,
            job: None,
        });
    }

    /// Has a picture made as it is on the screen, for the clipboard.
    pub(crate) fn copy_picture(&mut self) {
        let Some(export) = self.exported() else {
            return;
        };
        let (services, method) = (Arc::clone(&self.services), self.drawing.method().to_owned());
        self.copying = Some(Task::start(&self.wake, move || {
            Ok(color_image(&services.render(&export, &method)?))
        }));
    }

    /// What is seen, on paper; none where no layout is.
    fn exported(&self) -> Option<PictureRequest> {
        let view = self.camera.view()?;
        let scene = |layer: &Layer| Some(Arc::new(layer.document.as_ref()?.scene().clone()));
        let mut scenes: Vec<_> = self.seen_layers().filter_map(scene).collect();
        let top = scenes.pop()?;
        let active = self.layers.get(self.active);
        let is_seen = self.swept.is_shown && active.is_some_and(|layer| layer.is_visible);
        let areas = self.document().filter(|_| is_seen);
        let rows = areas.and_then(swept_rows);
        let floor_plan = self.floor.read.as_ref().filter(|_| self.floor.is_visible);
        Some(PictureRequest {
            scene: top,
            others: scenes,
            view,
            style: Style {
                background: self.look.paper(),
                ..self.look.style()
            },
            floor_plan: floor_plan.cloned(),
            swept: self
                .swept
                .vehicle()
                .ok()
                .zip(rows)
                .map(|(vehicle, rows)| SweptAreas { vehicle, rows }),
            grid: self.grid_list(&view),
            marks: self.marks_list(&view),
        })
    }
}

/// The same part of the world in another size.
fn enlarged(export: PictureRequest, width_px: u32) -> Result<PictureRequest, RenderError> {
    let view = &export.view;
    let factor = f64::from(width_px) / f64::from(view.size().width());
    let height_px = (f64::from(view.size().height()) * factor).round().max(1.0);
    let size = FrameSize::new(width_px, height_px as u32)?;
    Ok(PictureRequest {
        view: View::new(size, view.center_m(), view.px_per_m() * factor)?,
        grid: export.grid.scaled(factor),
        marks: export.marks.scaled(factor),
        ..export
    })
}

#[cfg(test)]
mod tests {
    use guideway_scene::{Rgba, Scene, SceneOptions};
    use guideway_spline::Point;

    use super::*;
    use crate::tests::table::lanes;

    fn export(width: u32, height: u32) -> PictureRequest {
        let scene = Scene::new(Arc::new(lanes(1)), &SceneOptions::default()).unwrap();
        let size = FrameSize::new(width, height).unwrap();
        let mut grid = guideway_scene::DrawList::default();
        grid.fill_rectangle(Rgba::BLACK, Point::new(1.0, 2.0), Point::new(3.0, 4.0));
        Export {
            scene: Arc::new(scene),
            others: Vec::new(),
            view: View::new(size, Point::new(5.0, 6.0), 20.0).unwrap(),
            style: Style::default(),
            floor_plan: None,
            swept: None,
            grid,
            marks: Default::default(),
        }
    }

    #[test]
    fn a_larger_picture_shows_the_same_part_of_the_world() {
        let small = export(400, 300);
        let large = enlarged(small.clone(), 40_000).unwrap();
        assert_eq!(
            (large.view.size().width(), large.view.size().height()),
            (40_000, 30_000)
        );
        assert_eq!(large.view.world_bounds(), small.view.world_bounds());
        let corner = large.grid.fills[0].polygons[0][2];
        assert_eq!(corner, Point::new(300.0, 400.0));
        let too_tall = enlarged(export(100, 300), 65_535)
            .err()
            .unwrap()
            .to_string();
        assert!(
            too_tall.contains("each side takes 1 to 65535"),
            "{too_tall}"
        );
    }
}
