//! Shader programs and vertex arrays.

use std::rc::Rc;

use glow::HasContext;

use super::{Buffer, Gl};
use crate::error::GlError;

/// The pipeline stage of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShaderStage {
    Vertex,
    TessControl,
    TessEvaluation,
    Fragment,
    Compute,
}

/// A linked program of one or more shaders.
pub(crate) struct Program {
    gl: Rc<Gl>,
    name: glow::Program,
}

impl Program {
    /// Compiles and links shaders from their sources.
    ///
    /// # Errors
    /// When the driver rejects a shader: the error holds its message.
    pub(crate) fn new(gl: &Rc<Gl>, sources: &[(ShaderStage, String)]) -> Result<Self, GlError> {
        let program = Self {
            gl: Rc::clone(gl),
            // SAFETY: the context is current; the call makes an object and takes no memory of the
            // host.
            name: unsafe { gl.raw.create_program() }.map_err(GlError::create("program"))?,
        };
        for (stage, source) in sources {
            program.attach(*stage, source)?;
        }
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe { gl.raw.link_program(program.name) };
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        if unsafe { gl.raw.get_program_link_status(program.name) } {
            return Ok(program);
        }
        // SAFETY: the program belongs to this context; the text of the log is copied.
        let log = unsafe { gl.raw.get_program_info_log(program.name) };
        Err(GlError::Link { log })
    }

    fn attach(&self, stage: ShaderStage, source: &str) -> Result<(), GlError> {
        let kind = match stage {
            ShaderStage::Vertex => glow::VERTEX_SHADER,
            ShaderStage::TessControl => glow::TESS_CONTROL_SHADER,
            ShaderStage::TessEvaluation => glow::TESS_EVALUATION_SHADER,
            ShaderStage::Fragment => glow::FRAGMENT_SHADER,
            ShaderStage::Compute => glow::COMPUTE_SHADER,
        };
        let raw = &self.gl.raw;
        // SAFETY: the shader and the program belong to this context; the source is a slice.
        unsafe {
            let shader = raw.create_shader(kind).map_err(GlError::create("shader"))?;
            raw.shader_source(shader, source);
            raw.compile_shader(shader);
            raw.attach_shader(self.name, shader);
            // OpenGL deletes the shader together with the program.
            raw.delete_shader(shader);
            if raw.get_shader_compile_status(shader) {
                return Ok(());
            }
            let log = raw.get_shader_info_log(shader);
            Err(GlError::Compile {
                stage: format!("{stage:?}"),
                log,
            })
        }
    }

    pub(super) fn bind(&self) {
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe { self.gl.raw.use_program(Some(self.name)) };
    }

    #[cfg(test)]
    pub(super) fn name(&self) -> glow::Program {
        self.name
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // SAFETY: the object belongs to this context, and nothing uses it afterwards.
        unsafe { self.gl.raw.delete_program(self.name) };
    }
}

/// The source of the vertices of a draw.
pub(crate) struct VertexArray {
    gl: Rc<Gl>,
    name: glow::VertexArray,
}

impl VertexArray {
    /// Without attributes: the shader pulls its data from storage buffers by vertex index.
    pub(crate) fn pulled(gl: &Rc<Gl>) -> Result<Self, GlError> {
        Ok(Self {
            gl: Rc::clone(gl),
            // SAFETY: the context is current; the call makes an object and takes no memory of the
            // host.
            name: unsafe { gl.raw.create_named_vertex_array() }
                .map_err(GlError::create("vertex array"))?,
        })
    }

    /// Two `f32` per vertex from `points`, by the `u32` indices in `elements`.
    pub(crate) fn indexed(
        gl: &Rc<Gl>,
        location: u32,
        points: &Buffer,
        elements: &Buffer,
    ) -> Result<Self, GlError> {
        let vertices = Self::pulled(gl)?;
        let (raw, name) = (&gl.raw, vertices.name);
        let stride = size_of::<[f32; 2]>() as i32;
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe {
            raw.enable_vertex_array_attrib(name, location);
            raw.vertex_array_attrib_format_f32(name, location, 2, glow::FLOAT, false, 0);
            raw.vertex_array_attrib_binding_f32(name, location, 0);
            raw.vertex_array_vertex_buffer(name, 0, Some(points.name()), 0, stride);
            raw.vertex_array_element_buffer(name, Some(elements.name()));
        }
        Ok(vertices)
    }

    pub(super) fn bind(&self) {
        // SAFETY: the object belongs to this context, which is current; no memory of the host is
        // passed.
        unsafe { self.gl.raw.bind_vertex_array(Some(self.name)) };
    }
}

impl Drop for VertexArray {
    fn drop(&mut self) {
        // SAFETY: the object belongs to this context, and nothing uses it afterwards.
        unsafe { self.gl.raw.delete_vertex_array(self.name) };
    }
}
