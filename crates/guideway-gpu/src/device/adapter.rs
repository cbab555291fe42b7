//! The graphics adapters of this computer, their rank, and how one is opened.

use std::sync::{LazyLock, Mutex, PoisonError};

use wgpu::{
    Adapter, AdapterInfo, Backend, Backends, Device, DeviceDescriptor, DeviceType, Features,
    Instance, Queue,
};

use super::options::GpuOptions;

/// All devices of the process share one instance and are opened one after the other: on an H200,
/// sixteen threads that each opened an instance were seen to hang.
static INSTANCE: LazyLock<Mutex<Instance>> = LazyLock::new(|| {
    Mutex::new(Instance::new(wgpu::InstanceDescriptor {
        backends: Backends::PRIMARY,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    }))
});

/// Calls a function with the adapters of this computer, of which no other is opened meanwhile.
pub(super) fn with_adapters<R>(call: impl FnOnce(Vec<Adapter>) -> R) -> R {
    let instance = INSTANCE.lock().unwrap_or_else(PoisonError::into_inner);
    call(pollster::block_on(
        instance.enumerate_adapters(Backends::PRIMARY),
    ))
}

/// Opens an adapter.
///
/// # Errors
/// The message of the driver.
pub(super) fn open(adapter: &Adapter, options: GpuOptions) -> Result<(Device, Queue), String> {
    let device = pollster::block_on(adapter.request_device(&descriptor_for(adapter, options)));
    device.map_err(|error| error.to_string())
}

/// The adapters of this computer with backend, kind and driver, hardware first. They may fail to
/// open.
pub fn adapters() -> Vec<String> {
    let mut found: Vec<AdapterInfo> =
        with_adapters(|found| found.iter().map(Adapter::get_info).collect());
    found.sort_by_key(preference);
    let shown = found.iter().map(|info| {
        let kind = match info.device_type {
            DeviceType::DiscreteGpu => "graphics card",
            DeviceType::IntegratedGpu => "graphics in the processor",
            DeviceType::VirtualGpu => "virtual graphics card",
            DeviceType::Other => "unknown kind",
            DeviceType::Cpu => "program on the processor",
        };
        let driver = driver(info);
        format!("{}: {}, {kind}, {driver}", info.name, info.backend)
    });
    shown.collect()
}

/// Driver of an adapter with its version, without a name that the adapter begins with, as
/// `llvmpipe` does.
pub(super) fn driver(info: &AdapterInfo) -> String {
    let driver = info.driver.as_str();
    let is_named = info.name.split(' ').next() == Some(driver);
    let name = if is_named { "" } else { driver };
    format!("{name} {}", info.driver_info).trim().to_owned()
}

/// Rank of an adapter, the best first: hardware before software; then Vulkan and Metal, for which
/// the shaders are tuned, before DirectX 12.
pub(super) fn preference(info: &AdapterInfo) -> (u8, bool) {
    let kind = match info.device_type {
        DeviceType::DiscreteGpu => 0,
        DeviceType::IntegratedGpu => 1,
        DeviceType::VirtualGpu => 2,
        DeviceType::Other => 3,
        DeviceType::Cpu => 4,
    };
    (kind, info.backend == Backend::Dx12)
}

/// The limits and features of an adapter that methods use, below artificial limits.
pub(super) fn descriptor_for(adapter: &Adapter, options: GpuOptions) -> DeviceDescriptor<'static> {
    let mut limits = adapter.limits();
    if let Some(bytes) = options.storage_binding_bytes {
        let binding = &mut limits.max_storage_buffer_binding_size;
        *binding = (*binding).min(bytes.into());
    }
    if let Some(workgroups) = options.workgroups_per_dimension {
        let side = &mut limits.max_compute_workgroups_per_dimension;
        *side = (*side).min(workgroups);
    }
    let mut features = Features::TIMESTAMP_QUERY | Features::SUBGROUP;
    features.set(Features::TIMESTAMP_QUERY, !options.without_timestamps);
    features.set(Features::SUBGROUP, !options.without_subgroups);
    DeviceDescriptor {
        label: Some("guideway"),
        required_features: adapter.features() & features,
        required_limits: limits,
        ..DeviceDescriptor::default()
    }
}
