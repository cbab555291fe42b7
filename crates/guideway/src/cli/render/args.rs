use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::AUTO;
use guideway::envelope::Source;
use guideway::render::density::ToneMap;
use guideway::render::{Budget, DrawList, FrameSize, Shading, Style};
use guideway::scene::{ColorBy, LineRule, Rgba, SceneOptions};
use guideway::spline::Point;

use super::Wishes;
use crate::cli::input::{Input, PLACEMENT_HELP};
use crate::cli::{Failure, envelope, values};

#[derive(Debug, clap::Args)]
#[command(after_help = format!("Examples:\n  \
    guideway render site.lif.json -o site.png\n  \
    guideway render site.lif.json -o dock.png --center 12.5,-3 --scale 40\n  \
    guideway render site.lif.json -o speed.png --color-by maxSpeed\n  \
    guideway render hall.lif.json annex.dxf@offset=80,0 -o both.png\n\n{}", PLACEMENT_HELP))]
pub(crate) struct Args {
    /// Layout files of any format that is read, found from their content
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    pub(crate) inputs: Vec<Input>,
    /// PNG or SVG file to write; - for PNG on standard output
    #[arg(long, short, value_name = "FILE")]
    pub(crate) output: PathBuf,
    /// Way of drawing, with options such as `grid+scan`; `guideway methods` shows what runs here
    #[arg(long, value_name = "NAME[+OPTION]", default_value = AUTO, value_parser = values::MethodSpec)]
    method: String,
    /// How edges are smoothed, with a method that has option `aa`: `--aa none` is `+aa=none`
    #[arg(long, value_name = "KIND")]
    aa: Option<String>,
    #[command(flatten)]
    view: ViewArgs,
    #[command(flatten)]
    look: LookArgs,
    #[command(flatten)]
    resources: ResourceArgs,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "What is seen")]
struct ViewArgs {
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = values::size)]
    size: FrameSize,
    /// Show everything; the default
    #[arg(long)]
    fit: bool,
    /// Point in the middle of the picture, in meters [default: the middle of the layout]
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    center: Option<Point<f64>>,
    /// Pixels a meter [default: so that everything is seen]
    #[arg(long, value_name = "PX_PER_M", value_parser = values::positive, allow_hyphen_values = true)]
    scale: Option<f64>,
    /// Draw only the level of this name or id
    #[arg(long, value_name = "NAME")]
    level: Option<String>,
    /// What lies below: paths of another layout or drawing, pale, or a PNG image whose lower left corner is
    /// at offset, such as `hall.png@px-per-m=20,offset=-3,-2`
    #[arg(long, value_name = "FILE", value_parser = Input::parser())]
    floor_plan: Option<Input>,
    /// The areas that a vehicle sweeps, under the paths: its length and width in meters, and how far its reference
    /// point is from its rear end (the middle unless given); or `file` for the corridors that the file gives
    #[arg(long, value_name = "LENGTHxWIDTH[,REAR]", value_parser = envelope::source)]
    envelope: Option<Source>,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "How it looks")]
struct LookArgs {
    /// Width of paths that have none of their own [default: 0.1]
    #[arg(long, value_name = "METERS", value_parser = values::not_negative, allow_hyphen_values = true)]
    width: Option<f64>,
    /// Least width of a path in pixels [default: 1.5]
    #[arg(long, value_name = "N", value_parser = values::not_negative, allow_hyphen_values = true)]
    min_px: Option<f64>,
    /// Greatest width of a path in pixels [default: 12]
    #[arg(long, value_name = "N", value_parser = values::not_negative, allow_hyphen_values = true)]
    max_px: Option<f64>,
    /// How wide paths are: `world` by the widths above, `thesis` 3 px held within 4 to 300 mm
    #[arg(
        long,
        value_name = "RULE",
        default_value = "world",
        hide_default_value = true
    )]
    line_rule: Rule,
    /// Color of paths that have none of their own [default: 000000]
    #[arg(long, value_name = "RRGGBB")]
    color: Option<Rgba>,
    /// Color every path by a column: `level`, `direction`, `vehicle_type` or one of the file
    #[arg(long, value_name = "COLUMN")]
    color_by: Option<String>,
    /// Put what the colors mean into the picture too
    #[arg(long, requires = "color_by")]
    legend: bool,
    /// What lies below the paths [default: ffffff]
    #[arg(long, value_name = "RRGGBB")]
    background: Option<Rgba>,
    /// What a pixel shows: the colors of paths, or how many there are
    #[arg(long, default_value = "color")]
    shade: Shade,
    /// How the number of paths becomes a color, with `--shade density` [default: log]
    #[arg(long)]
    tone: Option<Tone>,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "What it may use")]
