//! `guideway generate`: a test layout of any size, streamed to an Arrow file.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::formats::Progress;
use guideway::formats::arrow::{ArrowWriter, Column, ColumnType, Precision, WriteError};
use guideway::layout::{UserError, Value, shown_path};
use guideway_datasets::{GeneratedPath, RUN_POINTS, d1, d2};
use serde_json::json;

use super::error::Exit;
use super::output::{Output, is_stdout};
use super::progress_bar::ProgressBar;
use super::stdout::Stdout;
use super::{input, stdout, text, values};

/// Extensions of Arrow files.
const EXTENSIONS: [&str; 2] = ["arrow", "feather"];
/// Paths between two updates of the progress.
const PROGRESS_STEP: usize = 4096;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Kind of layout
    dataset: Dataset,
    /// Number of paths, such as 1000000, 1_000_000, 1e6 or 10k
    #[arg(long, value_name = "N", value_parser = values::paths)]
    paths: usize,
    /// Seed of the random numbers; the same seed generates the same file
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// Arrow file to write: .arrow or .feather. `-` is standard output
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Dataset {
    /// The shape of a real site: halls side by side
    D1,
    /// Overlapping curves on one field: every pixel has many paths
    D2,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    check_output(&args.output, out)?;
    let progress = out.progress(format!("writing {}", shown_path(&args.output)));
    let (file, paths) = (&args.output, args.paths);
    let bytes = match args.dataset {
        Dataset::D1 => write(file, d1(paths, args.seed), paths, &progress),
        Dataset::D2 => write(file, d2(paths, args.seed), paths, &progress),
    }?;
    let took_ms = progress.finish();

    let segments = args.paths * (RUN_POINTS - 3);
    let body = json!({
        "dataset": match args.dataset {
            Dataset::D1 => "d1",
            Dataset::D2 => "d2",
        },
        "output": args.output.to_string_lossy(),
        "paths": args.paths,
        "segments": segments,
        "seed": args.seed,
        "bytes": bytes,
        "ms": { "total": took_ms },
    });
    out.beside(Some(&args.output))
        .report("generate", &body, || {
            format!(
                "{}: {} of {}, {}\ntook {}\n",
                shown_path(&args.output),
                text::counted(args.paths as u64, "path"),
                text::counted(segments as u64, "segment"),
                text::bytes(bytes),
                text::time(took_ms)
            )
        })?;
    Ok(Exit::Clean)
}

/// Rejects an output that is not an Arrow file, before any long work.
fn check_output(output: &Path, out: &Output) -> Result<(), UserError> {
    if is_stdout(output) {
        return stdout::check(out, Some("Arrow"));
    }
    let extension = output.extension().unwrap_or_default();
    if !EXTENSIONS.iter().any(|e| extension.eq_ignore_ascii_case(e)) {
        return Err(UserError::new(
            "target-format",
            format!(
                "{}: not the name of an Arrow file, which ends in .arrow or .feather",
                shown_path(output)
            ),
            "Rename the output, such as `site.arrow`; `guideway render` writes pictures",
        ));
    }
    input::check_output(None, output)
}

/// Writes the paths. Returns the size of the file in bytes.
fn write(
    file: &Path,
    paths: impl Iterator<Item = GeneratedPath>,
    total: usize,
    progress: &ProgressBar,
) -> Result<u64, UserError> {
    let columns = columns();
    if !is_stdout(file) {
        let mut writer = ArrowWriter::create(file, Precision::F32, columns)?;
        push(&mut writer, paths, total, progress)?;
        return Ok(writer.finish()?);
    }
    let mut writer = ArrowWriter::to_stream(Stdout::lock(), file, Precision::F32, columns)?;
    push(&mut writer, paths, total, progress)?;
    let mut stream = writer.finish_stream()?;
    stream.flush().map_err(stdout::fail)?;
    Ok(stream.bytes())
}

fn columns() -> Vec<Column> {
    vec![
        Column::new("kind", ColumnType::Text),
        Column::new("max_speed", ColumnType::Float32),
        Column::new("hall", ColumnType::Int32),
    ]
}

fn push<W: Write>(
    writer: &mut ArrowWriter<W>,
    paths: impl Iterator<Item = GeneratedPath>,
    total: usize,
    progress: &ProgressBar,
) -> Result<(), WriteError> {
    for (done, path) in paths.enumerate() {
        let values = [
            Some(Value::Text(path.kind.name())),
            Some(Value::Float(path.max_speed_m_s.into())),
            Some(Value::Int(path.hall.into())),
        ];
        writer.push_run(&path.id, &path.run, &values)?;
        if done % PROGRESS_STEP == 0 {
            progress.advance(done as u64, total as u64);
        }
    }
    Ok(())
}
