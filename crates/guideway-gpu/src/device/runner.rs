//! Submits dispatches one submission at a time, and times their stages.

use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{Clock, RenderError, Stage, elapsed_ms};
use wgpu::BufferUsages;

use super::error::DeviceError;
use super::gpu::Gpu;
use super::kernel::{Bindings, Kernel};
use super::memory::{DeviceBuffer, Memory};
use super::readback::{PendingRead, READBACK_USAGE};

/// Most stages per submission.
const MAX_STAGES: usize = 12;
/// Bytes of two timestamps per stage: its begin and its end.
const TIMESTAMP_BYTES: u64 = (MAX_STAGES * 2) as u64 * wgpu::QUERY_SIZE as u64;

/// Submits work and waits for it, so that callers can cancel between two submissions.
pub struct Runner {
    gpu: Arc<Gpu>,
    clock: Option<DeviceClock>,
}

struct DeviceClock {
    tick_ns: f64,
    timestamps: wgpu::QuerySet,
    resolved: DeviceBuffer,
    readback: DeviceBuffer,
}

/// One dispatch of a kernel.
pub struct Dispatch<'a> {
    /// The pipeline to run.
    pub kernel: &'a Kernel,
    /// Its buffers.
    pub bindings: &'a Bindings,
    /// Number of workgroups.
    pub workgroups: u32,
}

impl Runner {
    /// Creates a runner, with a clock if the device has timestamp queries.
    ///
    /// # Errors
    /// [`RenderError::Budget`] if the clock's buffers exceed the budget; any error of the device.
    pub fn new(gpu: Arc<Gpu>, memory: &mut Memory) -> Result<Self, RenderError> {
        let clock = match gpu.tick_ns() {
            None => None,
            Some(tick_ns) => {
                let what = "the device's clock";
                let descriptor = wgpu::QuerySetDescriptor {
                    label: Some(what),
                    ty: wgpu::QueryType::Timestamp,
                    count: 2 * MAX_STAGES as u32,
                };
                let created = gpu.checked(what, || gpu.device.create_query_set(&descriptor));
                let resolve = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
                Some(DeviceClock {
                    tick_ns,
                    timestamps: created.map_err(|error| memory.device_error(&error))?,
                    resolved: memory.zeros(what, TIMESTAMP_BYTES, resolve)?,
                    readback: memory.zeros(what, TIMESTAMP_BYTES, READBACK_USAGE)?,
                })
            }
        };
        Ok(Self { gpu, clock })
    }

    /// A stage of `elapsed_ms` milliseconds by the clock that times this runner's dispatches.
    pub fn stage(&self, name: &'static str, elapsed_ms: f64) -> Stage {
        let clock = match self.clock {
            Some(_) => Clock::Device,
            None => Clock::Host,
        };
        Stage {
            name,
            elapsed_ms,
            clock,
        }
    }

