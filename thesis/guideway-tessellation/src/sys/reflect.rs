//! Reflection of compiled shaders, which tests compare with the Rust declarations.

use std::ptr;

use glow::HasContext;

use super::{Gl, Program};

type GetInterface = unsafe extern "system" fn(u32, u32, u32, *mut i32);
type GetName = unsafe extern "system" fn(u32, u32, u32, i32, *mut i32, *mut u8);
type GetResource =
    unsafe extern "system" fn(u32, u32, u32, i32, *const u32, i32, *mut i32, *mut i32);
type GetProgram = unsafe extern "system" fn(u32, u32, *mut i32);

/// A uniform or storage block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Block {
    pub(crate) name: String,
    pub(crate) binding: u32,
    pub(crate) members: Vec<Member>,
}

/// A field of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Member {
    pub(crate) name: String,
    pub(crate) offset: usize,
    /// Bytes between the items of the enclosing array; 0 without an array.
    pub(crate) stride: usize,
}

/// Queries one program.
pub(crate) struct Reflection<'a> {
    gl: &'a Gl,
    program: u32,
}

impl<'a> Reflection<'a> {
    pub(crate) fn new(gl: &'a Gl, program: &Program) -> Self {
        let program = program.name().0.get();
        Self { gl, program }
    }

    /// All uniform and storage blocks.
    pub(crate) fn blocks(&self) -> Vec<Block> {
        [
            (glow::UNIFORM_BLOCK, glow::UNIFORM),
            (glow::SHADER_STORAGE_BLOCK, glow::BUFFER_VARIABLE),
        ]
        .into_iter()
        .flat_map(|(blocks, members)| {
            (0..self.count(blocks)).map(move |block| Block {
                name: self.name(blocks, block),
                binding: self.property(blocks, block, glow::BUFFER_BINDING) as u32,
                members: self.members(members, block),
            })
        })
        .collect()
    }

    fn members(&self, interface: u32, block: u32) -> Vec<Member> {
        (0..self.count(interface))
            .filter(|&m| self.property(interface, m, glow::BLOCK_INDEX) as u32 == block)
            .map(|m| Member {
                name: self.name(interface, m),
                offset: self.property(interface, m, glow::OFFSET) as usize,
                stride: if interface == glow::BUFFER_VARIABLE {
                    let arrays = [glow::TOP_LEVEL_ARRAY_STRIDE, glow::ARRAY_STRIDE];
                    let strides = arrays.map(|array| self.property(interface, m, array));
                    strides.into_iter().max().unwrap_or(0) as usize
                } else {
                    0
                },
            })
            .collect()
    }

    /// Names and locations of the vertex attributes, without OpenGL's built-in ones.
    pub(crate) fn attributes(&self) -> Vec<(String, u32)> {
        let inputs = (0..self.count(glow::PROGRAM_INPUT)).map(|input| {
            let location = self.property(glow::PROGRAM_INPUT, input, glow::LOCATION);
            (self.name(glow::PROGRAM_INPUT, input), location)
        });
        inputs
            .filter_map(|(name, location)| Some((name, u32::try_from(location).ok()?)))
            .collect()
    }

    /// A parameter of the program that has `N` numbers.
    pub(crate) fn parameter<const N: usize>(&self, name: u32) -> [i32; N] {
        let mut values = [0; N];
        // SAFETY: the caller requests a parameter of `N` numbers.
        unsafe {
            let get: GetProgram = self.function("glGetProgramiv");
            get(self.program, name, values.as_mut_ptr());
        }
        values
    }

    fn count(&self, interface: u32) -> u32 {
        let mut count = 0;
        // SAFETY: this property is one number.
        unsafe {
            let get: GetInterface = self.function("glGetProgramInterfaceiv");
            get(
                self.program,
                interface,
                glow::ACTIVE_RESOURCES,
                &raw mut count,
            );
        }
        count as u32
    }

    fn name(&self, interface: u32, index: u32) -> String {
        let (mut text, mut length) = (vec![0; 256], 0);
        // SAFETY: the function writes at most `capacity` bytes.
        unsafe {
            let get: GetName = self.function("glGetProgramResourceName");
            let capacity = text.len() as i32;
            get(
                self.program,
                interface,
                index,
                capacity,
                &raw mut length,
                text.as_mut_ptr(),
            );
        }
        text.truncate(length as usize);
        String::from_utf8(text).expect("names are ASCII")
    }

    fn property(&self, interface: u32, index: u32, property: u32) -> i32 {
        let mut value = 0;
        // SAFETY: the call queries one property, and writes at most one number.
        unsafe {
            let get: GetResource = self.function("glGetProgramResourceiv");
            let (requested, found) = (&raw const property, &raw mut value);
            get(
                self.program,
                interface,
                index,
                1,
                requested,
                1,
                ptr::null_mut(),
                found,
            );
            assert_eq!(
                self.gl.raw.get_error(),
                glow::NO_ERROR,
                "{interface:#x} {property:#x}"
            );
        }
        value
    }

    /// # Safety
    /// `F` must be the type of the function with this name.
    unsafe fn function<F: Copy>(&self, name: &str) -> F {
        // SAFETY: the caller guarantees the type.
        unsafe { self.gl.context.function(name) }.expect("OpenGL 4.3 has it")
    }
}
