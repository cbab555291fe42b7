//! Renders the canvas for the clipboard.

use std::sync::Arc;

use eframe::egui::{ColorImage, Context};
use guideway_layout::UserError;

use crate::background::{BackgroundTask, RepaintHandle};
use crate::language::t;
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

    /// Copies a finished picture. Returns news for the user.
    ///
    /// # Errors
    /// When the picture cannot be rendered.
    pub(crate) fn poll(&mut self, ctx: &Context) -> Option<Result<String, UserError>> {
        let result = self.task.as_ref().and_then(BackgroundTask::result)?;
        self.task = None;
        Some(result.flatten().map(|image| {
            ctx.copy_image(image);
            t("The picture was copied to the clipboard").to_owned()
        }))
    }
}