    /// Writes a value to the start of a buffer, before the next submission.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn write<T: bytemuck::NoUninit>(
        &self,
        what: &'static str,
        buffer: &DeviceBuffer,
        value: &T,
    ) -> Result<(), DeviceError> {
        self.write_at(what, buffer, 0, std::slice::from_ref(value))
    }

    /// Writes values to a buffer from index `first` on, before the next submission.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn write_at<T: bytemuck::NoUninit>(
        &self,
        what: &'static str,
        buffer: &DeviceBuffer,
        first: u32,
        values: &[T],
    ) -> Result<(), DeviceError> {
        let offset = u64::from(first) * size_of::<T>() as u64;
        let parts = [bytemuck::cast_slice(values)];
        self.gpu.write_parts(what, buffer.raw(), offset, &parts)
    }

    /// Writes parts back to back from the start of a buffer, before the next submission.
    /// Threads share the work.
    ///
    /// # Errors
    /// Any error of the device.
    pub(crate) fn write_parts(
        &self,
        what: &'static str,
        buffer: &DeviceBuffer,
        parts: &[&[u32]],
    ) -> Result<(), DeviceError> {
        let parts: Vec<&[u8]> = parts
            .iter()
            .map(|part| bytemuck::cast_slice(part))
            .collect();
        self.gpu.write_parts(what, buffer.raw(), 0, &parts)
    }

    /// Submits dispatches without waiting. Later submissions run after them.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn start(
        &self,
        what: &'static str,
        dispatches: &[Dispatch<'_>],
    ) -> Result<(), DeviceError> {
        self.gpu.checked(what, || {
            let mut encoder = self.encoder(what);
            self.encode(&mut encoder, what, dispatches, None);
            self.gpu.queue.submit([encoder.finish()]);
        })
    }

    /// Runs dispatches in order, each after the writes of those before. Returns milliseconds.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn run(&self, what: &'static str, dispatches: &[Dispatch<'_>]) -> Result<f64, DeviceError> {
        let stages = self.run_stages(what, &[], &[(what, dispatches)])?;
        Ok(stages.iter().map(|stage| stage.elapsed_ms).sum())
    }

    /// Clears the first bytes of buffers and runs stages of dispatches, all in one submission.
    /// Without a device clock the first stage gets the time of all.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn run_stages(
        &self,
        what: &'static str,
        cleared: &[(&DeviceBuffer, u64)],
        stages: &[(&'static str, &[Dispatch<'_>])],
    ) -> Result<Vec<Stage>, DeviceError> {
        debug_assert!(stages.len() <= MAX_STAGES, "{what}");
        let start = Instant::now();
        let submission = self.gpu.checked(what, || {
            let mut encoder = self.encoder(what);
            for (buffer, bytes) in cleared {
                encoder.clear_buffer(buffer.raw(), 0, Some(*bytes));
            }
            for ((name, dispatches), stage) in stages.iter().zip(0..) {
                self.encode(&mut encoder, name, dispatches, Some(stage));
            }
            if let Some(clock) = &self.clock {
                let (resolved, readback) = (clock.resolved.raw(), clock.readback.raw());
                let queries = 0..2 * stages.len() as u32;
                encoder.resolve_query_set(&clock.timestamps, queries, resolved, 0);
                encoder.copy_buffer_to_buffer(resolved, 0, readback, 0, TIMESTAMP_BYTES);
            }
            self.gpu.queue.submit([encoder.finish()])
        })?;
        let mut spans_ms = vec![0.0; stages.len()];
        match &self.clock {
            None => {
                self.gpu.wait(what, submission)?;
                if let Some(first) = spans_ms.first_mut() {
                    *first = elapsed_ms(start);
                }
            }
            Some(clock) => {
                let mut ticks = [[0_u64; 2]; MAX_STAGES];
                let buffer = &clock.readback;
                let bytes = TIMESTAMP_BYTES;
                PendingRead::of_submission(&self.gpu, what, buffer, bytes, submission)?.finish(
                    &self.gpu,
                    |bytes| {
                        bytemuck::bytes_of_mut(&mut ticks).copy_from_slice(bytes);
                    },
                )?;
                for (span_ms, [begin, end]) in spans_ms.iter_mut().zip(ticks) {
                    *span_ms = end.saturating_sub(begin) as f64 * clock.tick_ns * 1e-6;
                }
            }
        }
        let named = stages.iter().zip(spans_ms);
        Ok(named.map(|((name, _), ms)| self.stage(name, ms)).collect())
    }

    fn encoder(&self, what: &'static str) -> wgpu::CommandEncoder {
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some(what) };
        self.gpu.device.create_command_encoder(&descriptor)
    }

    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        name: &str,
        dispatches: &[Dispatch<'_>],
        timed_stage: Option<u32>,
    ) {
        let clock = self.clock.as_ref().zip(timed_stage);
        let timestamp_writes = clock.map(|(clock, stage)| wgpu::ComputePassTimestampWrites {
            query_set: &clock.timestamps,
            beginning_of_pass_write_index: Some(2 * stage),
            end_of_pass_write_index: Some(2 * stage + 1),
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(name),
            timestamp_writes,
        });
        let side = self.gpu.max_workgroup_columns();
        for dispatch in dispatches.iter().filter(|d| d.workgroups > 0) {
            pass.set_pipeline(&dispatch.kernel.pipeline);
            pass.set_bind_group(0, &dispatch.bindings.0, &[]);
            let columns = dispatch.workgroups.min(side);
            pass.dispatch_workgroups(columns, dispatch.workgroups.div_ceil(columns), 1);
        }
    }

    /// Reads the first `bytes` of a buffer back through a mappable one.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn fetch(
        &self,
        what: &'static str,
        from: &DeviceBuffer,
        through: &DeviceBuffer,
        bytes: u64,
        take: impl FnOnce(&[u8]),
    ) -> Result<(), DeviceError> {
        PendingRead::of_buffer(&self.gpu, what, from, 0..bytes, through)?.finish(&self.gpu, take)
    }

    /// Reads the first `bytes` of a buffer back through smaller ones in turn: `take` runs while the
    /// next part is copied.
    ///
    /// # Errors
    /// Any error of the device.
    pub fn fetch_in_parts(
        &self,
        what: &'static str,
        from: &DeviceBuffer,
        through: &[DeviceBuffer],
        bytes: u64,
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), DeviceError> {
        let mut pending = None;
        let mut start = 0;
        for through in through.iter().cycle() {
            let end = bytes.min(start + through.bytes());
            let next = if start < end {
                let part = start..end;
                Some(PendingRead::of_buffer(
                    &self.gpu, what, from, part, through,
                )?)
            } else {
                None
            };
            let is_last = next.is_none() || end == bytes;
            if let Some(read) = std::mem::replace(&mut pending, next) {
                read.finish(&self.gpu, &mut take)?;
            }
            if is_last {
                break;
            }
            start = end;
        }
        match pending {
            Some(read) => read.finish(&self.gpu, take),
            None => Ok(()),
        }
    }
}
