//! `guideway reproduce`: the thesis' tables and figures, measured on this computer.

mod saved;
mod text;

use std::cell::RefCell;
use std::path::PathBuf;

use guideway::render::Cancel;
use guideway_bench::Start;
use guideway_reproduce::reproduce::{Plan, Run, reproduce, resume};

use super::activity::Activity;
use super::{Exit, Failure, Output, interrupt, values};
use saved::RUN;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
    guideway reproduce --quick\n  \
    guideway reproduce --out report --methods grid,grid+scan+radius,tessellation\n  \
    guideway reproduce --continue --out report --minutes 20\n  \
    guideway reproduce --from report/run.json --out again")]
pub(crate) struct Args {
    /// Measure in small: some ten minutes on a processor that plays the graphics device
    #[arg(long)]
    quick: bool,
    /// Folder for the page, the tables and the run
    #[arg(long, value_name = "DIR", default_value = "reproduction")]
    out: PathBuf,
    /// Methods with their options [default: the thesis' with their variants, `gpu` and `cpu`]
    #[arg(long, value_name = "A,B+OPTION", value_delimiter = ',', value_parser = values::MethodSpec)]
    methods: Vec<String>,
    /// Time for all of it; what does not fit is marked as missing [default: 60, or 9 with --quick; as before with --continue]
    #[arg(long, value_name = "N", value_parser = values::minutes)]
    minutes: Option<f64>,
    /// Memory that each method may use, in megabytes [default: 16000, or 2000 with --quick]
    #[arg(long, value_name = "MB")]
    memory: Option<u64>,
    /// Measure what the run in the folder lacks: its time was over, it was stopped, or a part failed
    #[arg(long = "continue", conflicts_with_all = ["quick", "methods", "memory", "from"])]
    is_continued: bool,
    /// Make the page and the tables from the run that this file holds, and measure nothing
    #[arg(long, value_name = "JSON", conflicts_with_all = ["quick", "methods", "minutes", "memory"])]
    from: Option<PathBuf>,
}

enum Task {
    Measure(Plan),
    Continue(Run),
    Show(Run),
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let task = args.task()?;
    // A folder that cannot be written is refused before hours of work.
    saved::make_folder(&args.out)?;
    let run = match task {
        Task::Measure(plan) => measure(args, out, |start, cancel, show| {
            Ok(reproduce(&plan, start, cancel, show)?)
        })?,
        Task::Continue(run) => measure(args, out, |start, cancel, show| {
            let done = resume(run, start, cancel, show);
            done.map_err(|error| saved::cannot_go_on(&args.out, error))
        })?,
        Task::Show(run) => run,
    };
    saved::write_report(&args.out, &run)?;
    text::answer(&args.out, &run, out)?;
    Ok(if run.is_partial {
        Exit::Interrupted
    } else {
        Exit::Clean
    })
}

/// Shows what is being measured, and keeps what was.
fn measure(
    args: &Args,
    out: &Output,
    work: impl FnOnce(Start<'_>, &Cancel, &dyn Fn(&str)) -> Result<Run, Failure>,
) -> Result<Run, Failure> {
    let start = |spec: &str| guideway::method(spec).map_err(|error| error.to_string());
    let shown: RefCell<Option<Activity>> = RefCell::default();
    let show = |what: &str| {
        let mut shown = shown.borrow_mut();
        // One display at a time.
        *shown = None;
        *shown = Some(out.activity(what));
    };
    let run = work(&start, &interrupt::patiently(), &show)?;
    drop(shown);
    saved::write_run(&args.out, &run)?;
    if !run.is_whole() {
        out.note("Run it again with --continue to measure what is missing");
    }
    Ok(run)
}

/// What does not run here has its row with the reason; what makes no sense is refused.
fn check_methods(plan: &Plan) -> Result<(), Failure> {
    for spec in &plan.methods {
        match guideway::method(spec) {
            Ok(_) | Err(guideway::MethodError::Unavailable { .. }) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

impl Args {
    fn task(&self) -> Result<Task, Failure> {
        if let Some(path) = &self.from {
            return saved::read(path).map(Task::Show);
        }
        if !self.is_continued {
            return self.plan().map(Task::Measure);
        }
        let mut run = saved::read(&self.out.join(RUN))?;
        check_methods(&run.plan)?;
        run.plan.minutes = self.minutes.unwrap_or(run.plan.minutes);
        Ok(Task::Continue(run))
    }

    fn plan(&self) -> Result<Plan, Failure> {
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
