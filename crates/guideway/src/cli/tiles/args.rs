//! Arguments of `tiles`, and the content that they select.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::layout::UserError;
use guideway::scene::{Budget, ColorBy, SceneOptions};
use guideway::tiles::{MAX_ZOOM, VectorOptions};

use crate::cli::error::usage_error;
use crate::cli::input::{self, Input, PLACEMENT_HELP};
use crate::cli::output::is_stdout;
use crate::cli::render::StyleArgs;
use crate::cli::values;

/// Extension of the output.
const EXTENSION: &str = "pmtiles";

#[derive(Debug, clap::Args)]
#[command(after_help = format!("Examples:\n  \
    guideway tiles site.lif.json -o site.pmtiles\n  \
    guideway tiles million.arrow -o million.pmtiles --zoom 0-8 --shade density\n  \
    guideway tiles roads.geojson -o roads.pmtiles --content vector --columns maxSpeed\n\n\
    A run that was stopped goes on where it stopped when it is started again.\n\n{}",
    PLACEMENT_HELP))]
pub(crate) struct Args {
    /// Layout files; the content decides the format
    #[arg(required = true, value_name = "FILE", value_parser = Input::parser())]
    pub(super) inputs: Vec<Input>,
    /// PMTiles file to write
    #[arg(long, short, value_name = "FILE")]
    pub(super) output: PathBuf,
    /// First and last zoom, such as 0-10 [default: from the whole layout in about one tile to six
    /// zooms further]
    #[arg(long, value_name = "FIRST-LAST", value_parser = zooms)]
    pub(super) zoom: Option<RangeInclusive<u8>>,
    /// Content of the tiles
    #[arg(long, value_name = "KIND", default_value = "raster")]
    pub(super) content: ContentKind,
    /// Lay the tiles over a square around the layout, even if it has a place on earth
    #[arg(long)]
    pub(super) plane: bool,
    /// Draw only the level with this name or id
    #[arg(long, value_name = "NAME")]
    level: Option<String>,
    /// Columns that the lines of vector tiles carry beside `id` and `level`, such as
    /// maxSpeed,direction [default: all but those with JSON]
    #[arg(long, value_name = "A,B", value_delimiter = ',')]
    columns: Option<Vec<String>>,
    /// Most paths of a vector tile: with more, the longest ones are in it [default: 20000]
    #[arg(long, value_name = "N", value_parser = values::paths)]
    max_paths: Option<usize>,
    #[command(flatten)]
    pub(super) style: StyleArgs,
    /// Memory of the render method, in megabytes [default: 1074]
    #[arg(long, value_name = "MB", help_heading = "Resources")]
    memory: Option<u64>,
}

/// Kind of the tiles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ContentKind {
    /// Pictures, as PNG
    Raster,
    /// Lines with attributes, as Mapbox vector tiles, which the map program draws
    Vector,
}

impl Args {
    /// Checks what needs no file.
    ///
    /// # Errors
    /// When the output is no file of its kind, or options contradict each other.
    pub(super) fn check(&self) -> Result<(), UserError> {
        let extension = self.output.extension().unwrap_or_default();
        if is_stdout(&self.output) || !extension.eq_ignore_ascii_case(EXTENSION) {
            return Err(usage_error(
                "tiles are written to a PMTiles file, whose name ends in .pmtiles",
                "Rename the output, such as `-o site.pmtiles`",
            ));
        }
        input::check_output(self.files(), &self.output)?;
        if self.style.legend {
            return Err(usage_error(
                "--legend belongs to a picture, and tiles have no place for it",
                "Omit --legend; `guideway render --legend` draws one",
            ));
        }
        let is_vector = self.content == ContentKind::Vector;
        if is_vector && self.style.is_given() {
            return Err(usage_error(
                "vector tiles hold lines that the map program draws, so options of style do not \
                 apply",
                "Omit the options of style, or make raster tiles with `--content raster`",
            ));
        }
        if !is_vector && (self.columns.is_some() || self.max_paths.is_some()) {
            return Err(usage_error(
                "--columns and --max-paths apply to vector tiles only",
                "Add `--content vector`, or omit them",
            ));
        }
        Ok(())
    }

    /// All files that the command reads.
    pub(super) fn files(&self) -> impl Iterator<Item = &Path> {
        self.inputs.iter().map(|input| input.path.as_path())
    }

    /// The options of the scene.
    ///
    /// # Errors
    /// When options of style contradict each other.
    pub(super) fn scene(&self) -> Result<SceneOptions, UserError> {
        let style = self.style.style()?;
        let column = self.style.color_by.clone();
        Ok(SceneOptions {
            color: self.style.path_color,
            color_by: column.map(|column| ColorBy { column }),
            numbers: self.style.numbers(style.background),
            level: self.level.clone(),
            has_common_colors: false,
            has_gray_structure: true,
        })
    }

    /// The content of vector tiles.
    pub(super) fn vector(&self) -> VectorOptions {
        let default = VectorOptions::default();
        VectorOptions {
            columns: self.columns.clone(),
            max_paths: self.max_paths.unwrap_or(default.max_paths),
        }
    }

    /// The memory of the render method.
    pub(super) fn budget(&self) -> Budget {
        let default = Budget::default();
        Budget {
            memory_bytes: self
                .memory
                .map_or(default.memory_bytes, |mb| mb.saturating_mul(1_000_000)),
            ..default
        }
    }
}

/// A range of zooms such as `0-10`, or one zoom.
fn zooms(text: &str) -> Result<RangeInclusive<u8>, String> {
    let (first, last) = text.split_once('-').unwrap_or((text, text));
    let zoom = |text: &str| {
        text.trim()
            .parse()
            .ok()
            .filter(|&zoom: &u8| zoom <= MAX_ZOOM)
    };
    match (zoom(first), zoom(last)) {
        (Some(first), Some(last)) if first <= last => Ok(first..=last),
        _ => Err(format!(
            "write the first and the last zoom, from 0 to {MAX_ZOOM}, such as 0-10"
        )),
    }
}
