//! A picture below the layouts (floor plan, swept areas), rendered by a background task.

use eframe::egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use guideway_layout::UserError;
use guideway_scene::{Frame, View};

use crate::background::{BackgroundTask, RepaintHandle};

/// The last picture and the next one. `K` identifies the content of a picture, beside its view.
pub(crate) struct BackgroundPicture<K> {
    shown: Option<(TextureHandle, View)>,
    /// Why there is no picture.
    error: Option<String>,
    task: Option<BackgroundTask<Result<ColorImage, UserError>>>,
    /// Content and view of the task in progress, or else of the picture or error.
    requested: Option<(K, View)>,
}

impl<K> Default for BackgroundPicture<K> {
    fn default() -> Self {
        Self {
            shown: None,
            error: None,
            task: None,
            requested: None,
        }
    }
}

impl<K: PartialEq> BackgroundPicture<K> {
    /// The last picture and its view.
    pub(crate) fn shown(&self) -> Option<(&TextureHandle, &View)> {
        self.shown.as_ref().map(|(texture, view)| (texture, view))
    }

    /// Why there is no picture.
    pub(crate) fn error(&self) -> Option<&str> {
        self.error.as_deref()
    }

    /// Drops picture and error.
    pub(crate) fn clear(&mut self) {
        (self.shown, self.requested, self.error) = (None, None, None);
    }

    /// Returns `true` if to start a task: none is in progress, and the last one had other content
    /// or view.
    pub(crate) fn needs(&self, content: &K, view: &View) -> bool {
        let is_requested = |(k, v): &(K, View)| k == content && v == view;
        self.task.is_none() && !self.requested.as_ref().is_some_and(is_requested)
    }

    /// Shows an error in place of a picture; `content` is `None` if it is invalid.
    pub(crate) fn fail(&mut self, content: Option<K>, view: View, error: String) {
        let requested = content.map(|content| (content, view));
        (self.shown, self.requested, self.error) = (None, requested, Some(error));
    }

    /// Starts to render the content.
    pub(crate) fn start(
        &mut self,
        content: K,
        view: View,
        repaint: &RepaintHandle,
        render: impl FnOnce() -> Result<Frame, UserError> + Send + 'static,
    ) {
        self.requested = Some((content, view));
        let task = BackgroundTask::start(repaint, move || Ok(color_image(&render()?)));
        self.task = Some(task);
    }

    /// Takes the result of a finished task.
    pub(crate) fn poll(&mut self, ctx: &Context, name: &str) {
        let Some(result) = self.task.as_ref().and_then(BackgroundTask::result) else {
            return;
        };
        self.task = None;
        match (result.flatten(), &self.requested) {
            (Ok(image), Some((_, view))) => {
                let texture = ctx.load_texture(name, image, TextureOptions::LINEAR);
                self.shown = Some((texture, *view));
                self.error = None;
            }
            (Ok(_), None) => {}
            (Err(error), _) => {
                self.shown = None;
                self.error = Some(error.to_string());
            }
        }
    }
}

/// Converts straight alpha (frame) into premultiplied alpha (egui).
pub(crate) fn color_image(frame: &Frame) -> ColorImage {
    let color = |&[r, g, b, a]: &[u8; 4]| Color32::from_rgba_unmultiplied(r, g, b, a);
    let size = [frame.size().width(), frame.size().height()];
    let pixels = frame.pixels().iter().map(color).collect();
    ColorImage::new(size.map(|side| side as usize), pixels)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;
    use std::thread;
    use std::time::Duration;

    use guideway_scene::FrameSize;
    use guideway_spline::Point;

    use super::*;

    #[test]
    fn renders_each_content_once() {
        let size = FrameSize::new(4, 3).unwrap();
        let view = View::new(size, Point::new(0.0, 0.0), 1.0).unwrap();
        let mut picture = BackgroundPicture::default();
        assert!(picture.needs(&1, &view));
        let repaint: RepaintHandle = Arc::new(|| {});
        picture.start(1, view, &repaint, move || Ok(Frame::new(size)));
        assert!(!picture.needs(&2, &view), "a task is in progress");
        let ctx = Context::default();
        for _ in 0..5_000 {
            picture.poll(&ctx, "test");
            if picture.shown().is_some() {
                break;
            }
            thread::sleep(Duration::from_millis(1));
        }
        assert_eq!(picture.shown().map(|(_, of)| *of), Some(view));
        assert!(!picture.needs(&1, &view) && picture.needs(&2, &view));
        picture.fail(Some(2), view, "too many paths".into());
        assert!(picture.shown().is_none() && !picture.needs(&2, &view));
        assert_eq!(picture.error(), Some("too many paths"));
    }
}
