//! Arguments of `reproduce`; measures, continues or shows a run.

use std::path::PathBuf;

use guideway::layout::UserError;
use guideway::scene::Cancel;
use guideway_bench::{Start, StartError};
use guideway_reproduce::reproduce::{Plan, Run, reproduce, resume};

use super::saved::RUN_FILE;
use super::{saved, text};
use crate::cli::error::Exit;
use crate::cli::input::check_no_stdout;
use crate::cli::output::Output;
use crate::cli::part_progress::PartProgress;
use crate::cli::{process, values};

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
    guideway reproduce --quick\n  \
    guideway reproduce -o report --methods grid,grid+scan+radius,tessellation\n  \
    guideway reproduce --continue -o report --minutes 20\n  \
    guideway reproduce --from report/run.json -o again")]
pub(crate) struct Args {
    /// Measure smaller datasets: about ten minutes, even with a software graphics device
    #[arg(long)]
    quick: bool,
    /// Folder for the page, the tables and the run file
    #[arg(
        long = "output",
        short = 'o',
        alias = "out",
        value_name = "DIR",
        default_value = "reproduction"
    )]
    out: PathBuf,
    /// Methods with their options [default: those of the thesis with their variants, `gpu` and
    /// `cpu`]
    #[arg(
        long,
        value_name = "A,B+OPTION",
        value_delimiter = ',',
        value_parser = values::MethodSpec
    )]
    methods: Vec<String>,
    /// Time limit in minutes; parts beyond it are marked as missing [default: 60, or 9 with
    /// --quick; with --continue, that of the run]
    #[arg(long, value_name = "N", value_parser = values::minutes)]
    minutes: Option<f64>,
    /// Memory per method, in megabytes [default: 16000, or 2000 with --quick]
    #[arg(long, value_name = "MB")]
    memory: Option<u64>,
    /// Measure the parts that the run in the folder lacks
    #[arg(long = "continue", conflicts_with_all = ["quick", "methods", "memory", "from"])]
    is_continued: bool,
    /// Write the page and the tables of this run file, and measure nothing
    #[arg(
        long,
        value_name = "JSON",
        conflicts_with_all = ["quick", "methods", "minutes", "memory"]
    )]
    from: Option<PathBuf>,
}

enum Task {
    Measure(Plan),
    Continue(Run),
    Show(Run),
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let task = args.task()?;
    check_no_stdout(&args.out)?;
    // Before hours of work: a folder that cannot be written is an error.
    saved::create_folder(&args.out)?;
    let run = match task {
        Task::Measure(plan) => measure(args, out, |start, cancel, show| {
            Ok(reproduce(&plan, start, cancel, show)?)
        })?,
        Task::Continue(run) => measure(args, out, |start, cancel, show| {
            let done = resume(run, start, cancel, show);
            done.map_err(|error| saved::resume_error(&args.out, error))
        })?,
        Task::Show(run) => run,
    };
    saved::write_report(&args.out, &run)?;
    text::report(&args.out, &run, out)?;
    Ok(if run.is_partial {
        Exit::Interrupted
    } else {
        Exit::Clean
    })
}

/// Measures with the current part on the progress bar, and saves the run.
fn measure(
    args: &Args,
    out: &Output,
    work: impl FnOnce(Start<'_>, &Cancel, &dyn Fn(&str)) -> Result<Run, UserError>,
) -> Result<Run, UserError> {
    let start = |spec: &str| guideway::method(spec).map_err(StartError::new);
    let progress = PartProgress::new(out);
    let show = |part: &str| progress.begin(part);
    let run = work(&start, &process::cancel_on_interrupt(), &show)?;
    drop(progress);
    saved::write_run(&args.out, &run)?;
    if !run.is_whole() {
        out.note("Run it again with --continue to measure the missing parts");
    }
    Ok(run)
}

/// Rejects unknown methods and options. An unavailable method has a row with the reason instead.
fn check_methods(plan: &Plan) -> Result<(), UserError> {
    for spec in &plan.methods {
        match guideway::method(spec) {
            Ok(_) | Err(guideway::MethodError::Unavailable { .. }) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

impl Args {
    fn task(&self) -> Result<Task, UserError> {
        if let Some(path) = &self.from {
            return saved::read(path).map(Task::Show);
        }
        if !self.is_continued {
            return self.plan().map(Task::Measure);
        }
        let mut run = saved::read(&self.out.join(RUN_FILE))?;
        check_methods(&run.plan)?;
        run.plan.minutes = self.minutes.unwrap_or(run.plan.minutes);
        Ok(Task::Continue(run))
    }

    fn plan(&self) -> Result<Plan, UserError> {
        let mut plan = if self.quick {
            Plan::quick()
        } else {
            Plan::full()
        };
        if !self.methods.is_empty() {
            self.methods.clone_into(&mut plan.methods);
        }
        check_methods(&plan)?;
        if let Some(minutes) = self.minutes {
            plan.minutes = minutes;
        }
        if let Some(mb) = self.memory {
            plan.memory_bytes = mb.saturating_mul(1_000_000);
        }
        Ok(plan)
    }
}
