//! An OpenGL context with its functions, limits and error checks.
//!
//! Input: a platform. Output: a context that has every feature that the method needs.

use std::ffi::c_void;
use std::rc::Rc;
use std::time::Duration;

use glow::HasContext;

use super::egl::{Context, Platform};
use crate::error::GlError;

type MultiDrawElementsIndirectCount =
    unsafe extern "system" fn(u32, u32, *const c_void, isize, i32, i32);
type GetQuery = unsafe extern "system" fn(u32, u32, *mut i32);
type GetResetStatus = unsafe extern "system" fn() -> u32;

/// Limits of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Limits {
    /// Most bytes of a buffer that a shader reads or writes.
    pub(crate) buffer_bytes: u64,
    /// Most workgroups per dispatch.
    pub(crate) workgroups: u32,
    /// Longest side of a picture, in pixels.
    pub(crate) picture_side: u32,
    /// Most samples per pixel.
    pub(crate) samples: u32,
    /// Allocations that succeed before the device reports that it is out of memory.
    #[cfg(test)]
    pub(crate) allocations: u32,
}

/// A current OpenGL context and its extension functions; `sys` lists the safety rules.
pub(crate) struct Gl {
    pub(super) raw: glow::Context,
    pub(super) multi_draw: MultiDrawElementsIndirectCount,
    get_query: GetQuery,
    reset_status: GetResetStatus,
    #[cfg(test)]
    allocations_left: std::cell::Cell<u32>,
    // The last field, so that it is dropped last.
    #[cfg_attr(not(test), expect(dead_code, reason = "held for its drop"))]
    pub(super) context: Context,
}

