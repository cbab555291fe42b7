//! Method `tessellation` (thesis 4.2): draws one patch of four control points per cubic segment.
//!
//! | stage | input | output | module |
//! |---|---|---|---|
//! | plan | scene, device limits | chunks of paths, buffer sizes | `plan` |
//! | upload | chunks | control points, path records, indices | `chunk` |
//! | tile | view, budget | tiles of the picture | `tiles` |
//! | cull | path bounds, view | draw commands of visible paths | `chunk`, `camera` |
//! | draw | visible patches | about one line per pixel of length | `chunk`, `programs` |
//! | read back | pixels | frame, report | `renderer`, `background`, `notes`, `work` |
//!
//! `shared` declares the data that Rust and GLSL exchange.

mod background;
mod camera;
mod chunk;
mod notes;
mod plan;
mod programs;
mod renderer;
mod shared;
#[cfg(test)]
mod tests;
mod tiles;
mod work;

use std::sync::Arc;

use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, MethodInfo, Preparation, Prepared, RenderError,
    Report, Scene, Style, View, Work,
};

use crate::device::GlDevice;
use crate::error::GlError;
use crate::options::{Commands, TessellationOptions};
use crate::sys::Limits;
use crate::worker::Worker;
use renderer::{Renderer, RendererConfig};

/// Draws lines 1 pixel wide in one color, with the tessellation stages of OpenGL.
#[derive(Clone, Debug)]
pub struct Tessellation {
    device: Arc<GlDevice>,
    limits: Limits,
    options: TessellationOptions,
}

impl Tessellation {
    /// The method on a device. Its name is `tessellation`, or `tessellation-compact` with a single
    /// draw command for all patches.
    pub fn new(device: Arc<GlDevice>, options: TessellationOptions) -> Self {
        Self {
            limits: device.limits,
            device,
            options,
        }
    }

    fn name(&self) -> &'static str {
        match self.options.commands {
            Commands::PerPath => "tessellation",
            Commands::Compact => "tessellation-compact",
        }
    }
}

impl Method for Tessellation {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: self.name(),
            summary: match self.options.commands {
                Commands::PerPath => {
                    "Thesis 4.2: hardware tessellation, one draw call per path; 1 px, one color"
                }
                Commands::Compact => {
                    "Thesis 4.2: hardware tessellation, a single draw call; 1 px, one color"
                }
            },
            device: self.device.description().to_owned(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let method = self.name();
        let config = RendererConfig {
            device: Arc::clone(&self.device),
            method,
            options: self.options,
            limits: self.limits,
            budget: *budget,
            scene,
        };
        let (worker, preparation) =
            Worker::start(move || Renderer::new(config)).ok_or_else(|| thread_ended(method))??;
        Ok(Box::new(PreparedTessellation {
            method,
            worker,
            preparation,
        }))
    }
}

/// A renderer on its own thread.
struct PreparedTessellation {
    method: &'static str,
    worker: Worker<Renderer>,
    preparation: Preparation,
}

impl Prepared for PreparedTessellation {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        // The thread cannot borrow the frame, so the frame moves there and back.
        let mut moved = std::mem::replace(frame, Frame::new(FrameSize::new(1, 1)?));
        let (view, style, cancel) = (*view, *style, cancel.clone());
        let work = move |renderer: &mut Renderer| {
            let report = renderer.render(&view, &style, &cancel, &mut moved);
            (report, moved)
        };
        let outcome = self.worker.call(work);
        let (report, moved) = outcome.ok_or_else(|| thread_ended(self.method))?;
        *frame = moved;
        report
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }

    fn count_work(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        let (view, style, cancel) = (*view, *style, cancel.clone());
        let work = move |renderer: &mut Renderer| renderer.count_work(&view, &style, &cancel);
        let outcome = self.worker.call(work);
        outcome.ok_or_else(|| thread_ended(self.method))?
    }
}

fn thread_ended(method: &'static str) -> RenderError {
    GlError::ThreadEnded.of_method(method)
}
