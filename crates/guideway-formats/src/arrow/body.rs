use std::ops::Range;

use arrow_array::ArrowNativeTypeOp;
use arrow_buffer::{Buffer, ScalarBuffer};

use super::guard::damaged;
use crate::Problem;
use crate::input::Input;

/// What bodies are made of, so that any value is aligned that is aligned in the file.
type Word = i128;
pub(super) const ALIGNMENT: usize = size_of::<Word>();

/// Memory of bodies that is used again and again: new memory costs more than to read what it is for.
#[derive(Default)]
pub(super) struct Bodies(Vec<Buffer>);

/// What follows the head of a message, where a part may have been left out.
pub(super) struct Body {
    bytes: Buffer,
    /// Where it begins in the input.
    at: usize,
    left_out: Range<usize>,
}

impl Bodies {
    /// Reads a body, but for a part of it, in whose place is anything.
    pub(super) fn read(
        &mut self,
        input: &Input<'_>,
        at: Range<usize>,
        left_out: Range<usize>,
    ) -> Result<Body, Problem> {
        let mut words = self.free();
        let needed = at.len().div_ceil(ALIGNMENT);
        if words.len() < needed {
            // Not made longer, for that would write to all of it; zeros nobody looks at take no memory.
            words = vec![0; needed + needed / 8];
        }
        let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut words);
        for part in [0..left_out.start, left_out.end..at.len()] {
            input.read(at.start + part.start, &mut bytes[part])?;
        }
        let all = Buffer::from_vec(words);
        self.0.push(all.clone());
        Ok(Body {
            bytes: all.slice_with_length(0, at.len()),
            at: at.start,
            left_out,
        })
    }

    /// The memory of a body of which nothing is held any more.
    fn free(&mut self) -> Vec<Word> {
        let free = self.0.iter().position(|body| body.strong_count() == 1);
        let body = free.map(|free| self.0.swap_remove(free));
        body.and_then(|body| body.into_vec().ok())
            .unwrap_or_default()
    }
}

impl Body {
    pub(super) fn bytes(&self) -> &Buffer {
        &self.bytes
    }

    /// Where in the input some values of it lie that were left out; nowhere if they were not.
    pub(super) fn left_out<T: ArrowNativeTypeOp>(
        &self,
        values: &ScalarBuffer<T>,
    ) -> Result<Option<usize>, Problem> {
        if self.left_out.is_empty() || values.is_empty() {
            return Ok(None);
        }
        let values = values.inner();
        let start = (values.as_ptr() as usize).wrapping_sub(self.bytes.as_ptr() as usize);
        let end = start.wrapping_add(values.len());
        if start < self.left_out.start || end > self.left_out.end || end < start {
            let place = format!("body at byte {}", self.at);
            return Err(damaged(place, "the points are not where its head says"));
        }
        Ok(Some(self.at + start))
    }
}
