//! Options of `render` that select what the picture shows.

use guideway::compose::Viewport;
use guideway::envelope::EnvelopeSource;
use guideway::layout::UserError;
use guideway::scene::FrameSize;
use guideway::spline::Point;

use crate::cli::error::usage_error;
use crate::cli::input::Input;
use crate::cli::{envelope, values};

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "View")]
pub(super) struct ViewArgs {
    /// Size of the picture in pixels
    #[arg(long, value_name = "WxH", default_value = "1920x1080", value_parser = values::size)]
    size: FrameSize,
    /// Show all paths; the default
    #[arg(long)]
    fit: bool,
    /// World point at the center of the picture, in meters [default: the center of all paths]
    #[arg(long, value_name = "X,Y", value_parser = values::point, allow_hyphen_values = true)]
    center: Option<Point<f64>>,
    /// Scale in pixels per meter [default: fits all paths]
    #[arg(
        long,
        value_name = "PX_PER_M",
        value_parser = values::factor,
        allow_hyphen_values = true
    )]
    scale: Option<f64>,
    /// Draw only the level with this name or id; `each` draws all levels side by side
    #[arg(long, value_name = "NAME")]
    pub(super) level: Option<String>,
    /// File to draw below the paths: a layout or drawing in a pale color; a `map.yaml` of ROS; or
    /// a PNG, JPEG, PBM, PGM or PPM image whose lower left corner is at `offset`, such as
    /// `hall.png@px-per-m=20,offset=-3,-2`
    #[arg(long, value_name = "FILE", value_parser = Input::parser())]
    pub(super) floor_plan: Option<Input>,
    /// Draw the areas that a vehicle sweeps below the paths. The vehicle is given by its length,
    /// width and the distance from its rear end to its reference point (default: half the length),
    /// in meters; `file` uses the envelopes of the file
    #[arg(long, value_name = "LENGTHxWIDTH[,REAR]", value_parser = envelope::source)]
    pub(super) envelope: Option<EnvelopeSource>,
}

impl ViewArgs {
    pub(super) fn viewport(&self) -> Result<Viewport, UserError> {
        if self.fit && (self.center.is_some() || self.scale.is_some()) {
            return Err(usage_error(
                "--fit shows all paths, so --center and --scale do not apply",
                "Omit --fit, such as `--center 12.5,-3 --scale 40`",
            ));
        }
        Ok(Viewport {
            size: self.size,
            center_m: self.center,
            px_per_m: self.scale,
        })
    }
}
