//! Compiles the shader programs of culling and drawing.

use std::rc::Rc;

use super::shared::{PATCH_VERTICES, px_per_line, source};
use crate::error::GlError;
use crate::options::{Commands, TessellationOptions};
use crate::sys::{Gl, Program, ShaderStage};

const CULL: &str = include_str!("../shaders/cull.glsl");
const CULL_COMMANDS: &str = include_str!("../shaders/cull_commands.comp");
const CULL_PATCHES: &str = include_str!("../shaders/cull_patches.comp");
const PROJECT: &str = include_str!("../shaders/project.glsl");
const INDEXED: &str = include_str!("../shaders/indexed.vert");
const PULLED: &str = include_str!("../shaders/pulled.vert");
const BSPLINE: &str = include_str!("../shaders/bspline.glsl");
const TESS_CONTROL: &str = include_str!("../shaders/segment.tesc");
const TESS_EVALUATION: &str = include_str!("../shaders/segment.tese");
const FRAGMENT: &str = include_str!("../shaders/color.frag");

/// The programs of the culling pass and of the draws.
pub(super) struct Programs {
    pub(super) cull: Program,
    pub(super) draw: Program,
}

impl Programs {
    /// Compiles both programs.
    ///
    /// # Errors
    /// When the driver rejects a shader.
    pub(super) fn new(gl: &Rc<Gl>, options: TessellationOptions) -> Result<Self, GlError> {
        let px_per_line = format!("#define PX_PER_LINE {:?}\n", px_per_line(options.antialias));
        let (cull, vertex) = match options.commands {
            Commands::PerPath => (CULL_COMMANDS, INDEXED),
            Commands::Compact => (CULL_PATCHES, PULLED),
        };
        gl.set_patch_vertices(PATCH_VERTICES);
        Ok(Self {
            cull: Program::new(gl, &[(ShaderStage::Compute, source(&[CULL, cull]))])?,
            draw: Program::new(
                gl,
                &[
                    (ShaderStage::Vertex, source(&[PROJECT, vertex])),
                    (
                        ShaderStage::TessControl,
                        source(&[&px_per_line, BSPLINE, TESS_CONTROL]),
                    ),
                    (
                        ShaderStage::TessEvaluation,
                        source(&[BSPLINE, TESS_EVALUATION]),
                    ),
                    (ShaderStage::Fragment, source(&[FRAGMENT])),
                ],
            )?,
        })
    }
}
