//! Reflects shaders by naga, to compare their bindings and structures with Rust.

use naga::{Module, TypeInner};

use crate::device::Source;

/// Name and offset of each member of a structure, and the stride of an array of it.
pub type Members<'a> = (Vec<(&'a str, u32)>, u32);

/// The members of a `#[repr(C)]` structure in order, without padding.
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
/// If it is not valid WGSL.
pub fn parse(source: &Source) -> Module {
    naga::front::wgsl::parse_str(&source.wgsl)
        .unwrap_or_else(|error| panic!("{}: {}", source.name, error.emit_to_string(&source.wgsl)))
}

/// Asserts that a shader binds exactly [`Source::bindings`] and has the one entry point `main`.
#[track_caller]
pub fn assert_bindings(source: &Source) {
    let module = parse(source);
    let mut bound: Vec<_> = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| {
            let binding = variable.binding?;
            assert_eq!(binding.group, 0, "{}", source.name);
            Some((binding.binding, variable.name.as_deref()?))
        })
        .collect();
    bound.sort_unstable();
    let expected: Vec<_> = (0..).zip(source.bindings.iter().copied()).collect();
    assert_eq!(bound, expected, "{}", source.name);
    assert_eq!(module.entry_points.len(), 1, "{}", source.name);
    assert_eq!(module.entry_points[0].name, "main", "{}", source.name);
}

/// The members of the structure `name`, if the shader has it.
pub fn structure<'a>(module: &'a Module, name: &str) -> Option<Members<'a>> {
    let mut types = module.types.iter();
    let (_, found) = types.find(|(_, t)| t.name.as_deref() == Some(name))?;
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

/// Asserts that some shader has the structure `name`, and that all of them have this layout.
#[track_caller]
pub fn assert_layout(sources: &[&Source], name: &str, expected: &Members<'_>) {
    let mut count = 0;
    for source in sources {
        let module = parse(source);
        if let Some(found) = structure(&module, name) {
            assert_eq!(found, *expected, "{name} of {}", source.name);
            count += 1;
        }
    }
    assert!(count > 0, "no shader has {name}");
}
