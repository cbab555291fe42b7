//! Progress of a command on the terminal as one scale over all of its steps, and the duration of
//! each step.

use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use guideway::formats::Progress;
use indicatif::ProgressStyle;

use super::text;

/// Shorter operations show no bar: one that flashes by distracts.
const DELAY: Duration = Duration::from_millis(500);
const REFRESH: Duration = Duration::from_millis(100);
/// Least share of the scale from which the time left is estimated.
const LEAST_SHARE: f64 = 0.05;
/// Part of what is left of the scale that a step takes for which no plan says more.
const UNPLANNED: f64 = 0.6;

/// The scale of the command.
static SCALE: Mutex<Scale> = Mutex::new(Scale::new());

/// The steps of a command on one scale from 0 to 1.
struct Scale {
    /// The share of the steps that are done.
    done: f64,
    /// The weights of the steps to come, last first.
    planned: Vec<f64>,
}

impl Scale {
    const fn new() -> Self {
        Self {
            done: 0.0,
            planned: Vec::new(),
        }
    }

    /// The part of the scale that the next step takes.
    fn next(&mut self) -> f64 {
        let left = 1.0 - self.done;
        let sum: f64 = self.planned.iter().sum();
        match self.planned.pop() {
            Some(weight) if sum > 0.0 => left * weight / sum,
            _ => left * UNPLANNED,
        }
    }
}

/// Tells how long the next steps take, as weights in their order. `of_each` is the number of files
/// that the first step repeats for.
pub(crate) fn plan(of_each: usize, weights: &[f64]) {
    let mut scale = SCALE.lock().unwrap_or_else(PoisonError::into_inner);
    let first = weights.first().copied().unwrap_or_default();
    let files = of_each.max(1);
    let others = weights.iter().skip(1).copied().rev();
    scale.planned = others.collect();
    scale
        .planned
        .extend(std::iter::repeat_n(first / files as f64, files));
}

/// Measures a step, and shows its progress on a terminal until it is dropped.
pub(crate) struct ProgressBar {
    started: Instant,
    /// Part of the scale that the step takes.
    part: f64,
    steps: Arc<Steps>,
    display: Option<(Sender<()>, JoinHandle<()>)>,
}

#[derive(Default)]
struct Steps {
    done: AtomicU64,
    total: AtomicU64,
    paths: AtomicU64,
    written_bytes: AtomicU64,
}

impl Steps {
    /// The share of the step that is done, from 0 to 1.
    fn share(&self) -> f64 {
        match self.total.load(Ordering::Relaxed) {
            0 => 0.0,
            total => (self.done.load(Ordering::Relaxed) as f64 / total as f64).min(1.0),
        }
    }
}

/// A step as its bar shows it.
struct Shown {
    label: String,
    /// Begin of the step on the scale, and its part.
    from: f64,
    part: f64,
    started: Instant,
}

impl ProgressBar {
    /// Starts the clock. `label` appears after half a second, if standard error is a terminal.
    pub(crate) fn start(label: String, is_visible: bool) -> Self {
        let steps = Arc::<Steps>::default();
        let (from, part) = {
            let mut scale = SCALE.lock().unwrap_or_else(PoisonError::into_inner);
            (scale.done, scale.next())
        };
        let is_shown = is_visible && io::stderr().is_terminal();
        let of_step = Shown {
            label,
            from,
            part,
            started: Instant::now(),
        };
        let display = is_shown.then(|| {
            let (end, ended) = mpsc::channel::<()>();
            let shown = Arc::clone(&steps);
            let thread = thread::Builder::new().spawn(move || {
                let is_over = |wait| ended.recv_timeout(wait) != Err(RecvTimeoutError::Timeout);
                if !is_over(DELAY) {
                    show(&of_step, &shown, is_over);
                }
            });
            // Without a thread there is no bar.
            thread.ok().map(|thread| (end, thread))
        });
        Self {
            started: Instant::now(),
            part,
            steps,
            display: display.flatten(),
        }
    }

    /// Says what share of the step is done, from 0 to 1, which is that of `paths`, too.
    pub(crate) fn share(&self, share: f64, paths: u64) {
        const WHOLE: f64 = 1e6;
        self.advance((share * WHOLE) as u64, WHOLE as u64);
        self.paths((share * paths as f64) as u64);
    }

    /// A stream whose bytes count as progress.
    pub(crate) fn counted<'p, W: Write>(&'p self, out: &'p mut W) -> Counted<'p, W> {
        Counted {
            out,
            steps: &self.steps,
        }
    }

    /// Removes the bar and returns the duration in milliseconds.
    pub(crate) fn finish(self) -> f64 {
        self.started.elapsed().as_secs_f64() * 1e3
    }
}

/// A stream that counts its bytes.
pub(crate) struct Counted<'p, W> {
    out: &'p mut W,
    steps: &'p Steps,
}

