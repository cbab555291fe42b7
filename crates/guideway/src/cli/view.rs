//! `guideway view`: the window.

mod floor;
mod smoothness;

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use etcetera::BaseStrategy;
use guideway::envelope::EnvelopeSource;
use guideway::formats::{Progress, ReadOptions, read_file};
use guideway::layout::Layout;
use guideway::render::{Budget, Frame, Method, View, elapsed_ms};
use guideway::scene::SceneOptions;
use guideway::{AUTO, save_png_by};
use guideway_viewer::{Export, Host, Job, MethodChoice, Opening, Stage, Trouble};

use self::floor::OnFloor;
use super::convert::Target;
use super::render::{Below, Wishes, draw, draw_swept, draw_vector};
use super::{Exit, Failure, Output, envelope, values};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "F1 in the window shows what each key does. Files can be dropped on it too."
)]
pub(crate) struct Args {
    /// Layout files of any format that is read, found from their content
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// What lies below: any layout or drawing, or a PNG image with its scale, such as
    /// `hall.png@px-per-m=20,offset=-3,-2`
    #[arg(long, value_name = "FILE", conflicts_with = "measure")]
    floor_plan: Option<String>,
    /// Way of drawing, as `guideway methods` lists them; `auto` takes `gpu` where there is graphics hardware, else
    /// `cpu`
    #[arg(long, value_name = "NAME[+OPTION]", default_value = AUTO, value_parser = values::MethodSpec)]
    method: String,
    /// Say on standard error when each file was read, shown, ready to be edited and checked
    #[arg(long, conflicts_with = "measure")]
    timings: bool,
    /// Show no window: open one file, move it as a hand would, and say how long frames take
    #[arg(long)]
    measure: bool,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    let method = (args.method != AUTO).then(|| args.method.clone());
    if args.measure {
        return smoothness::measure(&args.files, method, out);
    }
    if out.is_json() {
        return Err(Failure::arguments(
            "a window has nothing to say as JSON",
            "Leave --json out, or add --measure; `guideway info` and `guideway check` report as JSON too",
        ));
    }
    let desk = Desk {
        timed_since: args.timings.then(Instant::now),
        is_measuring: false,
    };
    let opening = Opening {
        files: args.files.clone(),
        floor_plan: args.floor_plan.clone().unwrap_or_default(),
        method,
    };
    guideway_viewer::run(Arc::new(desk), opening)?;
    Ok(Exit::Clean)
}

/// Files and ways of drawing, for the window.
#[derive(Default)]
struct Desk {
    /// When the command began, if it is to say how long things took.
    timed_since: Option<Instant>,
    /// Whether nobody is there who would open a file again.
    is_measuring: bool,
}

impl Host for Desk {
    fn open(&self, path: &Path, job: &Job) -> Result<Layout, Trouble> {
        let options = ReadOptions {
            progress: Some(&Followed(job)),
            ..ReadOptions::default()
        };
        Ok(read_file(path, &options).map_err(Failure::from)?)
    }

