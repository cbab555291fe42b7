//! Buffers of control points in one precision, and ranges within lists of end indices.

use std::ops::Range;

use guideway_spline::Point;

/// Control points in the precision of their source.
#[derive(Clone, Debug)]
pub(super) enum Points {
    F64(Vec<Point<f64>>),
    F32(Vec<Point<f32>>),
}

impl Points {
    pub(super) fn len(&self) -> usize {
        match self {
            Self::F64(p) => p.len(),
            Self::F32(p) => p.len(),
        }
    }

    /// No points, in the same precision.
    pub(super) fn empty_like(&self) -> Self {
        match self {
            Self::F64(_) => Self::F64(Vec::new()),
            Self::F32(_) => Self::F32(Vec::new()),
        }
    }

    /// Points at zero, in the same precision.
    pub(super) fn zeros_like(&self, count: usize) -> Self {
        match self {
            Self::F64(_) => Self::F64(vec![Point::default(); count]),
            Self::F32(_) => Self::F32(vec![Point::default(); count]),
        }
    }

    pub(super) fn heap_bytes(&self) -> usize {
        match self {
            Self::F64(p) => p.capacity() * size_of::<Point<f64>>(),
            Self::F32(p) => p.capacity() * size_of::<Point<f32>>(),
        }
    }
}

/// Range of the elements that belong to consecutive groups, where group `i` ends at `ends[i]` and
/// the first one starts at 0.
#[inline]
pub(super) fn elements_of(ends: &[u32], groups: &Range<usize>) -> Range<usize> {
    let end = |count: usize| count.checked_sub(1).map_or(0, |last| ends[last] as usize);
    end(groups.start)..end(groups.end)
}

/// Joins consecutive rows to ranges, in the order of the rows.
pub(super) fn consecutive(
    rows: impl IntoIterator<Item = usize>,
) -> impl Iterator<Item = Range<usize>> {
    let mut rows = rows.into_iter().peekable();
    std::iter::from_fn(move || {
        let first = rows.next()?;
        let mut end = first + 1;
        while rows.next_if_eq(&end).is_some() {
            end += 1;
        }
        Some(first..end)
    })
}

/// An end index as it is stored.
///
/// # Panics
/// When it exceeds `u32`; readers refuse such files earlier.
pub(super) fn end_index(end: usize) -> u32 {
    u32::try_from(end).expect("at most 2^32 control points")
}
