//! The open device: limits, error scopes, and waiting for submissions.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use wgpu::{DeviceType, ErrorFilter};

use super::adapter;
use super::error::DeviceError;
use super::options::GpuOptions;

/// Lower bound of `loops_per_thread`: the loops over one row of grid cells need as many.
const MIN_LOOPS: u32 = 4096;
/// Longest wait for one submission; a device that takes longer counts as hung.
pub(super) const TIMEOUT: Duration = Duration::from_secs(120);

/// An open graphics device.
#[derive(Debug)]
pub struct Gpu {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    info: wgpu::AdapterInfo,
    options: GpuOptions,
    /// Nanoseconds per tick of the device's clock; `None` without timestamp queries.
    tick_ns: Option<f64>,
    /// The first failure outside of any operation that could report it.
    failure: Arc<Mutex<Option<String>>>,
}

impl Gpu {
    /// Uses a device that the caller opened and draws on too. Its limits and features should be
    /// those of [`Self::descriptor`].
    pub fn shared(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Arc<Self> {
        Self::of(adapter, device, queue, GpuOptions::default())
    }

    /// The limits and features of an adapter that methods use.
    pub fn descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
        adapter::descriptor_for(adapter, GpuOptions::default())
    }

    /// An open device with artificial limits.
    pub(super) fn of(
        adapter: &wgpu::Adapter,
        device: wgpu::Device,
        queue: wgpu::Queue,
        options: GpuOptions,
    ) -> Arc<Self> {
        let failure = Arc::new(Mutex::new(None));
        let recorder = |failure: &Arc<Mutex<Option<String>>>| {
            let failure = Arc::clone(failure);
            move |reason: String| {
                let mut first = failure.lock().unwrap_or_else(PoisonError::into_inner);
                first.get_or_insert(reason);
            }
        };
        let (lost, uncaptured) = (recorder(&failure), recorder(&failure));
        device.set_device_lost_callback(move |_, message| {
            lost(format!("the device was lost: {message}"));
        });
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            uncaptured(error.to_string());
        }));
        let has_timestamps = device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let tick_ns = has_timestamps.then(|| f64::from(queue.get_timestamp_period()));
        Arc::new(Self {
            info: adapter.get_info(),
            device,
            queue,
            options,
            tick_ns,
            failure,
        })
    }

    /// Name of the adapter and its driver, for reports.
    pub fn adapter_name(&self) -> String {
        format!("{} ({})", self.info.name, adapter::driver(&self.info))
    }

    /// The device itself.
    pub fn device(&self) -> &wgpu::Device {
        &self.device
    }

    /// Returns `true` after a failure that no operation could report, such as the loss of the
    /// device: every operation fails from then on.
    pub fn is_lost(&self) -> bool {
        // The poll runs the callbacks that record a loss.
        drop(self.device.poll(wgpu::PollType::Poll));
        self.check_alive().is_err()
    }

    /// Returns `true` if the device is a program on the processor.
    pub fn is_software(&self) -> bool {
        self.info.device_type == DeviceType::Cpu
    }

    /// Nanoseconds per tick of the device's clock; `None` without timestamp queries.
    pub(super) fn tick_ns(&self) -> Option<f64> {
        self.tick_ns
    }

    /// Greatest number of threads per subgroup; `None` without subgroup operations.
    pub fn max_subgroup_size(&self) -> Option<u32> {
        let has_subgroups = self.device.features().contains(wgpu::Features::SUBGROUP);
        has_subgroups.then_some(self.info.subgroup_max_size)
    }

    /// The limits that the device was opened with.
    pub fn options(&self) -> GpuOptions {
        self.options
    }

    /// Names and values of the limits and features that decide how methods draw.
    pub fn limits(&self) -> Vec<(String, String)> {
        let limits = self.device.limits();
        let features = self.device.features();
        let mebibytes = |bytes: u64| format!("{} MiB", bytes >> 20);
        let subgroups = match features.contains(wgpu::Features::SUBGROUP) {
            true => format!(
                "{} to {} threads",
                self.info.subgroup_min_size, self.info.subgroup_max_size
            ),
            false => "none".to_owned(),
        };
        let has_timestamps = features.contains(wgpu::Features::TIMESTAMP_QUERY);
        let has_timestamps = if has_timestamps { "yes" } else { "no" };
        let facts = [
            ("Kind of device", format!("{:?}", self.info.device_type)),
            ("Graphics interface", self.info.backend.to_string()),
            (
                "Bytes that a shader binds",
                mebibytes(self.max_binding_bytes()),
            ),
            (
                "Buffers per shader",
                limits.max_storage_buffers_per_shader_stage.to_string(),
            ),
            (
                "Threads per workgroup",
                limits.max_compute_invocations_per_workgroup.to_string(),
            ),
            (
                "Bytes per workgroup",
                limits.max_compute_workgroup_storage_size.to_string(),
            ),
            ("Subgroups", subgroups),
            ("Clock of the device", has_timestamps.to_owned()),
        ];
        facts.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }

    /// Most storage buffers per shader.
    pub fn max_storage_bindings(&self) -> u32 {
        self.device.limits().max_storage_buffers_per_shader_stage
    }

    /// Most bytes of a buffer that a shader may bind.
    pub fn max_binding_bytes(&self) -> u64 {
        let limits = self.device.limits();
        limits
            .max_storage_buffer_binding_size
            .min(limits.max_buffer_size)
    }

    /// Most workgroups per dispatch, in rows as long as one dimension allows.
    pub fn max_workgroups(&self) -> u32 {
        let side = self.max_workgroup_columns();
        side.saturating_mul(side)
    }

    /// Most workgroups along one dimension of a dispatch.
    pub(super) fn max_workgroup_columns(&self) -> u32 {
        self.device.limits().max_compute_workgroups_per_dimension
    }

    /// Number of distance tests, or work of that size, that a slow device of this kind does in
    /// about 100 ms: the size of one submission that leaves the computer usable.
    pub fn tests_per_submit(&self) -> u64 {
        match self.info.device_type {
            DeviceType::DiscreteGpu => 20_000_000_000,
            DeviceType::IntegratedGpu | DeviceType::VirtualGpu | DeviceType::Other => 2_000_000_000,
            DeviceType::Cpu => 20_000_000,
        }
    }

    /// Most loop iterations per thread, all loops together.
    pub fn loops_per_thread(&self) -> u32 {
        let safe = if self.is_software() {
            // Mesa's llvmpipe silently leaves every loop at iteration 65,535
            // (`LP_MAX_TGSI_LOOP_ITERATIONS`).
            64_000
        } else {
            // Derived: about 0.1 s if each iteration waits for memory.
            1 << 22
        };
        let limit = self.options.loops_per_thread.unwrap_or(safe);
        limit.clamp(MIN_LOOPS, safe)
    }

    /// Runs an operation within error scopes. Returns its result, or its first error.
    pub(crate) fn checked<R>(
        &self,
        operation: &str,
        run: impl FnOnce() -> R,
    ) -> Result<R, DeviceError> {
        let filters = [
            ErrorFilter::Validation,
            ErrorFilter::OutOfMemory,
            ErrorFilter::Internal,
        ];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let result = run();
        let errors: Vec<_> = scopes
            .into_iter()
            .rev()
            .filter_map(|scope| pollster::block_on(scope.pop()))
            .collect();
        self.check_alive()?;
        let operation = operation.to_owned();
        match errors.first() {
            None => Ok(result),
            Some(wgpu::Error::OutOfMemory { .. }) => {
                Err(self.root_cause(DeviceError::OutOfMemory { operation }))
            }
            Some(error) => {
                let message = error.to_string();
                Err(self.root_cause(DeviceError::Rejected { operation, message }))
            }
        }
    }

    /// Waits for a submission.
    pub(super) fn wait(
        &self,
        operation: &str,
        submission: wgpu::SubmissionIndex,
    ) -> Result<(), DeviceError> {
        let waited = self.device.poll(wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(TIMEOUT),
        });
        self.check_alive()?;
        let operation = operation.to_owned();
        match waited {
            Ok(_) => Ok(()),
            Err(wgpu::PollError::Timeout) => Err(DeviceError::Timeout {
                operation,
                seconds: TIMEOUT.as_secs(),
            }),
            Err(error) => {
                let message = error.to_string();
                Err(self.root_cause(DeviceError::Rejected { operation, message }))
            }
        }
    }

    /// Replaces an error by the loss of the device, if it was lost without having reported it yet.
    fn root_cause(&self, error: DeviceError) -> DeviceError {
        // The poll runs the callbacks that record a loss.
        drop(self.device.poll(wgpu::PollType::Poll));
        self.check_alive().err().unwrap_or(error)
    }

    fn check_alive(&self) -> Result<(), DeviceError> {
        let failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
        match failure.as_ref() {
            None => Ok(()),
            Some(reason) => Err(DeviceError::Lost {
                reason: reason.clone(),
            }),
        }
    }

    /// Submits commands of a test.
    #[cfg(test)]
    pub(crate) fn submit(&self, commands: wgpu::CommandBuffer) {
        self.queue.submit([commands]);
    }

    /// Destroys the device, as a driver crash does.
    #[cfg(any(test, feature = "testing"))]
    pub fn lose(&self) {
        self.device.destroy();
    }
}
