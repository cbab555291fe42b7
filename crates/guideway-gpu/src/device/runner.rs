//! One submit at a time, and how long it took.

use std::ops::Range;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use guideway_scene::{Clock, RenderError, Stage, elapsed_ms};
use wgpu::BufferUsages;

use super::kernel::Bindings;
use super::{DeviceBuffer, Gpu, Kernel, Memory};

/// A device that takes longer than this for one submit is taken for dead.
const PATIENCE: Duration = Duration::from_secs(120);

/// Most stages of one submit.
const MOST_STAGES: usize = 12;
/// Bytes of the two ticks around each.
const TICKS_BYTES: u64 = (MOST_STAGES * 2) as u64 * wgpu::QUERY_SIZE as u64;

/// Submits work and waits for it, so that a caller may stop between two submits and none piles up.
pub struct Runner {
    gpu: Arc<Gpu>,
    clock: Option<DeviceClock>,
}

struct DeviceClock {
    tick_ns: f64,
    ticks: wgpu::QuerySet,
    resolved: DeviceBuffer,
    fetched: DeviceBuffer,
}

/// A kernel over so many workgroups.
pub struct Dispatch<'a> {
    /// The pipeline to run.
    pub kernel: &'a Kernel,
    /// Its buffers.
    pub bindings: &'a Bindings,
    /// Number of workgroups.
    pub workgroups: u32,
}

