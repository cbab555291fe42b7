//! `guideway convert`: writes a layout in another format.

use std::io::Write;
use std::path::{Path, PathBuf};

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use guideway::formats::{Losses, Target, WriteError, WriteProblem};
use guideway::layout::{Layout, UserError, shown_path};
use guideway::{NewFile, replace_file};
use serde_json::{Value, json};

use super::error::Exit;
use super::input::{self, Input};
use super::output::Output;
use super::progress_bar::{ProgressBar, plan};
use super::stdout::Stdout;
use super::{limits, stdout, text};

#[derive(Debug, clap::Args)]
#[command(after_help = input::PLACEMENT_HELP)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
    /// File to write; its extension selects the format unless --to is given. LIF stays in the
    /// version that was read. `-` writes to standard output
    output: PathBuf,
    /// Format of the output
    #[arg(long, value_name = "FORMAT", value_parser = target_parser())]
    to: Option<Target>,
}

/// Parses the identifier of a target, with its extensions in the help.
fn target_parser() -> impl TypedValueParser<Value = Target> {
    let values = Target::ALL.iter().map(|target| {
        let extensions = target.extensions().join(", ");
        let help = match extensions.as_str() {
            "" => target.description().to_owned(),
            extensions => format!("{}: {extensions}", target.description()),
        };
        PossibleValue::new(target.id()).help(help)
    });
    PossibleValuesParser::new(values)
        .try_map(|id| Target::from_id(&id).ok_or("the list of formats has this identifier"))
}

/// The format that the extension of a file promises.
fn promised(output: &Path) -> Option<Target> {
    let name = output.file_name().unwrap_or_default();
    Target::of_file_name(&name.to_string_lossy())
}

/// Says that `--to` selects another format than the extension promises.
fn contradiction(target: Target, output: &Path) -> Option<String> {
    let promised = promised(output).filter(|promised| {
        // Versions of one format share the extension of one of them.
        let family = |target: Target| target.name().split(' ').next().map(str::to_owned);
        family(*promised) != family(target)
    })?;
    Some(format!(
        "note: {} holds {}, as `--to` says, though its extension is that of {}",
        shown_path(output),
        target.name(),
        promised.name()
    ))
}

/// The format to save a layout in: see [`Target::for_file`].
pub(super) fn target_to_save(layout: &Layout, output: &Path) -> Result<Target, UserError> {
    Target::for_file(layout, output).ok_or_else(|| no_target(output))
}

/// No format has the extension of a file.
fn no_target(output: &Path) -> UserError {
    let error = UserError::from(guideway::SaveAsError::extension(output));
    let remedy = "Rename the output or name its format, such as `--to lif2`; `guideway render` \
                  writes pictures";
    UserError {
        remedy: remedy.to_owned(),
        ..error
    }
}

/// Rejects saving a layout over its source if the source may hold more than the layout.
#[cfg(feature = "viewer")]
pub(super) fn check_in_place(layout: &Layout, file: &Path) -> Result<(), UserError> {
    let refused = layout.refused.len();
    let target = target_to_save(layout, file)?;
    let would_lose = match target {
        _ if target.is_drawing() => "is a drawing: saving would keep only the paths".to_owned(),
        // Other XML formats and older versions of openTCS have the same extension.
        Target::OpenTcs6 | Target::OpenTcs7 if Target::of_source(layout) != Some(target) => {
            format!("is no {}", target.name())
        }
        Target::GeoJson
        | Target::Nav2
        | Target::Rmf
        | Target::OpenTcs6
        | Target::OpenTcs7
        | Target::Vda2
        | Target::Vda3
            if refused > 0 =>
        {
            format!("has {refused} refused paths, which saving would drop")
        }
        _ => return Ok(()),
    };
    Err(UserError::new(
        "target-format",
        format!("{} {would_lose}", shown_path(file)),
        "Save the layout under another name",
    ))
}

/// Writes the file atomically. Returns the losses of the format and the size of the file.
pub(super) fn write(
    target: Target,
    layout: &Layout,
    output: &Path,
    progress: &ProgressBar,
) -> Result<(Losses, u64), UserError> {
    Ok(replace_file(output, |file| {
        file.set_limit(limits::limits().output_bytes);
        let written = target.write_watched(layout, &mut progress.counted(&mut *file), progress);
        let losses = written.map_err(|problem| write_error(output, problem))?;
        Ok::<_, WriteError>((losses, file.bytes()))
    })?)
}

fn write_error(output: &Path, problem: WriteProblem) -> WriteError {
    WriteError {
        path: output.to_owned(),
        problem,
    }
}

/// Writes the layout into a new file for `output`. Returns the losses of the format.
pub(super) fn write_into(
    file: &mut NewFile,
    target: Target,
    layout: &Layout,
    output: &Path,
) -> Result<Losses, WriteError> {
    file.set_limit(limits::limits().output_bytes);
    let written = target.write(layout, file);
    written.map_err(|problem| write_error(output, problem))
}

