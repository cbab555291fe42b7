//! Arguments of `render`, and the options that they select.

use std::path::{Path, PathBuf};

use guideway::AUTO;
use guideway::compose::{Backdrop, Picture, SweptAreas, Viewport, suitable_widths};
use guideway::layout::{Layout, UserError};
use guideway::scene::{Budget, ColorBy, LineRule, Scene, SceneOptions, Shading, Style, View};
use guideway::spline::Bounds;

use super::decoration_args::DecorationArgs;
use super::style_args::StyleArgs;
use super::view_args::ViewArgs;
use crate::cli::error::usage_error;
use crate::cli::input::{Input, PLACEMENT_HELP, check_output};
use crate::cli::picture_file::{PictureFormat, default_name};
use crate::cli::picture_output::PictureOutput;
use crate::cli::values;

#[derive(Debug, clap::Args)]
#[command(after_help = format!("Examples:\n  \
    guideway render site.lif.json -o site.png\n  \
    guideway render site.lif.json -o plan.svg --site --title \"Hall 3\"\n  \
    guideway render site.lif.json -o dock.png --center 12.5,-3 --scale 40\n  \
    guideway render site.lif.json -o speed.png --color-by maxSpeed\n  \
    guideway render hall.lif.json annex.dxf@offset=80,0 -o both.png\n\n{}", PLACEMENT_HELP))]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    pub(super) inputs: Vec<Input>,
    /// PNG, SVG or PDF file to write, or the HTML page of `guideway share`; `-` is standard output
    /// [default: the name of the layout with .png, unless this file exists]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Format of the picture where the output has no extension, such as `-o - --to svg`
    #[arg(long, value_name = "FORMAT")]
    pub(super) to: Option<PictureFormat>,
    /// Also write a world file (.pgw), by which QGIS and other programs place the PNG
    #[arg(long)]
    pub(super) world_file: bool,
    /// Render method with options, such as `grid+scan`; `guideway methods` lists them
    #[arg(
        long,
        value_name = "NAME[+OPTION]",
        default_value = AUTO,
        value_parser = values::MethodSpec
    )]
    method: String,
    /// Antialiasing of a method with option `aa`: `--aa none` is `+aa=none`
    #[arg(long, value_name = "KIND")]
    aa: Option<String>,
    #[command(flatten)]
    pub(super) view: ViewArgs,
    #[command(flatten)]
    pub(super) decorations: DecorationArgs,
    #[command(flatten)]
    pub(super) style: StyleArgs,
    #[command(flatten)]
    resources: ResourceArgs,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Resources")]
struct ResourceArgs {
    /// Threads of the render method; 0 uses one per core
    #[arg(long, value_name = "N", default_value = "0", value_parser = values::threads)]
    threads: usize,
    /// Memory of the render method, in megabytes [default: 1074]
    #[arg(long, value_name = "MB")]
    memory: Option<u64>,
}

/// Least half margin around a view, in pixels, whose paths are read: for antialiasing.
const MARGIN_PX: f64 = 32.0;

/// The value of `--level` that shows all levels side by side.
const EACH: &str = "each";

/// The options of a picture, valid together.
pub(super) struct RenderOptions {
    pub(super) scene: SceneOptions,
    pub(super) viewport: Viewport,
    pub(super) style: Style,
    budget: Budget,
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

    /// The file to write.
    ///
    /// # Errors
    /// When none is named and the default exists.
    pub(super) fn output(&self) -> Result<PathBuf, UserError> {
        match (&self.output, &self.inputs[..]) {
            (None, [first, ..]) => default_name(&first.path),
            (named, _) => Ok(named.clone().unwrap_or_default()),
        }
    }

    /// The world file to write beside a PNG file.
    ///
    /// # Errors
    /// When the output is no PNG file.
    pub(super) fn world_file(
        &self,
        output: &PictureOutput<'_>,
    ) -> Result<Option<PathBuf>, UserError> {
        if !self.world_file {
            return Ok(None);
        }
        let file = output.file.filter(|_| output.format == PictureFormat::Png);
        let Some(file) = file else {
            return Err(usage_error(
                "--world-file places a PNG file",
                "Write one, such as `-o site.png --world-file`",
            ));
        };
        let file = file.with_extension("pgw");
        check_output(self.files(), &file)?;
        Ok(Some(file))
    }

