//! Method `tessellation` (thesis 4.2).
//!
//! A path is patches of four control points, one a cubic segment. For every frame a compute pre-pass tests
//! the box of each path against the view and appends what to draw; the tessellator turns the patches that
//! are drawn into as many lines as they are pixels long.

mod background;
mod camera;
mod chunk;
mod plan;
mod programs;
mod renderer;
mod shared;
#[cfg(test)]
mod tests;
mod tiles;
mod work;

use std::sync::Arc;

use guideway_scene::Scene;
use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, Method, MethodInfo, Preparation, Prepared, RenderError,
    Report, Style, View, Work,
};

use crate::device::GlDevice;
use crate::options::{Commands, TessellationOptions};
use crate::sys::Limits;
use crate::worker::Worker;
use renderer::{Renderer, Start};

/// Draws lines one pixel wide in one color, by the tessellation stages of OpenGL.
#[derive(Clone, Debug)]
pub struct Tessellation {
    device: Arc<GlDevice>,
    limits: Limits,
    options: TessellationOptions,
}

impl Tessellation {
    /// The method on this device. It is called `tessellation`, or `tessellation-compact` when it draws all
    /// patches by one command.
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
                    "hardware tessellation of thesis 4.2, one indirect command a path; 1 px lines, one color"
                }
                Commands::Compact => {
                    "hardware tessellation of thesis 4.2, one draw of all visible patches; 1 px lines, one color"
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
        let start = Start {
            device: Arc::clone(&self.device),
            method,
            options: self.options,
            limits: self.limits,
            budget: *budget,
            scene,
        };
        let (worker, preparation) =
            Worker::start(move || Renderer::new(start)).ok_or_else(|| gone(method))??;
        Ok(Box::new(PreparedTessellation {
            method,
            worker,
            preparation,
        }))
    }
}

/// A renderer, and the thread that it lives on.
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
        // The frame goes there and comes back, for that thread cannot borrow it.
        let mut lent = std::mem::replace(frame, Frame::new(FrameSize::new(1, 1)?));
        let (view, style, cancel) = (*view, *style, cancel.clone());
        let work = move |renderer: &mut Renderer| {
            let report = renderer.render(&view, &style, &cancel, &mut lent);
            (report, lent)
        };
        let (report, lent) = self.worker.call(work).ok_or_else(|| gone(self.method))?;
        *frame = lent;
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
        self.worker.call(work).ok_or_else(|| gone(self.method))?
    }
}

fn gone(method: &'static str) -> RenderError {
    RenderError::Device {
        method,
        what: "its thread ended; prepare the scene again, and report this".to_owned(),
    }
}
