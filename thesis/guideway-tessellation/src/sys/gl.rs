use std::ffi::c_void;
use std::rc::Rc;
use std::time::Duration;

use glow::HasContext;

use super::egl::{Context, Platform};
use super::{Buffer, Program, Vertices};

type MultiDrawElementsIndirectCount =
    unsafe extern "system" fn(u32, u32, *const c_void, isize, i32, i32);
type GetQuery = unsafe extern "system" fn(u32, u32, *mut i32);
type GetResetStatus = unsafe extern "system" fn() -> u32;

/// What a device can do at most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Limits {
    /// Bytes of one buffer that a shader reads or writes.
    pub(crate) buffer_bytes: u64,
    /// Workgroups of one dispatch.
    pub(crate) workgroups: u32,
    /// Side of a picture, in pixels.
    pub(crate) picture_side: u32,
    /// Samples a pixel.
    pub(crate) samples: u32,
    /// Allocations before the device is out of memory, to test what happens then.
    #[cfg(test)]
    pub(crate) allocations: u32,
}

/// A context of its own with what it can do; see the module for its rules.
pub(crate) struct Gl {
    pub(super) raw: glow::Context,
    multi_draw: MultiDrawElementsIndirectCount,
    get_query: GetQuery,
    reset_status: GetResetStatus,
    #[cfg(test)]
    allocations_left: std::cell::Cell<u32>,
    // The last to be dropped.
    #[cfg_attr(not(test), expect(dead_code, reason = "held for its drop"))]
    pub(super) context: Context,
}

impl Gl {
    /// Makes a context on this thread and checks that it has everything that the methods need.
    pub(crate) fn new(platform: Platform) -> Result<Rc<Self>, String> {
        let context = Context::new(platform)?;
        // SAFETY: the context is current, and `Context` gives addresses of OpenGL functions.
        let raw = unsafe { glow::Context::from_loader_function(|name| context.address(name)) };
        let has_count = raw.version().minor >= 6;
        if !has_count
            && !raw
                .supported_extensions()
                .contains("GL_ARB_indirect_parameters")
        {
            return Err("it has no GL_ARB_indirect_parameters".to_owned());
        }
        // SAFETY: the types are the functions' own, as the OpenGL registry gives them.
        let gl = unsafe {
            Self {
                multi_draw: context.function(if has_count {
                    "glMultiDrawElementsIndirectCount"
                } else {
                    "glMultiDrawElementsIndirectCountARB"
                })?,
                get_query: context.function("glGetQueryiv")?,
                reset_status: context.function("glGetGraphicsResetStatus")?,
                raw,
                #[cfg(test)]
                allocations_left: std::cell::Cell::new(u32::MAX),
                context,
            }
        };
        if gl.query_bits(glow::TIMESTAMP) == 0 {
            return Err("it has no timer queries".to_owned());
        }
        if gl.integer(glow::MAX_VERTEX_SHADER_STORAGE_BLOCKS) < 2 {
            return Err("its vertex shaders read no storage buffers".to_owned());
        }
        Ok(Rc::new(gl))
    }

    /// What the device and its OpenGL are called.
    pub(crate) fn description(&self) -> String {
        let text = |name| unsafe { self.raw.get_parameter_string(name) };
        format!("{}, OpenGL {}", text(glow::RENDERER), text(glow::VERSION))
    }

    /// Whether the processor does the work of a graphics device.
    pub(crate) fn is_software(&self) -> bool {
        let renderer = unsafe { self.raw.get_parameter_string(glow::RENDERER) };
        ["llvmpipe", "softpipe", "swrast", "SwiftShader"]
            .iter()
            .any(|software| renderer.contains(software))
    }

    /// What the device can do at most.
    pub(crate) fn limits(&self) -> Limits {
        let block_bytes = unsafe {
            self.raw
                .get_parameter_i64(glow::MAX_SHADER_STORAGE_BLOCK_SIZE)
        };
        let groups = unsafe {
            self.raw
                .get_parameter_indexed_i32(glow::MAX_COMPUTE_WORK_GROUP_COUNT, 0)
        };
        let mut viewport = [0; 2];
        unsafe {
            self.raw
                .get_parameter_i32_slice(glow::MAX_VIEWPORT_DIMS, &mut viewport);
        }
        let side = self.integer(glow::MAX_RENDERBUFFER_SIZE);
        Limits {
            // Sizes and offsets are signed 32-bit numbers here.
            buffer_bytes: block_bytes.clamp(0, i64::from(i32::MAX)) as u64,
            workgroups: groups.max(0) as u32,
            picture_side: side.min(viewport[0]).min(viewport[1]).max(0) as u32,
            samples: self.integer(glow::MAX_SAMPLES).max(0) as u32,
            #[cfg(test)]
            allocations: u32::MAX,
        }
    }

    fn integer(&self, name: u32) -> i32 {
        unsafe { self.raw.get_parameter_i32(name) }
    }

    fn query_bits(&self, target: u32) -> i32 {
        let mut bits = 0;
        // SAFETY: the query writes one number.
        unsafe { (self.get_query)(target, glow::QUERY_COUNTER_BITS, &raw mut bits) };
        bits
    }