struct ResourceArgs {
    /// Threads to draw with; 0 for one a core
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,
    /// Memory to draw with, in megabytes [default: 1074]
    #[arg(long, value_name = "MB")]
    memory: Option<u64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Rule {
    World,
    Thesis,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shade {
    #[value(alias = "colour")]
    Color,
    Density,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Tone {
    Log,
    Linear,
    Equalized,
}

impl Args {
    /// The method with its options.
    pub(super) fn method(&self) -> String {
        match &self.aa {
            Some(aa) => format!("{}+aa={aa}", self.method),
            None => self.method.clone(),
        }
    }

    pub(super) fn floor_plan(&self) -> Option<&Input> {
        self.view.floor_plan.as_ref()
    }

    pub(super) fn envelope(&self) -> Option<Source> {
        self.view.envelope
    }

    /// All files that are read.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        let inputs = self.inputs.iter().chain(self.floor_plan());
        inputs.map(|input| input.path.as_path())
    }

    /// Refuses what no SVG picture can have.
    pub(super) fn check_vector(&self) -> Result<(), Failure> {
        if self.method != AUTO || self.aa.is_some() {
            return Err(Failure::arguments(
                "an SVG picture holds the curves themselves: no method draws it",
                "Leave --method and --aa out, or save the picture as PNG",
            ));
        }
        Ok(())
    }

    /// What the arguments ask for together.
    pub(super) fn wishes(&self) -> Result<Wishes, Failure> {
        if self.view.fit && (self.view.center.is_some() || self.view.scale.is_some()) {
            return Err(Failure::arguments(
                "--fit shows everything, so it goes with neither --center nor --scale",
                "Leave --fit out, such as `--center 12.5,-3 --scale 40`",
            ));
        }
        let default = Budget::default();
        Ok(Wishes {
            size: self.view.size,
            center_m: self.view.center,
            px_per_m: self.view.scale,
            scene: SceneOptions {
                color: self.look.color,
                color_by: self.look.color_by.clone().map(|column| ColorBy { column }),
                level: self.view.level.clone(),
            },
            style: self.look.style()?,
            has_legend: self.look.legend,
            budget: Budget {
                memory_bytes: match self.resources.memory {
                    Some(mb) => mb.saturating_mul(1_000_000),
                    None => default.memory_bytes,
                },
                threads: self.resources.threads,
            },
            marks: DrawList::default(),
        })
    }
}

impl LookArgs {
    fn style(&self) -> Result<Style, Failure> {
        let default = Style::default();
        Ok(Style {
            line_rule: self.line_rule()?,
            shading: self.shading()?,
            background: self.background.unwrap_or(default.background),
        })
    }

    fn line_rule(&self) -> Result<LineRule, Failure> {
        let has_widths = self.width.or(self.min_px).or(self.max_px).is_some();
        if self.line_rule == Rule::Thesis {
            if has_widths {
                return Err(Failure::arguments(
                    "--line-rule thesis sets every width, so it goes with none of --width, --min-px \
                     and --max-px",
                    "Leave either out, such as `--width 0.2 --min-px 1`",
                ));
            }
            return Ok(LineRule::Thesis);
        }
        let mut rule = LineRule::default();
        if let LineRule::World {
            width_m,
            min_px,
            max_px,
        } = &mut rule
        {
            *width_m = self.width.unwrap_or(*width_m);
            *min_px = self.min_px.unwrap_or(*min_px);
            // Asking for one limit beyond the other's default moves the other along.
            *max_px = self.max_px.unwrap_or(max_px.max(*min_px));
            if self.min_px.is_none() {
                *min_px = min_px.min(*max_px);
            }
            if min_px > max_px {
                return Err(Failure::arguments(
                    format!("--min-px {min_px} is more than --max-px {max_px}"),
                    "Make the least width the smaller one, such as `--min-px 1 --max-px 12`",
                ));
            }
        }
        Ok(rule)
    }

    fn shading(&self) -> Result<Shading, Failure> {
        match (self.shade, self.tone) {
            (Shade::Color, None) => Ok(Shading::Color),
            (Shade::Color, Some(_)) => Err(Failure::arguments(
                "--tone says how the number of paths becomes a color, which needs --shade density",
                "Add it, such as `--shade density --tone linear`",
            )),
            (Shade::Density, tone) => Ok(Shading::Density(match tone {
                None | Some(Tone::Log) => ToneMap::Log,
                Some(Tone::Linear) => ToneMap::Linear,
                Some(Tone::Equalized) => ToneMap::Equalized,
            })),
        }
    }
}
