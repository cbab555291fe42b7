//! Fuzzes the named targets, or all of them, for some minutes each:
//! `cargo xtask fuzz [MINUTES [TARGET...]]`.

use std::collections::VecDeque;
use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::thread;

use guideway_laws::{TARGETS, Target};

/// An input that takes longer counts as a failure.
const TIMEOUT_S: u32 = 20;

type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

fn main() -> Outcome<()> {
    let mut args = std::env::args().skip(1);
    let minutes: f64 = args.next().map_or(Ok(1.0), |text| text.parse())?;
    let names: Vec<String> = args.collect();
    if let Some(name) = names.iter().find(|n| TARGETS.iter().all(|t| t.name != **n)) {
        let all: Vec<&str> = TARGETS.iter().map(|t| t.name).collect();
        return Err(format!("unknown target {name}; targets: {}", all.join(", ")).into());
    }
    if !cargo_fuzz("build").status()?.success() {
        return Err("`cargo fuzz build` failed".into());
    }
    let is_wanted = |t: &&Target| names.is_empty() || names.iter().any(|n| n == t.name);
    match fuzz_all(TARGETS.iter().filter(is_wanted).collect(), minutes * 60.0) {
        0 => Ok(()),
        failures => Err(format!("{failures} targets failed; see the inputs above").into()),
    }
}

/// Fuzzes one target per core at a time. Returns the number of failed targets.
fn fuzz_all(targets: VecDeque<&Target>, seconds: f64) -> usize {
    let cores = thread::available_parallelism().map_or(1, usize::from);
    let left = Mutex::new(targets);
    let next = || {
        left.lock()
            .unwrap_or_else(PoisonError::into_inner)
            .pop_front()
    };
    let work = || {
        let mut failures = 0;
        while let Some(target) = next() {
            match fuzz(target, seconds.ceil() as u64) {
                Ok(summary) => println!("{}: {summary}", target.name),
                Err(error) => {
                    println!("{}: FAILED\n{error}", target.name);
                    failures += 1;
                }
            }
        }
        failures
    };
    thread::scope(|scope| {
        let threads: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        threads.into_iter().map(|t| t.join().unwrap_or(1)).sum()
    })
}

/// Fuzzes one target. Returns a summary in one line.
fn fuzz(target: &Target, seconds: u64) -> Outcome<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let corpus = folder.join("corpus").join(target.name);
    fs::create_dir_all(&corpus)?;
    for (name, bytes) in target.seeds()? {
        fs::write(corpus.join(name), bytes)?;
    }
    let mut command = cargo_fuzz("run");
    command.arg(target.name).arg(corpus);
    command.arg("--");
    command.arg(format!("-max_total_time={seconds}"));
    command.arg(format!("-timeout={TIMEOUT_S}"));
    command.arg("-print_final_stats=1");
    let dictionary = folder.join(format!("dictionaries/{}.dict", target.name));
    if dictionary.is_file() {
        command.arg(format!("-dict={}", dictionary.display()));
    }
    let output = command.output()?;
    let log = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        let lines: Vec<&str> = log.lines().collect();
        return Err(lines[lines.len().saturating_sub(40)..].join("\n").into());
    }
    let number = |name: &str| {
        let line = log.lines().find(|line| line.contains(name));
        line.and_then(|line| line.split_whitespace().last())
            .unwrap_or("?")
    };
    let (runs, peak) = (number("number_of_executed_units"), number("peak_rss_mb"));
    Ok(format!("{seconds} s, {runs} runs, peak {peak} MB"))
}

/// The variable that names a sanitizer, such as `address`.
const SANITIZER: &str = "GUIDEWAY_SANITIZER";

/// A `cargo fuzz` command. By default without sanitizers, which need a nightly compiler and find
/// nothing in safe Rust that its own checks do not; the reader of Arrow calls a library in C.
fn cargo_fuzz(subcommand: &str) -> Command {
    let sanitizer = std::env::var(SANITIZER).unwrap_or_else(|_| "none".to_owned());
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut command = Command::new(env!("CARGO"));
    command
        .args(["fuzz", subcommand, "--sanitizer", &sanitizer])
        .current_dir(root);
    command
}
