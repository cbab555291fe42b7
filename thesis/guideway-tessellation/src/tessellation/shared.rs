//! The data that Rust and GLSL exchange: constants, bindings and structures.
//!
//! Only this module declares them: [`source`] generates the GLSL declarations of every shader.

use bytemuck::{Pod, Zeroable};

use crate::options::Antialias;

/// Vertices per patch: the control points of a cubic segment.
pub(super) const PATCH_VERTICES: u32 = 4;
/// Threads per workgroup of the culling pass; one thread per path.
pub(super) const WORKGROUP: u32 = 64;
/// Samples per segment that estimate its length (thesis 4.2.1).
pub(super) const LENGTH_SAMPLES: u32 = 5;
/// Fewest and most lines per isoline (thesis 4.2.1; also the limits of OpenGL).
pub(super) const LINES: (f32, f32) = (1.0, 64.0);
/// Length of one line, in pixels: 1 in the thesis. With several samples per pixel it is 2: such
/// lines look the same, and Mesa's llvmpipe drops lines within a single row or column of pixels.
pub(super) const fn px_per_line(antialias: Antialias) -> f32 {
    match antialias {
        Antialias::None => 1.0,
        Antialias::Multisample => 2.0,
    }
}
/// Largest distance between a line and its curve, in pixels.
pub(super) const FLATNESS_PX: f32 = 0.1;
/// Steps per pixel to which positions are rounded, the subpixel precision of rasterizers. Shifts by
/// whole pixels then keep the shape of a line.
pub(super) const STEPS_PER_PX: f32 = 256.0;

/// Binding of the uniform block.
pub(super) const VIEW: u32 = 0;
/// Bindings of the storage blocks.
pub(super) const PATHS: u32 = 0;
pub(super) const COUNTERS: u32 = 1;
pub(super) const COMMANDS: u32 = 2;
pub(super) const SEGMENTS: u32 = 3;
pub(super) const PATCHES: u32 = 4;
pub(super) const POINTS: u32 = 5;
/// Location of the vertex attribute.
pub(super) const POINT: u32 = 0;

/// Declares a structure for Rust and GLSL.
macro_rules! shared {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ident,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
        #[repr(C)]
        pub(super) struct $name { $($(#[$field_doc])* pub(super) $field: shared!(@rust $kind),)* }

        impl $name {
            /// The GLSL declarations of the fields.
            const GLSL: &str = concat!($(stringify!($kind), " ", stringify!($field), ";\n"),*);

            /// Name and byte offset per field.
            #[cfg(test)]
            pub(super) const OFFSETS: &[(&str, usize)] =
                &[$((stringify!($field), std::mem::offset_of!($name, $field)),)*];
        }
    };
    (@rust uint) => { u32 };
    (@rust float) => { f32 };
    (@rust vec2) => { [f32; 2] };
    (@rust vec4) => { [f32; 4] };
}

shared! {
    /// The view. World positions are meters from the origin of the scene; pixels count from the
    /// center of the picture, with y down.
    View {
        /// Center of the view, as the sum of two numbers for precision.
        center_high_m: vec2,
        center_low_m: vec2,
        /// Bounds of everything that can change a pixel.
        visible_min_m: vec2,
        visible_max_m: vec2,
        /// The pixel at the center of the viewport.
        viewport_px: vec2,
        px_per_m: float,
        clip_per_px: float,
        color: vec4,
    }
}

shared! {
    /// The input of the culling pass per path (thesis 4.2.3): bounds of the control points, and
    /// segments.
    PathRecord {
        min_m: vec2,
        max_m: vec2,
        first_segment: uint,
        segment_count: uint,
    }
}

shared! {
    /// `DrawElementsIndirectCommand` of OpenGL.
    DrawElements {
        index_count: uint,
        instance_count: uint,
        first_index: uint,
        base_vertex: uint,
        base_instance: uint,
    }
}

shared! {
    /// The counters of the culling pass: the number of visible paths, which is also the number of
    /// commands, followed by OpenGL's `DrawArraysIndirectCommand` with their vertices.
    Counters {
        drawn: uint,
        vertex_count: uint,
        instance_count: uint,
        first_vertex: uint,
        base_instance: uint,
    }
}

impl Counters {
    /// The counters before the culling pass.
    pub(super) const INITIAL: Self = Self {
        drawn: 0,
        vertex_count: 0,
        instance_count: 1,
        first_vertex: 0,
        base_instance: 0,
    };
    /// Byte offset of the command.
    pub(super) const COMMAND_OFFSET: usize = std::mem::offset_of!(Counters, vertex_count);
}

/// Assembles the source of a shader: the shared declarations, then its parts.
pub(super) fn source(parts: &[&str]) -> String {
    let mut text = String::from("#version 450 core\n");
    let mut define = |name: &str, value: &dyn std::fmt::Debug| {
        text += &format!("#define {name} {value:?}\n");
    };
    define("PATCH_VERTICES", &PATCH_VERTICES);
    define("WORKGROUP", &WORKGROUP);
    define("LENGTH_SAMPLES", &LENGTH_SAMPLES);
    define("MIN_LINES", &LINES.0);
    define("MAX_LINES", &LINES.1);
    define("FLATNESS_PX", &FLATNESS_PX);
    define("STEPS_PER_PX", &STEPS_PER_PX);
    for (name, binding) in [
        ("PATHS", PATHS),
        ("COUNTERS", COUNTERS),
        ("COMMANDS", COMMANDS),
        ("SEGMENTS", SEGMENTS),
        ("PATCHES", PATCHES),
        ("POINTS", POINTS),
        ("POINT", POINT),
    ] {
        define(name, &binding);
    }
    for (name, fields) in [
        ("PathRecord", PathRecord::GLSL),
        ("DrawElements", DrawElements::GLSL),
        ("Counters", Counters::GLSL),
    ] {
        text += &format!("struct {name} {{\n{fields}}};\n");
    }
    let view = View::GLSL;
    text += &format!("layout(std140, binding = {VIEW}) uniform View {{\n{view}}};\n");
    text + &parts.concat()
}
