//! `guideway convert`: a layout in another format.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use guideway::formats::{arrow as arrow_format, geojson};
use guideway::layout::{Diagnostics, Layout};
use guideway::{SaveError, replace_file};
use serde_json::{Value, json};

use super::{Exit, Failure, Output, arrow, input, text};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Layout file: LIF, VDA 5050, openTCS, DXF, GeoJSON or Arrow, found from its content
    input: PathBuf,
    /// File to write; its name ends in .arrow, .feather or .geojson
    output: PathBuf,
}

/// What can be written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Target {
    Arrow,
    GeoJson,
}

impl Target {
    fn of(output: &Path) -> Result<Self, Failure> {
        let ending = output.extension().unwrap_or_default();
        if ending.eq_ignore_ascii_case("geojson") {
            return Ok(Self::GeoJson);
        }
        if arrow::has_ending(output) {
            return Ok(Self::Arrow);
        }
        Err(Failure {
            code: "target-format",
            message: format!(
                "{}: what can be written ends in .arrow, .feather or .geojson",
                output.display()
            ),
            remedy: "Name the output so, such as `site.arrow`; for a picture use `guideway render`"
                .into(),
        })
    }

    fn name(self) -> &'static str {
        match self {
            Self::Arrow => "Arrow",
            Self::GeoJson => "GeoJSON",
        }
    }

    fn check_output(self, input: &Path, output: &Path) -> Result<(), Failure> {
        match self {
            Self::Arrow => arrow::check_output(Some(input), output),
            Self::GeoJson => input::check_output(Some(input), output),
        }
    }

    /// Writes the file whole or not at all; returns what it cannot hold, and its size.
    fn write(self, layout: &Layout, output: &Path) -> Result<(Diagnostics, u64), Failure> {
        match self {
            Self::Arrow => arrow::replace(output, |file| {
                arrow_format::write_layout(layout, file, &arrow_format::WriteOptions::default())
            }),
            Self::GeoJson => Ok(replace_file(output, |file| {
                write_geojson(layout, file).map_err(|problem| SaveError {
                    path: output.to_owned(),
                    problem,
                })
            })?),
        }
    }
}

fn write_geojson(layout: &Layout, file: &Path) -> io::Result<(Diagnostics, u64)> {
    let mut out = BufWriter::new(File::create(file)?);
    let losses = geojson::write_layout(layout, &mut out, &geojson::WriteOptions::default())?;
    out.flush()?;
    Ok((losses, out.get_ref().metadata()?.len()))
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let target = Target::of(&args.output)?;
    target.check_output(&args.input, &args.output)?;
    let (layout, read_ms) = input::read(&args.input, out)?;
    let activity = out.activity(format!("writing {}", args.output.display()));
    let (losses, bytes) = target.write(&layout, &args.output)?;
    let write_ms = activity.finish();

    let lost: Vec<Value> = losses
        .iter()
        .map(|loss| json!({ "place": loss.place.element, "message": loss.message }))
        .collect();
    let body = json!({
        "file": args.input.to_string_lossy(),
        "output": args.output.to_string_lossy(),
        "format": target.name(),
        "paths": layout.paths.len(),
        "bytes": bytes,
        "not_stored": lost,
        "ms": { "read": read_ms, "write": write_ms, "total": read_ms + write_ms },
    });
    out.report("convert", &body, || {
        let mut text = format!(
            "{}: {}, {}\n",
            args.output.display(),
            text::counted(layout.paths.len() as u64, "path"),
            text::bytes(bytes)
        );
        if !losses.is_empty() {
            text += &format!(
                "what a file of {} cannot hold, so keep the source:\n",
                target.name()
            );
        }
        for loss in losses.iter() {
            let place = text::plain(&loss.place.element, 80);
            text += &format!("  {place}: {}\n", text::plain(&loss.message, 200));
        }
        text + &format!(
            "took {}: reading {}, writing {}\n",
            text::time(read_ms + write_ms),
            text::time(read_ms),
            text::time(write_ms)
        )
    })?;
    Ok(Exit::Clean)
}
