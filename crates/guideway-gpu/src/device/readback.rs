//! Reads buffers back to the host through mappable ones.

use std::ops::Range;
use std::sync::mpsc::{Receiver, channel};

use wgpu::BufferUsages;

use super::error::DeviceError;
use super::gpu::{Gpu, TIMEOUT};
use super::memory::DeviceBuffer;

/// Usage of a buffer that the host reads back through.
pub const READBACK_USAGE: BufferUsages = BufferUsages::MAP_READ.union(BufferUsages::COPY_DST);

/// Bytes of a mappable buffer that a submission fills.
pub(super) struct PendingRead<'a> {
    what: &'static str,
    buffer: &'a DeviceBuffer,
    bytes: u64,
    submission: wgpu::SubmissionIndex,
    mapped: Receiver<Result<(), wgpu::BufferAsyncError>>,
}

impl<'a> PendingRead<'a> {
    /// Maps the first bytes of a buffer once a submission has ended.
    pub(super) fn of_submission(
        gpu: &Gpu,
        what: &'static str,
        buffer: &'a DeviceBuffer,
        bytes: u64,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Self, DeviceError> {
        let (sender, mapped) = channel();
        gpu.checked(what, || {
            let slice = buffer.raw().slice(..bytes);
            // Sending fails only if the read was abandoned.
            slice.map_async(wgpu::MapMode::Read, move |result| {
                drop(sender.send(result));
            });
        })?;
        Ok(Self {
            what,
            buffer,
            bytes,
            submission,
            mapped,
        })
    }

    /// Copies bytes of a buffer into a mappable one, and maps that.
    pub(super) fn of_buffer(
        gpu: &Gpu,
        what: &'static str,
        from: &DeviceBuffer,
        bytes: Range<u64>,
        through: &'a DeviceBuffer,
    ) -> Result<Self, DeviceError> {
        let count = bytes.end - bytes.start;
        let submission = gpu.checked(what, || {
            let descriptor = wgpu::CommandEncoderDescriptor { label: Some(what) };
            let mut encoder = gpu.device.create_command_encoder(&descriptor);
            encoder.copy_buffer_to_buffer(from.raw(), bytes.start, through.raw(), 0, count);
            gpu.queue.submit([encoder.finish()])
        })?;
        Self::of_submission(gpu, what, through, count, submission)
    }

    /// Waits for the bytes, and passes them to `take`.
    pub(super) fn finish(self, gpu: &Gpu, take: impl FnOnce(&[u8])) -> Result<(), DeviceError> {
        let failed = |message: String| DeviceError::Readback {
            operation: self.what.to_owned(),
            message,
        };
        gpu.wait(self.what, self.submission)?;
        // If another thread polled first, it may not have run the callback yet.
        match self.mapped.recv_timeout(TIMEOUT) {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(failed(error.to_string())),
            Err(_) => return Err(failed("the device does not answer".to_owned())),
        }
        let raw = self.buffer.raw();
        let view = raw.slice(..self.bytes).get_mapped_range();
        let view = view.map_err(|error| failed(error.to_string()))?;
        take(&view);
        drop(view);
        raw.unmap();
        Ok(())
    }
}
