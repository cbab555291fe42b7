//! Methods on graphics devices to test, with the limits of their differences from the oracle.

use std::fmt::Display;
use std::sync::{Arc, LazyLock};

use guideway_gpu::{DeviceError, Gpu, Tiles, TilesOptions};
use guideway_grid::{Grid, GridError, GridOptions};
use guideway_scene::Method;
use guideway_tessellation::{GlDevice, GlError};
use guideway_tree::{Structure, TreeError, TreeOptions, Trees};

use crate::BoxError;
use crate::compare::Tolerance;

/// A method on a device to compare with the oracle.
pub struct DeviceCandidate {
    /// Name of the method and its variant.
    pub name: String,
    /// The method.
    pub method: Box<dyn Method>,
    /// Limit of its difference from the oracle.
    pub tolerance: Tolerance,
    /// The same for paths of several colors.
    pub color_tolerance: Tolerance,
    /// Fewest scenes of the suite that it must draw.
    pub least_scenes: usize,
    /// Number of this variant among those of its method that take turns, and how many do.
    turn: (usize, usize),
}

impl DeviceCandidate {
    /// Returns `true` if the variant draws the scene of this number. The variants of a method take
    /// turns on a software device, where each of them would take minutes.
    pub fn draws(&self, scene: usize) -> bool {
        scene % self.turn.1 == self.turn.0
    }
}

/// For `grid` with coverage by the distance to the nearest line. Pictures of edges only and of
/// crowds differ most (measured over the scene suite):
///
/// - An edge is a smoothstep over 1.5 px instead of the covered area, which changes adjacent pixels
///   by up to 40 levels; in a picture three pixels high, nearly all are adjacent (mean 10, 91 %
///   within 32, 90 at most).
/// - Only the nearest line of a pixel counts, not the union: 144 levels with 200 adjacent lines of
///   0.004 px.
pub const SMOOTH_EDGES: Tolerance = Tolerance {
    mean: 11.0,
    within: (32.0, 0.90),
    max: 160.0,
};

/// As [`SMOOTH_EDGES`], with the 10 samples per segment of the thesis: the chords of a segment as
/// large as the picture are up to two pixels off the curve (measured: 211 levels).
pub const TEN_SAMPLES: Tolerance = Tolerance {
    max: 225.0,
    ..SMOOTH_EDGES
};

/// For `grid` with 32 samples per pixel instead of the oracle's 256. Measured: up to 38 levels on a
/// line of half a pixel, and a mean of 3 in pictures of thin lines.
pub const SUB_SAMPLES: Tolerance = Tolerance {
    mean: 3.5,
    within: (32.0, 0.999),
    max: 48.0,
};

/// As [`SUB_SAMPLES`], for paths of several colors: which of many thin layers shows at 32 points is
/// not what shows at 256. Measured: a mean of 6.1 and up to 61 levels on colored hairlines.
pub const COLORED_SUB_SAMPLES: Tolerance = Tolerance {
    mean: 6.5,
    within: (32.0, 0.99),
    max: 64.0,
};

/// The tested variants of `grid`; the one of the thesis loses coverage between cells and is not
/// among them.
const GRIDS: [(&str, Tolerance); 3] = [
    ("scan+radius", TEN_SAMPLES),
    ("scan+radius+exit+samples=64", SMOOTH_EDGES),
    ("scan+radius+aa=subpixel+samples=64", SUB_SAMPLES),
];

/// The tested variants of `tree` and `quadtree`, with the limits of `grid`. The tests of
/// `guideway-tree` compare the other ones with these. In this order, the costliest scene,
/// `crowds/long-curves-large`, is the turn of a cheap variant.
const TREES: [(Structure, &str, Tolerance); 4] = [
    (Structure::Tree, "", TEN_SAMPLES),
    (Structure::Quadtree, "tiles+exit+samples=64", SMOOTH_EDGES),
    (
        Structure::Tree,
        "tiles+exit+aa=subpixel+samples=64",
        SUB_SAMPLES,
    ),
    (
        Structure::Quadtree,
        "exit+aa=subpixel+samples=64",
        SUB_SAMPLES,
    ),
];