/// Bytes of a buffer that a submission fills.
struct Coming<'a> {
    buffer: &'a DeviceBuffer,
    bytes: u64,
    submission: wgpu::SubmissionIndex,
    answer: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl Runner {
    /// A runner on a device, with a clock where the device has one.
    ///
    /// # Errors
    /// When the clock's buffers do not fit the budget.
    pub fn new(gpu: Arc<Gpu>, memory: &mut Memory) -> Result<Self, RenderError> {
        let clock = match gpu.tick_ns {
            None => None,
            Some(tick_ns) => {
                let what = "the device's clock";
                let descriptor = wgpu::QuerySetDescriptor {
                    label: Some(what),
                    ty: wgpu::QueryType::Timestamp,
                    count: 2 * MOST_STAGES as u32,
                };
                let ticks = gpu.checked(what, || gpu.device.create_query_set(&descriptor));
                let resolve = BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC;
                Some(DeviceClock {
                    tick_ns,
                    ticks: ticks.map_err(|what| memory.trouble(what))?,
                    resolved: memory.zeros(what, TICKS_BYTES, resolve)?,
                    fetched: memory.zeros(what, TICKS_BYTES, FETCHED)?,
                })
            }
        };
        Ok(Self { gpu, clock })
    }

    /// A stage of so many milliseconds, by the clock that times what this runs.
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

    /// Sets a buffer that shaders read, from the next submit on.
    pub fn set<T: bytemuck::NoUninit>(
        &self,
        what: &'static str,
        buffer: &DeviceBuffer,
        value: &T,
    ) -> Result<(), String> {
        self.set_all(what, buffer, std::slice::from_ref(value))
    }

    /// As [`Self::set`], for the first of many values.
    pub fn set_all<T: bytemuck::NoUninit>(
        &self,
        what: &'static str,
        buffer: &DeviceBuffer,
        values: &[T],
    ) -> Result<(), String> {
        self.set_from(what, buffer, 0, values)
    }

    /// As [`Self::set_all`], for values behind a number of others.
    pub fn set_from<T: bytemuck::NoUninit>(
        &self,
        what: &'static str,
        buffer: &DeviceBuffer,
        others: u32,
        values: &[T],
    ) -> Result<(), String> {
        let offset = u64::from(others) * size_of::<T>() as u64;
        let bytes = bytemuck::cast_slice(values);
        self.gpu.checked(what, || {
            self.gpu.queue.write_buffer(buffer.raw(), offset, bytes);
        })
    }

    /// Submits dispatches without waiting for them: what is submitted later comes after them.
    pub fn start(&self, what: &'static str, dispatches: &[Dispatch<'_>]) -> Result<(), String> {
        self.gpu.checked(what, || {
            let mut encoder = self.encoder(what);
            self.encode(&mut encoder, what, dispatches, None);
            self.gpu.queue.submit([encoder.finish()]);
        })
    }

    /// Runs dispatches one after the other, each seeing what those before it wrote. Returns milliseconds.
    pub fn run(&self, what: &'static str, dispatches: &[Dispatch<'_>]) -> Result<f64, String> {
        let stages = self.run_stages(what, &[], &[(what, dispatches)])?;
        Ok(stages.iter().map(|stage| stage.elapsed_ms).sum())
    }

    /// Sets the first bytes of buffers to zero and runs stages of dispatches, all in one submit. Where there is no clock that
    /// tells the stages apart, the first one has the time of all.
    pub fn run_stages(
        &self,
        what: &'static str,
        cleared: &[(&DeviceBuffer, u64)],
        stages: &[(&'static str, &[Dispatch<'_>])],
    ) -> Result<Vec<Stage>, String> {
        debug_assert!(stages.len() <= MOST_STAGES, "{what}");
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
                let (resolved, fetched) = (clock.resolved.raw(), clock.fetched.raw());
                let ticks = 0..2 * stages.len() as u32;
                encoder.resolve_query_set(&clock.ticks, ticks, resolved, 0);
                encoder.copy_buffer_to_buffer(resolved, 0, fetched, 0, TICKS_BYTES);
            }
            self.gpu.queue.submit([encoder.finish()])
        })?;
        let mut spans_ms = vec![0.0; stages.len()];
        match &self.clock {
            None => {
                self.wait(what, submission)?;
                if let Some(first) = spans_ms.first_mut() {
                    *first = elapsed_ms(start);
                }
            }
            Some(clock) => {
                let mut ticks = [[0_u64; 2]; MOST_STAGES];
                let coming = self.coming(what, &clock.fetched, TICKS_BYTES, submission)?;
                self.arrive(what, coming, |bytes| {
                    bytemuck::bytes_of_mut(&mut ticks).copy_from_slice(bytes);
                })?;
                for (span_ms, [begin, end]) in spans_ms.iter_mut().zip(ticks) {
                    *span_ms = end.saturating_sub(begin) as f64 * clock.tick_ns * 1e-6;
                }
            }
        }
        let named = stages.iter().zip(spans_ms);
        Ok(named.map(|((name, _), ms)| self.stage(name, ms)).collect())
    }

    fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        name: &str,
        dispatches: &[Dispatch<'_>],
        timed: Option<u32>,
    ) {
        let clock = self.clock.as_ref().zip(timed);
        let timestamp_writes = clock.map(|(clock, stage)| wgpu::ComputePassTimestampWrites {
            query_set: &clock.ticks,
            beginning_of_pass_write_index: Some(2 * stage),
            end_of_pass_write_index: Some(2 * stage + 1),
        });
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(name),
            timestamp_writes,
        });
        let limits = self.gpu.device.limits();
        let side = limits.max_compute_workgroups_per_dimension;
        for dispatch in dispatches.iter().filter(|d| d.workgroups > 0) {
            pass.set_pipeline(&dispatch.kernel.pipeline);
            pass.set_bind_group(0, &dispatch.bindings.0, &[]);
            let columns = dispatch.workgroups.min(side);
            pass.dispatch_workgroups(columns, dispatch.workgroups.div_ceil(columns), 1);
        }
    }

    /// Fetches the first `bytes` of a buffer, by way of one that can be mapped.
    pub fn fetch(
        &self,
        what: &'static str,
        from: &DeviceBuffer,
        through: &DeviceBuffer,
        bytes: u64,
        take: impl FnOnce(&[u8]),
    ) -> Result<(), String> {
        let coming = self.send_for(what, from, 0..bytes, through)?;
        self.arrive(what, coming, take)
    }

    /// The same by way of smaller ones in turn: while a part is taken, the next is under way.
    pub fn fetch_in_parts(
        &self,
        what: &'static str,
        from: &DeviceBuffer,
        through: &[DeviceBuffer],
        bytes: u64,
        mut take: impl FnMut(&[u8]),
    ) -> Result<(), String> {
        let mut under_way = None;
        let mut start = 0;
        for through in through.iter().cycle() {
            let end = bytes.min(start + through.bytes());
            let next = if start < end {
                Some(self.send_for(what, from, start..end, through)?)
            } else {
                None
            };
            let is_last = next.is_none() || end == bytes;
            if let Some(coming) = std::mem::replace(&mut under_way, next) {
                self.arrive(what, coming, &mut take)?;
            }
            if is_last {
                break;
            }
            start = end;
        }
        match under_way {
            Some(coming) => self.arrive(what, coming, take),
            None => Ok(()),
        }
    }

    /// Has bytes of a buffer copied into one that can be mapped.
    fn send_for<'a>(
        &self,
        what: &'static str,
        from: &DeviceBuffer,
        bytes: Range<u64>,
        through: &'a DeviceBuffer,
    ) -> Result<Coming<'a>, String> {
        let count = bytes.end - bytes.start;
        let submission = self.gpu.checked(what, || {
            let mut encoder = self.encoder(what);
            encoder.copy_buffer_to_buffer(from.raw(), bytes.start, through.raw(), 0, count);
            self.gpu.queue.submit([encoder.finish()])
        })?;
        self.coming(what, through, count, submission)
    }

    fn encoder(&self, what: &'static str) -> wgpu::CommandEncoder {
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some(what) };
        self.gpu.device.create_command_encoder(&descriptor)
    }

    /// Bytes of a buffer that are there once a submission is through.
    fn coming<'a>(
        &self,
        what: &'static str,
        buffer: &'a DeviceBuffer,
        bytes: u64,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Coming<'a>, String> {
        let (sender, answer) = channel();
        self.gpu.checked(what, || {
            let slice = buffer.raw().slice(..bytes);
            // The receiver waits for it; if it is gone, nobody wants to know.
            slice.map_async(wgpu::MapMode::Read, move |mapped| drop(sender.send(mapped)));
        })?;
        Ok(Coming {
            buffer,
            bytes,
            submission,
            answer,
        })
    }

    /// Waits for bytes and shows them.
    fn arrive(
        &self,
        what: &'static str,
        coming: Coming<'_>,
        take: impl FnOnce(&[u8]),
    ) -> Result<(), String> {
        self.wait(what, coming.submission)?;
        // If another thread polled first, it may still be on its way to the answer.
        match coming.answer.recv_timeout(PATIENCE) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(format!("{what} cannot be read back: {error}")),
            Err(_) => {
                return Err(format!(
                    "{what} cannot be read back: the device does not answer"
                ));
            }
        }
        let raw = coming.buffer.raw();
        let view = raw.slice(..coming.bytes).get_mapped_range();
        let view = view.map_err(|error| format!("{what} cannot be read back: {error}"))?;
        take(&view);
        drop(view);
        raw.unmap();
        Ok(())
    }

    fn wait(&self, what: &str, submission: wgpu::SubmissionIndex) -> Result<(), String> {
        let waited = self.gpu.device.poll(wgpu::PollType::Wait {
            submission_index: Some(submission),
            timeout: Some(PATIENCE),
        });
        self.gpu.check_alive()?;
        match waited {
            Ok(_) => Ok(()),
            Err(wgpu::PollError::Timeout) => Err(format!(
                "{what} did not end within {} s; draw fewer paths, or by another method",
                PATIENCE.as_secs()
            )),
            Err(error) => Err(self.gpu.root_of(format!("{what}: {error}"))),
        }
    }
}

/// How a buffer that can be mapped is used.
pub const FETCHED: BufferUsages = BufferUsages::MAP_READ.union(BufferUsages::COPY_DST);
