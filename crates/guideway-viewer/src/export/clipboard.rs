//! Renders the canvas for the clipboard.

use std::sync::Arc;

use eframe::egui::{ColorImage, Context};
use guideway_layout::UserError;

use crate::background::{BackgroundTask, RepaintHandle};
use crate::render_queue::color_image;
use crate::services::{AppServices, PictureRequest};

/// The picture being rendered for the clipboard, if any.
#[derive(Default)]
pub(crate) struct Clipboard {
    task: Option<BackgroundTask<Result<ColorImage, UserError>>>,
}

impl Clipboard {
    /// Starts to render a picture.
    pub(crate) fn copy(
        &mut self,
        picture: PictureRequest,
        method: String,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) {
        let services = Arc::clone(services);
        let render = move || Ok(color_image(&services.render(&picture, &method)?));
        self.task = Some(BackgroundTask::start(repaint, render));
    }

    /// Copies a finished picture. Returns a notice for the user.
    pub(crate) fn poll(&mut self, ctx: &Context) -> Option<String> {
        let result = self.task.as_ref().and_then(BackgroundTask::result)?;
        self.task = None;
        Some(match result.flatten() {
            Ok(image) => {
                ctx.copy_image(image);
                "The picture was copied to the clipboard".to_owned()
            }
            Err(error) => error.to_string(),
        })
    }
}
