//! Runs `render`: reads the files, composes the picture, prints the report.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use guideway::compose::{LevelPart, VectorFormat, world_file as world_file_of};
use guideway::layout::{Layout, Level, UserError};
use guideway::scene::density::ToneMap;
use guideway::scene::{Method, Scene, SceneOptions, Shading, elapsed_ms};

use super::args::Args;
use super::part;
use super::report::{self, Shown, Times};
use super::view_notes::view_notes;
use crate::cli::error::{Exit, usage_error};
use crate::cli::output::Output;
use crate::cli::picture_output::PictureOutput;
use crate::cli::progress_bar::plan;
use crate::cli::share::is_page;
use crate::cli::{floor_plan, output};

/// The maker of the picture.
enum Renderer {
    Curves(VectorFormat),
    Pixels(Box<dyn Method>),
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let output_file = args.output()?;
    if is_page(&output_file) {
        return args.write_page(&output_file, out);
    }
    let mut options = args.options()?;
    let target = PictureOutput::new(&output_file, args.to, args.files(), out)?;
    let world_file = args.world_file(&target)?;
    // Before a large file is read: an unknown method is an error of the arguments.
    let renderer = match target.format.vector() {
        Some(format) => {
            args.check_vector()?;
            Renderer::Curves(format)
        }
        None => Renderer::Pixels(guideway::method(&args.method())?),
    };
    let floor_plan = args.floor_plan();
    // Reading, merging, preparing, drawing.
    let files = args.inputs.len() + usize::from(floor_plan.is_some());
    plan(files, &[6.0, 0.1, 1.0, 3.0]);
    let floor_plan = floor_plan.map(|plan| floor_plan::read(plan, target.file, out));
    let floor_plan = floor_plan.transpose()?;
    let (layout, read_ms) = part::read(args, &options, out)?;
    let progress = out.progress("preparing the scene");
    let is_each = args.is_each_level(&layout);
    if is_each && world_file.is_some() {
        return Err(usage_error(
            "--world-file places one view, and --level each has one per level",
            "Omit --world-file, or choose one level",
        ));
    }
    if is_each {
        options.scene.level = None;
    }
    let layout = Arc::new(layout);
    let scene = Arc::new(Scene::new(Arc::clone(&layout), &options.scene)?);
    let levels = match is_each {
        true => level_parts(&layout, &options.scene)?,
        false => Vec::new(),
    };
    let scene_ms = progress.finish();
    let mut picture = args.picture(&options, Arc::clone(&scene), floor_plan);
    picture.levels = levels;
    let choosing = Instant::now();
    args.suit_widths(&mut picture)?;
    let route = args.decorations.route.as_ref();
    let route = route.map(|ends| ends.find(scene.layout())).transpose()?;
    picture.decorations.route = route.as_ref().map(|route| route.mark.clone());
    let progress = out.progress("drawing");
    let mut notes = Vec::new();
    if let Renderer::Pixels(method) = &renderer
        && args.may_show_density()
        && picture.is_crowded(&**method, &progress)?
    {
        picture.style.shading = Shading::Density(ToneMap::Log);
        picture.decorations.has_legend = true;
        notes.push(
            "many paths cover most of the picture, so it shows how many there are per pixel; \
             `--shade lines` draws their colors"
                .to_owned(),
        );
    }
    let choice_ms = elapsed_ms(choosing);
    let started = Instant::now();
    let mut rendered = match &renderer {
        Renderer::Curves(format) => target.write_vector(&picture, *format)?,
        Renderer::Pixels(method) => target.write_png(&picture, &**method, &progress)?,
    };
    if let Renderer::Curves(_) = renderer {
        rendered.write_ms = elapsed_ms(started);
    }
    drop(progress);
    if let Some(file) = &world_file {
        output::save(file, world_file_of(&rendered.view).as_bytes())?;
    }
    let has_level = options.scene.level.is_some() || !picture.levels.is_empty();
    notes.extend(view_notes(&scene, &rendered, has_level));
    rendered.report.notes.extend(notes);
    let times = Times {
        read: read_ms,
        scene: scene_ms,
        prepare: choice_ms + rendered.prepare_ms,
        render: rendered.render_ms,
        write: rendered.write_ms,
    };
    let shown = Shown {
        scene: &scene,
        rendered: &rendered,
        size: picture.viewport.size,
        route: route.as_ref(),
    };
    print_report(args, &output_file, &shown, &times, out)?;
    Ok(Exit::Clean)
}

/// The levels of a layout that have paths, in file order.
fn level_parts(layout: &Arc<Layout>, options: &SceneOptions) -> Result<Vec<LevelPart>, UserError> {
    let mut has_paths = vec![false; layout.levels.len()];
    for level in layout.paths.iter().filter_map(|path| path.level()) {
        has_paths[level as usize] = true;
    }
    let levels = layout.levels.iter().zip(has_paths);
    let part = |level: &Level| {
        let options = SceneOptions {
            level: Some(level.id.clone()),
            // One color means the same on all of them.
            has_common_colors: true,
            ..options.clone()
        };
        Ok(LevelPart {
            scene: Arc::new(Scene::new(Arc::clone(layout), &options)?),
            title: level.name_or_id().to_owned(),
        })
    };
    let shown = levels.filter(|(_, has_paths)| *has_paths);
    shown.map(|(level, _)| part(level)).collect()
}

fn print_report(
    args: &Args,
    output: &Path,
    shown: &Shown<'_>,
    times: &Times,
    out: &Output,
) -> Result<(), UserError> {
    let body = report::json(args, output, shown, times);
    let out = out.beside(Some(output));
    out.report("render", &body, || report::text(output, shown, times))
}
