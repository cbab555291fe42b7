//! `guideway demo`: pictures of a built-in site, of a crowd of paths and of findings in a faulty
//! site, and commands to go on with.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use guideway::compose::{Decorations, Picture, Rendered};
use guideway::formats::{ReadOptions, read_bytes};
use guideway::layout::{Layout, NewPath, UserError, shown_path};
use guideway::scene::density::ToneMap;
use guideway::scene::{
    ColorBy, FrameSize, LineRule, Rgba, Scene, SceneOptions, Shading, elapsed_ms,
};
use guideway::spline::{Point, Runs};
use guideway_datasets::d1;
use serde_json::{Value, json};

use super::check::{findings_text, write_picture};
use super::error::{Exit, json_error, usage_error};
use super::input::{self, Input};
use super::output::{Output, save};
use super::picture_output::PictureOutput;
use super::{packed, text, values};

const SITE_NAME: &str = "crates/guideway/examples/site.lif.json";
/// Seed of the crowd.
const SEED: u64 = 1;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Folder for the files; it is created
    #[arg(long, short, value_name = "FOLDER", default_value = "guideway-demo")]
    output: PathBuf,
    /// Paths of the crowd
    #[arg(long, value_name = "N", default_value = "1M", value_parser = values::paths)]
    paths: usize,
}

/// A file that the demo leaves.
struct Made {
    name: &'static str,
    shows: String,
    ms: f64,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let folder = &args.output;
    input::check_no_stdout(folder)?;
    fs::create_dir_all(folder).map_err(|error| {
        usage_error(
            format!("{}: cannot make the folder: {error}", shown_path(folder)),
            "Name another one, such as `guideway demo -o /tmp/demo`",
        )
    })?;
    let site = packed::site()?;
    save(&folder.join("site.lif.json"), site.as_bytes())?;
    let faulty = faulty_site(&site)?;
    save(&folder.join("faulty.lif.json"), &faulty)?;
    let (site, rendered) = draw_site(&site, folder, out)?;
    let crowd = draw_crowd(folder, args.paths, out)?;
    let (findings, said) = draw_findings(folder, &faulty, out)?;
    let made = [site, crowd, findings];
    let total_ms: f64 = made.iter().map(|made| made.ms).sum();
    let folder = dunce::canonicalize(folder).unwrap_or_else(|_| folder.clone());
    let files: Vec<Value> = made
        .iter()
        .map(|made| json!({ "file": made.name, "shows": made.shows, "ms": made.ms }))
        .collect();
    let body = json!({
        "output": folder.to_string_lossy(),
        "files": files,
        "paths": { "total": rendered.report.total, "drawn": rendered.report.drawn },
        "method": { "name": rendered.method.name, "device": rendered.method.device },
        "ms": { "total": total_ms },
    });
    out.report("demo", &body, || {
        let mut text = format!("In {}:\n", shown_path(&folder));
        for Made { name, shows, ms } in &made {
            text += &format!("  {name:<14}{shows} ({})\n", text::time(*ms));
        }
        text += &format!("\nOf the findings (all are in findings.txt):\n{said}\n");
        text + &next_steps(&args.output)
    })?;
    Ok(Exit::Clean)
}

/// The layout in the file of the example site.
pub(super) fn read_site(site: &str) -> Result<Layout, UserError> {
    let options = ReadOptions::default();
    Ok(read_bytes(SITE_NAME, site.as_bytes(), &options)?)
}

/// The site with stations, arrows, names and speeds.
fn draw_site(site: &str, folder: &Path, out: &Output) -> Result<(Made, Rendered), UserError> {
    let progress = out.progress("drawing the site");
    let layout = read_site(site)?;
    let options = SceneOptions {
        color_by: Some(ColorBy {
            column: "maxSpeed".into(),
        }),
        level: layout.levels.first().map(|level| level.id.clone()),
        ..SceneOptions::default()
    };
    let scene = Arc::new(Scene::new(Arc::new(layout), &options)?);
    let mut picture = Picture::new(scene, FrameSize::new(1920, 1080)?);
    // Wider than by default: the picture is to be looked at, not measured.
    picture.style.line_rule = LineRule::World {
        width_m: 0.25,
        min_px: 2.5,
        max_px: 12.0,
    };
    picture.decorations = Decorations::site("Guideway example site");
    let method = guideway::method("cpu")?;
    let rendered = picture.save_png(&*method, folder.join("site.png"), &progress)?;
    let shows = format!(
        "{} of a site, colored by speed",
        text::counted(rendered.report.drawn, "path")
    );
    let made = Made {
        name: "site.png",
        shows,
        ms: progress.finish(),
    };
    Ok((made, rendered))
}

