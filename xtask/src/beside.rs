//! A task of this program that runs beside another, in a process of its own: what it prints goes to
//! a file and is shown after it, so that the two are not mixed.

use std::fs::{self, File};
use std::path::PathBuf;
use std::process::Child;

use anyhow::{Context, Result, bail};

use crate::step;

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

    /// Waits for the end of the task and prints what it printed.
    ///
    /// # Errors
    /// When the task failed.
    pub(crate) fn finish(mut self) -> Result<()> {
        let status = self.process.wait()?;
        let printed = fs::read(&self.log)?;
        print!("{}", String::from_utf8_lossy(&printed));
        if !status.success() {
            bail!("cargo xtask {} failed: {status}", self.task);
        }
        Ok(())
    }
}
