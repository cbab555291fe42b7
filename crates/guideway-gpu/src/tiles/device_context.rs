//! The device as the stages of a frame use it: memory account, submissions, counters.

use std::sync::Arc;

use guideway_scene::{Budget, RenderError};

use super::layouts::FrameCounters;
use super::options::NAME;
use crate::device::{
    DeviceBuffer, DeviceError, Gpu, Kernel, Memory, PatchTarget, Patcher, READBACK_USAGE, Runner,
};

/// Device handles of one prepared scene.
pub(crate) struct DeviceContext {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) memory: Memory,
    pub(crate) runner: Runner,
    counters_readback: DeviceBuffer,
    patch_kernel: Kernel,
}

impl DeviceContext {
    pub(crate) fn new(
        gpu: Arc<Gpu>,
        patch_kernel: Kernel,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let mut memory = Memory::new(Arc::clone(&gpu), NAME, budget);
        let runner = Runner::new(Arc::clone(&gpu), &mut memory)?;
        let bytes = size_of::<FrameCounters>() as u64;
        let counters_readback = memory.zeros("the counters", bytes, READBACK_USAGE)?;
        Ok(Self {
            gpu,
            memory,
            runner,
            counters_readback,
            patch_kernel,
        })
    }

    /// A patcher, created on first use, and a buffer as its target.
    pub(crate) fn patch<'a>(
        &'a mut self,
        patcher: &'a mut Option<Patcher>,
        buffer: &'a DeviceBuffer,
    ) -> Result<(&'a mut Patcher, PatchTarget<'a>), RenderError> {
        let patcher = match patcher {
            Some(patcher) => patcher,
            none => none.insert(Patcher::new(self.patch_kernel.clone(), &mut self.memory)?),
        };
        let target = PatchTarget {
            gpu: &self.gpu,
            memory: &mut self.memory,
            runner: &self.runner,
            buffer,
        };
        Ok((patcher, target))
    }

    /// Reads the counters of the last window back.
    pub(crate) fn fetch_counters(
        &self,
        buffer: &DeviceBuffer,
    ) -> Result<FrameCounters, RenderError> {
        let mut counters = FrameCounters::default();
        let fetched = self.runner.fetch(
            "the counters",
            buffer,
            &self.counters_readback,
            size_of::<FrameCounters>() as u64,
            |bytes| bytemuck::bytes_of_mut(&mut counters).copy_from_slice(bytes),
        );
        fetched.map_err(device_error)?;
        Ok(counters)
    }
}

/// Converts an error of the device to one of method `gpu`.
pub(crate) fn device_error(error: DeviceError) -> RenderError {
    error.of_method(NAME)
}