/// Writes the file to standard output.
fn write_stdout(
    target: Target,
    layout: &Layout,
    progress: &ProgressBar,
) -> Result<(Losses, u64), UserError> {
    let mut out = Stdout::lock();
    let losses = target.write_watched(layout, &mut progress.counted(&mut out), progress);
    let losses = losses.and_then(|losses| Ok(out.flush().map(|()| losses)?));
    let losses = losses.map_err(|problem| write_error(Path::new("-"), problem))?;
    Ok((losses, out.bytes()))
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    // An unknown extension must not wait for the read; the source decides about these two.
    let is_of_source = Target::depends_on_source(&args.output);
    if args.to.is_none() && !is_of_source && promised(&args.output).is_none() {
        return Err(no_target(&args.output));
    }
    let is_stdout = stdout::is_stdout(&args.output);
    match is_stdout {
        true => stdout::check(out, (args.to == Some(Target::Arrow)).then_some("Arrow"))?,
        false => input::check_output(args.inputs.iter().map(|i| i.path.as_path()), &args.output)?,
    }
    // Reading, merging, writing.
    plan(args.inputs.len(), &[5.0, 0.1, 5.0]);
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let of_source = || target_to_save(&layout, &args.output);
    let target = args.to.map_or_else(of_source, Ok)?;
    let progress = out.progress(format!("writing {}", shown_path(&args.output)));
    let (losses, bytes) = match is_stdout {
        true => write_stdout(target, &layout, &progress)?,
        false => write(target, &layout, &args.output, &progress)?,
    };
    let write_ms = progress.finish();

    let lost = losses.iter().map(
        |loss| json!({ "place": loss.what, "count": loss.count, "message": loss.to_string() }),
    );
    let body = json!({
        "file": input::names(&args.inputs),
        "output": args.output.to_string_lossy(),
        "format": target.name(),
        "paths": layout.paths.len(),
        "bytes": bytes,
        "not_stored": lost.collect::<Vec<Value>>(),
        "ms": { "read": read_ms, "write": write_ms, "total": read_ms + write_ms },
    });
    let report = || {
        let mut text = format!(
            "{}: {}, {}\n",
            shown_path(&args.output),
            text::counted(layout.paths.len() as u64, "path"),
            text::bytes(bytes)
        );
        if !losses.is_empty() {
            text += &format!("{} cannot hold, or holds in another form:\n", target.name());
        }
        for loss in losses.iter() {
            let (what, count) = (text::single_line(&loss.what, 80), text::count(loss.count));
            text += &format!(
                "  {what}: {count} {}\n",
                text::single_line(&loss.noun(), 200)
            );
        }
        text + &format!(
            "took {}: reading {}, writing {}\n",
            text::time(read_ms + write_ms),
            text::time(read_ms),
            text::time(write_ms)
        )
    };
    match is_stdout {
        true => out.note(report().trim_end()),
        false => out.report("convert", &body, report)?,
    }
    if let Some(note) = contradiction(target, &args.output) {
        out.note(&note);
    }
    Ok(Exit::Clean)
}

#[cfg(all(test, feature = "viewer"))]
mod tests {
    use super::*;

    fn read_from(format: &str, version: &str) -> Layout {
        let mut layout = Layout::default();
        layout.provenance.format = format.into();
        layout.provenance.format_version = version.into();
        layout
    }

    #[test]
    fn saves_in_the_format_of_the_source() {
        use Target::{Arrow, GeoJson, Lif1, Lif2, Nav2, OpenTcs6, OpenTcs7, Rmf, Vda2, Vda3};
        for (format, version, name, target) in [
            ("LIF", "1.0", "a.lif.json", Some(Lif1)),
            ("LIF", "2.0", "a.lif.json", Some(Lif2)),
            ("LIF", "2.0", "site.json", Some(Lif2)),
            ("LIF", "2.0", "a.arrow", Some(Arrow)),
            ("GeoJSON", "", "roads.json", Some(GeoJson)),
            ("GeoJSON", "", "roads.lif.json", Some(Lif1)),
            ("GeoJSON", "Nav2 route graph", "graph.geojson", Some(Nav2)),
            ("GeoJSON", "Nav2 route graph", "graph.json", Some(Nav2)),
            ("Open-RMF", "navigation graph", "0.yaml", Some(Rmf)),
            ("Open-RMF", "building", "office.building.yaml", None),
            ("VDA 5050", "2.0", "order.json", Some(Vda2)),
            ("VDA 5050", "3.0", "order.json", Some(Vda3)),
            ("VDA 5050", "3.0", "a.vda5050.json", Some(Vda3)),
            ("openTCS", "6.0.0", "plant.xml", Some(OpenTcs6)),
            ("openTCS", "7.0.0", "plant.xml", Some(OpenTcs7)),
            ("LIF", "1.0", "site.txt", None),
        ] {
            let layout = read_from(format, version);
            let saved = target_to_save(&layout, Path::new(name));
            assert_eq!(saved.ok(), target, "{format} {version} as {name}");
            let in_place = check_in_place(&layout, Path::new(name));
            assert_eq!(in_place.is_ok(), target.is_some(), "{name}");
        }
        for (format, version) in [("openTCS", "0.0.2"), ("OpenDRIVE", "1.6")] {
            let layout = read_from(format, version);
            let saved = target_to_save(&layout, Path::new("map.xml"));
            assert_eq!(saved.ok(), Some(OpenTcs7));
            let rejected = check_in_place(&layout, Path::new("map.xml"));
            assert!(rejected.unwrap_err().message.contains("no openTCS 7.0.0"));
        }
        let drawing = read_from("DXF", "AC1015");
        let rejected = check_in_place(&drawing, Path::new("plan.dxf"));
        assert!(rejected.unwrap_err().message.contains("only the paths"));
        assert_eq!(
            target_to_save(&drawing, Path::new("b.dxf")).ok(),
            Some(Target::Dxf)
        );
    }
}
