//! Arguments of `share`.

use std::path::PathBuf;

use guideway::envelope::EnvelopeSource;
use guideway::scene::Palette;
use guideway::spline::Point;

use super::page::SharedLook;
use crate::cli::input::{Input, PLACEMENT_HELP};
use crate::cli::number_args::NumberArgs;
use crate::cli::{envelope, values};

#[derive(Debug, clap::Args)]
#[command(after_help = format!("Examples:\n  \
    guideway share site.lif.json -o site.html\n  \
    guideway share site.lif.json -o speed.html --title \"Hall 3\" --color-by maxSpeed\n  \
    guideway share site.lif.json -o hall.html --floor-plan hall.dxf\n\n{}",
    PLACEMENT_HELP))]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    pub(super) inputs: Vec<Input>,
    /// HTML file to write; `-` is standard output [default: the name of the layout with .html,
    /// unless this file exists]
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Title of the page [default: the name of the first file]
    #[arg(long, value_name = "TEXT")]
    pub(super) title: Option<String>,
    /// World point at the center at first, in meters [default: the center of all paths]
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    center: Option<Point<f64>>,
    /// Scale at first, in pixels per meter [default: fits all paths]
    #[arg(
        long,
        value_name = "PX_PER_M",
        value_parser = values::factor,
        allow_hyphen_values = true
    )]
    scale: Option<f64>,
    /// Show only the level with this name or id at first
    #[arg(long, value_name = "NAME")]
    pub(super) level: Option<String>,
    /// Color paths by a column: `level`, `direction`, `vehicle_type` or a column of the file
    #[arg(long, value_name = "COLUMN")]
    pub(super) color_by: Option<String>,
    #[command(flatten)]
    numbers: NumberArgs,
    /// File to show below the paths: a layout, a drawing, a ROS map, a page of a PDF or an image,
    /// such as `hall.png@px-per-m=20,offset=-3,-2`
    #[arg(long, value_name = "FILE", value_parser = Input::parser())]
    pub(super) floor_plan: Option<Input>,
    /// Vehicle whose swept areas the page shows: its length, width and the distance from its rear
    /// end to its reference point (default: half the length), in meters; `file` uses the envelopes
    /// of the file
    #[arg(long, value_name = "LENGTHxWIDTH[,REAR]", value_parser = envelope::source)]
    envelope: Option<EnvelopeSource>,
    /// Light lines on dark paper
    #[arg(long)]
    dark: bool,
}

impl Args {
    /// The view and the colors in which the page opens.
    pub(super) fn look(&self) -> SharedLook {
        SharedLook {
            center: self.center.map(|center| [center.x, center.y]),
            px_per_m: self.scale,
            level: self.level.clone(),
            color_by: self.color_by.clone(),
            palette: self.numbers.palette.map(Palette::name),
            range: self.numbers.range,
            breaks: self.numbers.breaks.map(|breaks| breaks.numbers().to_vec()),
            envelope: self.envelope,
            legend: self.color_by.is_some().then_some(true),
            background: self.dark.then(|| "16181d".to_owned()),
            ..SharedLook::default()
        }
    }
}
