//! Shaders as their compiler sees them, for tests that hold this side to them.

use naga::{Module, TypeInner};

use crate::device::Source;

/// Name and offset of each member of a structure, and its size: the distance to the next in an array.
pub type Members<'a> = (Vec<(&'a str, u32)>, u32);

/// The members of a `#[repr(C)]` structure, in their order; those that only pad are left out.
#[macro_export]
macro_rules! members {
    ($type:ty: $($member:ident),+) => {
        (
            vec![$((stringify!($member), std::mem::offset_of!($type, $member) as u32)),+],
            size_of::<$type>() as u32,
        )
    };
}
pub use crate::members;

/// Parses a shader.
///
/// # Panics
/// When it is not valid WGSL.
pub fn parse(source: &Source) -> Module {
    naga::front::wgsl::parse_str(source.wgsl)
        .unwrap_or_else(|error| panic!("{}: {}", source.name, error.emit_to_string(source.wgsl)))
}

/// Fails unless a shader binds the variables that are given to it, and has its entry point.
#[track_caller]
pub fn assert_binds_what_it_is_given(source: &Source) {
    let module = parse(source);
    let mut found: Vec<_> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| {
            let binding = variable.binding?;
            assert_eq!(binding.group, 0, "{}", source.name);
            Some((binding.binding, variable.name.as_deref()?))
        })
        .collect();
    found.sort_unstable();
    let expected: Vec<_> = (0..).zip(source.bindings.iter().copied()).collect();
    assert_eq!(found, expected, "{}", source.name);
    assert_eq!(module.entry_points.len(), 1, "{}", source.name);
    assert_eq!(module.entry_points[0].name, "main", "{}", source.name);
}

/// The structure of this name, if the shader has it.
pub fn structure<'a>(module: &'a Module, name: &str) -> Option<Members<'a>> {
    let found = module
        .types
        .iter()
        .find(|(_, t)| t.name.as_deref() == Some(name));
    let (_, found) = found?;
    let TypeInner::Struct { members, span } = &found.inner else {
        panic!("{name} is no structure");
    };
    let named = members
        .iter()
        .map(|m| (m.name.as_deref().unwrap_or(""), m.offset));
    Some((
        named.filter(|(name, _)| *name != "padding").collect(),
        *span,
    ))
}

/// Fails unless every one of the shaders that has a structure lays it out so, and some shader has it.
#[track_caller]
pub fn assert_laid_out(sources: &[&Source], name: &str, expected: &Members<'_>) {
    let mut seen = 0;
    for source in sources {
        let module = parse(source);
        if let Some(found) = structure(&module, name) {
            assert_eq!(found, *expected, "{name} of {}", source.name);
            seen += 1;
        }
    }
    assert!(seen > 0, "no shader has {name}");
}
