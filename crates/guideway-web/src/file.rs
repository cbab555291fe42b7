//! The file that is being opened: bytes of the worker that holds it, outside the engine.

use std::cell::RefCell;
use std::io;

use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// The worker defines it.
    #[wasm_bindgen(js_name = guidewayProgress)]
    fn guideway_progress(share: f64);

    /// The bytes of a file, in the memory of the worker.
    pub type Uint8Array;

    #[wasm_bindgen(method, getter)]
    fn length(this: &Uint8Array) -> usize;

    #[wasm_bindgen(method)]
    fn subarray(this: &Uint8Array, start: usize, end: usize) -> Uint8Array;

    #[wasm_bindgen(js_namespace = ["Uint8Array", "prototype", "set"], js_name = call)]
    fn copy(to: &mut [u8], from: &Uint8Array);
}

thread_local! {
    /// The file that is being opened: no object of JavaScript goes from thread to thread.
    static OPENED: RefCell<Option<Uint8Array>> = const { RefCell::new(None) };
}

/// Calls `open` with the number of bytes of a file, which [`read`] reads meanwhile. Memory of an
/// engine never shrinks, so a whole copy would be there for good.
pub(crate) fn opening<R>(bytes: Uint8Array, open: impl FnOnce(usize) -> R) -> R {
    let byte_count = bytes.length();
    OPENED.set(Some(bytes));
    let opened = open(byte_count);
    OPENED.set(None);
    opened
}

/// Fills `to` with the bytes of the file that is being opened in this thread.
pub(crate) fn read(from: usize, to: &mut [u8]) -> io::Result<()> {
    OPENED.with_borrow(|file| {
        let file = file.as_ref().ok_or(io::ErrorKind::NotFound)?;
        let end = from.checked_add(to.len());
        let end = end.filter(|end| *end <= file.length());
        let end = end.ok_or(io::ErrorKind::UnexpectedEof)?;
        copy(to, &file.subarray(from, end));
        Ok(())
    })
}

/// Tells the worker that `done` of `total` steps are done.
pub(crate) fn tell(done: u64, total: u64) {
    guideway_progress(done as f64 / total.max(1) as f64);
}