    fn save(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, Trouble> {
        let (losses, _) = Target::to_save(layout, path)?.write(layout, path)?;
        Ok(losses.iter().map(|loss| loss.to_string()).collect())
    }

    fn check_in_place(&self, layout: &Layout, file: &Path) -> Result<(), Trouble> {
        Ok(Target::check_in_place(layout, file)?)
    }

    fn picture(&self, export: &Export, method: &str) -> Result<Frame, Trouble> {
        let (below, wishes) = (below(export)?, wishes(export));
        let (method, progress) = (self.method(method)?, Followed(&Job::default()));
        let mut frame = Frame::new(wishes.size);
        let mut rows = frame.pixels_mut().iter_mut();
        let take = &mut |strip: &Frame| {
            let pixels = rows.by_ref().zip(strip.pixels());
            pixels.for_each(|(pixel, drawn)| *pixel = *drawn);
            Ok(())
        };
        draw(&*method, &export.scene, &below, &wishes, &progress, take)?;
        Ok(frame)
    }

    fn save_picture(
        &self,
        export: &Export,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), Trouble> {
        let (below, wishes) = (below(export)?, wishes(export));
        let (method, progress) = (self.method(method)?, Followed(job));
        save_png_by(path, wishes.size, |take| {
            draw(&*method, &export.scene, &below, &wishes, &progress, take)
        })?;
        Ok(())
    }

    fn save_drawing(&self, export: &Export, path: &Path) -> Result<(), Trouble> {
        draw_vector(path, &export.scene, &below(export)?, &wishes(export))?;
        Ok(())
    }

    fn floor_plan(&self, plan: &str) -> Result<Arc<dyn guideway_viewer::FloorPlan>, Trouble> {
        Ok(Arc::new(OnFloor::read(plan)?))
    }

    fn swept(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: &str,
        view: &View,
    ) -> Result<Frame, Trouble> {
        Ok(draw_swept(layout, rows, source(vehicle)?, view)?)
    }

    fn reached(&self, stage: Stage, file: &Path) {
        let Some(since) = self.timed_since else {
            return;
        };
        let what = match stage {
            Stage::Read => "read",
            Stage::Shown => "shown",
            Stage::Editable => "ready to be edited",
            Stage::Checked => "checked",
        };
        // There may be nobody who reads it.
        let (ms, file) = (elapsed_ms(since), file.display());
        let _ = writeln!(io::stderr(), "{ms:.0} ms: {file} is {what}");
    }

    fn state_folder(&self) -> Option<PathBuf> {
        if self.is_measuring {
            return None;
        }
        let places = etcetera::choose_base_strategy().ok()?;
        let folder = places.state_dir().unwrap_or_else(|| places.data_dir());
        Some(folder.join("guideway"))
    }

    fn methods(&self) -> Vec<MethodChoice> {
        let listed = guideway::methods().into_iter().map(|method| MethodChoice {
            name: method.info.name.to_owned(),
            summary: method.info.summary.to_owned(),
            why_not: method.why_not,
        });
        let mut choices: Vec<MethodChoice> = listed.collect();
        let best = guideway::live_method();
        choices.sort_by_key(|choice| choice.name != best);
        choices
    }

    fn method(&self, name: &str) -> Result<Box<dyn Method>, Trouble> {
        Ok(guideway::method(name).map_err(Failure::from)?)
    }
}

/// A vehicle, as a person wrote it.
fn source(vehicle: &str) -> Result<EnvelopeSource, Failure> {
    envelope::source(vehicle).map_err(|problem| {
        Failure::arguments(
            format!("`{vehicle}` is no vehicle: {problem}"),
            "Write it so",
        )
    })
}

/// What lies below the layout on top.
fn below(export: &Export) -> Result<Below, Failure> {
    let plan = export.floor_plan.as_deref().map(floor::read);
    let vehicle = export.swept.as_ref().map(|(vehicle, _)| source(vehicle));
    Ok(Below {
        floor_plan: plan.transpose()?,
        lines: export.grid.clone(),
        envelope: vehicle.transpose()?,
        swept: export.swept.as_ref().map(|(_, rows)| rows.clone()),
        others: export.others.clone(),
    })
}

/// A picture of what is seen, with what the colors mean.
fn wishes(export: &Export) -> Wishes {
    let Export {
        scene, view, style, ..
    } = export;
    Wishes {
        size: view.size(),
        center_m: Some(view.center_m()),
        px_per_m: Some(view.px_per_m()),
        scene: SceneOptions::default(),
        style: *style,
        has_legend: scene.legend().is_some(),
        budget: Budget::default(),
        marks: export.marks.clone(),
    }
}

/// A job, as readers and pictures follow it.
struct Followed<'a>(&'a Job);

impl Progress for Followed<'_> {
    fn advance(&self, done: u64, total: u64) {
        self.0.advance(done, total);
    }

    fn cancelled(&self) -> bool {
        self.0.is_cancelled()
    }
}

impl From<Failure> for Trouble {
    fn from(failure: Failure) -> Self {
        Self {
            message: failure.message,
            remedy: failure.remedy,
        }
    }
}

impl From<Trouble> for Failure {
    fn from(trouble: Trouble) -> Self {
        Self {
            code: "window",
            message: trouble.message,
            remedy: trouble.remedy,
        }
    }
}
