use guideway_scene::{Budget, RenderError};
use wgpu::BufferUsages;

use super::*;

/// The device, unless there is none: then the tests of the methods say so.
fn memory(memory_bytes: u64) -> Option<Memory> {
    let gpu = Gpu::new().ok()?;
    let budget = Budget {
        memory_bytes,
        ..Budget::default()
    };
    Some(Memory::new(gpu, "any", &budget))
}

#[test]
fn what_is_dropped_may_be_held_again() {
    let Some(mut memory) = memory(1000) else {
        return;
    };
    let held = memory.hold("one", 600).unwrap();
    let buffer = memory.zeros("two", 400, BufferUsages::STORAGE).unwrap();
    assert_eq!((memory.held_bytes(), memory.spare_bytes()), (1000, 0));
    let Err(RenderError::Budget {
        what, needed_bytes, ..
    }) = memory.hold("three", 1)
    else {
        panic!("there is no room");
    };
    assert_eq!((what, needed_bytes), ("three", 1001));
    drop(held);
    assert_eq!((memory.held_bytes(), buffer.bytes()), (400, 400));
    assert_eq!(memory.take_peak_bytes(), 1000);
    assert_eq!(memory.take_peak_bytes(), 400);
}

#[test]
fn an_allocation_that_the_device_refuses_is_named() {
    let Some(mut memory) = memory(u64::MAX) else {
        return;
    };
    let too_much = 1 << 60;
    let Err(RenderError::Device { what, .. }) =
        memory.zeros("the moon", too_much, BufferUsages::STORAGE)
    else {
        panic!("nobody has so much");
    };
    assert!(what.contains("the moon"), "{what}");
    assert_eq!(memory.held_bytes(), 0);
    assert!(memory.zeros("a word", 4, BufferUsages::STORAGE).is_ok());
}

#[test]
fn a_shader_that_does_not_compile_is_named() {
    let Ok(gpu) = Gpu::new() else { return };
    let source = Source {
        name: "nonsense",
        wgsl: "fn main() {",
        bindings: &[],
    };
    let Err(message) = Kernel::new(&gpu, &source, &[]) else {
        panic!("it is no shader");
    };
    assert!(message.contains("nonsense"), "{message}");
}
