//! Runs commands: each is printed before it runs, with the environment that all steps share.

use std::ffi::{OsStr, OsString};
use std::fs::File;
use std::path::Path;
use std::process::{Child, Command};
use std::sync::{LazyLock, Mutex, PoisonError};
use std::time::Instant;

use anyhow::{Context, Result, bail};

/// One command to run.
pub(crate) struct Step(Command);

/// The result of a captured command.
pub(crate) struct Captured {
    pub(crate) succeeded: bool,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

/// Start time of this program.
pub(crate) static STARTED: LazyLock<Instant> = LazyLock::new(Instant::now);

/// Seconds since [`STARTED`].
pub(crate) fn elapsed_s() -> f64 {
    STARTED.elapsed().as_secs_f64()
}

/// Prints the title of the next check and the time elapsed so far.
pub(crate) fn heading(title: &str) {
    println!("\n== {title} (after {:.0} s)", elapsed_s());
}

pub(crate) fn command(program: impl AsRef<OsStr>) -> Step {
    let mut command = Command::new(program);
    for (name, value) in shared_env() {
        command.env(name, value);
    }
    Step(command)
}

pub(crate) fn cargo(args: &[&str]) -> Step {
    command(env!("CARGO")).args(args)
}

/// Builds the libraries, the command and the fuzzer with the workspace. The example brings the
/// features that dependencies of tests have: without them crates would be built anew.
pub(crate) fn build_with_workspace() -> Result<()> {
    let targets = ["--lib", "--bin", "guideway", "--example", "fuzz"];
    cargo(&["build", "--quiet", "--workspace"])
        .args(targets)
        .run()
}

impl Step {
    pub(crate) fn args<A: AsRef<OsStr>>(mut self, args: impl IntoIterator<Item = A>) -> Self {
        self.0.args(args);
        self
    }

    pub(crate) fn env(mut self, name: &str, value: impl AsRef<OsStr>) -> Self {
        self.0.env(name, value);
        self
    }

    pub(crate) fn current_dir(mut self, folder: impl AsRef<Path>) -> Self {
        self.0.current_dir(folder);
        self
    }

    /// Runs the command with its output shown; fails when the command fails.
    pub(crate) fn run(mut self) -> Result<()> {
        println!("$ {:?}", self.0);
        let status = self
            .0
            .status()
            .with_context(|| format!("cannot start {:?}", self.0))?;
        if !status.success() {
            bail!("{:?} failed: {status}", self.0);
        }
        Ok(())
    }

    /// Starts the command, whose output goes to a file.
    pub(crate) fn start(mut self, output: File) -> Result<Child> {
        let both = output.try_clone()?;
        self.0.stdout(output).stderr(both);
        let start = self.0.spawn();
        start.with_context(|| format!("cannot start {:?}", self.0))
    }

    /// Runs the command and captures its output.
    pub(crate) fn capture(mut self) -> Result<Captured> {
        let output = self
            .0
            .output()
            .with_context(|| format!("cannot start {:?}", self.0))?;
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ok(Captured {
            succeeded: output.status.success(),
            stdout: text(&output.stdout),
            stderr: text(&output.stderr),
        })
    }

    /// Returns `true` if the command starts and succeeds; its output is discarded.
    pub(crate) fn succeeds(self) -> bool {
        self.capture().is_ok_and(|c| c.succeeded)
    }
}

static SHARED_ENV: Mutex<Vec<(String, OsString)>> = Mutex::new(Vec::new());

/// Sets a variable for every later step.
pub(crate) fn set_env(name: &str, value: impl Into<OsString>) {
    SHARED_ENV
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .push((name.to_owned(), value.into()));
}

fn shared_env() -> Vec<(String, OsString)> {
    SHARED_ENV
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .clone()
}
