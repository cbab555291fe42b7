//! Compares structures, bindings and constants with the driver's reflection.

use std::rc::Rc;

use super::super::programs::Programs;
use super::super::shared::{
    COMMANDS, COUNTERS, Counters, DrawElements, PATCH_VERTICES, PATCHES, PATHS, POINT, POINTS,
    PathRecord, SEGMENTS, VIEW, View, WORKGROUP, source,
};
use super::device;
use crate::error::GlError;
use crate::options::{Commands, TessellationOptions};
use crate::sys::reflect::{Block, Reflection};
use crate::sys::{Gl, Program, ShaderStage};

type Fields = &'static [(&'static str, usize)];

/// Block, binding, prefix of its fields, array stride in bytes, fields.
const DECLARED: &[(&str, u32, &str, usize, Fields)] = &[
    ("View", VIEW, "", 0, View::OFFSETS),
    (
        "Paths",
        PATHS,
        "paths[0].",
        size_of::<PathRecord>(),
        PathRecord::OFFSETS,
    ),
    ("CountersBlock", COUNTERS, "counters.", 0, Counters::OFFSETS),
    (
        "Commands",
        COMMANDS,
        "commands[0].",
        size_of::<DrawElements>(),
        DrawElements::OFFSETS,
    ),
    (
        "Segments",
        SEGMENTS,
        "segments[0]",
        size_of::<u32>(),
        &[("", 0)],
    ),
    (
        "Patches",
        PATCHES,
        "patches[0]",
        size_of::<u32>(),
        &[("", 0)],
    ),
    (
        "Points",
        POINTS,
        "points_m[0]",
        size_of::<[f32; 2]>(),
        &[("", 0)],
    ),
];

/// Differences between the declarations of the driver and the host.
fn disagreements(block: &Block) -> Vec<String> {
    let Some((_, binding, prefix, stride, fields)) =
        DECLARED.iter().find(|declared| declared.0 == block.name)
    else {
        return vec![format!("{} is not declared", block.name)];
    };
    let mut found = Vec::new();
    if block.binding != *binding {
        found.push(format!("{}: binding {}", block.name, block.binding));
    }
    if block.members.is_empty() {
        found.push(format!("{} has no members", block.name));
    }
    for member in &block.members {
        let field = fields
            .iter()
            .find(|(field, _)| format!("{prefix}{field}") == member.name);
        // Only arrays have a stride.
        let is_equal = field.is_some_and(|(_, offset)| *offset == member.offset)
            && (*stride == 0 || *stride == member.stride);
        if !is_equal {
            found.push(format!("{}: {member:?}", block.name));
        }
    }
    found
}

fn context() -> Option<Rc<Gl>> {
    Some(Gl::new(device()?.platform).unwrap())
}

#[test]
fn shaders_and_host_have_equal_declarations() {
    let Some(gl) = context() else { return };
    let mut found = Vec::new();
    for commands in [Commands::PerPath, Commands::Compact] {
        let programs = Programs::new(
            &gl,
            TessellationOptions {
                commands,
                ..TessellationOptions::default()
            },
        )
        .unwrap();
        for program in [&programs.cull, &programs.draw] {
            for block in Reflection::new(&gl, program).blocks() {
                assert_eq!(disagreements(&block), [""; 0]);
                found.push(block.name);
            }
        }
        let cull = Reflection::new(&gl, &programs.cull);
        let groups = cull.parameter(glow::COMPUTE_WORK_GROUP_SIZE);
        assert_eq!(groups, [WORKGROUP as i32, 1, 1]);
        let draw = Reflection::new(&gl, &programs.draw);
        let patch = draw.parameter(glow::TESS_CONTROL_OUTPUT_VERTICES);
        assert_eq!(patch, [PATCH_VERTICES as i32]);
        let attributes = match commands {
            Commands::PerPath => vec![("point_m".to_owned(), POINT)],
            Commands::Compact => Vec::new(),
        };
        assert_eq!(draw.attributes(), attributes);
    }
    for (name, ..) in DECLARED {
        assert!(found.iter().any(|s| s == name), "{name} is in no shader");
    }
}

#[test]
fn differing_layouts_and_bindings_are_detected() {
    let Some(gl) = context() else { return };
    let right = "layout(std430, binding = PATHS) buffer Paths { PathRecord paths[]; };";
    let swapped =
        "struct Swapped { vec2 max_m; vec2 min_m; uint first_segment; uint segment_count; };
        layout(std430, binding = PATHS) buffer Paths { Swapped paths[]; };";
    let padded = "struct Padded {
            vec2 min_m; vec2 max_m; uint first_segment; uint segment_count; vec4 more;
        };
        layout(std430, binding = PATHS) buffer Paths { Padded paths[]; };";
    let misplaced = "layout(std430, binding = COUNTERS) buffer Paths { PathRecord paths[]; };";
    for (declaration, is_right) in [
        (right, true),
        (swapped, false),
        (padded, false),
        (misplaced, false),
    ] {
        let text = format!(
            "layout(local_size_x = 1) in;\n{declaration}\n
            void main() {{ paths[0].min_m = paths[1].max_m; paths[0].first_segment = 1u; }}\n"
        );
        let program = Program::new(&gl, &[(ShaderStage::Compute, source(&[&text]))]).unwrap();
        let blocks = Reflection::new(&gl, &program).blocks();
        let found: Vec<_> = blocks.iter().flat_map(disagreements).collect();
        assert_eq!(found.is_empty(), is_right, "{declaration}: {found:?}");
    }
}

#[test]
fn compile_error_names_the_stage_and_the_cause() {
    let Some(gl) = context() else { return };
    let broken = [(
        ShaderStage::Compute,
        source(&["void main() { nothing(); }\n"]),
    )];
    let error = Program::new(&gl, &broken).err().unwrap().to_string();
    assert!(
        error.contains("Compute") && error.contains("nothing"),
        "{error}"
    );
}

#[test]
fn rejects_a_second_context_on_a_thread() {
    let Some(gl) = context() else { return };
    let platform = device().unwrap().platform;
    let second = Gl::new(platform).err();
    assert_eq!(second, Some(GlError::ContextExists));
    drop(gl);
    assert!(Gl::new(platform).is_ok());
}
