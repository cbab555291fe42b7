//! Message bodies: reads the body of a message into recycled, aligned memory, except a deferred
//! range.

use std::ops::Range;

use arrow_array::ArrowNativeTypeOp;
use arrow_buffer::{Buffer, ScalarBuffer};

use super::problems::damaged;
use crate::Problem;
use crate::input::Input;

/// Element of body memory: values that are aligned in the file stay aligned in memory.
type Word = i128;
/// Alignment of bodies in bytes.
pub(super) const ALIGNMENT: usize = size_of::<Word>();

/// Pool of body memory. It reuses buffers, because fresh pages cost more than reading into them.
#[derive(Default)]
pub(super) struct BodyPool(Vec<Buffer>);

/// Body of a message, of which a range may be deferred: its bytes in memory are undefined.
pub(super) struct Body {
    bytes: Buffer,
    /// Offset in the input.
    at: usize,
    deferred: Range<usize>,
}

impl BodyPool {
    /// Reads a body, except the deferred range.
    pub(super) fn read(
        &mut self,
        input: &Input<'_>,
        at: Range<usize>,
        deferred: Range<usize>,
    ) -> Result<Body, Problem> {
        let mut words = self.take_unused();
        let needed = at.len().div_ceil(ALIGNMENT);
        if words.len() < needed {
            // A fresh allocation, not a resize, which would write all of it; untouched zero pages
            // take no memory.
            words = vec![0; needed + needed / 8];
        }
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut words);
        for part in [0..deferred.start, deferred.end..at.len()] {
            input.read(at.start + part.start, &mut bytes[part])?;
        }
        let all = Buffer::from_vec(words);
        self.0.push(all.clone());
        Ok(Body {
            bytes: all.slice_with_length(0, at.len()),
            at: at.start,
            deferred,
        })
    }

    /// Takes the memory of a body without references, or none.
    fn take_unused(&mut self) -> Vec<Word> {
        let unused = self.0.iter().position(|body| body.strong_count() == 1);
        let body = unused.map(|index| self.0.swap_remove(index));
        body.and_then(|body| body.into_vec().ok())
            .unwrap_or_default()
    }
}

impl Body {
    /// Returns the bytes.
    pub(super) fn bytes(&self) -> &Buffer {
        &self.bytes
    }

    /// Returns the offset in the input of values in the deferred range, or `None` if they were
    /// read.
    pub(super) fn deferred_offset<T: ArrowNativeTypeOp>(
        &self,
        values: &ScalarBuffer<T>,
    ) -> Result<Option<usize>, Problem> {
        if self.deferred.is_empty() || values.is_empty() {
            return Ok(None);
        }
        let values = values.inner();
        let start = (values.as_ptr() as usize).wrapping_sub(self.bytes.as_ptr() as usize);
        let end = start.wrapping_add(values.len());
        if start < self.deferred.start || end > self.deferred.end || end < start {
            let place = format!("body at byte {}", self.at);
            return Err(damaged(place, "the points are not in the declared buffer"));
        }
        Ok(Some(self.at + start))
    }
}
