//! The picture of one open file: its render thread, and the last picture as a texture.

use std::sync::Arc;
use std::sync::mpsc::TryRecvError;

use eframe::egui::{Context, TextureHandle, TextureId, TextureOptions};
use guideway_scene::{Coloring, Gesture, Report, Scene, View};
use guideway_spline::Affine;

use super::method_selection::FALLBACK_METHOD;
use super::queue::RenderQueue;
use super::renderer::Renderer;
use super::request::RenderRequest;
use super::window_device::{DeviceTexture, WindowDevice};
use super::worker::{Picture, Pixels, RenderEvent};
use crate::background::RepaintHandle;
use crate::language::say;
use crate::services::AppServices;

/// Renders one file and holds its last picture.
pub(crate) struct LayerPicture {
    renderer: Renderer,
    device: WindowDevice,
    shown: Option<ShownPicture>,
    requested: Option<RenderRequest>,
    gesture: Option<Gesture>,
}

/// A picture as a texture.
pub(crate) struct ShownPicture {
    texture: ShownTexture,
    /// Number of this picture among those of the file, from 1.
    pub(crate) number: u64,
    pub(crate) view: View,
    pub(crate) report: Report,
    /// Milliseconds from the start of the request to the finished picture.
    pub(crate) wall_ms: f64,
}

/// Pixels that the window uploaded, or a texture that the method drew on the window's device.
enum ShownTexture {
    Uploaded(TextureHandle),
    OnDevice(DeviceTexture),
}

impl ShownPicture {
    /// Name of the texture for the painter.
    pub(crate) fn texture_id(&self) -> TextureId {
        match &self.texture {
            ShownTexture::Uploaded(texture) => texture.id(),
            ShownTexture::OnDevice(texture) => texture.id(),
        }
    }
}

/// A change of the picture that concerns the open file.
pub(crate) enum PictureEvent {
    /// A new picture is shown.
    Shown { is_first: bool },
    /// The render thread needs the current scene.
    NeedsScene,
    /// The fallback method replaced the selected one; the reason as a sentence.
    FellBack(String),
    /// The last request has no picture; the reason.
    Failed(String),
    /// The first picture is a crowd of paths, whose density says more than their colors.
    Crowded,
}

impl LayerPicture {
    /// The last request.
    #[cfg(test)]
    pub(crate) fn requested(&self) -> Option<&RenderRequest> {
        self.requested.as_ref()
    }

    /// Starts a render thread, which waits for a scene.
    pub(crate) fn start(
        services: &Arc<dyn AppServices>,
        method: &str,
        repaint: &RepaintHandle,
        device: &WindowDevice,
    ) -> Self {
        let (services, repaint) = (Arc::clone(services), Arc::clone(repaint));
        Self {
            renderer: Renderer::start(services, method, repaint, device.clone()),
            device: device.clone(),
            shown: None,
            requested: None,
            gesture: None,
        }
    }

    /// The last picture.
    pub(crate) fn shown(&self) -> Option<&ShownPicture> {
        self.shown.as_ref()
    }

    /// A queue that accepts edits from any thread.
    pub(crate) fn queue(&self) -> RenderQueue {
        self.renderer.queue()
    }

    /// Replaces the scene.
    pub(crate) fn set_scene(&self, scene: Arc<Scene>) {
        self.renderer.set_scene(scene);
    }

    /// Gives the scene other colors.
    pub(crate) fn recolor(&self, coloring: Arc<Coloring>) {
        self.renderer.recolor(coloring);
    }

    /// Replaces the render method.
    pub(crate) fn set_method(&self, name: &str) {
        self.renderer.set_method(name);
    }

    /// Shows paths by a map, until [`Self::end_gesture`]. `paths` gives them at the beginning.
    pub(crate) fn show_gesture(&mut self, by: Affine, paths: impl FnOnce() -> Arc<[u32]>) {
        let shown = self.gesture.take();
        if shown.as_ref().is_none_or(|shown| shown.by != by) {
            let paths = shown.map_or_else(paths, |shown| shown.paths);
            let gesture = Gesture { paths, by };
            self.renderer.show_gesture(Some(gesture.clone()));
            self.gesture = Some(gesture);
        } else {
            self.gesture = shown;
        }
    }

    /// Shows the scene without a gesture.
    pub(crate) fn end_gesture(&mut self) {
        if self.gesture.take().is_some() {
            self.renderer.show_gesture(None);
        }
    }

    /// Requests a picture, unless the same one was requested last.
    pub(crate) fn request(&mut self, request: RenderRequest) {
        if self.requested != Some(request) {
            self.renderer.request(request);
            self.requested = Some(request);
        }
    }

    /// Returns `true` if the last request is on screen and no other is in progress.
    pub(crate) fn is_settled(&self) -> bool {
        let is_shown = |request: &RenderRequest| {
            let shown = self.shown.as_ref();
            shown.is_some_and(|shown| shown.view == request.view)
        };
        self.requested.as_ref().is_none_or(is_shown) && !self.renderer.is_busy()
    }

    /// Takes finished pictures; `name` gives the name of the file, for the texture and for notices.
    pub(crate) fn poll(
        &mut self,
        ctx: &Context,
        name: impl Fn() -> String,
        services: &Arc<dyn AppServices>,
        repaint: &RepaintHandle,
    ) -> Vec<PictureEvent> {
        let mut events = Vec::new();
        loop {
            match self.renderer.try_event() {
                Ok(RenderEvent::Picture(picture)) => {
                    let is_first = self.shown.is_none();
                    self.show(ctx, &name, *picture);
                    events.push(PictureEvent::Shown { is_first });
                }
                Ok(RenderEvent::NeedsScene) => events.push(PictureEvent::NeedsScene),
                Ok(RenderEvent::FellBack(why)) => events.push(PictureEvent::FellBack(why)),
                Ok(RenderEvent::Failed(why)) => events.push(PictureEvent::Failed(why)),
                Ok(RenderEvent::Crowded) => events.push(PictureEvent::Crowded),
                Err(TryRecvError::Empty) => return events,
                Err(TryRecvError::Disconnected) => {
                    events.push(PictureEvent::FellBack(say!(
                        "an internal error stopped rendering {name}. Switched to `{other}`",
                        name = name(),
                        other = FALLBACK_METHOD
                    )));
                    let (services, repaint) = (Arc::clone(services), Arc::clone(repaint));
                    let device = self.device.clone();
                    self.renderer
                        .restart(services, FALLBACK_METHOD, repaint, device);
                    events.push(PictureEvent::NeedsScene);
                    return events;
                }
            }
        }
    }

    fn show(&mut self, ctx: &Context, name: impl Fn() -> String, picture: Picture) {
        let options = TextureOptions::LINEAR;
        let number = self.shown.as_ref().map_or(0, |shown| shown.number) + 1;
        let earlier = self.shown.take().map(|shown| shown.texture);
        let texture = match (picture.pixels, earlier) {
            (Pixels::InMemory(image), Some(ShownTexture::Uploaded(mut texture))) => {
                texture.set(image, options);
                ShownTexture::Uploaded(texture)
            }
            (Pixels::InMemory(image), _) => {
                ShownTexture::Uploaded(ctx.load_texture(name(), image, options))
            }
            (Pixels::OnDevice(picture), _) => match self.device.register(picture) {
                Some(texture) => ShownTexture::OnDevice(texture),
                None => return,
            },
        };
        self.shown = Some(ShownPicture {
            texture,
            number,
            view: picture.request.view,
            report: picture.report,
            wall_ms: picture.wall_ms,
        });
    }
}
