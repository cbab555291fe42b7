//! Prefetch: loads memory into the cache before a loop reads it.
//!
//! The loops over control points do little work per element, so they wait for memory unless they
//! request it early. Hardware prefetchers do not cover this on every machine.

/// Bytes per cache line of x86-64 processors.
const LINE_BYTES: usize = 64;
/// Distance from the elements in use to those that [`prefetch_ahead`] requests.
const AHEAD_BYTES: usize = 2048;
/// Most cache lines per call of [`prefetch`], in addition to the last one of the slice.
const MAX_LINES: usize = 16;
/// Elements per chunk of [`prefetched_chunks`]: a loop requests memory once per chunk.
pub const CHUNK_LEN: usize = 32;

/// Prefetches a slice: its first cache lines (at most 16) and its last one.
#[inline(always)]
pub fn prefetch<T>(elements: &[T]) {
    for line in cache_lines(elements).take(MAX_LINES) {
        prefetch_address(line.as_ptr());
    }
    if let Some(last) = elements.last() {
        prefetch_address(last);
    }
}

/// Prefetches as many cache lines as `chunk` covers, 2 KiB after its start. The memory there need
/// not exist: any address is allowed.
#[inline(always)]
pub fn prefetch_ahead<T>(chunk: &[T]) {
    for line in cache_lines(chunk) {
        prefetch_address(line.as_ptr().wrapping_byte_add(AHEAD_BYTES));
    }
}

/// Chunks of [`CHUNK_LEN`] elements; each one that is taken prefetches the memory ahead of it.
#[inline(always)]
pub fn prefetched_chunks<T>(elements: &[T]) -> impl Iterator<Item = &[T]> {
    elements
        .chunks(CHUNK_LEN)
        .inspect(|chunk| prefetch_ahead(chunk))
}

/// Chunks of one cache line each, if the slice starts at the start of one.
fn cache_lines<T>(elements: &[T]) -> impl Iterator<Item = &[T]> {
    elements.chunks(const { LINE_BYTES.div_ceil(size_of::<T>()) })
}

/// Prefetches the cache line of an address; any address is allowed.
#[inline(always)]
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code, reason = "the intrinsic has no safe form; see SAFETY")]
pub fn prefetch_address<T>(address: *const T) {
    use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
    // SAFETY: a prefetch neither reads nor writes, and never faults, whatever the address.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
}

/// Does nothing: stable Rust has no prefetch intrinsic for other processors.
#[inline(always)]
#[cfg(not(target_arch = "x86_64"))]
pub fn prefetch_address<T>(_address: *const T) {}