    /// All files that the command reads.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        let inputs = self.inputs.iter().chain(self.floor_plan());
        inputs.map(|input| input.path.as_path())
    }

    /// Rejects options that SVG and PDF cannot express.
    pub(super) fn check_vector(&self) -> Result<(), UserError> {
        if self.method != AUTO || self.aa.is_some() {
            return Err(usage_error(
                "SVG and PDF hold the curves themselves, so --method and --aa do not apply",
                "Omit --method and --aa, or save the picture as PNG",
            ));
        }
        Ok(())
    }

    /// Checks the options together.
    ///
    /// # Errors
    /// When options contradict each other.
    pub(super) fn options(&self) -> Result<RenderOptions, UserError> {
        let default = Budget::default();
        let memory = self.resources.memory;
        let style = self.style.style()?;
        Ok(RenderOptions {
            scene: SceneOptions {
                color: self.style.path_color,
                color_by: self.style.color_by.clone().map(|column| ColorBy { column }),
                numbers: self.style.numbers(style.background),
                level: self.view.level.clone(),
                has_common_colors: false,
                has_gray_structure: !self.decorations.plain,
            },
            viewport: self.view.viewport()?,
            style,
            budget: Budget {
                memory_bytes: memory
                    .map_or(default.memory_bytes, |mb| mb.saturating_mul(1_000_000)),
                threads: self.resources.threads,
            },
        })
    }

    /// The box, in meters, of the paths that a picture may show; `None` if it depends on all paths.
    pub(super) fn area(&self, options: &RenderOptions) -> Option<Bounds<f64>> {
        let depends_on_all = self.style.color_by.is_some()
            || self.view.level.is_some()
            || self.view.envelope.is_some()
            || self.decorations.depends_on_all();
        let (center, px_per_m) = options.viewport.center_m.zip(options.viewport.px_per_m)?;
        let view = View::new(options.viewport.size, center, px_per_m).ok()?;
        // Widths that suit the view may replace those of the style.
        let widest_px = [options.style.line_rule, LineRule::default()]
            .into_iter()
            .flat_map(|rule| [None, Some(f32::MAX)].map(|own| rule.radius_px(own, px_per_m)))
            .fold(MARGIN_PX, f64::max);
        let reach_m = 2.0 * widest_px / px_per_m;
        (!depends_on_all).then(|| view.world_bounds().inflated(reach_m))
    }

    /// The picture that the options describe.
    pub(super) fn picture(
        &self,
        options: &RenderOptions,
        scene: std::sync::Arc<Scene>,
        floor_plan: Option<guideway::compose::FloorPlan>,
    ) -> Picture {
        let vehicle = self.view.envelope;
        let mut picture = Picture::new(scene, options.viewport.size);
        picture.viewport = options.viewport;
        picture.style = options.style;
        picture.budget = options.budget;
        picture.backdrop = Backdrop {
            floor_plan,
            swept: vehicle.map(|vehicle| SweptAreas {
                vehicle,
                rows: None,
            }),
            ..Backdrop::default()
        };
        picture.decorations = self.decorations.decorations(&self.inputs);
        let is_density = options.style.shading != Shading::Color;
        picture.decorations.has_legend |=
            self.style.legend || (is_density && !self.decorations.plain);
        picture
    }

    /// Suits the widths of lines to what a picture shows, unless they are given.
    ///
    /// # Errors
    /// When the view is out of range.
    pub(super) fn suit_widths(&self, picture: &mut Picture) -> Result<(), UserError> {
        if !self.decorations.plain && !self.style.has_widths() {
            let is_all_shown = picture.viewport.px_per_m.is_none();
            let layout = picture.scene.layout();
            picture.style.line_rule = suitable_widths(layout, &picture.view()?, is_all_shown);
        }
        Ok(())
    }

    /// Returns `true` if the picture may show density where its paths are crowded: nothing says
    /// what their colors mean.
    pub(super) fn may_show_density(&self) -> bool {
        !self.decorations.plain && self.style.may_show_density()
    }

    /// Returns `true` if the levels of a layout are to be shown side by side.
    pub(super) fn is_each_level(&self, layout: &Layout) -> bool {
        self.view.level.as_deref() == Some(EACH) && layout.level_named(EACH).is_none()
    }
}
