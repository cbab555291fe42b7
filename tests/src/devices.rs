//! Methods that need a graphics device, and what they may differ by from the oracle.

use std::fmt::Display;
use std::sync::{Arc, LazyLock};

use guideway_gpu::{DeviceError, Gpu, Tiles, TilesOptions};
use guideway_grid::{Grid, GridError, GridOptions};
use guideway_scene::Method;
use guideway_tessellation::{GlDevice, GlError};

use crate::compare::Tolerance;

/// A method on a device that must agree with the oracle, within its means.
pub struct DeviceCandidate {
    /// Name of the method and its variant.
    pub name: String,
    /// The method.
    pub method: Box<dyn Method>,
    /// How far from the oracle it may be.
    pub tolerance: Tolerance,
    /// Fewest scenes of the suite that it must be able to draw.
    pub least_scenes: usize,
}

/// For `grid` by the distance to the nearest line. The extremes are pictures of edges alone, and crowds.
///
/// - An edge is a smoothstep over 1.5 px instead of the area covered, which changes the pixels beside it by
///   up to 40 levels; in a picture three pixels high nearly all are (mean 10, 91 % within 32, 90 at most).
/// - Of many lines on a pixel only the nearest counts, not their union: 144 levels where 200 lines of
///   0.004 px lie side by side.
pub const SMOOTH_EDGES: Tolerance = Tolerance {
    mean: 11.0,
    within: (32.0, 0.90),
    max: 160.0,
};

/// As [`SMOOTH_EDGES`], and with the thesis' 10 samples a segment: a chord of a curve that fills the picture
/// with one segment is up to a pixel or two beside it, where a pixel can be anything (211 levels).
pub const TEN_SAMPLES: Tolerance = Tolerance {
    max: 225.0,
    ..SMOOTH_EDGES
};

/// For `grid` by 32 samples a pixel instead of the oracle's 256: on a line of half a pixel they are off by
/// up to 38 levels, and by 3 on average where a picture is nothing but thin lines.
pub const SUB_SAMPLES: Tolerance = Tolerance {
    mean: 3.5,
    within: (32.0, 0.999),
    max: 48.0,
};

/// The variants of `grid` under test. That as the thesis writes it is not among them, for it loses coverage
/// between cells.
const GRIDS: [(&str, Tolerance); 3] = [
    ("scan+radius", TEN_SAMPLES),
    ("scan+radius+exit+samples=64", SMOOTH_EDGES),
    ("scan+radius+aa=subpixel+samples=64", SUB_SAMPLES),
];

/// The device of [`guideway_gpu`].
///
/// # Errors
/// What is missing for it.
pub fn gpu() -> Result<Arc<Gpu>, DeviceError> {
    static GPU: LazyLock<Result<Arc<Gpu>, DeviceError>> = LazyLock::new(Gpu::new);
    GPU.clone()
}

/// The device of [`guideway_tessellation`].
///
/// # Errors
/// What is missing for it.
pub fn gl() -> Result<Arc<GlDevice>, GlError> {
    static GL: LazyLock<Result<Arc<GlDevice>, GlError>> = LazyLock::new(GlDevice::new);
    GL.clone()
}

/// A variant of `grid`.
///
/// # Errors
/// When its device is not here.
///
/// # Panics
/// When there is no such variant.
pub fn grid(variant: &str) -> Result<Grid, GridError> {
    let options = GridOptions::parse(variant).expect("the variant is well written");
    Grid::new(gpu()?, options)
}

/// Method `gpu`.
///
/// # Errors
/// When its device is not here.
pub fn tiles() -> Result<Tiles, DeviceError> {
    Tiles::new(gpu()?, TilesOptions::default())
}

/// Every candidate, or what is missing for it.
fn all() -> Vec<Result<DeviceCandidate, String>> {
    let grids = GRIDS.map(|(variant, tolerance)| {
        Ok(DeviceCandidate {
            name: format!("grid {variant}"),
            method: Box::new(grid(variant).map_err(|error| error.to_string())?),
            tolerance,
            least_scenes: 150,
        })
    });
    let mut all: Vec<_> = grids.into();
    let tiles = tiles().map(|tiles| judged_tiles("gpu", tiles));
    all.push(tiles.map_err(|error| error.to_string()));
    all
}

fn judged_tiles(name: &str, tiles: Tiles) -> DeviceCandidate {
    DeviceCandidate {
        name: name.to_owned(),
        method: Box::new(tiles),
        tolerance: Tolerance::STANDARD,
        least_scenes: 230,
    }
}

/// The candidates whose device is here.
pub fn candidates() -> Vec<DeviceCandidate> {
    all().into_iter().filter_map(here).collect()
}

/// Something that needs a device, unless the device is missing: then says so, for a test to be skipped.
///
/// # Panics
/// When the device is missing and `GUIDEWAY_REQUIRE_DEVICES` is 1.
pub fn here<T>(found: Result<T, impl Display>) -> Option<T> {
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
