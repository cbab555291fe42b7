//! Work of the engine in the one thread that it has.

use guideway::formats::{Parts, Progress};
use guideway::layout::UserError;

use crate::file::{self, Uint8Array};
use crate::session::Session;

/// The file that is being opened.
struct Opened {
    byte_count: usize,
}

impl Parts for Opened {
    fn byte_count(&self) -> usize {
        self.byte_count
    }

    fn read(&self, from: usize, to: &mut [u8]) -> std::io::Result<()> {
        file::read(from, to)
    }
}

impl Progress for Opened {
    fn advance(&self, done: u64, total: u64) {
        file::tell(done, total);
    }
}

/// Opens the bytes of a file.
pub(crate) fn open(name: &str, bytes: Uint8Array) -> Result<Session, UserError> {
    file::opening(bytes, |byte_count| {
        let opened = Opened { byte_count };
        Session::open(name, &opened, &opened)
    })
}

/// Does the work of a call.
pub(crate) fn work<R>(work: impl FnOnce() -> R) -> R {
    work()
}
