//! Pictures that are drawn beside the window and laid under those of the layouts.

use eframe::egui::{ColorImage, Context, TextureHandle, TextureOptions};
use guideway_scene::{Frame, View};

use super::Wake;
use super::renderer::color_image;
use super::task::Task;
use guideway_layout::UserError;

/// The last picture of something, and the next one. `K` is what a picture is of, beside its view.
pub(crate) struct Beside<K> {
    /// The last one, and what it shows.
    pub(crate) picture: Option<(TextureHandle, View)>,
    /// Why there is none.
    pub(crate) trouble: Option<String>,
    task: Option<Task<Result<ColorImage, UserError>>>,
    /// What the task, or else the picture, is of.
    asked: Option<(K, View)>,
}

impl<K> Default for Beside<K> {
    fn default() -> Self {
        Self {
            picture: None,
            trouble: None,
            task: None,
            asked: None,
        }
    }
}

impl<K: PartialEq> Beside<K> {
    /// The last picture, and what it shows.
    pub(crate) fn shown(&self) -> Option<(&TextureHandle, &View)> {
        self.picture.as_ref().map(|(texture, view)| (texture, view))
    }

    /// Shows nothing any more.
    pub(crate) fn clear(&mut self) {
        (self.picture, self.asked, self.trouble) = (None, None, None);
    }

    /// Whether a picture is to be asked for: it is neither there nor on its way, and no other is being drawn.
    pub(crate) fn needs(&self, of: &K, view: &View) -> bool {
        let is_asked = |(k, v): &(K, View)| k == of && v == view;
        self.task.is_none() && !self.asked.as_ref().is_some_and(is_asked)
    }

    /// Shows a message in place of a picture.
    pub(crate) fn fail(&mut self, why: String) {
        (self.picture, self.asked, self.trouble) = (None, None, Some(why));
    }

    /// There is no picture of this, and why.
    pub(crate) fn refuse(&mut self, of: K, view: View, why: String) {
        (self.picture, self.asked, self.trouble) = (None, Some((of, view)), Some(why));
    }

    /// Has one drawn.
    pub(crate) fn ask(
        &mut self,
        of: K,
        view: View,
        wake: &Wake,
        draw: impl FnOnce() -> Result<Frame, UserError> + Send + 'static,
    ) {
        self.asked = Some((of, view));
        self.task = Some(Task::start(wake, move || Ok(color_image(&draw()?))));
    }

    /// Takes one that was drawn.
    pub(crate) fn poll(&mut self, ctx: &Context, name: &str) {
        let Some(drawn) = self.task.as_ref().and_then(Task::outcome) else {
            return;
        };
        self.task = None;
        match (drawn.flatten(), &self.asked) {
            (Ok(image), Some((_, view))) => {
                let texture = ctx.load_texture(name, image, TextureOptions::LINEAR);
                self.picture = Some((texture, *view));
                self.trouble = None;
            }
            (Ok(_), None) => {}
            (Err(trouble), _) => {
                self.picture = None;
                self.trouble = Some(trouble.to_string());
            }
        }
    }
}