impl<W: Write> Write for Counted<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        let written = &self.steps.written_bytes;
        written.fetch_add(count as u64, Ordering::Relaxed);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

impl Drop for ProgressBar {
    fn drop(&mut self) {
        SCALE.lock().unwrap_or_else(PoisonError::into_inner).done += self.part;
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

    fn paths(&self, done: u64) {
        self.steps.paths.store(done, Ordering::Relaxed);
    }
}

/// Shows the scale of the command, what the step does, and how fast.
fn show(of: &Shown, steps: &Steps, is_over: impl Fn(Duration) -> bool) {
    const LENGTH: u64 = 1000;
    let template = "{msg} {wide_bar} {percent:>3} % {prefix}";
    let style = ProgressStyle::with_template(template);
    let bar = indicatif::ProgressBar::new(LENGTH);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.set_message(of.label.clone());
    let mut most = 0.0_f64;
    while !is_over(REFRESH) {
        most = most.max(of.from + of.part * steps.share());
        bar.set_position((most * LENGTH as f64) as u64);
        bar.set_prefix(pace(steps, of.started.elapsed(), (of.from, most)));
        bar.tick();
    }
    bar.finish_and_clear();
}

/// The speed of a step that began at a share of the scale, the time that is left, and how to stop.
fn pace(steps: &Steps, elapsed: Duration, (from, share): (f64, f64)) -> String {
    let seconds = elapsed.as_secs_f64();
    let load = |count: &AtomicU64| count.load(Ordering::Relaxed);
    let per_second = |count: u64| (count as f64 / seconds) as u64;
    let mut parts = Vec::new();
    let (paths, bytes) = (load(&steps.paths), load(&steps.written_bytes));
    if paths > 0 {
        parts.push(format!("{} paths/s", text::count(per_second(paths))));
    }
    if bytes > 0 {
        let speed = text::bytes(per_second(bytes));
        parts.push(format!("{} written, {speed}/s", text::bytes(bytes)));
    }
    let done = share - from;
    if done >= LEAST_SHARE {
        let left_ms = seconds * (1.0 - share) / done * 1e3;
        parts.push(format!("{} left", text::time(left_ms)));
    }
    parts.push("Ctrl+C stops".to_owned());
    parts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_share_one_scale_and_never_exceed_it() {
        let mut scale = Scale::new();
        scale.planned = vec![1.0, 3.0];
        let mut step = || {
            let part = scale.next();
            scale.done += part;
            (part * 1e6).round() / 1e6
        };
        assert_eq!((step(), step()), (0.75, 0.25));
        for _ in 0..5 {
            assert_eq!(step(), 0.0, "nothing is left for steps beyond the plan");
        }
        let mut unplanned = Scale::new();
        for _ in 0..20 {
            unplanned.done += unplanned.next();
            assert!(unplanned.done < 1.0);
        }
    }

    #[test]
    fn pace_says_paths_per_second_and_what_is_left() {
        let (steps, elapsed) = (Steps::default(), Duration::from_secs(2));
        assert_eq!(pace(&steps, elapsed, (0.5, 0.5)), "Ctrl+C stops");
        steps.paths.store(5000, Ordering::Relaxed);
        let said = pace(&steps, elapsed, (0.5, 0.6));
        assert!(said.starts_with("2,500 paths/s, 8"), "{said}");
        assert!(said.ends_with("left, Ctrl+C stops"), "{said}");
    }

    #[test]
    fn share_of_a_check_is_that_of_its_paths() {
        let bar = ProgressBar::start("checking".to_owned(), false);
        bar.share(0.25, 4000);
        assert_eq!(bar.steps.share(), 0.25);
        let said = pace(&bar.steps, Duration::from_secs(1), (0.0, 0.25));
        assert!(said.starts_with("1,000 paths/s, 3"), "{said}");
    }

    #[test]
    fn written_bytes_count() {
        let bar = ProgressBar::start("writing".to_owned(), false);
        let mut file = Vec::new();
        bar.counted(&mut file).write_all(&[7; 3000]).unwrap();
        assert_eq!(file.len(), 3000);
        let said = pace(&bar.steps, Duration::from_secs(3), (0.0, 0.0));
        assert!(
            said.contains("written, ") && said.contains("/s, Ctrl"),
            "{said}"
        );
    }

    #[test]
    fn share_of_a_step_is_that_of_its_total() {
        let steps = Steps::default();
        assert_eq!(steps.share(), 0.0);
        steps.done.store(3, Ordering::Relaxed);
        steps.total.store(4, Ordering::Relaxed);
        assert_eq!(steps.share(), 0.75);
        steps.done.store(9, Ordering::Relaxed);
        assert_eq!(steps.share(), 1.0);
    }
}
