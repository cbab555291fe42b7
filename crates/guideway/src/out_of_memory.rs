//! The allocator of the command and of the window: without memory the program ends with an error
//! and its exit code, and leaves no unfinished file, where Rust would abort.

use std::alloc::{GlobalAlloc, Layout, System};
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};

use guideway::layout::may_fail;

/// The exit code of every error.
const ERROR: i32 = 2;
const REMEDY: &str = "Free some memory, or process a smaller file or a smaller picture; `--limit` \
                      and `--memory` bound what is used";

/// True if errors are reports in JSON.
static IS_JSON: AtomicBool = AtomicBool::new(false);

/// Makes the error a report in JSON on standard output, as `--json` says.
pub(crate) fn report_as_json() {
    IS_JSON.store(true, Ordering::SeqCst);
}

/// The system's allocator, which ends the process when it has no memory.
#[derive(Clone, Copy, Debug)]
pub struct Allocator;

#[expect(unsafe_code, reason = "an allocator is unsafe to implement")]
// SAFETY: every call is passed on to the system's allocator; a failed one does not return, unless
// the caller expects that it may fail.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the rules of `alloc`.
        checked(unsafe { System.alloc(layout) })
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the rules of `alloc_zeroed`.
        checked(unsafe { System.alloc_zeroed(layout) })
    }

    unsafe fn realloc(&self, old: *mut u8, layout: Layout, bytes: usize) -> *mut u8 {
        // SAFETY: the caller keeps the rules of `realloc`.
        checked(unsafe { System.realloc(old, layout, bytes) })
    }

    unsafe fn dealloc(&self, old: *mut u8, layout: Layout) {
        // SAFETY: the caller keeps the rules of `dealloc`.
        unsafe { System.dealloc(old, layout) }
    }
}

fn checked(memory: *mut u8) -> *mut u8 {
    if memory.is_null() && !may_fail() {
        end();
    }
    memory
}

/// Prints the error, removes unfinished files and ends the process.
fn end() -> ! {
    static IS_ENDING: AtomicBool = AtomicBool::new(false);
    // Either step may need memory itself; the second attempt ends at once.
    if !IS_ENDING.swap(true, Ordering::SeqCst) {
        if IS_JSON.load(Ordering::SeqCst) {
            print(
                b"{\"guideway\":{\"report\":\"error\",\"version\":1},\"error\":{\"code\":\
                \"out-of-memory\",\"message\":\"out of memory\",\"remedy\":\"",
            );
            print(REMEDY.as_bytes());
            print(b"\"}}\n");
        } else {
            // Nobody can be told that standard error is closed.
            for text in ["error: out of memory\nhint: ", REMEDY, "\n"] {
                let _ = std::io::stderr().write_all(text.as_bytes());
            }
        }
        guideway::try_remove_unfinished();
    }
    exit()
}

/// Writes to standard output past its buffer, which another thread may hold.
#[cfg(unix)]
#[expect(unsafe_code, reason = "the safe functions lock, and may allocate")]
fn print(text: &[u8]) {
    // SAFETY: the text is valid for its length. Nobody can be told that the output is closed.
    let _ = unsafe { libc::write(1, text.as_ptr().cast(), text.len()) };
}

#[cfg(not(unix))]
fn print(text: &[u8]) {
    let _ = std::io::stdout().write_all(text);
}

/// Ends the process without the handlers of libraries, which need memory.
#[cfg(unix)]
#[expect(unsafe_code, reason = "there is no safe function for it")]
fn exit() -> ! {
    // SAFETY: the call takes a number and does not return.
    unsafe { libc::_exit(ERROR) }
}

#[cfg(not(unix))]
fn exit() -> ! {
    std::process::exit(ERROR)
}
