//! Dispatches and draws: runs programs on buffers.
//!
//! Input: a linked program and the buffers of its commands. Output: work queued on the device.

use glow::HasContext;

use super::{Buffer, Gl, Program, VertexArray};

/// Runs a compute program.
pub(crate) fn dispatch(gl: &Gl, program: &Program, groups: u32) {
    program.bind();
    // SAFETY: the plan keeps what shaders access within buffers of the planned sizes.
    unsafe { gl.raw.dispatch_compute(groups, 1, 1) };
}

/// Draws patches by the packed indexed commands in `commands`. The first number in `count` is the
/// number of commands, at most `max_commands`.
pub(crate) fn draw_commands(
    gl: &Gl,
    program: &Program,
    vertices: &VertexArray,
    commands: &Buffer,
    count: &Buffer,
    max_commands: u32,
) {
    program.bind();
    vertices.bind();
    commands.bind(glow::DRAW_INDIRECT_BUFFER);
    count.bind(glow::PARAMETER_BUFFER);
    // SAFETY: OpenGL reads packed commands from the start of the buffer bound to
    // DRAW_INDIRECT_BUFFER, and their count from the one bound to PARAMETER_BUFFER. The caller
    // planned for at most `max_commands` commands.
    unsafe {
        (gl.multi_draw)(
            glow::PATCHES,
            glow::UNSIGNED_INT,
            std::ptr::null(),
            0,
            max_commands as i32,
            0,
        );
    }
}

/// Draws patches by the unindexed command at `offset_bytes` in `command`.
pub(crate) fn draw_command(
    gl: &Gl,
    program: &Program,
    vertices: &VertexArray,
    command: &Buffer,
    offset_bytes: usize,
) {
    program.bind();
    vertices.bind();
    command.bind(glow::DRAW_INDIRECT_BUFFER);
    // SAFETY: the plan keeps the command and what it draws within buffers of the planned sizes.
    unsafe {
        gl.raw
            .draw_arrays_indirect_offset(glow::PATCHES, offset_bytes as i32);
    }
}
