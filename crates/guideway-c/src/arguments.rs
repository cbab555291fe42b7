//! Arguments of C as those of Rust: pointers become references, texts and bytes; NULL and texts
//! that are not UTF-8 are refused.

use std::ffi::{CStr, c_char};
use std::path::PathBuf;
use std::slice;

use guideway::layout::UserError;

/// An error about an argument.
pub(crate) fn refused(message: String, remedy: &str) -> UserError {
    UserError::new("argument", message, remedy)
}

fn null(name: &str) -> UserError {
    refused(format!("the argument `{name}` is NULL"), "Pass its address")
}

/// The value that a pointer points to.
///
/// # Safety
/// It is NULL, or points to a `T` that lives and is not written during the call.
pub(crate) unsafe fn reference<'a, T>(pointer: *const T, name: &str) -> Result<&'a T, UserError> {
    // SAFETY: as above; `as_ref` refuses NULL.
    unsafe { pointer.as_ref() }.ok_or_else(|| null(name))
}

/// A place to write to.
///
/// # Safety
/// It is NULL, or points to memory for a `T`, initialized or not, that no other thread uses during
/// the call.
pub(crate) unsafe fn write<T>(pointer: *mut T, value: T, name: &str) -> Result<(), UserError> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: as above; what was there is overwritten, not dropped.
    unsafe { pointer.write(value) };
    Ok(())
}

/// A text.
///
/// # Safety
/// It is NULL, or ends with 0 and is not written during the call.
pub(crate) unsafe fn text<'a>(pointer: *const c_char, name: &str) -> Result<&'a str, UserError> {
    // SAFETY: as above.
    let text = unsafe { optional_text(pointer, name) }?;
    text.ok_or_else(|| null(name))
}

/// A text; `None` for NULL.
///
/// # Safety
/// See [`text`].
pub(crate) unsafe fn optional_text<'a>(
    pointer: *const c_char,
    name: &str,
) -> Result<Option<&'a str>, UserError> {
    if pointer.is_null() {
        return Ok(None);
    }
    // SAFETY: it is not NULL, and the caller promises the rest.
    let text = unsafe { CStr::from_ptr(pointer) }.to_str();
    let refuse = |_| refused(format!("the argument `{name}` is not UTF-8"), "Encode it");
    text.map(Some).map_err(refuse)
}

/// The name of a file. On Unix it may be any bytes, as files have them there.
///
/// # Safety
/// See [`text`].
pub(crate) unsafe fn path(pointer: *const c_char, name: &str) -> Result<PathBuf, UserError> {
    if pointer.is_null() {
        return Err(null(name));
    }
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt;
        // SAFETY: it is not NULL, and the caller promises the rest.
        let bytes = unsafe { CStr::from_ptr(pointer) }.to_bytes();
        Ok(PathBuf::from(std::ffi::OsStr::from_bytes(bytes)))
    }
    #[cfg(not(unix))]
    // SAFETY: as above.
    unsafe { text(pointer, name) }.map(PathBuf::from)
}

/// The bytes of a memory area, whose address may be NULL if it is empty.
///
/// # Safety
/// It is NULL, or points to `len` bytes that are not written during the call.
pub(crate) unsafe fn bytes<'a>(
    pointer: *const u8,
    len: usize,
    name: &str,
) -> Result<&'a [u8], UserError> {
    match (pointer.is_null(), isize::try_from(len)) {
        (_, Ok(0)) => Ok(&[]),
        (true, _) => Err(null(name)),
        (false, Err(_)) => {
            let message = format!("the argument `{name}` has {len} bytes, more than memory");
            Err(refused(message, "Pass its length in bytes"))
        }
        // SAFETY: it is not NULL, and no longer than an object; the caller promises the rest.
        (false, Ok(_)) => Ok(unsafe { slice::from_raw_parts(pointer, len) }),
    }
}
