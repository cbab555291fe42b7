use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use guideway::formats::Progress;
use indicatif::{ProgressBar, ProgressStyle};

/// Work shorter than this shows nothing: a bar that flashes by only disturbs.
const PATIENCE: Duration = Duration::from_millis(500);
const REFRESH: Duration = Duration::from_millis(100);

/// Something that may take long: shown on a terminal as long as it lasts.
pub(crate) struct Activity {
    started: Instant,
    steps: Arc<Steps>,
    display: Option<(Sender<()>, JoinHandle<()>)>,
}

#[derive(Default)]
struct Steps {
    done: AtomicU64,
    total: AtomicU64,
}

impl Activity {
    pub(crate) fn start(what: String, is_wanted: bool) -> Self {
        let steps = Arc::<Steps>::default();
        let display = (is_wanted && std::io::stderr().is_terminal()).then(|| {
            let (end, ended) = mpsc::channel::<()>();
            let shown = Arc::clone(&steps);
            let thread = thread::spawn(move || {
                let over = |wait| ended.recv_timeout(wait) != Err(RecvTimeoutError::Timeout);
                if !over(PATIENCE) {
                    show(&what, &shown, over);
                }
            });
            (end, thread)
        });
        Self {
            started: Instant::now(),
            steps,
            display,
        }
    }

    /// Ends the display and returns how long the work took, in milliseconds.
    pub(crate) fn finish(self) -> f64 {
        self.started.elapsed().as_secs_f64() * 1e3
    }
}

impl Drop for Activity {
    fn drop(&mut self) {
        if let Some((end, thread)) = self.display.take() {
            drop(end);
            // The display thread holds nothing that its end could spoil.
            let _ = thread.join();
        }
    }
}

impl Progress for Activity {
    fn advance(&self, done: u64, total: u64) {
        self.steps.done.store(done, Ordering::Relaxed);
        self.steps.total.store(total, Ordering::Relaxed);
    }
}

/// A spinner until the number of steps is known, then a bar.
fn show(what: &str, steps: &Steps, over: impl Fn(Duration) -> bool) {
    let style = |template| {
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
    };
    let bar = ProgressBar::new_spinner();
    bar.set_message(what.to_owned());
    bar.set_style(style("{spinner} {msg} {elapsed}"));
    let mut is_counting = false;
    while !over(REFRESH) {
        let total = steps.total.load(Ordering::Relaxed);
        if total > 0 {
            if !is_counting {
                bar.set_style(style("{msg} {wide_bar} {percent:>3} % {elapsed}"));
                is_counting = true;
            }
            bar.set_length(total);
            bar.set_position(steps.done.load(Ordering::Relaxed));
        }
        bar.tick();
    }
    bar.finish_and_clear();
}
