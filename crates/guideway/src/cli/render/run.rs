//! Runs `render`: reads the files, composes the picture, prints the report.

use std::path::Path;
use std::sync::Arc;

use guideway::compose::world_file as world_file_of;
use guideway::layout::UserError;
use guideway::scene::Scene;

use super::args::Args;
use super::report::{self, Shown, Times};
use super::target::Target;
use super::view_notes::view_notes;
use crate::cli::exit::Exit;
use crate::cli::output::Output;
use crate::cli::picture_file::check_extension;
use crate::cli::{floor_plan, input, output, stdout};

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, UserError> {
    let options = args.options()?;
    let output_file = args.output()?;
    let target = Target::new(&output_file, out)?;
    if let Target::File(path) = target {
        input::check_output(args.files(), path)?;
        check_extension(path)?;
    }
    let world_file = args.world_file(&output_file)?;
    // Before a large file is read: an unknown method is an error of the arguments.
    let method = match target.is_vector() {
        true => {
            args.check_vector()?;
            None
        }
        false => Some(guideway::method(&args.method())?),
    };
    let output = match target {
        Target::File(path) => Some(path),
        Target::StandardOutput => None,
    };
    let plan = args.floor_plan();
    let plan = plan.map(|plan| floor_plan::read(plan, output, out));
    let plan = plan.transpose()?;
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let progress = out.progress("preparing the scene");
    let scene = Arc::new(Scene::new(Arc::new(layout), &options.scene)?);
    let scene_ms = progress.finish();
    let mut picture = args.picture(&options, Arc::clone(&scene), plan);
    let route = args.decorations.route.as_ref();
    let route = route.map(|ends| ends.find(scene.layout())).transpose()?;
    picture.decorations.route = route.as_ref().map(|route| route.mark.clone());
    let (mut rendered, svg_ms) = match method {
        None => {
            let progress = out.progress("writing the picture");
            let rendered = picture.save_svg(&output_file)?;
            (rendered, progress.finish())
        }
        Some(method) => {
            let progress = out.progress("rendering");
            (target.write_png(&picture, &*method, &progress)?, 0.0)
        }
    };
    if let Some(file) = &world_file {
        output::save(file, world_file_of(&rendered.view).as_bytes())?;
    }
    rendered
        .report
        .notes
        .extend(view_notes(&scene, &rendered, options.scene.level.is_some()));
    let times = Times {
        read: read_ms,
        scene: scene_ms,
        prepare: rendered.prepare_ms,
        render: rendered.render_ms,
        write: rendered.write_ms + svg_ms,
    };
    let shown = Shown {
        scene: &scene,
        rendered: &rendered,
        route: route.as_ref(),
    };
    print_report(args, &output_file, &shown, &times, out)?;
    Ok(Exit::Clean)
}

fn print_report(
    args: &Args,
    output: &Path,
    shown: &Shown<'_>,
    times: &Times,
    out: &Output,
) -> Result<(), UserError> {
    let text = || report::text(output, shown, times);
    if stdout::is_stdout(output) {
        out.note(text().trim_end());
        return Ok(());
    }
    let body = report::json(args, output, shown, times);
    out.report("render", &body, text)
}
