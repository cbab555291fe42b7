use guideway_scene::{Budget, RenderError};
use wgpu::BufferUsages;

use super::*;

/// An account on the device, if there is one. The tests of the methods report its absence.
fn memory(memory_bytes: u64) -> Option<Memory> {
    let gpu = Gpu::new().ok()?;
    let budget = Budget {
        memory_bytes,
        ..Budget::default()
    };
    Some(Memory::new(gpu, "any", &budget))
}

#[test]
fn dropping_a_reservation_returns_its_bytes() {
    let Some(mut memory) = memory(1000) else {
        return;
    };
    let reservation = memory.reserve("one", 600).unwrap();
    let buffer = memory.zeros("two", 400, BufferUsages::STORAGE).unwrap();
    assert_eq!((memory.held_bytes(), memory.spare_bytes()), (1000, 0));
    let Err(RenderError::Budget {
        what, needed_bytes, ..
    }) = memory.reserve("three", 1)
    else {
        panic!("expected a budget error");
    };
    assert_eq!((what, needed_bytes), ("three", 1001));
    drop(reservation);
    assert_eq!((memory.held_bytes(), buffer.bytes()), (400, 400));
    assert_eq!(memory.take_peak_bytes(), 1000);
    assert_eq!(memory.take_peak_bytes(), 400);
}

#[test]
fn names_the_allocation_that_the_device_refuses() {
    let Some(mut memory) = memory(u64::MAX) else {
        return;
    };
    let too_much = 1 << 60;
    let Err(RenderError::Device { what, .. }) =
        memory.zeros("the moon", too_much, BufferUsages::STORAGE)
    else {
        panic!("expected a device error");
    };
    assert!(what.contains("the moon"), "{what}");
    assert_eq!(memory.held_bytes(), 0);
    assert!(memory.zeros("a word", 4, BufferUsages::STORAGE).is_ok());
}

#[test]
fn names_the_shader_that_does_not_compile() {
    let Ok(gpu) = Gpu::new() else { return };
    let source = Source {
        name: "nonsense",
        wgsl: "fn main() {".into(),
        bindings: &[],
    };
    let Err(error) = Kernel::new(&gpu, &source, &[]) else {
        panic!("expected a shader error");
    };
    assert!(
        matches!(&error, DeviceError::Shader { name, .. } if name == "nonsense"),
        "{error}"
    );
}
