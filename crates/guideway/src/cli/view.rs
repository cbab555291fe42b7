//! `guideway view`: the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use guideway::formats::{Progress, ReadOptions, read_file};
use guideway::layout::Layout;
use guideway::render::{Budget, Method};
use guideway::scene::SceneOptions;
use guideway::{AUTO, save_png_by};
use guideway_viewer::{Export, Host, Job, MethodChoice, Trouble};

use super::convert::Target;
use super::render::{Below, Wishes, draw, draw_vector};
use super::{Exit, Failure, Output, values};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "F1 in the window shows what each key does. Files can be dropped on it too."
)]
pub(crate) struct Args {
    /// Layout files of any format that is read, found from their content
    #[arg(value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Way of drawing, as `guideway methods` lists them; `auto` takes `gpu` where there is graphics hardware, else
    /// `cpu`
    #[arg(long, value_name = "NAME[+OPTION]", default_value = AUTO, value_parser = values::MethodSpec)]
    method: String,
}

pub(crate) fn run(args: &Args, out: &Output) -> Result<Exit, Failure> {
    if out.is_json() {
        return Err(Failure::arguments(
            "a window has nothing to say as JSON",
            "Leave --json out; `guideway info` and `guideway check` report as JSON",
        ));
    }
    let method = (args.method != AUTO).then(|| args.method.clone());
    guideway_viewer::run(Arc::new(Desk), args.files.clone(), method)?;
    Ok(Exit::Clean)
}

/// Files and ways of drawing, for the window.
struct Desk;

impl Host for Desk {
    fn open(&self, path: &Path, job: &Job) -> Result<Layout, Trouble> {
        let options = ReadOptions {
            progress: Some(&Followed(job)),
            ..ReadOptions::default()
        };
        Ok(read_file(path, &options).map_err(Failure::from)?)
    }

    fn save(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, Trouble> {
        let (losses, _) = Target::of(path)?.write(layout, path)?;
        Ok(losses.iter().map(|loss| loss.to_string()).collect())
    }

    fn save_picture(
        &self,
        export: Export<'_>,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), Trouble> {
        let method = self.method(method)?;
        let wishes = wishes(&export);
        save_png_by(path, wishes.size, |take| {
            let (below, progress) = (Below::default(), Followed(job));
            draw(&*method, export.scene, &below, &wishes, &progress, take)
        })?;
        Ok(())
    }

    fn save_drawing(&self, export: Export<'_>, path: &Path) -> Result<(), Trouble> {
        draw_vector(path, export.scene, &Below::default(), &wishes(&export))?;
        Ok(())
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

/// A picture of what is seen, with what the colours mean.
fn wishes(export: &Export<'_>) -> Wishes {
    let Export { scene, view, style } = export;
    Wishes {
        size: view.size(),
        center_m: Some(view.center_m()),
        px_per_m: Some(view.px_per_m()),
        scene: SceneOptions::default(),
        style: **style,
        has_legend: scene.legend().is_some(),
        budget: Budget::default(),
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
