//! `guideway render`: layout files as a picture, PNG or SVG.

mod args;
mod below;
mod floor_plan;
mod legend;
mod picture;
mod report;
mod sheet;
mod swept;
mod vector;

use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::sync::Arc;

use guideway::render::FrameSize;
use guideway::scene::Scene;
use guideway::{SaveError, save_png_by, write_png_by};

pub(crate) use args::{Args, Rule, Shade};
pub(crate) use below::Below;
#[cfg(feature = "viewer")]
pub(crate) use floor_plan::Floor;
pub(crate) use picture::{Drawn, Take, Wishes, draw};
pub(crate) use report::{Times, what_was_drawn};
#[cfg(feature = "viewer")]
pub(crate) use swept::draw as draw_swept;
#[cfg(feature = "viewer")]
pub(crate) use vector::draw as draw_vector;

use super::{Exit, Failure, Output, input};
pub(crate) use floor_plan::FloorPlan;

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let wishes = args.wishes()?;
    let target = Target::new(&args.output, out)?;
    if let Target::File(path) = target {
        input::check_output(args.files(), path)?;
    }
    // A name that is unknown is refused before a large file is read.
    let method = match vector::is_wanted(&args.output) {
        true => {
            args.check_vector()?;
            None
        }
        false => Some(guideway::method(&args.method())?),
    };
    let plan = args.floor_plan().map(|plan| FloorPlan::read(plan, out));
    let below = Below {
        floor_plan: plan.transpose()?,
        envelope: args.envelope(),
        ..Below::default()
    };
    let (layout, read_ms) = input::read_all(&args.inputs, out)?;
    let activity = out.activity("arranging");
    let scene = Arc::new(Scene::new(Arc::new(layout), &wishes.scene)?);
    let mut times = Times {
        read: read_ms,
        scene: activity.finish(),
        ..Times::default()
    };
    let Some(method) = method else {
        let activity = out.activity("writing the picture");
        let drawn = vector::draw(&args.output, &scene, &below, &wishes)?;
        times.write = activity.finish();
        return tell(args, &target, &scene, &drawn, &times, out);
    };
    let activity = out.activity("drawing");
    let drawn = target.write(wishes.size, |take| {
        draw(&*method, &scene, &below, &wishes, &activity, take)
    })?;
    drop(activity);
    times.prepare = drawn.prepare_ms;
    times.render = drawn.render_ms;
    times.write = drawn.write_ms;
    tell(args, &target, &scene, &drawn, &times, out)
}

fn tell(
    args: &Args,
    target: &Target<'_>,
    scene: &Scene,
    drawn: &Drawn,
    times: &Times,
    out: &Output,
) -> Result<Exit, Failure> {
    let text = || report::text(&args.output, scene, drawn, times);
    match target {
        Target::StandardOutput => out.note(text().trim_end()),
        Target::File(_) => {
            let body = report::json(args, scene, drawn, times);
            out.report("render", &body, text)?;
        }
    }
    Ok(Exit::Clean)
}

/// Where the picture goes.
enum Target<'a> {
    StandardOutput,
    File(&'a Path),
}

impl<'a> Target<'a> {
    fn new(path: &'a Path, out: &Output) -> Result<Self, Failure> {
        if path != Path::new("-") {
            return Ok(Self::File(path));
        }
        if out.is_json() {
            return Err(Failure::arguments(
                "standard output cannot take the picture and the JSON report at once",
                "Give the picture a file, such as `-o site.png --json`",
            ));
        }
        if io::stdout().is_terminal() {
            return Err(Failure::arguments(
                "a picture is not for a terminal",
                "Send it on, such as `guideway render site.lif.json -o - | feh -`, or give it a file",
            ));
        }
        Ok(Self::StandardOutput)
    }

    /// Writes the picture that `draw` hands over.
    fn write(
        &self,
        size: FrameSize,
        draw: impl FnOnce(Take<'_>) -> Result<Drawn, Failure>,
    ) -> Result<Drawn, Failure> {
        match self {
            Self::File(path) => save_png_by(path, size, draw),
            Self::StandardOutput => {
                let fail = |problem| {
                    Failure::from(SaveError {
                        path: "-".into(),
                        problem,
                    })
                };
                write_png_by(Willing(io::stdout().lock()), size, fail, draw)
            }
        }
    }
}

/// Standard output, of which a reader may want no more: that is no failure.
struct Willing(io::StdoutLock<'static>);

impl Write for Willing {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        willing(self.0.write(bytes), bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        willing(self.0.flush(), ())
    }
}

fn willing<T>(outcome: io::Result<T>, as_if: T) -> io::Result<T> {
    match outcome {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(as_if),
        outcome => outcome,
    }
}
