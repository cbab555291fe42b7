//! Runs `tiles`: reads the files, makes the tiles, writes the archive, prints the report.

use std::sync::Arc;

use guideway::layout::{UserError, shown_path};
use guideway::replace_file;
use guideway::scene::{Cancel, Scene};
use guideway::tiles::{
    ArchiveInfo, ArchiveSize, Content, GridKind, Made, Pyramid, TileGrid, TileRenderer, place,
};
use guideway::{SaveError, tiles::MAX_ZOOM};
use serde_json::{Value, json};

use super::args::{Args, ContentKind};
use super::unfinished::Unfinished;
use crate::cli::error::Exit;
use crate::cli::output::Output;
use crate::cli::progress_bar::plan;
use crate::cli::{input, process, text};

/// Zooms that are made beside the first one, unless they are given.
const MORE_ZOOMS: u8 = 6;
/// The method: it alone draws tiles with the same bits as one large picture.
const METHOD: &str = "cpu";

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    args.check()?;
    let scene_options = args.scene()?;
    // Reading, preparing, making tiles, writing.
    plan(args.inputs.len(), &[2.0, 0.3, 20.0, 0.5]);
    let (layout, _) = input::read_all(&args.inputs, out)?;
    let preparing = out.progress("preparing the scene");
    let (layout, grid) = place(Arc::new(layout), args.plane);
    let scene = Arc::new(Scene::new(layout, &scene_options)?);
    let zooms = args.zoom.clone().unwrap_or_else(|| {
        let first = scene.bounds().map_or(0, |bounds| grid.fitting_zoom(bounds));
        first..=(first + MORE_ZOOMS).min(MAX_ZOOM)
    });
    let vector = (args.content == ContentKind::Vector).then(|| args.vector());
    let mut content = match &vector {
        Some(options) => Content::Vector(options.clone()),
        None => {
            let (method, style) = (guideway::method(METHOD)?, args.style.style()?);
            let shared = Arc::clone(&scene);
            let renderer = TileRenderer::new(&*method, shared, grid, style, &args.budget())?;
            Content::Raster(Box::new(renderer))
        }
    };
    let mut unfinished = Unfinished::open(args)?;
    drop(preparing);
    let cancel = process::cancel_on_interrupt();
    let made = make(&scene, (grid, zooms.clone()), &cancel, out, |pyramid| {
        pyramid.make(&mut content, &mut unfinished.journal)
    })?;
    let (tiles, continued) = (unfinished.journal.len(), unfinished.journal.continued());
    if made.0 == Made::Stopped {
        out.note(&format!(
            "{} are done and kept; the same command makes the others",
            text::counted(tiles, "tile")
        ));
        return Ok(Exit::Interrupted);
    }
    let writing = out.progress(format!("writing {}", shown_path(&args.output)));
    // Without folders: the file may be for anyone.
    let names = args
        .files()
        .map(|file| file.file_name().unwrap_or_default());
    let names: Vec<_> = names.map(|name| name.to_string_lossy()).collect();
    let name = names.join(" + ");
    let info = ArchiveInfo {
        name: &name,
        scene: &scene,
        grid,
        zooms: [*zooms.start(), *zooms.end()],
        vector: vector.as_ref(),
    };
    let size = replace_file(&args.output, |file| {
        let written = unfinished.journal.write_archive(&info, file);
        written.map_err(|problem| SaveError {
            path: args.output.clone(),
            problem,
        })
    })?;
    unfinished.remove();
    drop(writing);
    report(args, &info, (size, continued, made.1), out)
}

/// Makes tiles under a progress bar; returns the outcome and the time in milliseconds.
fn make(
    scene: &Arc<Scene>,
    (grid, zooms): (TileGrid, std::ops::RangeInclusive<u8>),
    cancel: &Cancel,
    out: &Output,
    work: impl FnOnce(&Pyramid<'_>) -> Result<Made, guideway::tiles::TileError>,
) -> Result<(Made, f64), UserError> {
    let progress = out.progress("making tiles");
    let pyramid = Pyramid {
        scene: Arc::clone(scene),
        grid,
        zooms,
        progress: &|share| progress.share(share, 0),
        cancel,
    };
    let made = work(&pyramid)?;
    Ok((made, progress.finish()))
}

fn report(
    args: &Args,
    info: &ArchiveInfo<'_>,
    (size, continued, took_ms): (ArchiveSize, u64, f64),
    out: &Output,
) -> Result<Exit, UserError> {
    let [first, last] = info.zooms;
    let body = json!({
        "output": args.output.to_string_lossy(),
        "content": match args.content {
            ContentKind::Raster => "raster",
            ContentKind::Vector => "vector",
        },
        "grid": grid_json(&info.grid),
        "zooms": [first, last],
        "tiles": size.tiles,
        "contents": size.contents,
        "continued": continued,
        "omitted_paths": size.omitted,
        "bytes": size.bytes,
        "ms": { "tiles": took_ms },
    });
    out.report("tiles", &body, || {
        let mut lines = format!(
            "{}: {} of zoom {first} to {last}, {} of them different, {}\n",
            shown_path(&args.output),
            text::counted(size.tiles, "tile"),
            text::count(size.contents),
            text::bytes(size.bytes),
        );
        if info.grid.kind() == GridKind::Plane {
            let (corner, side) = (info.grid.corner(), info.grid.side());
            lines += &format!(
                "the tile of zoom 0 is a square of {side} m from ({}, {}) down; it has no place on \
                 earth\n",
                corner.x, corner.y
            );
        }
        if size.omitted > 0 {
            lines += &format!(
                "tiles leave out {} in all, the shortest ones: too many for a tile, or too small \
                 to show; the metadata counts them by zoom\n",
                text::counted(size.omitted, "path"),
            );
        }
        if continued > 0 {
            lines += &format!("{} were done before\n", text::counted(continued, "tile"));
        }
        lines + &format!("took {}\n", text::time(took_ms))
    })?;
    Ok(Exit::Clean)
}

fn grid_json(grid: &TileGrid) -> Value {
    let corner = grid.corner();
    json!({
        "kind": match grid.kind() {
            GridKind::Plane => "plane",
            GridKind::Earth => "EPSG:3857",
        },
        "upper_left": [corner.x, corner.y],
        "side": grid.side(),
    })
}
