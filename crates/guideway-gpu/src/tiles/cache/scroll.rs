//! Scrolls a cached picture: copies its pixels, moved, into a second buffer, and swaps the two.

use guideway_scene::{RenderError, Stage};
use wgpu::BufferUsages;

use crate::device::{DeviceBuffer, Dispatch, Kernel};
use crate::tiles::constants::CLUSTER_THREADS;
use crate::tiles::device_context::{DeviceContext, device_error};
use crate::tiles::frame::dispatch_plan::DispatchPlan;
use crate::tiles::frame::tile_buffers::TileBuffers;
use crate::tiles::layouts::ScrollParams;

/// The second pixel buffer and what belongs to it.
pub(crate) struct Scroller {
    params: DeviceBuffer,
    pixels: DeviceBuffer,
    /// The plan of frames whose pixel buffer is the second one.
    pub(crate) plan: Option<DispatchPlan>,
}

/// Scrolls the picture. Returns its stages; `None` if the budget has no room for a second buffer.
pub(crate) fn scroll(
    device: &mut DeviceContext,
    kernel: &Kernel,
    tiles: &mut TileBuffers,
    plan: &mut Option<DispatchPlan>,
    scroller: &mut Option<Scroller>,
    by: &ScrollParams,
) -> Result<Option<Vec<Stage>>, RenderError> {
    let scroller = match scroller {
        Some(scroller) => scroller,
        None if tiles.pixels.bytes() > device.memory.spare_bytes() => return Ok(None),
        none => {
            let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
            let bytes = size_of::<ScrollParams>() as u64;
            none.insert(Scroller {
                params: device.memory.zeros("the view", bytes, usage)?,
                pixels: tiles.create_pixels(&mut device.memory)?,
                plan: None,
            })
        }
    };
    std::mem::swap(&mut tiles.pixels, &mut scroller.pixels);
    std::mem::swap(plan, &mut scroller.plan);
    let runner = &device.runner;
    let run = || {
        runner.write("the view", &scroller.params, by)?;
        let buffers = [&scroller.params, &scroller.pixels, &tiles.pixels];
        let bindings = kernel.bind(&device.gpu, &buffers)?;
        let dispatch = Dispatch {
            kernel,
            bindings: &bindings,
            workgroups: (tiles.size.pixels() as u32).div_ceil(CLUSTER_THREADS),
        };
        runner.run_stages("the frame", &[], &[("scroll", &[dispatch])])
    };
    run().map(Some).map_err(device_error)
}