impl Gl {
    /// Makes a context on this thread and checks that it has every feature of the method.
    ///
    /// # Errors
    /// When EGL fails, the thread already has a context, or the driver lacks a feature.
    pub(crate) fn new(platform: Platform) -> Result<Rc<Self>, GlError> {
        let context = Context::new(platform)?;
        // SAFETY: the context is current, and `Context` gives addresses of OpenGL functions.
        let raw = unsafe { glow::Context::from_loader_function(|name| context.address(name)) };
        let has_count = raw.version().minor >= 6;
        if !has_count
            && !raw
                .supported_extensions()
                .contains("GL_ARB_indirect_parameters")
        {
            return Err(missing("GL_ARB_indirect_parameters"));
        }
        // SAFETY: the types are those of the OpenGL registry.
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
            return Err(missing("timer queries"));
        }
        if gl.integer(glow::MAX_VERTEX_SHADER_STORAGE_BLOCKS) < 2 {
            return Err(missing("storage buffers in vertex shaders"));
        }
        Ok(Rc::new(gl))
    }

    /// Name of the device, and its OpenGL version.
    pub(crate) fn description(&self) -> String {
        // SAFETY: the context is current; the text of the driver lives as long as the context.
        let text = |name| unsafe { self.raw.get_parameter_string(name) };
        format!("{}, OpenGL {}", text(glow::RENDERER), text(glow::VERSION))
    }

    /// Returns `true` if the device is a software rasterizer.
    pub(crate) fn is_software(&self) -> bool {
        // SAFETY: the context is current; the text of the driver lives as long as the context.
        let renderer = unsafe { self.raw.get_parameter_string(glow::RENDERER) };
        ["llvmpipe", "softpipe", "swrast", "SwiftShader"]
            .iter()
            .any(|software| renderer.contains(software))
    }

    /// Queries the limits of the device.
    pub(crate) fn limits(&self) -> Limits {
        // SAFETY: the context is current, and the driver answers by value.
        let block_bytes = unsafe {
            self.raw
                .get_parameter_i64(glow::MAX_SHADER_STORAGE_BLOCK_SIZE)
        };
        // SAFETY: the context is current, and the driver answers by value.
        let groups = unsafe {
            self.raw
                .get_parameter_indexed_i32(glow::MAX_COMPUTE_WORK_GROUP_COUNT, 0)
        };
        let mut viewport = [0; 2];
        // SAFETY: the driver writes two numbers, as many as the slice has.
        unsafe {
            self.raw
                .get_parameter_i32_slice(glow::MAX_VIEWPORT_DIMS, &mut viewport);
        }
        let side = self.integer(glow::MAX_RENDERBUFFER_SIZE);
        Limits {
            // `glow` takes sizes and offsets as signed 32-bit numbers.
            buffer_bytes: block_bytes.clamp(0, i64::from(i32::MAX)) as u64,
            workgroups: groups.max(0) as u32,
            picture_side: side.min(viewport[0]).min(viewport[1]).max(0) as u32,
            samples: self.integer(glow::MAX_SAMPLES).max(0) as u32,
            #[cfg(test)]
            allocations: u32::MAX,
        }
    }

    fn integer(&self, name: u32) -> i32 {
        // SAFETY: the context is current, and the driver answers by value.
        unsafe { self.raw.get_parameter_i32(name) }
    }

    fn query_bits(&self, target: u32) -> i32 {
        let mut bits = 0;
        // SAFETY: the query writes one number.
        unsafe { (self.get_query)(target, glow::QUERY_COUNTER_BITS, &raw mut bits) };
        bits
    }

    /// Checks for errors since the last call; `operation` names the calls in the error.
    ///
    /// # Errors
    /// When the device was lost or is out of memory, or a call was wrong.
    pub(crate) fn check(&self, operation: &str) -> Result<(), GlError> {
        let operation = || operation.to_owned();
        // SAFETY: the function takes nothing.
        let status = unsafe { (self.reset_status)() };
        if status != glow::NO_ERROR {
            return Err(GlError::Reset {
                operation: operation(),
            });
        }
        // SAFETY: the context is current, and the driver answers by value.
        match unsafe { self.raw.get_error() } {
            glow::NO_ERROR => Ok(()),
            glow::OUT_OF_MEMORY => Err(GlError::OutOfMemory {
                operation: operation(),
            }),
            glow::CONTEXT_LOST => Err(GlError::Lost {
                operation: operation(),
            }),
            code => Err(GlError::Rejected {
                operation: operation(),
                code,
            }),
        }
    }

    /// Lets the next `count` allocations succeed and all later ones fail.
    #[cfg(test)]
    pub(crate) fn allow_allocations(&self, count: u32) {
        self.allocations_left.set(count);
    }

    /// Like [`Self::check`], after an allocation.
    pub(super) fn check_allocation(&self, what: &str, bytes: u64) -> Result<(), GlError> {
        let operation = format!("the allocation of {bytes} bytes for {what}");
        #[cfg(test)]
        {
            let left = self.allocations_left.get();
            if left == 0 {
                return Err(GlError::OutOfMemory { operation });
            }
            self.allocations_left.set(left - 1);
        }
        self.check(&operation)
    }

    /// Makes shader writes visible to draws, to shaders and to the host.
    pub(crate) fn barrier(&self) {
        let visible = glow::COMMAND_BARRIER_BIT
            | glow::SHADER_STORAGE_BARRIER_BIT
            | glow::BUFFER_UPDATE_BARRIER_BIT;
        // SAFETY: the context is current, and no memory of the host is passed.
        unsafe { self.raw.memory_barrier(visible) };
    }

    /// Sets the number of vertices per patch.
    pub(crate) fn set_patch_vertices(&self, vertices: u32) {
        // SAFETY: the context is current, and no memory of the host is passed.
        unsafe {
            self.raw
                .patch_parameter_i32(glow::PATCH_VERTICES, vertices as i32);
        }
    }

    /// Waits until the device is idle, or until `is_wanted` returns false.
    pub(crate) fn finish(&self, mut is_wanted: impl FnMut() -> bool) -> Result<(), GlError> {
        /// Interval of the calls of `is_wanted`: bounds the delay of a cancelled frame.
        const INTERVAL: Duration = Duration::from_millis(10);
        // SAFETY: the context is current; the call makes an object and takes no memory of the host.
        let fence = unsafe { self.raw.fence_sync(glow::SYNC_GPU_COMMANDS_COMPLETE, 0) }
            .map_err(GlError::create("fence"))?;
        let wait = || {
            let interval_ns = INTERVAL.as_nanos() as i32;
            // SAFETY: the fence belongs to this context and is not deleted yet.
            unsafe {
                self.raw
                    .client_wait_sync(fence, glow::SYNC_FLUSH_COMMANDS_BIT, interval_ns)
            }
        };
        let mut status = wait();
        while status == glow::TIMEOUT_EXPIRED && is_wanted() {
            status = wait();
        }
        // SAFETY: the object belongs to this context, and nothing uses it afterwards.
        unsafe { self.raw.delete_sync(fence) };
        match status {
            glow::WAIT_FAILED => Err(GlError::Wait),
            _ => Ok(()),
        }
    }
}

fn missing(feature: &str) -> GlError {
    GlError::Missing {
        feature: feature.to_owned(),
    }
}
