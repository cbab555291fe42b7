//! `guideway convert`: writes a layout in another format.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use clap::ValueEnum;
#[cfg(feature = "viewer")]
use guideway::formats::Format;
use guideway::formats::lif::{self, Version};
use guideway::formats::{Losses, arrow as arrow_format, dxf, geojson, svg};
use guideway::layout::{Layout, UserError};
use guideway::{SaveError, replace_file};
use serde_json::{Value, json};

use super::exit::Exit;
use super::input::{self, Input};
use super::output::Output;
use super::{arrow, text};

#[derive(Debug, clap::Args)]
#[command(after_help = input::PLACEMENT_HELP)]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    inputs: Vec<Input>,
    /// File to write; its extension selects the format unless --to is given
    output: PathBuf,
    /// Format of the output
    #[arg(long, value_name = "FORMAT")]
    to: Option<Target>,
}

/// The formats with a writer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Target {
    /// Apache Arrow, a row per run: .arrow, .feather
    Arrow,
    /// DXF, a drawing for CAD programs: .dxf
    Dxf,
    /// GeoJSON, a Nav2 route graph if the layout has nodes: .geojson
    Geojson,
    /// VDMA LIF 1.0: .lif.json, .lif
    Lif,
    /// VDMA LIF 2.0
    Lif2,
    /// SVG, a drawing with exact curves: .svg
    Svg,
}

impl Target {
    /// The format that the extension of a file selects.
    pub(super) fn of(output: &Path) -> Result<Self, UserError> {
        let name = output.file_name().unwrap_or_default().to_string_lossy();
        let name = name.to_lowercase();
        let extensions = [
            (".arrow", Self::Arrow),
            (".feather", Self::Arrow),
            (".geojson", Self::Geojson),
            (".lif.json", Self::Lif),
            (".lif", Self::Lif),
            (".dxf", Self::Dxf),
            (".svg", Self::Svg),
        ];
        let known = extensions
            .iter()
            .find(|(extension, _)| name.ends_with(extension));
        known.map(|(_, target)| *target).ok_or_else(|| {
            let extensions = extensions.map(|(extension, _)| extension).join(", ");
            UserError::new(
                "target-format",
                format!(
                    "{}: no format has this extension; known are {extensions}",
                    output.display()
                ),
                "Rename the output or name its format, such as `--to lif2`; `guideway render` \
                 writes pictures",
            )
        })
    }