/// The density of a generated crowd of paths.
fn draw_crowd(folder: &Path, paths: usize, out: &Output) -> Result<Made, UserError> {
    let progress = out.progress("drawing a crowd of paths");
    let mut layout = Layout::default();
    let mut runs = Runs::default();
    for path in d1(paths, SEED) {
        runs.clear();
        let point = |p: Point<f32>| Point::new(f64::from(p.x), f64::from(p.y));
        runs.push(&path.run.map(point));
        layout.paths.push(&NewPath {
            id: &path.id,
            runs: &runs,
            ..NewPath::default()
        });
    }
    let scene = Scene::new(Arc::new(layout), &SceneOptions::default())?;
    let mut picture = Picture::new(Arc::new(scene), FrameSize::new(1920, 1080)?);
    picture.style.shading = Shading::Density(ToneMap::Log);
    picture.style.background = Rgba::BLACK;
    picture.decorations.has_legend = true;
    picture.decorations.has_scale_bar = true;
    let method = guideway::method("cpu")?;
    let rendered = picture.save_png(&*method, folder.join("crowd.png"), &progress)?;
    let shows = format!(
        "how {} overlap",
        text::counted(rendered.report.drawn, "path")
    );
    Ok(Made {
        name: "crowd.png",
        shows,
        ms: progress.finish(),
    })
}

/// The findings of the faulty site as text and picture. Returns the first ones, too.
fn draw_findings(folder: &Path, faulty: &[u8], out: &Output) -> Result<(Made, String), UserError> {
    const NAME: &str = "faulty.lif.json";
    let started = Instant::now();
    let progress = out.progress("checking a faulty site");
    let layout = read_bytes(NAME, faulty, &ReadOptions::default())?;
    let found = guideway::check(&layout);
    let input = Input {
        path: NAME.into(),
        ..Input::default()
    };
    let report = findings_text(&input, &layout, found.clone());
    save(&folder.join("findings.txt"), report.as_bytes())?;
    drop(progress);
    let file = folder.join("findings.png");
    let picture = PictureOutput::new(&file, None, [], out)?;
    write_picture(layout, &found, NAME, &picture, out)?;
    let first = report.split("\n\n").next().unwrap_or_default();
    let made = Made {
        name: "findings.png",
        shows: report.lines().last().unwrap_or_default().to_owned(),
        ms: elapsed_ms(started),
    };
    Ok((made, format!("{first}\n")))
}

/// The example site with faults as they occur in practice.
fn faulty_site(site: &str) -> Result<Vec<u8>, UserError> {
    let fail = |error: &serde_json::Error| json_error(error, "Report this as a bug of the demo");
    let mut site: Value = serde_json::from_str(site).map_err(|error| fail(&error))?;
    let hall = &mut site["layouts"][0];
    // A node that was moved without its edges, and edges to a node that was renamed.
    set(hall, "nodes", "nodeId", "dock-3-009", |node| {
        node["nodePosition"]["x"] = json!(50.4);
    });
    set(
        hall,
        "edges",
        "edgeId",
        "charger-2-037--charger-2-038",
        |edge| {
            edge["endNodeId"] = json!("charger-2-038-old");
        },
    );
    // A speed in millimeters per second, and a curve that lost its last knots.
    set(hall, "edges", "edgeId", "dock-7-025--dock-7-026", |edge| {
        edge["vehicleTypeEdgeProperties"][0]["maxSpeed"] = json!(800);
    });
    set(hall, "edges", "edgeId", "dock-4-013--dock-4-014", |edge| {
        let trajectory = &mut edge["vehicleTypeEdgeProperties"][0]["trajectory"];
        trajectory["knotVector"] = json!([0, 0, 0, 0, 1]);
    });
    // An aisle that no edge leaves any more.
    const GONE: [&str; 2] = ["aisle-5-115--aisle-5-110", "aisle-5-119--aisle-5-113"];
    if let Some(edges) = hall["edges"].as_array_mut() {
        edges.retain(|edge| !GONE.iter().any(|id| edge["edgeId"] == *id));
    }
    serde_json::to_vec_pretty(&site).map_err(|error| fail(&error))
}

/// Changes the element of a table that has this identifier.
fn set(hall: &mut Value, table: &str, key: &str, id: &str, change: impl Fn(&mut Value)) {
    let elements = hall[table].as_array_mut().into_iter().flatten();
    elements
        .filter(|element| element[key] == id)
        .for_each(change);
}

/// Commands to go on with, each of which gives a picture.
fn next_steps(folder: &Path) -> String {
    let folder = shown_path(folder);
    let site = format!("guideway render {folder}/site.lif.json");
    format!(
        "Try these next, or a file of your own (LIF, VDA 5050, openTCS, DXF and more):\n  \
         {site} -o docks.png --site --center 60,10 --scale 45\n  \
         {site} -o route.pdf --site --route dock-1,charger-3,tugger-3000\n  \
         guideway check {folder}/faulty.lif.json --picture faults.svg\n"
    )
}
