//! `guideway generate`: a test layout of any size, written as it is made.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::formats::Progress;
use guideway::formats::arrow::{ArrowWriter, Column, ColumnType, Precision, WriteError};
use guideway::layout::Value;
use guideway_datasets::{GeneratedPath, RUN_POINTS, d1, d2};
use serde_json::json;

use super::activity::Activity;
use super::{Exit, Failure, Output, arrow, text, values};

/// How often the display learns how far it is, in paths.
const STEP: usize = 4096;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Kind of layout
    dataset: Dataset,
    /// Number of paths, such as 1000000 or 1_000_000
    #[arg(long, value_name = "N", value_parser = values::paths)]
    paths: usize,
    /// Another seed gives another layout of the same kind
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
    /// File to write; its name ends in .arrow or .feather
    #[arg(long, short, value_name = "FILE")]
    output: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Dataset {
    /// The shape of a real site, hall beside hall
    D1,
    /// Curves over one field, until every pixel lies under many
    D2,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    arrow::check_output(&args.output)?;
    let activity = out.activity(format!("writing {}", args.output.display()));
    let ((), bytes) = arrow::replace(&args.output, |file| match args.dataset {
        Dataset::D1 => write(file, d1(args.paths, args.seed), args.paths, &activity),
        Dataset::D2 => write(file, d2(args.paths, args.seed), args.paths, &activity),
    })?;
    let took_ms = activity.finish();

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
    out.report("generate", &body, || {
        format!(
            "{}: {} of {}, {}\ntook {}\n",
            args.output.display(),
            text::counted(args.paths as u64, "path"),
            text::counted(segments as u64, "segment"),
            text::bytes(bytes),
            text::time(took_ms)
        )
    })?;
    Ok(Exit::Clean)
}

fn write(
    file: &Path,
    paths: impl Iterator<Item = GeneratedPath>,
    total: usize,
    activity: &Activity,
) -> Result<(), WriteError> {
    let columns = vec![
        Column::new("kind", ColumnType::Text),
        Column::new("max_speed", ColumnType::Float32),
        Column::new("hall", ColumnType::Int32),
    ];
    let mut writer = ArrowWriter::create(file, Precision::F32, columns)?;
    for (done, path) in paths.enumerate() {
        let values = [
            Some(Value::Text(path.kind.name())),
            Some(Value::Float(path.max_speed_m_s.into())),
            Some(Value::Int(path.hall.into())),
        ];
        writer.push_run(&path.id, &path.run, &values)?;
        if done % STEP == 0 {
            activity.advance(done as u64, total as u64);
        }
    }
    writer.finish()
}
