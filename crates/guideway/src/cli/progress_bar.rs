//! Progress of a long operation on the terminal, and its duration.

use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use guideway::formats::Progress;
use indicatif::ProgressStyle;

/// Shorter operations show no bar: one that flashes by distracts.
const DELAY: Duration = Duration::from_millis(500);
const REFRESH: Duration = Duration::from_millis(100);

/// Measures an operation, and shows its progress on a terminal until it is dropped.
pub(crate) struct ProgressBar {
    started: Instant,
    steps: Arc<Steps>,
    display: Option<(Sender<()>, JoinHandle<()>)>,
}

#[derive(Default)]
struct Steps {
    done: AtomicU64,
    total: AtomicU64,
}

impl ProgressBar {
    /// Starts the clock. `label` appears after half a second, if standard error is a terminal.
    pub(crate) fn start(label: String, is_visible: bool) -> Self {
        let steps = Arc::<Steps>::default();
        let is_shown = is_visible && std::io::stderr().is_terminal();
        let display = is_shown.then(|| {
            let (end, ended) = mpsc::channel::<()>();
            let shown = Arc::clone(&steps);
            let thread = thread::Builder::new().spawn(move || {
                let is_over = |wait| ended.recv_timeout(wait) != Err(RecvTimeoutError::Timeout);
                if !is_over(DELAY) {
                    show(&label, &shown, is_over);
                }
            });
            // Without a thread there is no bar.
            thread.ok().map(|thread| (end, thread))
        });
        let display = display.flatten();
        Self {
            started: Instant::now(),
            steps,
            display,
        }
    }

    /// Removes the bar and returns the duration in milliseconds.
    pub(crate) fn finish(self) -> f64 {
        self.started.elapsed().as_secs_f64() * 1e3
    }
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        if let Some((end, thread)) = self.display.take() {
            drop(end);
            // A panic of the display thread spoils nothing but the display.
            let _ = thread.join();
        }
    }
}

impl Progress for ProgressBar {
    fn advance(&self, done: u64, total: u64) {
        self.steps.done.store(done, Ordering::Relaxed);
        self.steps.total.store(total, Ordering::Relaxed);
    }
}

/// Shows a spinner until the number of steps is known, then a bar.
fn show(label: &str, steps: &Steps, is_over: impl Fn(Duration) -> bool) {
    let style = |template| {
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
    };
    let bar = indicatif::ProgressBar::new_spinner();
    bar.set_message(label.to_owned());
    bar.set_style(style("{spinner} {msg} {elapsed}"));
    let mut is_counting = false;
    while !is_over(REFRESH) {
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
