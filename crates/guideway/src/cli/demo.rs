//! `guideway demo`: a picture of the built-in example site.

use std::path::PathBuf;
use std::sync::Arc;

use guideway::compose::{Decorations, Picture, Rendered};
use guideway::formats::{ReadOptions, read_bytes};
use guideway::layout::{Layout, UserError, shown_path};
use guideway::scene::{ColorBy, FrameSize, Legend, LineRule, Scene, SceneOptions};
use serde_json::json;

use super::exit::Exit;
use super::output::Output;
use super::picture_file::check_extension;
use super::render::paths_text;
use super::{input, text};

/// The example site, part of the program so that the demo runs anywhere.
const SITE: &[u8] = include_bytes!("../../examples/site.lif.json");
const SITE_NAME: &str = "crates/guideway/examples/site.lif.json";

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// PNG file to write
    #[arg(long, short, value_name = "PNG", default_value = "demo.png")]
    output: PathBuf,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    input::check_output(None, &args.output)?;
    check_extension(&args.output)?;
    let progress = out.progress("drawing the example site");
    let layout = read_site()?;
    let options = SceneOptions {
        color_by: Some(ColorBy {
            column: "maxSpeed".into(),
        }),
        level: layout.levels.first().map(|level| level.id.clone()),
        ..SceneOptions::default()
    };
    let scene = Arc::new(Scene::new(Arc::new(layout), &options)?);
    let mut picture = Picture::new(Arc::clone(&scene), FrameSize::new(1920, 1080)?);
    // Wider than by default: the picture is to be looked at, not measured.
    picture.style.line_rule = LineRule::World {
        width_m: 0.25,
        min_px: 2.5,
        max_px: 12.0,
    };
    picture.decorations = Decorations::site("Guideway example site");
    let method = guideway::method("cpu")?;
    let rendered = picture.save_png(&*method, &args.output, &progress)?;
    let took_ms = progress.finish();
    let output = args
        .output
        .canonicalize()
        .unwrap_or_else(|_| args.output.clone());
    let body = json!({
        "output": output.to_string_lossy(),
        "paths": { "total": rendered.report.total, "drawn": rendered.report.drawn },
        "method": { "name": rendered.method.name, "device": rendered.method.device },
        "ms": { "total": took_ms },
    });
    out.report("demo", &body, || {
        format!(
            "The picture is in {}\n\n{}{}took {}\n\n{}",
            shown_path(&output),
            paths_text(&rendered),
            scene.legend().map_or_else(String::new, speeds),
            text::time(took_ms),
            next_steps(&rendered),
        )
    })?;
    Ok(Exit::Clean)
}

/// The layout of the example site.
pub(super) fn read_site() -> Result<Layout, UserError> {
    Ok(read_bytes(SITE_NAME, SITE, &ReadOptions::default())?)
}

/// The colors of the picture: one line per maximum speed.
fn speeds(legend: &Legend) -> String {
    let entries = legend.entries.iter().filter_map(|entry| {
        let paths = text::counted(entry.paths?, "path");
        Some(format!("  {}  {} ({paths})\n", entry.color, entry.label))
    });
    let title = legend.title();
    format!("colored by {title}:\n{}", entries.collect::<String>())
}

/// Commands to try on other files.
fn next_steps(rendered: &Rendered) -> String {
    let center = rendered.view.center_m();
    format!(
        "Try it on a file of your own (LIF, VDA 5050, openTCS, DXF, GeoJSON or Arrow):\n  \
           guideway info site.lif.json\n  \
           guideway check site.lif.json\n  \
           guideway render site.lif.json -o site.png --site\n  \
           guideway render site.lif.json -o closer.png --center {:.0},{:.0} --scale 40\n",
        center.x, center.y
    )
}
