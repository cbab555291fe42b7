//! What the host and the shaders agree on. It is stated here and nowhere else: every shader is compiled
//! with the text that [`source`] makes of it.

use bytemuck::{Pod, Zeroable};

use crate::options::Antialias;

/// Control points of a cubic segment, which is the vertices of a patch.
pub(super) const CORNERS: u32 = 4;
/// Threads of a workgroup of the pre-pass, one a path.
pub(super) const WORKGROUP: u32 = 64;
/// Samples of a segment that its length is measured by (thesis 4.2.1).
pub(super) const LENGTH_SAMPLES: u32 = 5;
/// Least and most lines of one isoline (thesis 4.2.1; also what OpenGL has).
pub(super) const LINES: (f32, f32) = (1.0, 64.0);
/// Pixels along a segment that one line stands for: 1 in the thesis. With several samples a pixel it is 2, for
/// such lines are as good, and Mesa's llvmpipe drops any that is all within one row or column of pixels.
pub(super) const fn px_per_line(antialias: Antialias) -> f32 {
    match antialias {
        Antialias::None => 1.0,
        Antialias::Multisample => 2.0,
    }
}
/// How far a line may be from the curve that it stands for, in pixels.
pub(super) const FLATNESS_PX: f32 = 0.1;
/// Positions are rounded to this fraction of a pixel, as rasterizers do anyway: whole pixels can then be
/// added and taken away without a change of shape.
pub(super) const STEPS_PER_PX: f32 = 256.0;

/// Uniform block.
pub(super) const VIEW: u32 = 0;
/// Storage blocks.
pub(super) const PATHS: u32 = 0;
pub(super) const TALLY: u32 = 1;
pub(super) const COMMANDS: u32 = 2;
pub(super) const SEGMENTS: u32 = 3;
pub(super) const PATCHES: u32 = 4;
pub(super) const POINTS: u32 = 5;
/// Vertex attribute.
pub(super) const POINT: u32 = 0;

/// A Rust structure with its fields as GLSL knows them.
macro_rules! shared {
    ($(#[$doc:meta])* $name:ident { $($(#[$field_doc:meta])* $field:ident: $kind:ident,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
        #[repr(C)]
        pub(super) struct $name { $($(#[$field_doc])* pub(super) $field: shared!(@rust $kind),)* }

        impl $name {
            /// The fields, as they are declared in GLSL.
            const GLSL: &str = concat!($(stringify!($kind), " ", stringify!($field), ";\n"),*);

            /// Name and byte offset of every field.
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
    /// What is seen, and how. World positions are meters from the origin of the scene; pixels are counted
    /// from the middle of the picture, y down.
    View {
        /// Middle of the view, as the sum of two numbers.
        center_high_m: vec2,
        center_low_m: vec2,
        /// Box of all that can leave a mark.
        seen_min_m: vec2,
        seen_max_m: vec2,
        /// The pixel in the middle of the viewport.
        viewport_px: vec2,
        px_per_m: float,
        clip_per_px: float,
        color: vec4,
    }
}

shared! {
    /// What the pre-pass knows of a path (thesis 4.2.3): the box of its control points, and its segments.
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
    /// What the pre-pass adds up: the paths that are seen, which is also the number of commands, and their
    /// vertices, in what is `DrawArraysIndirectCommand` of OpenGL from there on.
    Tally {
        drawn: uint,
        vertex_count: uint,
        instance_count: uint,
        first_vertex: uint,
        base_instance: uint,
    }
}

impl Tally {
    /// Nothing seen yet.
    pub(super) const NONE: Self = Self {
        drawn: 0,
        vertex_count: 0,
        instance_count: 1,
        first_vertex: 0,
        base_instance: 0,
    };
    /// Where the command begins.
    pub(super) const COMMAND_OFFSET: usize = std::mem::offset_of!(Tally, vertex_count);
}

/// The source of a shader: all that is shared, then its parts.
pub(super) fn source(parts: &[&str]) -> String {
    let mut text = String::from("#version 450 core\n");
    let mut define = |name: &str, value: &dyn std::fmt::Debug| {
        text += &format!("#define {name} {value:?}\n");
    };
    define("CORNERS", &CORNERS);
    define("WORKGROUP", &WORKGROUP);
    define("LENGTH_SAMPLES", &LENGTH_SAMPLES);
    define("LEAST_LINES", &LINES.0);
    define("MOST_LINES", &LINES.1);
    define("FLATNESS_PX", &FLATNESS_PX);
    define("STEPS_PER_PX", &STEPS_PER_PX);
    for (name, binding) in [
        ("PATHS", PATHS),
        ("TALLY", TALLY),
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
        ("Tally", Tally::GLSL),
    ] {
        text += &format!("struct {name} {{\n{fields}}};\n");
    }
    let view = View::GLSL;
    text += &format!("layout(std140, binding = {VIEW}) uniform View {{\n{view}}};\n");
    text + &parts.concat()
}
