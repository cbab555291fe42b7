//! Every shader against what this side takes it for.

use std::mem::offset_of;

use naga::{AddressSpace, Module, TypeInner};

use super::*;

const SHADERS: &[&Source] = &[
    &SAMPLE,
    &COUNT,
    &PREFIX_NAIVE,
    &SCAN_BLOCKS,
    &SCAN_SUMS,
    &ADD_SUMS,
    &BIN,
    &PIXELS_NEAREST,
    &PIXELS_SAMPLES,
];

fn parse(source: &Source) -> Module {
    naga::front::wgsl::parse_str(source.wgsl)
        .unwrap_or_else(|error| panic!("{}: {}", source.name, error.emit_to_string(source.wgsl)))
}

/// Names of the bound variables, by their numbers.
fn bindings(module: &Module) -> Vec<(u32, &str)> {
    let mut found: Vec<_> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| {
            let binding = variable.binding?;
            assert_eq!(binding.group, 0);
            Some((binding.binding, variable.name.as_deref()?))
        })
        .collect();
    found.sort_unstable();
    found
}

/// Name and offset of each member, and the size, of the uniform that is called `name`.
fn uniform<'a>(module: &'a Module, name: &str) -> Option<(Vec<(&'a str, u32)>, u32)> {
    let (_, variable) = module
        .global_variables
        .iter()
        .find(|(_, v)| v.space == AddressSpace::Uniform && v.name.as_deref() == Some(name))?;
    let TypeInner::Struct { members, span } = &module.types[variable.ty].inner else {
        panic!("{name} is no struct");
    };
    let member = |m: &'a naga::StructMember| (m.name.as_deref().unwrap_or(""), m.offset);
    Some((members.iter().map(member).collect(), *span))
}

#[test]
fn every_shader_binds_what_it_is_given() {
    for source in SHADERS {
        let module = parse(source);
        let expected: Vec<_> = (0..).zip(source.bindings.iter().copied()).collect();
        assert_eq!(bindings(&module), expected, "{}", source.name);
        assert_eq!(module.entry_points.len(), 1, "{}", source.name);
        assert_eq!(module.entry_points[0].name, "main", "{}", source.name);
    }
}

macro_rules! members {
    ($type:ty: $($member:ident),+) => {
        vec![$((stringify!($member), offset_of!($type, $member) as u32)),+]
    };
}

#[test]
fn uniforms_are_laid_out_alike() {
    let expected = [
        (
            "items",
            members!(Items: first, end, first_part, end_part),
            size_of::<Items>(),
        ),
        (
            "grid",
            members!(GridParams: origin_m, cells_per_m, reach_m),
            size_of::<GridParams>(),
        ),
        (
            "view",
            members!(ViewParams: center_m, half_size_px, box_low_m, box_high_m, excess_m, m_per_px,
                px_per_m, radius_m, color, background, width_px, first_row, rows, first_tile, end_tile,
                first_cell_row, end_cell_row, first_line, end_line, is_first_pass, is_last_pass),
            size_of::<ViewParams>(),
        ),
    ];
    for (name, members, size) in expected {
        let mut seen = 0;
        for source in SHADERS {
            let module = parse(source);
            if let Some(found) = uniform(&module, name) {
                assert_eq!(
                    found,
                    (members.clone(), size as u32),
                    "{name} of {}",
                    source.name
                );
                seen += 1;
            }
        }
        assert!(seen > 0, "no shader has {name}");
    }
}

#[test]
fn a_line_has_the_bytes_that_it_is_given() {
    for source in [&SAMPLE, &COUNT, &BIN] {
        let module = parse(source);
        let lines = module
            .global_variables
            .iter()
            .find(|(_, v)| v.name.as_deref() == Some("lines_m"));
        let (_, lines) = lines.expect("lines");
        let TypeInner::Array { stride, .. } = module.types[lines.ty].inner else {
            panic!("lines are an array");
        };
        assert_eq!(u64::from(stride), LINE_BYTES);
    }
}
