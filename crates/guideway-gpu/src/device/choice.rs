//! Chooses a graphics adapter: the best one that passes a trial.

use std::sync::Arc;

use guideway_scene::{Budget, RenderError};
use wgpu::{Adapter, AdapterInfo, Backend, BufferUsages};

use super::adapter::{open, preference, with_adapters};
use super::error::DeviceError;
use super::gpu::Gpu;
use super::kernel::{Kernel, Source};
use super::memory::Memory;
use super::options::GpuOptions;
use super::readback::READBACK_USAGE;
use super::runner::{Dispatch, Runner};

/// Writes `1234 + i` to each word.
const TRIAL: Source = Source {
    name: "trial",
    wgsl: std::borrow::Cow::Borrowed(include_str!("trial.wgsl")),
    bindings: &["words"],
};
/// Words of the trial: one workgroup.
const TRIAL_WORDS: u32 = 64;

impl Gpu {
    /// Opens the best adapter of this computer that works, hardware before software.
    ///
    /// # Errors
    /// [`DeviceError::NoAdapter`] or [`DeviceError::NotOpened`].
    pub fn new() -> Result<Arc<Self>, DeviceError> {
        Self::with_options(GpuOptions::default())
    }

    /// Opens the best adapter with artificial limits.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_options(options: GpuOptions) -> Result<Arc<Self>, DeviceError> {
        with_adapters(|adapters| {
            best(
                adapters.iter(),
                |adapter| adapter.get_info(),
                |adapter| open_tried(adapter, options),
            )
        })
    }

    /// The best of the adapters that `can_present` accepts and that work, for a window: devices of
    /// it are opened later. A single one is not tried, as nothing could replace it.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn choose(
        adapters: &[Adapter],
        can_present: impl Fn(&Adapter) -> bool,
    ) -> Result<Adapter, DeviceError> {
        let usable: Vec<&Adapter> = adapters.iter().filter(|a| can_present(a)).collect();
        let is_only = usable.len() == 1;
        let options = GpuOptions::default();
        best(
            usable,
            |adapter| adapter.get_info(),
            |adapter| match is_only {
                true => Ok(adapter.clone()),
                false => open_tried(adapter, options).map(|_| adapter.clone()),
            },
        )
    }
}

/// The result for the best adapter for which `open` succeeds.
fn best<A, R>(
    adapters: impl IntoIterator<Item = A>,
    info: impl Fn(&A) -> AdapterInfo,
    open: impl Fn(A) -> Result<R, String>,
) -> Result<R, DeviceError> {
    let adapters = adapters
        .into_iter()
        .map(|adapter| (info(&adapter), adapter));
    let mut adapters: Vec<_> = adapters.collect();
    adapters.sort_by_key(|(info, _)| preference(info));
    let mut reasons = Vec::new();
    for (info, adapter) in adapters {
        match open(adapter) {
            Ok(opened) => return Ok(opened),
            Err(reason) => reasons.push(format!("{} ({}): {reason}", info.name, info.backend)),
        }
    }
    if reasons.is_empty() {
        Err(DeviceError::NoAdapter)
    } else {
        let reasons = reasons.join("; ");
        Err(DeviceError::NotOpened { reasons })
    }
}

/// Opens an adapter, and tries one of DirectX 12: Wine has some that open and then lose the device
/// with the first work.
fn open_tried(adapter: &Adapter, options: GpuOptions) -> Result<Arc<Gpu>, String> {
    let (device, queue) = open(adapter, options)?;
    let gpu = Gpu::of(adapter, device, queue, options);
    if adapter.get_info().backend == Backend::Dx12 {
        let computed = trial(&gpu).map_err(|error| error.to_string())?;
        if !computed {
            return Err("it computes wrong numbers".into());
        }
    }
    Ok(gpu)
}

/// Runs a shader and reads its words back; tells whether they are right.
fn trial(gpu: &Arc<Gpu>) -> Result<bool, RenderError> {
    let mut memory = Memory::new(Arc::clone(gpu), "trial", &Budget::default());
    let bytes = u64::from(TRIAL_WORDS) * 4;
    let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
    let words = memory.zeros("words", bytes, usage)?;
    let readback = memory.zeros("words read back", bytes, READBACK_USAGE)?;
    let runner = Runner::new(Arc::clone(gpu), &mut memory)?;
    let run = || {
        let kernel = Kernel::new(gpu, &TRIAL, &[])?;
        let bindings = kernel.bind(gpu, &[&words])?;
        let dispatch = Dispatch {
            kernel: &kernel,
            bindings: &bindings,
            workgroups: 1,
        };
        runner.run("trial", &[dispatch])?;
        let mut found = vec![0_u32; TRIAL_WORDS as usize];
        runner.fetch("trial", &words, &readback, bytes, |bytes| {
            bytemuck::cast_slice_mut(&mut found).copy_from_slice(bytes);
        })?;
        Ok(found)
    };
    let found = run().map_err(|error| memory.device_error(&error))?;
    Ok(found.into_iter().eq((0..TRIAL_WORDS).map(|i| 1234 + i)))
}

#[cfg(test)]
mod tests {
    use wgpu::DeviceType;

    use super::*;

    fn info(name: &str, device_type: DeviceType, backend: Backend) -> AdapterInfo {
        let mut info = AdapterInfo::new(device_type, backend);
        info.name = name.to_owned();
        info
    }

    /// The name of the adapter that is chosen when these are broken.
    fn chosen(broken: &[&str]) -> Result<String, DeviceError> {
        let adapters = [
            info("WARP", DeviceType::Cpu, Backend::Dx12),
            info("llvmpipe", DeviceType::Cpu, Backend::Vulkan),
            info("card, 12", DeviceType::DiscreteGpu, Backend::Dx12),
            info("chip", DeviceType::IntegratedGpu, Backend::Vulkan),
            info("card", DeviceType::DiscreteGpu, Backend::Vulkan),
        ];
        best(adapters, AdapterInfo::clone, |info| {
            match broken.contains(&info.name.as_str()) {
                true => Err("it is broken".to_owned()),
                false => Ok(info.name),
            }
        })
    }

    #[test]
    fn a_broken_adapter_gives_way_to_the_next() {
        let order = ["card", "card, 12", "chip", "llvmpipe", "WARP"];
        for (broken, next) in order.iter().enumerate() {
            assert_eq!(chosen(&order[..broken]).unwrap(), *next);
        }
        let Err(DeviceError::NotOpened { reasons }) = chosen(&order) else {
            panic!("all are broken");
        };
        assert!(reasons.starts_with("card (vulkan): it is broken; card, 12 (dx12): "));
        assert!(reasons.ends_with("WARP (dx12): it is broken"), "{reasons}");
        let none = best([], AdapterInfo::clone, |_| Ok(()));
        assert_eq!(none, Err(DeviceError::NoAdapter));
    }

    #[test]
    fn a_device_that_works_passes_the_trial_and_a_lost_one_fails() {
        let Ok(gpu) = Gpu::new() else { return };
        assert_eq!(trial(&gpu), Ok(true));
        gpu.lose();
        assert!(trial(&gpu).is_err());
    }

    #[test]
    fn a_window_takes_only_adapters_that_present() {
        with_adapters(|adapters| {
            let none = Gpu::choose(&adapters, |_| false);
            assert!(matches!(none, Err(DeviceError::NoAdapter)));
            assert_eq!(
                Gpu::choose(&adapters, |_| true).is_ok(),
                !adapters.is_empty()
            );
        });
    }
}