    /// The format to save a layout in: by the extension of the file, or by the source of the layout
    /// where the extension fits several formats.
    #[cfg(feature = "viewer")]
    pub(super) fn to_save(layout: &Layout, output: &Path) -> Result<Self, UserError> {
        let is_geojson = layout.provenance.format == Format::GeoJson.name();
        let read = match Version::of_layout(layout) {
            Some(Version::V1) => Some(Self::Lif),
            Some(Version::V2) => Some(Self::Lif2),
            None => is_geojson.then_some(Self::Geojson),
        };
        let is_any_json = output
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("json"));
        match (Self::of(output), read) {
            (Ok(Self::Lif), Some(Self::Lif2)) => Ok(Self::Lif2),
            (Err(_), Some(read)) if is_any_json => Ok(read),
            (named, _) => named,
        }
    }

    /// Rejects saving a layout over its source if the source may hold more than the layout.
    #[cfg(feature = "viewer")]
    pub(super) fn check_in_place(layout: &Layout, file: &Path) -> Result<(), UserError> {
        let refused = layout.refused.len();
        let would_lose = match Self::to_save(layout, file)? {
            Self::Dxf | Self::Svg => "is a drawing: saving would keep only the paths".to_owned(),
            Self::Arrow | Self::Geojson if refused > 0 => {
                format!("has {refused} refused paths, which saving would drop")
            }
            Self::Arrow | Self::Geojson | Self::Lif | Self::Lif2 => return Ok(()),
        };
        Err(UserError::new(
            "target-format",
            format!("{} {would_lose}", file.display()),
            "Save the layout under another name",
        ))
    }

    fn name(self) -> &'static str {
        match self {
            Self::Arrow => "Arrow",
            Self::Dxf => "DXF",
            Self::Geojson => "GeoJSON",
            Self::Lif => "LIF 1.0",
            Self::Lif2 => "LIF 2.0",
            Self::Svg => "SVG",
        }
    }

    /// Writes the file atomically. Returns the losses of the format and the size of the file.
    pub(super) fn write(self, layout: &Layout, output: &Path) -> Result<(Losses, u64), UserError> {
        let write: TextWriter = match self {
            Self::Arrow => {
                return arrow::replace(output, |file| {
                    arrow_format::write_layout(layout, file, &arrow_format::WriteOptions::default())
                });
            }
            Self::Dxf => |layout, out| dxf::write_layout(layout, out),
            Self::Geojson => {
                |layout, out| geojson::write_layout(layout, out, &geojson::WriteOptions::default())
            }
            Self::Lif => |layout, out| lif::write_layout(layout, out, &lif_options(Version::V1)),
            Self::Lif2 => |layout, out| lif::write_layout(layout, out, &lif_options(Version::V2)),
            Self::Svg => |layout, out| svg::write_layout(layout, out),
        };
        let write = |file: &Path| {
            let mut out = BufWriter::with_capacity(1 << 16, File::create(file)?);
            let losses = write(layout, &mut out)?;
            out.flush()?;
            Ok((losses, out.get_ref().metadata()?.len()))
        };
        Ok(replace_file(output, |file| {
            write(file).map_err(|problem| SaveError {
                path: output.to_owned(),
                problem,
            })
        })?)
    }
}

/// Writes a layout in a text format.
type TextWriter = fn(&Layout, &mut BufWriter<File>) -> io::Result<Losses>;

fn lif_options(version: Version) -> lif::WriteOptions {
    lif::WriteOptions {
        version,
        exported: SystemTime::now(),
    }
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let target = args.to.map_or_else(|| Target::of(&args.output), Ok)?;
    input::check_output(args.inputs.iter().map(|i| i.path.as_path()), &args.output)?;
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let progress = out.progress(format!("writing {}", args.output.display()));
    let (losses, bytes) = target.write(&layout, &args.output)?;
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
    out.report("convert", &body, || {
        let mut text = format!(
            "{}: {}, {}\n",
            args.output.display(),
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
                text::single_line(&loss.detail, 200)
            );
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
        use Target::{Arrow, Geojson, Lif, Lif2};
        for (format, version, name, target) in [
            ("LIF", "1.0", "a.lif.json", Some(Lif)),
            ("LIF", "2.0", "a.lif.json", Some(Lif2)),
            ("LIF", "2.0", "site.json", Some(Lif2)),
            ("LIF", "2.0", "a.arrow", Some(Arrow)),
            ("GeoJSON", "", "roads.json", Some(Geojson)),
            ("GeoJSON", "", "roads.lif.json", Some(Lif)),
            ("VDA 5050", "2.0", "order.json", None),
            ("openTCS", "6.0.0", "plant.xml", None),
            ("LIF", "1.0", "site.txt", None),
        ] {
            let layout = read_from(format, version);
            let saved = Target::to_save(&layout, Path::new(name));
            assert_eq!(saved.ok(), target, "{format} {version} as {name}");
            let in_place = Target::check_in_place(&layout, Path::new(name));
            assert_eq!(in_place.is_ok(), target.is_some(), "{name}");
        }
        let drawing = read_from("DXF", "AC1015");
        let rejected = Target::check_in_place(&drawing, Path::new("plan.dxf"));
        assert!(rejected.unwrap_err().message.contains("only the paths"));
        assert_eq!(
            Target::to_save(&drawing, Path::new("b.dxf")).ok(),
            Some(Target::Dxf)
        );
    }
}
