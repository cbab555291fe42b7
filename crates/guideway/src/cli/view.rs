//! `guideway view`: the window.

mod floor;
mod smoothness;

use std::any::Any;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use etcetera::BaseStrategy;
use guideway::envelope::Source;
use guideway::formats::{Progress, ReadOptions, read_file};
use guideway::layout::{Layout, UserError};
use guideway::render::{Budget, Frame, Method, View, elapsed_ms};
use guideway::scene::SceneOptions;
use guideway::{AUTO, save_png_by};
use guideway_viewer::{AppServices, Job, LaunchOptions, LoadStage, MethodChoice, PictureRequest};

use self::floor::OnFloor;
use super::convert::Target;
use super::render::{Below, Wishes, draw, draw_swept, draw_vector};
use super::{Exit, Failure, Output, values};

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
    let opening = LaunchOptions {
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

impl AppServices for Desk {
    fn read_layout(&self, path: &Path, job: &Job) -> Result<Layout, UserError> {
        let options = ReadOptions {
            progress: Some(&Followed(job)),
            ..ReadOptions::default()
        };
        Ok(read_file(path, &options).map_err(Failure::from)?)
    }

    fn save_layout(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, UserError> {
        let (losses, _) = Target::to_save(layout, path)?.write(layout, path)?;
        Ok(losses.iter().map(|loss| loss.to_string()).collect())
    }

    fn check_save_in_place(&self, layout: &Layout, file: &Path) -> Result<(), UserError> {
        Ok(Target::check_in_place(layout, file)?)
    }

    fn render(&self, export: &PictureRequest, method: &str) -> Result<Frame, UserError> {
        let (below, wishes) = (below(export), wishes(export));
        let (method, progress) = (self.start_method(method)?, Followed(&Job::default()));
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

    fn export_png(
        &self,
        export: &PictureRequest,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), UserError> {
        let (below, wishes) = (below(export), wishes(export));
        let (method, progress) = (self.start_method(method)?, Followed(job));
        save_png_by(path, wishes.size, |take| {
            draw(&*method, &export.scene, &below, &wishes, &progress, take)
        })?;
        Ok(())
    }

    fn export_svg(&self, export: &PictureRequest, path: &Path) -> Result<(), UserError> {
        draw_vector(path, &export.scene, &below(export), &wishes(export))?;
        Ok(())
    }

    fn read_floor_plan(
        &self,
        plan: &str,
    ) -> Result<Arc<dyn guideway_viewer::FloorPlan>, UserError> {
        Ok(Arc::new(OnFloor::read(plan)?))
    }

    fn render_swept_areas(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: Source,
        view: &View,
    ) -> Result<Frame, UserError> {
        Ok(draw_swept(layout, rows, vehicle, view)?)
    }

    fn on_stage(&self, stage: LoadStage, file: &Path) {
        let Some(since) = self.timed_since else {
            return;
        };
        let what = match stage {
            LoadStage::Read => "read",
            LoadStage::Shown => "shown",
            LoadStage::Editable => "ready to be edited",
            LoadStage::Checked => "checked",
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
            unavailable: method.why_not,
        });
        let mut choices: Vec<MethodChoice> = listed.collect();
        let best = guideway::live_method();
        choices.sort_by_key(|choice| choice.name != best);
        choices
    }

    fn start_method(&self, name: &str) -> Result<Box<dyn Method>, UserError> {
        Ok(guideway::method(name).map_err(Failure::from)?)
    }
}

/// The content below the topmost layout.
fn below(picture: &PictureRequest) -> Below {
    // The window holds no plan but those of `read_floor_plan`.
    let plan = picture.floor_plan.as_deref().and_then(|plan| {
        let plan: &dyn Any = plan;
        plan.downcast_ref::<OnFloor>()
    });
    let swept = picture.swept.as_ref();
    Below {
        floor_plan: plan.map(|plan| plan.plan.clone()),
        lines: picture.grid.clone(),
        envelope: swept.map(|swept| swept.vehicle),
        swept: swept.map(|swept| swept.rows.clone()),
        others: picture.others.clone(),
    }
}

/// A picture of what is seen, with what the colors mean.
fn wishes(export: &PictureRequest) -> Wishes {
    let PictureRequest {
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

impl From<Failure> for UserError {
    fn from(failure: Failure) -> Self {
        Self {
            code: failure.code,
            message: failure.message,
            remedy: failure.remedy,
        }
    }
}

impl From<UserError> for Failure {
    fn from(error: UserError) -> Self {
        Self {
            code: error.code,
            message: error.message,
            remedy: error.remedy,
        }
    }
}
