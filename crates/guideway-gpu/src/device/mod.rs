//! The device: found once, shared by methods, and never trusted to succeed.

mod adapter;
mod kernel;
mod memory;
mod patch;
mod runner;

use std::sync::{Arc, Mutex, PoisonError};

use wgpu::{DeviceType, ErrorFilter};

pub use kernel::{Bindings, Kernel, Source};
pub use memory::{DeviceBuffer, Held, Memory};
pub(crate) use patch::{Patch, Patcher};
pub use runner::{Dispatch, FETCHED, Runner};

/// What a device is asked to do with less than it could: for tests, and to stand in for a weaker one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GpuOptions {
    /// Most bytes that a shader may see of one buffer; the adapter's own limit if none.
    pub storage_binding_bytes: Option<u32>,
    /// Most workgroups along one dimension of a dispatch; the adapter's own limit if none.
    pub workgroups_per_dimension: Option<u32>,
    /// Most times that a thread goes round its loops; as many as are safe if none.
    pub rounds_a_thread: Option<u32>,
    /// Longest list of a tile that one workgroup covers where several may; as long as it should be if none.
    pub longest_alone: Option<u32>,
    /// Have every access of a shader checked while it runs.
    pub has_checked_shaders: bool,
    /// Do not use the device's clock, as if it had none.
    pub without_clock: bool,
    /// Do not let threads see each other's values (subgroups), as if they could not.
    pub without_lanes: bool,
    /// Run on a processor what is made for graphics hardware.
    pub as_hardware: bool,
}

/// Fewer rounds than this would not do for the loops of one row of cells.
const LEAST_ROUNDS: u32 = 4096;

/// A graphics device without a window.
#[derive(Debug)]
pub struct Gpu {
    device: wgpu::Device,
    queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    options: GpuOptions,
    /// Nanoseconds a tick of the device's clock; none if it has no clock that can be read.
    tick_ns: Option<f64>,
    /// The first thing that went wrong outside of any call that could report it.
    trouble: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// The best adapter of this computer: one in hardware if there is any.
    ///
    /// # Errors
    /// A sentence on what is missing and what to install.
    pub fn new() -> Result<Arc<Self>, String> {
        Self::with_options(GpuOptions::default())
    }

    /// As [`Self::new`], with limits of its own.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_options(options: GpuOptions) -> Result<Arc<Self>, String> {
        let (adapter, device, queue) = adapter::open(options)?;
        let trouble = Arc::new(Mutex::new(None));
        let note = |trouble: &Arc<Mutex<Option<String>>>| {
            let trouble = Arc::clone(trouble);
            move |what: String| {
                let mut first = trouble.lock().unwrap_or_else(PoisonError::into_inner);
                first.get_or_insert(what);
            }
        };
        let (lost, uncaptured) = (note(&trouble), note(&trouble));
        device.set_device_lost_callback(move |_, message| {
            lost(format!("the device was lost: {message}"));
        });
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            uncaptured(error.to_string());
        }));
        let has_clock = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let tick_ns = has_clock.then(|| f64::from(queue.get_timestamp_period()));
        Ok(Arc::new(Self {
            info: adapter.get_info(),
            device,
            queue,
            options,
            tick_ns,
            trouble,
        }))
    }

    /// The adapter and its driver, for reports.
    pub fn adapter_name(&self) -> String {
        let driver = format!("{} {}", self.info.driver, self.info.driver_info);
        format!("{} ({})", self.info.name, driver.trim())
    }

    /// Whether the device is a program on the processor.
    pub fn is_software(&self) -> bool {
        self.info.device_type == DeviceType::Cpu
    }

    /// How many threads at most run in step and see each other's values; none if they do not.
    pub fn most_lanes(&self) -> Option<u32> {
        let has_lanes = self.device.features().contains(wgpu::Features::SUBGROUP);
        has_lanes.then_some(self.info.subgroup_max_size)
    }

    /// How many threads run in step, always as many, where the device is a processor: there each thread that waits for others,
    /// and each operation on memory that they share, takes long.
    pub fn processor_lanes(&self) -> Option<u32> {
        let (least, most) = (self.info.subgroup_min_size, self.most_lanes()?);
        let is_meant = self.is_software() && !self.options.as_hardware && least == most;
        is_meant.then_some(most)
    }

    /// The limits that the device was opened with.
    pub fn options(&self) -> GpuOptions {
        self.options
    }

    /// Most buffers of storage that a shader may see.
    pub fn storage_bindings(&self) -> u32 {
        self.device.limits().max_storage_buffers_per_shader_stage
    }

    /// Most bytes that a shader may see of one buffer.
    pub fn binding_bytes(&self) -> u64 {
        let limits = self.device.limits();
        limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size)
    }

    /// Most workgroups of one dispatch, in rows of as many as fit one dimension.
    pub fn most_workgroups(&self) -> u32 {
        let side = self.device.limits().max_compute_workgroups_per_dimension;
        side.saturating_mul(side)
    }

    /// How many distance tests, or work of that size, a device of this kind does in about 100 ms even if
    /// it is a slow one: what is submitted at a time, so that the computer stays usable.
    pub fn tests_a_submit(&self) -> u64 {
        match self.info.device_type {
            DeviceType::DiscreteGpu => 20_000_000_000,
            DeviceType::IntegratedGpu | DeviceType::VirtualGpu | DeviceType::Other => 2_000_000_000,
            DeviceType::Cpu => 20_000_000,
        }
    }

    /// Most times that a thread may go round its loops, all loops together.
    pub fn rounds_a_thread(&self) -> u32 {
        let safe = if self.is_software() {
            // Mesa's llvmpipe leaves every loop of a thread at round 65,535, without a word
            // (`LP_MAX_TGSI_LOOP_ITERATIONS`).
            64_000
        } else {
            // About a tenth of a second, if each round waits for memory.
            1 << 22
        };
        let asked = self.options.rounds_a_thread.unwrap_or(safe);
        asked.clamp(LEAST_ROUNDS, safe)
    }

    /// Does what may fail on the device.
    fn checked<R>(&self, what: &str, work: impl FnOnce() -> R) -> Result<R, String> {
        let filters = [
            ErrorFilter::Validation,
            ErrorFilter::OutOfMemory,
            ErrorFilter::Internal,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let result = work();
        let errors: Vec<_> = scopes
            .into_iter()
            .rev()
            .filter_map(|scope| pollster::block_on(scope.pop()))
            .collect();
        self.check_alive()?;
        match errors.first() {
            None => Ok(result),
            Some(wgpu::Error::OutOfMemory { .. }) => Err(self.root_of(format!(
                "there is no memory left for {what}; close other programs or draw fewer paths"
            ))),
            Some(error) => Err(self.root_of(format!("{what}: {error}"))),
        }
    }

    /// Why something failed: because the device is lost, if it is; it may have had no occasion to say so.
    fn root_of(&self, failure: String) -> String {
        // What the poll finds is told to the callbacks, and asked for below.
        drop(self.device.poll(wgpu::PollType::Poll));
        self.check_alive().err().unwrap_or(failure)
    }

    fn check_alive(&self) -> Result<(), String> {
        let trouble = self.trouble.lock().unwrap_or_else(PoisonError::into_inner);
        trouble.as_ref().map_or(Ok(()), |what| {
            Err(format!(
                "{what}; start again, and update the driver if it happens again"
            ))
        })
    }

    /// Takes the device away, as a driver that crashed does.
    #[cfg(any(test, feature = "testing"))]
    pub fn lose(&self) {
        self.device.destroy();
    }
}

#[cfg(test)]
mod tests;
