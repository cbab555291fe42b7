//! Work of the engine in a pool of threads: workers that share the memory of the one that the page
//! calls. That one waits while they work, and reads the file for them, since it alone has it.

use std::io;
use std::sync::mpsc::{Sender, SyncSender, channel, sync_channel};
use std::sync::{Condvar, Mutex, PoisonError};

use guideway::formats::{Parts, Progress};
use guideway::layout::UserError;
use rayon::{ThreadBuilder, ThreadPoolBuilder};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::file::{self, Uint8Array};
use crate::session::Session;

/// Bytes that are read at once: they are copied once more, and memory never shrinks.
const PART_BYTES: usize = 1 << 20;

/// Threads of the pool that no worker has begun to run.
static THREADS: Mutex<Vec<ThreadBuilder>> = Mutex::new(Vec::new());
static HAS_THREAD: Condvar = Condvar::new();

/// Makes the pool, of workers that call [`run_thread`]. Returns `false` if there is one.
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript calls it")]
pub fn start_threads(count: usize) -> bool {
    let pool = ThreadPoolBuilder::new().num_threads(count);
    let pool = pool.spawn_handler(|thread| {
        let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
        threads.push(thread);
        HAS_THREAD.notify_one();
        Ok(())
    });
    pool.build_global().is_ok()
}

/// Runs a thread of the pool, in a worker of its own; it ends with the worker.
#[wasm_bindgen]
#[expect(unreachable_pub, reason = "JavaScript calls it")]
pub fn run_thread() {
    let threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    let threads = HAS_THREAD.wait_while(threads, |threads| threads.is_empty());
    let thread = threads.unwrap_or_else(PoisonError::into_inner).pop();
    if let Some(thread) = thread {
        thread.run();
    }
}

/// A request of the pool to the worker that has the file.
enum Request {
    Read {
        from: usize,
        byte_count: usize,
        answer: SyncSender<io::Result<Vec<u8>>>,
    },
    Tell {
        done: u64,
        total: u64,
    },
}

impl Request {
    /// Does it. An answer that nobody awaits any more is dropped.
    fn serve(self) {
        match self {
            Self::Tell { done, total } => file::tell(done, total),
            Self::Read {
                from,
                byte_count,
                answer,
            } => {
                let mut bytes = vec![0; byte_count];
                let read = file::read(from, &mut bytes);
                let _ = answer.send(read.map(|()| bytes));
            }
        }
    }
}

/// The file that is being opened, as the pool sees it.
struct Opened {
    byte_count: usize,
    requests: Sender<Request>,
}

impl Parts for Opened {
    fn byte_count(&self) -> usize {
        self.byte_count
    }

    fn read(&self, from: usize, to: &mut [u8]) -> io::Result<()> {
        let mut from = from;
        for part in to.chunks_mut(PART_BYTES) {
            let (answer, answered) = sync_channel(1);
            let byte_count = part.len();
            let request = Request::Read {
                from,
                byte_count,
                answer,
            };
            let gone = io::ErrorKind::BrokenPipe;
            self.requests.send(request).map_err(|_| gone)?;
            part.copy_from_slice(&answered.recv().map_err(|_| gone)??);
            from = from.saturating_add(byte_count);
        }
        Ok(())
    }
}

impl Progress for Opened {
    fn advance(&self, done: u64, total: u64) {
        // Nobody hears of it once the file is open.
        let _ = self.requests.send(Request::Tell { done, total });
    }
}

/// Opens the bytes of a file.
pub(crate) fn open(name: &str, bytes: Uint8Array) -> Result<Session, UserError> {
    file::opening(bytes, |byte_count| {
        let (requests, asked) = channel();
        let opened = Opened {
            byte_count,
            requests,
        };
        let mut session = None;
        rayon::in_place_scope(|scope| {
            let session = &mut session;
            // Requests end when it drops the file.
            scope.spawn(move |_| *session = Some(Session::open(name, &opened, &opened)));
            asked.into_iter().for_each(Request::serve);
        });
        session.expect("a thread that fails ends the engine")
    })
}

/// Does the work of a call within the pool, which else would be woken for each of its steps.
pub(crate) fn work<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    rayon::scope(|_| work())
}
