//! A task of this program that runs beside another, in a process of its own: what it prints goes to
//! a file and is shown after it, so that the two are not mixed.

use std::fs::File;
use std::io;
use std::path::PathBuf;
use std::process::Child;
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, bail};

use crate::step;

/// Time between two looks at a task that still runs.
const POLL: Duration = Duration::from_millis(200);

pub(crate) struct Beside {
    task: &'static str,
    process: Child,
    log: PathBuf,
}

impl Beside {
    pub(crate) fn start(task: &'static str) -> Result<Self> {
        let log = PathBuf::from(format!("target/xtask-{task}.log"));
        let file = File::create(&log).with_context(|| format!("cannot write {}", log.display()))?;
        println!(
            "\nbeside the next: cargo xtask {task}, into {}",
            log.display()
        );
        // By its name: the build of the tests can have replaced the file of this process.
        let program = format!("xtask{}", std::env::consts::EXE_SUFFIX);
        let program = std::env::current_exe()?.with_file_name(program);
        let process = step::command(program).args([task]).start(file)?;
        Ok(Self { task, process, log })
    }

    /// Prints what the task has printed and, until it ends, what it still prints: a task that hangs
    /// has shown where.
    ///
    /// # Errors
    /// When the task failed.
    pub(crate) fn finish(mut self) -> Result<()> {
        let mut printed = File::open(&self.log)?;
        let status = loop {
            // Before the copy: the last words of a task that has ended are copied too.
            let ended = self.process.try_wait()?;
            io::copy(&mut printed, &mut io::stdout())?;
            if let Some(status) = ended {
                break status;
            }
            thread::sleep(POLL);
        };
        if !status.success() {
            bail!("cargo xtask {} failed: {status}", self.task);
        }
        Ok(())
    }
}
