//! A fake method with given frame times and capacity.

use std::sync::Arc;

use guideway_scene::{
    Budget, Cancel, Frame, Method, MethodInfo, Preparation, Prepared, RenderError, Report, Scene,
    Stage, Style, View, Work,
};

/// A method that reports frames of `a_ms` plus `b_ms` per path.
#[derive(Clone, Copy)]
pub(crate) struct Fake {
    pub(crate) device: &'static str,
    pub(crate) a_ms: f64,
    pub(crate) b_ms: f64,
    /// Most paths that it accepts.
    pub(crate) capacity: usize,
}

pub(crate) const FAKE: Fake = Fake {
    device: "a made-up device",
    a_ms: 1.0,
    b_ms: 0.01,
    capacity: usize::MAX,
};

impl Method for Fake {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "fake",
            summary: "",
            device: self.device.to_owned(),
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let paths = scene.draw_order().len();
        if paths > self.capacity {
            return Err(RenderError::Budget {
                method: "fake",
                what: "paths",
                needed_bytes: budget.memory_bytes + 1,
                budget_bytes: budget.memory_bytes,
            });
        }
        let stages = ["sample", "count", "prefix sum", "bin"];
        Ok(Box::new(PreparedFake {
            fake: *self,
            paths,
            preparation: Preparation {
                stages: stages
                    .map(|name| Stage::device(name, paths as f64 * 1e-3))
                    .to_vec(),
                held_bytes: paths as u64 * 100,
                peak_bytes: paths as u64 * 200,
                work: Work::default(),
            },
        }))
    }
}

struct PreparedFake {
    fake: Fake,
    paths: usize,
    preparation: Preparation,
}

impl Prepared for PreparedFake {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        cancel.check()?;
        frame.resize(view.size());
        let background = style.background;
        frame
            .pixels_mut()
            .fill([background.r, background.g, background.b, 255]);
        frame.pixels_mut()[0] = [0, 0, 0, 255];
        Ok(Report {
            method: "fake",
            total: self.paths as u64,
            drawn: self.paths as u64,
            stages: vec![
                Stage::device("cull", self.fake.a_ms),
                Stage::device("tessellate and draw", self.fake.b_ms * self.paths as f64),
                Stage::host(Stage::READ_BACK, 1e6),
            ],
            lines: self.paths as u64 * 80,
            bands: 1,
            ..Report::default()
        })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }

    fn count_work(&mut self, _: &View, _: &Style, _: &Cancel) -> Result<Work, RenderError> {
        Ok(Work {
            tests: Some(self.paths as u64),
            ..Work::default()
        })
    }
}
