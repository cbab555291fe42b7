//! Pictures of what is seen: as files, and for the clipboard.

use std::path::PathBuf;
use std::sync::Arc;

use guideway_render::{Budget, Cancel, Frame, FrameSize, RenderError, Style, View};
use guideway_scene::Scene;

use super::App;
use super::files::Saver;
use crate::host::{Export, Job, Trouble};
use crate::work::renderer::color_image;
use crate::work::task::Task;

impl App {
    pub(super) fn export_picture(&mut self, path: PathBuf, width_px: u32) {
        let Some((scene, view, style)) = self.exported() else {
            return;
        };
        if !self.is_free_to_write() {
            return;
        }
        let job = Arc::<Job>::default();
        let (host, method) = (Arc::clone(&self.host), self.drawing.method().to_owned());
        let watched = Arc::clone(&job);
        let task = Task::start(&self.wake, move || {
            let view = enlarged(&view, width_px).map_err(|error| Trouble {
                message: error.to_string(),
                remedy: "Ask for a smaller picture".into(),
            })?;
            let export = Export {
                scene: &scene,
                view: &view,
                style: &style,
            };
            let saved = host.save_picture(export, &method, &watched, &path);
            let path = path.display();
            if watched.is_cancelled() && saved.is_err() {
                return Ok(format!("{path} was cancelled, and is not written"));
            }
            saved?;
            let (width, height) = (view.size().width(), view.size().height());
            Ok(format!("{path} is written, {width} x {height} pixels"))
        });
        self.saver = Some(Saver {
            task,
            saving: None,
            job: Some(job),
        });
    }

    pub(super) fn export_drawing(&mut self, path: PathBuf) {
        let Some((scene, view, style)) = self.exported() else {
            return;
        };
        if !self.is_free_to_write() {
            return;
        }
        let host = Arc::clone(&self.host);
        let task = Task::start(&self.wake, move || {
            let export = Export {
                scene: &scene,
                view: &view,
                style: &style,
            };
            host.save_drawing(export, &path)?;
            Ok(format!("{} is written", path.display()))
        });
        self.saver = Some(Saver {
            task,
            saving: None,
            job: None,
        });
    }

    /// Has the picture of the active layer made as it is on the screen, for the clipboard.
    pub(crate) fn copy_picture(&mut self) {
        let Some((scene, view, style)) = self.exported() else {
            return;
        };
        let (host, method) = (Arc::clone(&self.host), self.drawing.method().to_owned());
        self.copying = Some(Task::start(&self.wake, move || {
            let fail = |error: RenderError| Trouble {
                message: error.to_string(),
                remedy: "Choose another way of drawing".into(),
            };
            let method = host.method(&method)?;
            let mut prepared = method.prepare(scene, &Budget::default()).map_err(fail)?;
            let (mut frame, cancel) = (Frame::new(view.size()), Cancel::default());
            let drawn = prepared.render(&view, &style, &cancel, &mut frame);
            drawn.map_err(fail)?;
            Ok(color_image(&frame))
        }));
    }

    /// What is seen of the active layer, on paper.
    fn exported(&self) -> Option<(Arc<Scene>, View, Style)> {
        let style = Style {
            background: self.look.paper(),
            ..self.look.style()
        };
        let scene = self.document()?.scene().clone();
        Some((Arc::new(scene), self.camera.view()?, style))
    }
}

/// The same part of the world in another size.
fn enlarged(view: &View, width_px: u32) -> Result<View, RenderError> {
    let factor = f64::from(width_px) / f64::from(view.size().width());
    let height_px = (f64::from(view.size().height()) * factor).round().max(1.0);
    let size = FrameSize::new(width_px, height_px as u32)?;
    View::new(size, view.center_m(), view.px_per_m() * factor)
}

#[cfg(test)]
mod tests {
    use guideway_spline::Point;

    use super::*;

    #[test]
    fn a_larger_picture_shows_the_same_part_of_the_world() {
        let size = FrameSize::new(400, 300).unwrap();
        let view = View::new(size, Point::new(5.0, 6.0), 20.0).unwrap();
        let large = enlarged(&view, 40_000).unwrap();
        assert_eq!(
            (large.size().width(), large.size().height()),
            (40_000, 30_000)
        );
        assert_eq!(large.world_bounds(), view.world_bounds());
        let tall = FrameSize::new(100, 300).unwrap();
        let tall = View::new(tall, Point::new(5.0, 6.0), 20.0).unwrap();
        let too_tall = enlarged(&tall, 65_535).unwrap_err().to_string();
        assert!(
            too_tall.contains("each side takes 1 to 65535"),
            "{too_tall}"
        );
    }
}
