//! Options of `render` for line widths, colors and shading.

use clap::ValueEnum;
use guideway::layout::UserError;
use guideway::scene::density::ToneMap;
use guideway::scene::{LineRule, NumberColors, Rgba, Shading, Style};

use crate::cli::error::usage_error;
use crate::cli::number_args::NumberArgs;
use crate::cli::values;

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Style")]
pub(crate) struct StyleArgs {
    /// Width of paths without a width in the file [default: a hairline in drawings and where paths
    /// would cover each other, 2 pixels where all is shown, else 0.1]
    #[arg(
        long,
        value_name = "METERS",
        value_parser = values::not_negative,
        allow_hyphen_values = true
    )]
    width: Option<f64>,
    /// Minimum width of a path in pixels [default: 1.5]
    #[arg(long, value_name = "N", value_parser = values::width_px, allow_hyphen_values = true)]
    min_px: Option<f64>,
    /// Maximum width of a path in pixels [default: 12]
    #[arg(long, value_name = "N", value_parser = values::width_px, allow_hyphen_values = true)]
    max_px: Option<f64>,
    /// Rule for widths: `world` uses the widths above, `thesis` 3 px clamped to 4 to 300 mm
    #[arg(
        long,
        value_name = "RULE",
        default_value = "world",
        hide_default_value = true
    )]
    line_rule: Rule,
    /// Color of paths without a color in the file [default: 000000]
    #[arg(long, value_name = "RRGGBB")]
    pub(crate) path_color: Option<Rgba>,
    /// Color paths by a column: `level`, `direction`, `vehicle_type` or a column of the file
    #[arg(long, value_name = "COLUMN")]
    pub(crate) color_by: Option<String>,
    #[command(flatten)]
    pub(super) numbers: NumberArgs,
    /// Draw the legend of the colors into the picture
    #[arg(long)]
    pub(crate) legend: bool,
    /// Background color; `none` for a transparent picture [default: ffffff]
    #[arg(long, value_name = "RRGGBB", value_parser = values::background)]
    background: Option<Rgba>,
    /// Value of a pixel: the color of the topmost path, or the number of paths [default: density
    /// where many paths cover more than half of the area that they take, else color]
    #[arg(long)]
    shade: Option<Shade>,
    /// Map from the number of paths to a color, with `--shade density` [default: log]
    #[arg(long)]
    tone: Option<Tone>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Rule {
    World,
    Thesis,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shade {
    #[value(aliases = ["colour", "lines"])]
    Color,
    Density,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Tone {
    Log,
    Linear,
    #[value(alias = "equalised")]
    Equalized,
}

impl StyleArgs {
    /// Returns `true` if an option sets the widths of lines.
    pub(crate) fn has_widths(&self) -> bool {
        let is_given = self.width.or(self.min_px).or(self.max_px).is_some();
        is_given || self.line_rule == Rule::Thesis
    }

    /// Returns `true` if any of these options is given.
    pub(crate) fn is_given(&self) -> bool {
        let is_colored = self.color_by.is_some() || self.background.is_some();
        let options = self.absent_in_pages();
        let is_set = options.iter().any(|(_, is_set)| *is_set);
        is_set || is_colored || self.shade.is_some() || self.legend
    }

    /// The options of which a page has none.
    pub(crate) fn absent_in_pages(&self) -> [(&'static str, bool); 6] {
        [
            ("--width", self.width.is_some()),
            ("--min-px", self.min_px.is_some()),
            ("--max-px", self.max_px.is_some()),
            ("--line-rule", self.line_rule == Rule::Thesis),
            ("--path-color", self.path_color.is_some()),
            ("--tone", self.tone.is_some()),
        ]
    }

    /// Returns `true` if neither colors nor shading are asked for.
    pub(crate) fn may_show_density(&self) -> bool {
        self.shade.is_none() && self.color_by.is_none() && self.path_color.is_none()
    }

    /// The colors of numbers on a background.
    pub(crate) fn numbers(&self, background: Rgba) -> NumberColors {
        NumberColors {
            palette: self.numbers.palette.unwrap_or_default(),
            range: self.numbers.range,
            breaks: self.numbers.breaks,
            background,
        }
    }

    pub(crate) fn style(&self) -> Result<Style, UserError> {
        let default = Style::default();
        Ok(Style {
            line_rule: self.line_rule()?,
            shading: self.shading()?,
            background: self.background.unwrap_or(default.background),
        })
    }

    fn line_rule(&self) -> Result<LineRule, UserError> {
        if self.line_rule == Rule::Thesis {
            if self.width.or(self.min_px).or(self.max_px).is_some() {
                return Err(usage_error(
                    "--line-rule thesis sets every width, so --width, --min-px and --max-px do not \
                     apply",
                    "Omit --line-rule or the widths, such as `--width 0.2 --min-px 1`",
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
            // A limit beyond the default of the other one moves that default.
            *max_px = self.max_px.unwrap_or(max_px.max(*min_px));
            if self.min_px.is_none() {
                *min_px = min_px.min(*max_px);
            }
            if min_px > max_px {
                return Err(usage_error(
                    format!("--min-px {min_px} exceeds --max-px {max_px}"),
                    "Make --min-px the smaller one, such as `--min-px 1 --max-px 12`",
                ));
            }
        }
        Ok(rule)
    }

    fn shading(&self) -> Result<Shading, UserError> {
        let shade = self.shade.unwrap_or(Shade::Color);
        if self.legend && self.color_by.is_none() && shade == Shade::Color {
            return Err(usage_error(
                "--legend says what colors mean, and here they have no meaning",
                "Add a column, such as `--legend --color-by maxSpeed`, or `--shade density`",
            ));
        }
        match (shade, self.tone) {
            (Shade::Color, None) => Ok(Shading::Color),
            (Shade::Color, Some(_)) => Err(usage_error(
                "--tone applies only with --shade density",
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