    /// Fails when anything went wrong since the last call; `doing` says what was being done.
    pub(crate) fn check(&self, doing: &str) -> Result<(), String> {
        // SAFETY: the function takes nothing.
        let status = unsafe { (self.reset_status)() };
        if status != glow::NO_ERROR {
            return Err(format!(
                "the device was reset at {doing}; prepare the scene again"
            ));
        }
        match unsafe { self.raw.get_error() } {
            glow::NO_ERROR => Ok(()),
            glow::OUT_OF_MEMORY => Err(format!(
                "no memory left at {doing}; ask for a smaller picture or fewer paths, or close what else \
                 uses the device"
            )),
            glow::CONTEXT_LOST => Err(format!(
                "the device was lost at {doing}; prepare the scene again"
            )),
            code => Err(format!(
                "OpenGL error {code:#06x} at {doing}; update its driver, or report this"
            )),
        }
    }

    /// Lets so many allocations succeed.
    #[cfg(test)]
    pub(crate) fn allow_allocations(&self, count: u32) {
        self.allocations_left.set(count);
    }

    /// As [`Self::check`], after an allocation.
    pub(super) fn check_allocation(&self, what: &str, bytes: u64) -> Result<(), String> {
        #[cfg(test)]
        {
            let left = self.allocations_left.get();
            if left == 0 {
                return Err(format!("no memory left at {what}, as the test asks"));
            }
            self.allocations_left.set(left - 1);
        }
        self.check(&format!("the {bytes} bytes of {what}"))
    }

    /// Runs a compute program.
    pub(crate) fn dispatch(&self, program: &Program, groups: u32) {
        program.bind();
        unsafe { self.raw.dispatch_compute(groups, 1, 1) };
    }

    /// Makes what shaders wrote visible to draws, to shaders and to the host.
    pub(crate) fn barrier(&self) {
        let visible = glow::COMMAND_BARRIER_BIT
            | glow::SHADER_STORAGE_BARRIER_BIT
            | glow::BUFFER_UPDATE_BARRIER_BIT;
        unsafe { self.raw.memory_barrier(visible) };
    }

    /// Makes patches of so many vertices from now on.
    pub(crate) fn patches_of(&self, vertices: u32) {
        unsafe {
            self.raw
                .patch_parameter_i32(glow::PATCH_VERTICES, vertices as i32);
        }
    }

    /// Draws patches by as many of the packed indexed commands in `commands` as the number at the start of
    /// `count` says, at most `most`.
    pub(crate) fn draw_commands(
        &self,
        program: &Program,
        vertices: &Vertices,
        commands: &Buffer,
        count: &Buffer,
        most: u32,
    ) {
        program.bind();
        vertices.bind();
        commands.bind(glow::DRAW_INDIRECT_BUFFER);
        count.bind(glow::PARAMETER_BUFFER);
        // SAFETY: the commands are read from the buffer bound for them, from its start, packed; the count
        // from the other. There are at most `most` of them, as the caller planned.
        unsafe {
            (self.multi_draw)(
                glow::PATCHES,
                glow::UNSIGNED_INT,
                std::ptr::null(),
                0,
                most as i32,
                0,
            );
        }
    }

    /// Draws patches by the unindexed command at `offset_bytes` in `command`.
    pub(crate) fn draw_command(
        &self,
        program: &Program,
        vertices: &Vertices,
        command: &Buffer,
        offset_bytes: usize,
    ) {
        program.bind();
        vertices.bind();
        command.bind(glow::DRAW_INDIRECT_BUFFER);
        unsafe {
            self.raw
                .draw_arrays_indirect_offset(glow::PATCHES, offset_bytes as i32);
        }
    }

    /// Waits until all work is done, or for as long as it `is_wanted`.
    pub(crate) fn finish(&self, mut is_wanted: impl FnMut() -> bool) -> Result<(), String> {
        /// How often that is asked.
        const STEP: Duration = Duration::from_millis(10);
        let fence = unsafe { self.raw.fence_sync(glow::SYNC_GPU_COMMANDS_COMPLETE, 0) }?;
        let wait = || {
            let step_ns = STEP.as_nanos() as i32;
            unsafe {
                self.raw
                    .client_wait_sync(fence, glow::SYNC_FLUSH_COMMANDS_BIT, step_ns)
            }
        };
        let mut status = wait();
        while status == glow::TIMEOUT_EXPIRED && is_wanted() {
            status = wait();
        }
        unsafe { self.raw.delete_sync(fence) };
        match status {
            glow::WAIT_FAILED => Err("waiting for the device failed".to_owned()),
            _ => Ok(()),
        }
    }
}

/// Counts the primitives that draws make.
pub(crate) struct Primitives {
    gl: Rc<Gl>,
    query: glow::Query,
}

impl Primitives {
    /// A counter.
    pub(crate) fn new(gl: &Rc<Gl>) -> Result<Self, String> {
        let query = unsafe { gl.raw.create_query() }?;
        Ok(Self {
            gl: Rc::clone(gl),
            query,
        })
    }

    /// Counts what `draw` draws.
    pub(crate) fn during(&self, draw: impl FnOnce()) {
        unsafe {
            self.gl
                .raw
                .begin_query(glow::PRIMITIVES_GENERATED, self.query);
        }
        draw();
        unsafe { self.gl.raw.end_query(glow::PRIMITIVES_GENERATED) };
    }

    /// What was counted; waits for it.
    pub(crate) fn count(&self) -> u64 {
        unsafe {
            self.gl
                .raw
                .get_query_parameter_u64(self.query, glow::QUERY_RESULT)
        }
    }
}

impl Drop for Primitives {
    fn drop(&mut self) {
        unsafe { self.gl.raw.delete_query(self.query) };
    }
}
