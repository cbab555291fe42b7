//! Arguments of `bench`.

use std::path::PathBuf;

use clap::ValueEnum;
use guideway::scene::FrameSize;

use crate::cli::render::{Rule, Shade};
use crate::cli::values;

#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:\n  \
    guideway bench d1 --paths 100000 --methods grid,cpu\n  \
    guideway bench site.lif.json --motion pan --json\n  \
    guideway bench d1 --paths 100000 --motion edit --moved 10\n  \
    guideway bench d1 --paths 100000 --motion edit --moved 100 --apart\n  \
    guideway bench d1 --paths 1000000 --methods gpu,cpu --magnify 20 --dress mixed\n  \
    guideway bench d2 --methods grid,grid+scan+radius+exit,tessellation --frames 60 -o d2.json\n  \
    guideway bench tools --paths 1000000\n  \
    guideway bench --report laptop.html")]
pub(crate) struct Args {
    /// Layout file, or dataset `d1` or `d2`; `tools` measures network, check, route and diff
    #[arg(value_name = "FILE|d1|d2|tools", default_value = "d1")]
    pub(super) subject: PathBuf,
    /// Number of paths of the dataset, or of lines of the plan of `tools` [default: 10000]
    #[arg(long, value_name = "N", value_parser = values::paths)]
    pub(super) paths: Option<usize>,
    /// Methods to compare, with their options; ratios are relative to the first [default: all that
    /// run on this computer except `oracle`]
    #[arg(
        long,
        value_name = "A,B+OPTION",
        value_delimiter = ',',
        value_parser = values::MethodSpec
    )]
    pub(super) methods: Vec<String>,
    /// Measured frames per method
    #[arg(long, value_name = "N", default_value = "20", value_parser = values::frames)]
    pub(super) frames: usize,
    /// Unmeasured frames per method before those
    #[arg(long, value_name = "N", default_value = "3", value_parser = values::warmup)]
    pub(super) warmup: usize,
    /// Zoom factor about the densest place; 1 shows all paths, less zooms out
    #[arg(long, value_name = "TIMES", default_value = "1", value_parser = values::times)]
    pub(super) magnify: f64,
    /// Colors and widths of the paths
    #[arg(long, default_value = "own")]
    pub(super) dress: StyleChoice,
    /// Value of a pixel: the color of the topmost path, or the number of paths
    #[arg(long, default_value = "color")]
    pub(super) shade: Shade,
    /// Change from frame to frame
    #[arg(long, default_value = "still")]
    pub(super) motion: MotionKind,
    /// Share of the paths that `--motion edit` moves per frame, in percent [default: 1]
    #[arg(long, value_name = "PERCENT", value_parser = values::percent)]
    pub(super) moved: Option<f64>,
    /// Move the paths of `--motion edit` by an edit per frame, as at the end of a drag, not by the
    /// map of a gesture
    #[arg(long, group = "way")]
    pub(super) drop: bool,
    /// Move each path of `--motion edit` by its own new curve
    #[arg(long, group = "way")]
    pub(super) apart: bool,
    /// Remove the paths of `--motion edit` instead of moving them, and undo that in the next frame
    #[arg(long, group = "way")]
    pub(super) remove: bool,
    /// Give the paths of `--motion edit` another color and width, and undo that in the next frame
    #[arg(long, group = "way")]
    pub(super) restyle: bool,
    /// Give the scene other colors, different for the paths of `--motion edit`, and its own in the
    /// next frame, as when another column colors it
    #[arg(long, group = "way")]
    pub(super) recolor: bool,
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = values::frame_size)]
    pub(super) size: FrameSize,
    /// Rule for widths: `world` 0.1 m clamped to 1.5 to 12 px, `thesis` 3 px clamped to 4 to 300 mm
    #[arg(long, value_name = "RULE", default_value = "thesis")]
    pub(super) line_rule: Rule,
    /// Width of every path in pixels, instead of a line rule
    #[arg(
        long,
        value_name = "PX",
        value_parser = values::width_px,
        conflicts_with = "line_rule"
    )]
    pub(super) width_px: Option<f64>,
    /// Memory per method, in megabytes
    #[arg(long, value_name = "MB", default_value_t = 16_000)]
    pub(super) memory: u64,
    /// Threads of methods on the processor; 0 uses one per core
    #[arg(long, value_name = "N", default_value = "0", value_parser = values::threads)]
    pub(super) threads: usize,
    /// File to write the JSON report to
    #[arg(long, short, value_name = "JSON")]
    pub(super) output: Option<PathBuf>,
    /// Measure this computer by ten fixed cases within about five minutes, and write a page to send
    /// to others, with the figures as JSON beside it. Of the other options only --methods applies
    #[arg(long, value_name = "HTML", conflicts_with = "output")]
    pub(super) report: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MotionKind {
    /// No change
    Still,
    /// The view moves by whole pixels, as when dragged
    Pan,
    /// The view zooms in a little per frame, then out again
    Zoom,
    /// Some paths move
    Edit,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum StyleChoice {
    /// Those of the layout; a dataset is black
    Own,
    /// A color per path, and one of four widths
    Mixed,
    /// As `mixed`, with half of the paths translucent
    Translucent,
}
