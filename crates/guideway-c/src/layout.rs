//! [`GuidewayLayout`]: reads it from files and bytes, writes it to files and streams, and describes
//! it as JSON.

use std::ffi::{CString, c_char, c_void};
use std::io::{self, BufWriter, Write};
use std::ptr;
use std::sync::Arc;

use guideway::formats::{Losses, ReadOptions, Target, WriteError, read_bytes};
use guideway::layout::{Layout, UserError};
use serde_json::Value;

use crate::arguments::{bytes, path, reference, refused, text, write};
use crate::border::{GuidewayStatus, guarded, owned, status};
use crate::error::c_text;

/// A layout: paths, nodes, stations and all that a file says about them.
pub struct GuidewayLayout(pub(crate) Arc<Layout>);

/// Receives the next bytes of a file. Returns 0 to go on, another number to stop.
pub type GuidewayWriteCallback =
    Option<unsafe extern "C" fn(data: *const u8, len: usize, user: *mut c_void) -> i32>;

/// Size of the pieces that a [`GuidewayWriteCallback`] receives.
const PIECE_BYTES: usize = 1 << 16;

/// The version of the library, such as "0.1.0". It is not freed.
#[unsafe(no_mangle)]
pub extern "C" fn guideway_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// Reads a file; its content decides the format. Free the layout with `guideway_layout_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_open(file: *const c_char) -> *mut GuidewayLayout {
    owned(|| {
        // SAFETY: the caller passes a text.
        let file = unsafe { path(file, "file") }?;
        Ok(GuidewayLayout(Arc::new(guideway::open(file)?)))
    })
}

/// Reads `len` bytes at `data`, those of a file that errors call `name`. Free the layout with
/// `guideway_layout_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_from_bytes(
    name: *const c_char,
    data: *const u8,
    len: usize,
) -> *mut GuidewayLayout {
    owned(|| {
        // SAFETY: the caller passes a text, and an area of this length.
        let (name, data) = unsafe { (text(name, "name")?, bytes(data, len, "data")?) };
        let layout = read_bytes(name, data, &ReadOptions::default())?;
        Ok(GuidewayLayout(Arc::new(layout)))
    })
}

/// Frees a layout. Its drawings stay.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_free(layout: *mut GuidewayLayout) {
    if !layout.is_null() {
        // SAFETY: `owned` made it of a box, and the caller gives it back.
        drop(unsafe { Box::from_raw(layout) });
    }
}

/// Format, counts, extent, levels, vehicle types and columns of a layout as JSON. Free the text
/// with `guideway_text_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_info(layout: *const GuidewayLayout) -> *mut c_char {
    owned_text(|| {
        // SAFETY: the caller passes a layout.
        let layout = unsafe { reference(layout, "layout") }?;
        Ok(guideway::json::info(&layout.0))
    })
}

/// Saves a layout in the format that the extension of the file names, whole or not at all.
///
/// Unless `losses` is NULL it receives what the format cannot hold, as a JSON list of sentences;
/// free it with `guideway_text_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_save(
    layout: *const GuidewayLayout,
    file: *const c_char,
    losses: *mut *mut c_char,
) -> GuidewayStatus {
    status(|| {
        // SAFETY: the caller passes a layout and a text.
        let (layout, file) = unsafe { (reference(layout, "layout")?, path(file, "file")?) };
        let found = guideway::save(&layout.0, file)?;
        // SAFETY: the caller passes a place for a pointer, or NULL.
        unsafe { tell(&found, losses) };
        Ok(())
    })
}

/// Writes a layout in a format, such as "lif", "geojson" or "opentcs", piece by piece to a
/// callback, which receives `user` too. `losses` is as in `guideway_layout_save`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_layout_write(
    layout: *const GuidewayLayout,
    format: *const c_char,
    callback: GuidewayWriteCallback,
    user: *mut c_void,
    losses: *mut *mut c_char,
) -> GuidewayStatus {
    status(|| {
        // SAFETY: the caller passes a layout and a text.
        let (layout, format) = unsafe { (reference(layout, "layout")?, text(format, "format")?) };
        let target = Target::from_id(format).ok_or_else(|| {
            let known: Vec<&str> = Target::ALL.iter().map(|target| target.id()).collect();
            let remedy = format!("Choose one of {}", known.join(", "));
            refused(format!("no format is called `{format}`"), &remedy)
        })?;
        let Some(callback) = callback else {
            return Err(refused(
                "the argument `callback` is NULL".to_owned(),
                "Pass a function",
            ));
        };
        let out = Callback {
            callback,
            user,
            answer: 0,
        };
        let mut out = BufWriter::with_capacity(PIECE_BYTES, out);
        let written = guideway::write(&layout.0, target, &mut out);
        let written = written.and_then(|found| {
            out.flush()?;
            Ok(found)
        });
        let found = written.map_err(|problem| WriteError {
            path: "memory".into(),
            problem,
        })?;
        // SAFETY: the caller passes a place for a pointer, or NULL.
        unsafe { tell(&found, losses) };
        Ok(())
    })
}

/// Frees a text that a function returned.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guideway_text_free(text: *mut c_char) {
    if !text.is_null() {
        // SAFETY: `CString::into_raw` made it, and the caller gives it back.
        drop(unsafe { CString::from_raw(text) });
    }
}

/// Runs a call that returns JSON which the caller owns; NULL when it fails.
pub(crate) fn owned_text(work: impl FnOnce() -> Result<Value, UserError>) -> *mut c_char {
    let json = guarded(|| work().map(|json| c_text(&json.to_string())));
    json.map_or(ptr::null_mut(), CString::into_raw)
}

/// Writes losses as JSON, unless the place is NULL.
///
/// # Safety
/// It is NULL, or a place for a pointer.
unsafe fn tell(losses: &Losses, place: *mut *mut c_char) {
    if !place.is_null() {
        let losses: Value = losses.iter().map(ToString::to_string).collect();
        // SAFETY: it is not NULL, and the caller promises the rest.
        let written = unsafe { write(place, c_text(&losses.to_string()).into_raw(), "losses") };
        debug_assert!(written.is_ok());
    }
}

/// A stream to a callback.
struct Callback {
    callback: unsafe extern "C" fn(*const u8, usize, *mut c_void) -> i32,
    user: *mut c_void,
    /// Its last answer. It is not called again after it stopped.
    answer: i32,
}

impl Write for Callback {
    fn write(&mut self, piece: &[u8]) -> io::Result<usize> {
        if self.answer == 0 {
            // SAFETY: the piece lives during the call, and `user` is the callback's own.
            self.answer = unsafe { (self.callback)(piece.as_ptr(), piece.len(), self.user) };
        }
        match self.answer {
            0 => Ok(piece.len()),
            other => Err(io::Error::other(format!("the callback returned {other}"))),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
