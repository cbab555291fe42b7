use std::rc::Rc;

use glow::HasContext;

use super::{Buffer, Gl};

/// What a shader is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShaderStage {
    Vertex,
    TessControl,
    TessEvaluation,
    Fragment,
    Compute,
}

/// Shaders linked to run together.
pub(crate) struct Program {
    gl: Rc<Gl>,
    name: glow::Program,
}

impl Program {
    /// Compiles and links shaders, given by their sources.
    pub(crate) fn new(gl: &Rc<Gl>, sources: &[(ShaderStage, String)]) -> Result<Self, String> {
        let program = Self {
            gl: Rc::clone(gl),
            name: unsafe { gl.raw.create_program() }?,
        };
        for (stage, source) in sources {
            program.attach(*stage, source)?;
        }
        unsafe { gl.raw.link_program(program.name) };
        if unsafe { gl.raw.get_program_link_status(program.name) } {
            return Ok(program);
        }
        let log = unsafe { gl.raw.get_program_info_log(program.name) };
        Err(format!("its driver does not link the shaders: {log}"))
    }

    fn attach(&self, stage: ShaderStage, source: &str) -> Result<(), String> {
        let kind = match stage {
            ShaderStage::Vertex => glow::VERTEX_SHADER,
            ShaderStage::TessControl => glow::TESS_CONTROL_SHADER,
            ShaderStage::TessEvaluation => glow::TESS_EVALUATION_SHADER,
            ShaderStage::Fragment => glow::FRAGMENT_SHADER,
            ShaderStage::Compute => glow::COMPUTE_SHADER,
        };
        let raw = &self.gl.raw;
        unsafe {
            let shader = raw.create_shader(kind)?;
            raw.shader_source(shader, source);
            raw.compile_shader(shader);
            raw.attach_shader(self.name, shader);
            // It lives on while it is attached.
            raw.delete_shader(shader);
            if raw.get_shader_compile_status(shader) {
                return Ok(());
            }
            let log = raw.get_shader_info_log(shader);
            Err(format!(
                "its driver does not compile the {stage:?} shader: {log}"
            ))
        }
    }

    pub(super) fn bind(&self) {
        unsafe { self.gl.raw.use_program(Some(self.name)) };
    }

    #[cfg(test)]
    pub(super) fn name(&self) -> glow::Program {
        self.name
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        unsafe { self.gl.raw.delete_program(self.name) };
    }
}

/// Where a draw takes its vertices from.
pub(crate) struct Vertices {
    gl: Rc<Gl>,
    name: glow::VertexArray,
}

impl Vertices {
    /// From storage buffers, by the number of the vertex.
    pub(crate) fn pulled(gl: &Rc<Gl>) -> Result<Self, String> {
        Ok(Self {
            gl: Rc::clone(gl),
            name: unsafe { gl.raw.create_named_vertex_array() }?,
        })
    }

    /// Two `f32` a vertex, out of `points` by the `u32` indices in `elements`.
    pub(crate) fn indexed(
        gl: &Rc<Gl>,
        location: u32,
        points: &Buffer,
        elements: &Buffer,
    ) -> Result<Self, String> {
        let vertices = Self::pulled(gl)?;
        let (raw, name) = (&gl.raw, vertices.name);
        let stride = size_of::<[f32; 2]>() as i32;
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
        unsafe { self.gl.raw.bind_vertex_array(Some(self.name)) };
    }
}

impl Drop for Vertices {
    fn drop(&mut self) {
        unsafe { self.gl.raw.delete_vertex_array(self.name) };
    }
}
