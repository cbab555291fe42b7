//! [`Look`]: what a picture shows, as the page asks for it in JSON.

use std::sync::Arc;

use guideway::compose::{Decorations, MarkedRoute, Picture, SweptAreas, Viewport};
use guideway::envelope::EnvelopeSource;
use guideway::layout::UserError;
use guideway::scene::density::ToneMap;
use guideway::scene::{
    ClassBreaks, ColorBy, FrameSize, NumberColors, Palette, Rgba, Scene, SceneOptions, Shading,
};
use guideway::spline::Point;
use serde::Deserialize;

/// Size, view, colors and decorations of a picture. What is left out is as in the command.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub(crate) struct Look {
    /// Pixels.
    width: u32,
    height: u32,
    /// World point at the center in meters, and pixels per meter; without them all is shown.
    center: Option<[f64; 2]>,
    px_per_m: Option<f64>,
    /// Pixels per point, the scale of texts and lines.
    px_per_point: Option<f64>,
    /// Name or id of the only level that is shown.
    level: Option<String>,
    color_by: Option<String>,
    /// The colors of numbers: the name of a palette, and either the numbers at its ends or the
    /// ascending ones between classes.
    palette: Option<String>,
    range: Option<[f64; 2]>,
    breaks: Option<Vec<f64>>,
    /// RRGGBB; black on white by default.
    color: Option<String>,
    background: Option<String>,
    pub(crate) shade: Shade,
    /// Shows the floor plan, if there is one.
    pub(crate) floor_plan: bool,
    /// The vehicle whose swept areas are shown: `LENGTHxWIDTH[,REAR]` in meters, or `file`.
    envelope: Option<String>,
    arrows: bool,
    nodes: bool,
    stations: bool,
    labels: bool,
    grid: bool,
    scale_bar: bool,
    legend: bool,
    title: Option<String>,
    /// Names of two stations or nodes, and the vehicle type, to draw the fastest route between.
    pub(crate) route: Option<RouteEnds>,
}

/// The ends of a route.
#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub(crate) struct RouteEnds {
    pub(crate) from: String,
    pub(crate) to: String,
    #[serde(default)]
    pub(crate) vehicle_type: Option<String>,
}

/// The value of a pixel.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "camelCase")]
pub(crate) enum Shade {
    /// Density where many paths cover most of the picture, else color.
    Auto,
    #[default]
    Color,
    Density,
}

/// The part of a look that decides the scene: looks with the same key share it.
#[derive(PartialEq)]
pub(crate) struct SceneKey {
    level: Option<String>,
    color_by: Option<String>,
    color: Rgba,
    numbers: NumberColors,
}

impl SceneKey {
    /// The options of the scene.
    pub(crate) fn scene_options(&self) -> SceneOptions {
        SceneOptions {
            color: Some(self.color),
            color_by: self.color_by.clone().map(|column| ColorBy { column }),
            numbers: self.numbers,
            level: self.level.clone(),
            has_common_colors: false,
            has_gray_structure: true,
        }
    }
}

impl Look {
    pub(crate) fn parse(json: &str) -> Result<Self, UserError> {
        let look = serde_json::from_str(json);
        look.map_err(|error| usage(format!("the look of the picture: {error}")))
    }

    pub(crate) fn scene_key(&self) -> Result<SceneKey, UserError> {
        let palette = self.palette.as_deref().map(|name| {
            let unknown = || usage(format!("no palette is called `{name}`"));
            Palette::named(name).ok_or_else(unknown)
        });
        if self.range.is_some() && self.breaks.is_some() {
            return Err(UserError::new(
                "usage",
                "the look of the picture has both `range` and `breaks`",
                "Leave out one of them: breaks make classes, a range a continuous scale",
            ));
        }
        let breaks = self.breaks.as_deref().map(ClassBreaks::new).transpose();
        Ok(SceneKey {
            level: self.level.clone(),
            color_by: self.color_by.clone(),
            color: rgba(self.color.as_deref(), Rgba::BLACK)?,
            numbers: NumberColors {
                palette: palette.transpose()?.unwrap_or_default(),
                range: self.range,
                breaks: breaks.map_err(|error| usage(error.to_string()))?,
                background: rgba(self.background.as_deref(), Rgba::WHITE)?,
            },
        })
    }

    /// Size and view, as far as they are asked for.
    pub(crate) fn viewport(&self) -> Result<Viewport, UserError> {
        Ok(Viewport {
            size: FrameSize::new(self.width, self.height)?,
            center_m: self.center.map(|[x, y]| Point::new(x, y)),
            px_per_m: self.px_per_m,
        })
    }

    /// The picture of a scene, without the widths of its lines.
    pub(crate) fn picture(
        &self,
        scene: Arc<Scene>,
        route: Option<MarkedRoute>,
    ) -> Result<Picture, UserError> {
        let viewport = self.viewport()?;
        let mut picture = Picture::new(scene, viewport.size);
        picture.viewport = viewport;
        picture.style.background = rgba(self.background.as_deref(), Rgba::WHITE)?;
        if self.shade == Shade::Density {
            picture.style.shading = Shading::Density(ToneMap::Log);
        }
        let vehicle = self.envelope.as_deref().map(vehicle).transpose()?;
        picture.backdrop.swept = vehicle.map(|vehicle| SweptAreas {
            vehicle,
            rows: None,
        });
        picture.decorations = Decorations {
            has_grid: self.grid,
            has_zones: true,
            has_arrows: self.arrows,
            has_nodes: self.nodes,
            has_stations: self.stations,
            has_labels: self.labels,
            has_scale_bar: self.scale_bar,
            has_legend: self.legend || self.shade == Shade::Density,
            route,
            title: self.title.clone(),
            px_per_point: self.px_per_point,
        };
        Ok(picture)
    }

    /// Returns `true` if the picture shows marks, which an index finds.
    pub(crate) fn has_marks(&self) -> bool {
        self.arrows || self.nodes || self.stations || self.labels
    }
}

/// The vehicle of a text.
///
/// # Errors
/// When the text describes none.
pub(crate) fn vehicle(text: &str) -> Result<EnvelopeSource, UserError> {
    text.parse::<EnvelopeSource>().map_err(|error| {
        let message = format!("`{text}` is no vehicle: {error}");
        UserError::new(
            "usage",
            message,
            "Write its length and width, such as 2x1.2",
        )
    })
}

fn rgba(text: Option<&str>, default: Rgba) -> Result<Rgba, UserError> {
    let Some(text) = text else {
        return Ok(default);
    };
    let parsed = text.parse::<Rgba>();
    parsed.map_err(|error| usage(format!("the color `{text}`: {error}")))
}

/// A call that the page made wrongly.
pub(crate) fn usage(message: impl Into<String>) -> UserError {
    UserError::new("usage", message, "Report this fault of the page")
}
