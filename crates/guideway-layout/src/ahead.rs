//! Memory that is asked for before it is needed: where little is done with each element, processors wait for most of them
//! otherwise, for not all guess well what comes next.

/// Bytes of a line of the cache, on most processors.
const LINE_BYTES: usize = 64;
/// How far ahead of where it is a loop asks.
const AHEAD_BYTES: usize = 2048;
/// Most lines of one list that are asked for at once.
const MOST_LINES: usize = 16;
/// So many elements a loop goes through before it asks again.
pub(crate) const FEW: usize = 32;

/// Asks for what lies somewhat behind some elements, whatever that is.
#[inline(always)]
pub(crate) fn ask_ahead<T>(few: &[T]) {
    for line in lines(few) {
        ask(line.as_ptr().wrapping_byte_add(AHEAD_BYTES));
    }
}

/// Elements, a few at a time, for a loop that asks for those ahead of it.
#[inline(always)]
pub(crate) fn few<T>(elements: &[T]) -> impl Iterator<Item = &[T]> {
    elements.chunks(FEW).inspect(|few| ask_ahead(few))
}

/// Asks for some elements, or the first of many, so that whoever reads them soon does not wait for them.
#[inline(always)]
pub fn ask_for<T>(elements: &[T]) {
    for line in lines(elements).take(MOST_LINES) {
        ask(line.as_ptr());
    }
    if let Some(last) = elements.last() {
        ask(last);
    }
}

fn lines<T>(elements: &[T]) -> impl Iterator<Item = &[T]> {
    elements.chunks(const { LINE_BYTES.div_ceil(size_of::<T>()) })
}

/// Asks for what lies at an address, in vain where there is nothing.
#[inline(always)]
#[cfg(target_arch = "x86_64")]
#[allow(
    unsafe_code,
    reason = "there is no safe way to ask for memory; see SAFETY"
)]
pub(crate) fn ask<T>(address: *const T) {
    use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
    // SAFETY: nothing is read or written, and any address may be asked for.
    unsafe { _mm_prefetch::<_MM_HINT_T0>(address.cast()) };
}

/// Other processors are left to guess.
#[inline(always)]
#[cfg(not(target_arch = "x86_64"))]
pub(crate) fn ask<T>(_address: *const T) {}