/// The device of [`guideway_gpu`].
///
/// # Errors
/// When the computer has no such device.
pub fn gpu() -> Result<Arc<Gpu>, DeviceError> {
    static GPU: LazyLock<Result<Arc<Gpu>, DeviceError>> = LazyLock::new(Gpu::new);
    GPU.clone()
}

/// The device of [`guideway_tessellation`].
///
/// # Errors
/// When the computer has no such device.
pub fn gl() -> Result<Arc<GlDevice>, GlError> {
    static GL: LazyLock<Result<Arc<GlDevice>, GlError>> = LazyLock::new(GlDevice::new);
    GL.clone()
}

/// A variant of `grid`.
///
/// # Errors
/// When the computer has no suitable device.
///
/// # Panics
/// When the variant is unknown.
pub fn grid(variant: &str) -> Result<Grid, GridError> {
    let options = GridOptions::parse(variant).expect("a known variant");
    Grid::new(gpu()?, options)
}

/// A variant of `tree` or `quadtree`.
///
/// # Errors
/// When the computer has no suitable device.
///
/// # Panics
/// When the variant is unknown.
pub fn tree(structure: Structure, variant: &str) -> Result<Trees, TreeError> {
    let options = TreeOptions::parse(variant).expect("a known variant");
    Trees::new(gpu()?, structure, options)
}

/// Method `gpu`.
///
/// # Errors
/// When the computer has no suitable device.
pub fn tiles() -> Result<Tiles, DeviceError> {
    Tiles::new(gpu()?, TilesOptions::default())
}

/// Every candidate, or the reason why it cannot run.
fn all() -> Vec<Result<DeviceCandidate, BoxError>> {
    let grids = GRIDS
        .iter()
        .enumerate()
        .map(|(number, &(variant, tolerance))| {
            let name = format!("grid {variant}");
            let method = Box::new(grid(variant)?);
            let tolerances = [tolerance; 2];
            Ok(variant_candidate(
                name,
                method,
                tolerances,
                (number, GRIDS.len()),
            ))
        });
    let trees = TREES
        .iter()
        .enumerate()
        .map(|(number, &(structure, variant, tolerance))| {
            let name = format!("{} {variant}", structure.name());
            let method = Box::new(tree(structure, variant)?);
            let tolerances = [tolerance, COLORED_SUB_SAMPLES];
            let turn = (number, TREES.len());
            Ok(variant_candidate(name, method, tolerances, turn))
        });
    let tiles = tiles().map(|tiles| DeviceCandidate {
        name: "gpu".to_owned(),
        method: Box::new(tiles),
        tolerance: Tolerance::STANDARD,
        color_tolerance: Tolerance::STANDARD,
        least_scenes: 230,
        turn: (0, 1),
    });
    let tiles = tiles.map_err(BoxError::from);
    grids.chain(trees).chain([tiles]).collect()
}

/// A variant of a method with per-pixel tests, with its turn on a software device.
fn variant_candidate(
    name: String,
    method: Box<dyn Method>,
    [tolerance, color_tolerance]: [Tolerance; 2],
    turn: (usize, usize),
) -> DeviceCandidate {
    let takes_turns = gpu().is_ok_and(|gpu| gpu.is_software());
    let turn = if takes_turns { turn } else { (0, 1) };
    DeviceCandidate {
        name,
        method,
        tolerance,
        color_tolerance,
        least_scenes: 140 / turn.1,
        turn,
    }
}

/// The candidates that can run on this computer.
pub fn candidates() -> Vec<DeviceCandidate> {
    all().into_iter().filter_map(available_or_skip).collect()
}

/// The value, or `None` with a message for a skipped test when the device is missing.
///
/// # Panics
/// When the device is missing and `GUIDEWAY_REQUIRE_DEVICES` is 1.
pub fn available_or_skip<T>(found: Result<T, impl Display>) -> Option<T> {
    match found {
        Ok(found) => Some(found),
        Err(why) => {
            let is_required = std::env::var("GUIDEWAY_REQUIRE_DEVICES").is_ok_and(|v| v == "1");
            assert!(!is_required, "{why}");
            println!("SKIPPED: {why}");
            None
        }
    }
}
