//! `guideway demo`: a picture without a file of one's own.

use std::path::PathBuf;
use std::sync::Arc;

use guideway::formats::{ReadOptions, read_bytes};
use guideway::render::{Budget, DrawList, FrameSize, Style};
use guideway::save_png_by;
use guideway::scene::{ColorBy, Legend, LineRule, Scene, SceneOptions};
use serde_json::json;

use super::render::{Below, Drawn, Wishes, draw, what_was_drawn};
use super::{Exit, Failure, Output, input, text};

/// A site of our own making, in the command itself so that the demo runs anywhere.
const SITE: &[u8] = include_bytes!("../../examples/site.lif.json");
const SITE_NAME: &str = "crates/guideway/examples/site.lif.json";

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// PNG file to write
    #[arg(long, short, value_name = "PNG", default_value = "demo.png")]
    output: PathBuf,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    input::check_output(None, &args.output)?;
    let activity = out.activity("drawing the example site");
    let layout = read_bytes(SITE_NAME, SITE, &ReadOptions::default())?;
    let name = layout.levels.first().map(|level| level.id.clone());
    let wishes = Wishes {
        size: FrameSize::new(1920, 1080)?,
        center_m: None,
        px_per_m: None,
        scene: SceneOptions {
            color_by: Some(ColorBy {
                column: "maxSpeed".into(),
            }),
            level: name,
            ..SceneOptions::default()
        },
        // A little wider than a plan would have it: the picture is for looking at.
        style: Style {
            line_rule: LineRule::World {
                width_m: 0.25,
                min_px: 2.5,
                max_px: 12.0,
            },
            ..Style::default()
        },
        has_legend: false,
        budget: Budget::default(),
        marks: DrawList::default(),
    };
    let scene = Arc::new(Scene::new(Arc::new(layout), &wishes.scene)?);
    let method = guideway::method("cpu")?;
    let drawn = save_png_by(&args.output, wishes.size, |take| {
        draw(
            &*method,
            &scene,
            &Below::default(),
            &wishes,
            &activity,
            take,
        )
    })?;
    let took_ms = activity.finish();
    let place = args
        .output
        .canonicalize()
        .unwrap_or_else(|_| args.output.clone());
    let body = json!({
        "output": place.to_string_lossy(),
        "paths": { "total": drawn.report.total, "drawn": drawn.report.drawn },
        "method": { "name": drawn.method.name, "device": drawn.method.device },
        "ms": { "total": took_ms },
    });
    out.report("demo", &body, || {
        format!(
            "The picture is in {}\n\n{}{}took {}\n\n{}",
            place.display(),
            what_was_drawn(&drawn),
            scene.legend().map_or_else(String::new, speeds),
            text::time(took_ms),
            next(&drawn),
        )
    })?;
    Ok(Exit::Clean)
}

fn speeds(legend: &Legend) -> String {
    let entries = legend.entries.iter().filter_map(|entry| {
        let paths = text::counted(entry.paths?, "path");
        Some(format!(
            "  {}  {} m/s ({paths})\n",
            entry.color, entry.label
        ))
    });
    format!(
        "colored by the greatest speed:\n{}",
        entries.collect::<String>()
    )
}

fn next(drawn: &Drawn) -> String {
    let center = drawn.view.center_m();
    format!(
        "Now try it on a file of your own (LIF, VDA 5050, openTCS, DXF, GeoJSON or Arrow):\n  \
           guideway info site.lif.json\n  \
           guideway check site.lif.json\n  \
           guideway render site.lif.json -o site.png\n  \
           guideway render site.lif.json -o closer.png --center {:.0},{:.0} --scale 40\n",
        center.x, center.y
    )
}
