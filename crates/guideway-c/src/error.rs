//! The last failure of each thread: its input is an error, its output texts that C reads.

use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::ptr;

use guideway::layout::UserError;

/// Why a call failed.
#[derive(Debug)]
#[repr(C)]
pub struct GuidewayError {
    /// Stable name of the kind of failure, for programs.
    pub code: *const c_char,
    /// The failure and its place, without final period.
    pub message: *const c_char,
    /// The action that resolves it, without final period.
    pub remedy: *const c_char,
}

/// An error with the texts that it points to.
struct Kept {
    error: GuidewayError,
    _texts: [CString; 3],
}

thread_local! {
    /// In a box: its address stays the same.
    static LAST: RefCell<Option<Box<Kept>>> = const { RefCell::new(None) };
}

/// Remembers a failure of this thread.
pub(crate) fn remember(error: UserError) {
    let UserError {
        code,
        message,
        remedy,
    } = error;
    let texts = [code, &message, &remedy].map(c_text);
    let [code, message, remedy] = texts.each_ref().map(|text| text.as_ptr());
    let kept = Kept {
        error: GuidewayError {
            code,
            message,
            remedy,
        },
        _texts: texts,
    };
    LAST.with_borrow_mut(|last| *last = Some(Box::new(kept)));
}

/// A text that ends with 0 there and nowhere before.
pub(crate) fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "\u{fffd}")).unwrap_or_default()
}

/// Why the last call of this thread that failed did so; NULL if none failed. Calls that succeed
/// leave it as it is.
///
/// The library owns it: it is valid until the next call of this thread fails.
#[unsafe(no_mangle)]
pub extern "C" fn guideway_last_error() -> *const GuidewayError {
    LAST.with_borrow(|last| match last {
        Some(kept) => &raw const kept.error,
        None => ptr::null(),
    })
}
