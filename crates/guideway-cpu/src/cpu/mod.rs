use std::sync::Arc;

use guideway_render::{Budget, Method, MethodInfo, Prepared, RenderError};
use guideway_scene::Scene;

/// (being written)
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

impl Method for Cpu {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "cpu",
            summary: "",
            device: String::new(),
        }
    }
    fn plan_bytes(&self, _scene: &Scene, _budget: &Budget) -> u64 {
        0
    }
    fn prepare(
        &self,
        _scene: Arc<Scene>,
        _budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        Err(RenderError::Cancelled)
    }
}
