use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::render::density::ToneMap;
use guideway::render::{Budget, FrameSize, Shading, Style};
use guideway::scene::LineRule;
use guideway_bench::{Contest, Dataset, Dress, Motion, Moves, plain_scene};

use crate::cli::render::{Rule, Shade};
use crate::cli::{Failure, Output, input, values};

/// Paths of a dataset unless told.
const PATHS: usize = 10_000;
/// Share of the paths that move unless told.
const MOVED_PERCENT: f64 = 1.0;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
    guideway bench d1 --paths 100000 --methods grid,cpu\n  \
    guideway bench site.lif.json --motion pan --json\n  \
    guideway bench d1 --paths 100000 --motion edit --moved 10\n  \
    guideway bench d1 --paths 100000 --motion edit --moved 100 --apart\n  \
    guideway bench d1 --paths 1000000 --methods gpu,cpu --magnify 20 --dress mixed\n  \
    guideway bench d2 --methods grid,grid+scan+radius+exit,tessellation --frames 60 -o d2.json")]
pub(crate) struct Args {
    /// Layout file, or one of the datasets `d1` and `d2`
    #[arg(value_name = "FILE|d1|d2", default_value = "d1")]
    subject: PathBuf,
    /// Paths of the dataset [default: 10000]
    #[arg(long, value_name = "N", value_parser = values::paths)]
    paths: Option<usize>,
    /// Methods to compare, with their options; ratios are to the first [default: all that run here
    /// but `oracle`]
    #[arg(long, value_name = "A,B+OPTION", value_delimiter = ',', value_parser = values::MethodSpec)]
    methods: Vec<String>,
    /// Frames of each method that count
    #[arg(long, value_name = "N", default_value = "20", value_parser = values::frames)]
    frames: usize,
    /// Frames of each method that are drawn before and do not count
    #[arg(long, value_name = "N", default_value_t = 3)]
    warmup: usize,
    /// Come so many times nearer to the busiest place; 1 sees all, less goes farther away
    #[arg(long, value_name = "TIMES", default_value = "1", value_parser = values::times)]
    magnify: f64,
    /// What paths look like
    #[arg(long, default_value = "own")]
    dress: Look,
    /// What a pixel shows: the colors of paths, or how many there are
    #[arg(long, default_value = "color")]
    shade: Shade,
    /// What changes from frame to frame
    #[arg(long, default_value = "still")]
    motion: Move,
    /// Share of the paths that `--motion edit` moves each frame, in percent [default: 1]
    #[arg(long, value_name = "PERCENT", value_parser = values::percent)]
    moved: Option<f64>,
    /// Let each path that `--motion edit` moves go its own way, by a curve given anew, not all of them by one map
    #[arg(long)]
    apart: bool,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = values::frame_size)]
    size: FrameSize,
    /// How wide paths are: `world` 0.1 m held within 1.5 to 12 px, `thesis` 3 px held within 4 to 300 mm
    #[arg(long, value_name = "RULE", default_value = "thesis")]
    line_rule: Rule,
    /// Width of every path in pixels, in place of a line rule
    #[arg(long, value_name = "PX", value_parser = values::positive, conflicts_with = "line_rule")]
    width_px: Option<f64>,
    /// Memory that each method may use, in megabytes
    #[arg(long, value_name = "MB", default_value_t = 16_000)]
    memory: u64,
    /// Threads that methods on the processor may use; 0 for one a core
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// File for the JSON report
    #[arg(long, short, value_name = "JSON")]
    pub(super) output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Move {
    /// Nothing
    Still,
    /// The view moves by whole pixels, as when it is dragged
    Pan,
    /// The view comes a little nearer each frame, and goes away again
    Zoom,
    /// Some paths move
    Edit,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Look {
    /// As the layout says; a dataset is black
    Own,
    /// Each path has a color of its own, and one of four widths
    Mixed,
    /// The same, half of them translucent
    Translucent,
}

impl Args {
    /// The layout file, unless a dataset is asked for.
    pub(super) fn file(&self) -> Option<&Path> {
        self.dataset().is_none().then_some(&*self.subject)
    }

    fn dataset(&self) -> Option<Dataset> {
        match self.subject.to_str() {
            Some("d1") => Some(Dataset::D1),
            Some("d2") => Some(Dataset::D2),
            _ => None,
        }
    }

    /// What the arguments ask for together.
    pub(super) fn contest(&self, out: &Output) -> Result<Contest, Failure> {
        if self.file().is_some() && self.paths.is_some() {
            return Err(Failure::arguments(
                "--paths is for the datasets d1 and d2; a file has as many paths as it has",
                "Leave --paths out, or measure a dataset, such as `guideway bench d1 --paths 100000`",
            ));
        }
        if self.motion != Move::Edit && (self.moved.is_some() || self.apart) {
            return Err(Failure::arguments(
                "--moved and --apart say how paths move, which needs --motion edit",
                "Add it, such as `--motion edit --moved 10`",
            ));
        }
        let scene = match self.dataset() {
            Some(dataset) => {
                let _activity = out.activity("making the dataset");
                dataset.scene(self.paths.unwrap_or(PATHS))
            }
            None => plain_scene(input::read(&self.subject, out)?.0),
        };
        let dress = match self.dress {
            Look::Own => Dress::Own,
            Look::Mixed => Dress::Mixed,
            Look::Translucent => Dress::Translucent,
        };
        Ok(Contest {
            name: self.subject.to_string_lossy().into_owned(),
            scene: dress.scene(scene),
            dress,
            methods: self.specs(),
            size: self.size,
            magnify: self.magnify,
            motion: match self.motion {
                Move::Still => Motion::Still,
                Move::Pan => Motion::Pan,
                Move::Zoom => Motion::Zoom,
                Move::Edit => Motion::Edit,
            },
            edit: Moves {
                share: self.moved.unwrap_or(MOVED_PERCENT) / 100.0,
                is_apart: self.apart,
            },
            style: Style {
                line_rule: match (self.width_px, self.line_rule) {
                    (Some(width_px), _) => LineRule::World {
                        width_m: 0.0,
                        min_px: width_px,
                        max_px: width_px,
                    },
                    (None, Rule::World) => LineRule::default(),
                    (None, Rule::Thesis) => LineRule::Thesis,
                },
                shading: match self.shade {
                    Shade::Color => Shading::Color,
                    Shade::Density => Shading::Density(ToneMap::default()),
                },
                ..Style::default()
            },
            budget: Budget {
                memory_bytes: self.memory.saturating_mul(1_000_000),
                threads: self.threads,
            },
            warmup: self.warmup,
            frames: self.frames,
        })
    }

    /// The methods asked for, or all but the slow judge.
    fn specs(&self) -> Vec<String> {
        if self.methods.is_empty() {
            let all = guideway::methods().into_iter();
            let running = all.filter(|m| m.why_not.is_none() && m.info.name != "oracle");
            return running.map(|m| m.info.name.to_owned()).collect();
        }
        self.methods.clone()
    }
}
