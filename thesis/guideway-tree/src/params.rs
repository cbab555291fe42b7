//! The interface to the shaders: constants, uniforms, sources and compiled kernels. Tests compare
//! it with the WGSL.

use std::borrow::Cow;
use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use guideway_gpu::device::{DeviceError, Gpu, Kernel, Source};
use guideway_grid::Antialias;
use guideway_grid::per_pixel::{
    ADD_SUMS, BLEND, CURVE, HALF_EDGE_PX, LINE, NEAREST, Purpose, SAMPLES, SCAN_BLOCKS, SCAN_SUMS,
    SCAN_THREADS, TILE_PX,
};

use crate::options::{Structure, TreeOptions};

/// Threads per workgroup of the shaders that process one leaf per thread.
pub(super) const WORKGROUP: u32 = 64;
/// Keys per block of the sort.
pub(super) const SORT_THREADS: u32 = 256;
/// Bits of a digit of the sort.
pub(super) const DIGIT_BITS: u32 = 4;
/// Digits of a key.
pub(super) const KEY_DIGITS: u32 = u32::BITS / DIGIT_BITS;
/// Nodes per thread of the measurement of quality.
pub(super) const NODES_PER_THREAD: u32 = 16;
/// Deepest level of the quadtree: `key_of` in `leaf.wgsl` derives it.
pub(super) const MAX_LEVEL: u32 = 14;
/// Words of the counters: whether a walk is to be resumed, and segments per level.
pub(super) const COUNTERS: u64 = 1 + MAX_LEVEL as u64 + 1;
/// Samples per pixel where paths have several colors.
pub(super) const RANKED_SAMPLES: u64 = 32;

/// `Build` of `build.wgsl`.
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct BuildParams {
    pub(super) origin_m: [f32; 2],
    pub(super) side_m: f32,
    pub(super) leaves: u32,
    pub(super) max_level: u32,
    pub(super) measures_depth: u32,
}

/// `Digit` of `sort.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct DigitParams {
    pub(super) keys: u32,
    pub(super) shift: u32,
    pub(super) blocks: u32,
}

/// `View` of `query.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(super) struct ViewParams {
    pub(super) center_m: [f32; 2],
    pub(super) half_size_px: [f32; 2],
    pub(super) origin_m: [f32; 2],
    pub(super) side_m: f32,
    pub(super) reach_m: f32,
    pub(super) m_per_px: f32,
    pub(super) px_per_m: f32,
    pub(super) radius_m: f32,
    pub(super) color: u32,
    pub(super) background: u32,
    pub(super) width_px: u32,
    pub(super) first_row: u32,
    pub(super) rows: u32,
    pub(super) first_tile: u32,
    pub(super) end_tile: u32,
    pub(super) leaves: u32,
    pub(super) limit: u32,
    pub(super) max_level: u32,
    pub(super) is_first_chunk: u32,
    pub(super) is_last_chunk: u32,
    pub(super) is_start: u32,
}

macro_rules! wgsl {
    ($file:literal) => {
        include_str!(concat!("shaders/", $file, ".wgsl"))
    };
}

/// Shader text: the uniform of the shaders that build.
const BUILD: &str = "
struct Build {
    // Lower left corner and side of the root.
    origin_m: vec2f,
    side_m: f32,
    leaves: u32,
    max_level: u32,
    // Quality: also measures the depth.
    measures_depth: u32,
}
@group(0) @binding(0) var<uniform> build: Build;
";

fn source(name: &'static str, parts: &[&str], bindings: &'static [&'static str]) -> Source {
    Source {
        name,
        wgsl: Cow::Owned(parts.concat()),
        bindings,
    }
}

fn keys() -> Source {
    let bindings = &[
        "build", "points_m", "segments", "keys", "order", "boxes", "counters",
    ];
    let parts = [BUILD, CURVE, wgsl!("leaf"), wgsl!("keys")];
    source("keys", &parts, bindings)
}

fn sort() -> Source {
    let bindings = &[
        "digit",
        "keys",
        "order",
        "blocks",
        "sorted_keys",
        "sorted_order",
    ];
    source("sort", &[wgsl!("sort")], bindings)
}

fn emit() -> Source {
    let bindings = &["build", "keys", "children", "parents", "ends"];
    source("emit", &[BUILD, wgsl!("emit")], bindings)
}

fn fit() -> Source {
    let bindings = &[
        "build",
        "points_m",
        "segments",
        "order",
        "parents",
        "boxes",
        "top_ranks",
    ];
    let parts = [BUILD, CURVE, wgsl!("leaf"), wgsl!("fit")];
    source("fit", &parts, bindings)
}

fn quality() -> Source {
    let bindings = &["build", "parents", "boxes", "sums"];
    source("quality", &[BUILD, wgsl!("quality")], bindings)
}

/// The shader of pixels of a variant.
fn pixels(structure: Structure, options: &TreeOptions) -> Source {
    let (walk, bindings): (_, &[_]) = match structure {
        Structure::Tree => (
            wgsl!("walk_tree"),
            &[
                "view",
                "points_m",
                "segments",
                "order",
                "boxes",
                "colors",
                "pixels",
                "progress",
                "counters",
                "children",
                "top_ranks",
            ],
        ),
        Structure::Quadtree => (
            wgsl!("walk_quadtree"),
            &[
                "view", "points_m", "segments", "order", "boxes", "colors", "pixels", "progress",
                "counters", "keys",
            ],
        ),
    };
    let form = if options.tiles {
        wgsl!("one_tile")
    } else {
        wgsl!("one_pixel")
    };
    let cover = match options.antialias {
        Antialias::Subpixel => SAMPLES,
        Antialias::Smooth | Antialias::None => NEAREST,
    };
    let parts = [
        wgsl!("query"),
        wgsl!("state"),
        CURVE,
        wgsl!("leaf"),
        LINE,
        cover,
        BLEND,
        walk,
        form,
    ];
    source("pixels", &parts, bindings)
}

/// The device, options and shaders that all scenes of one variant share.
pub(super) struct Variant {
    pub(super) gpu: Arc<Gpu>,
    pub(super) structure: Structure,
    pub(super) options: TreeOptions,
    pub(super) kernels: Kernels,
}

/// All shaders of a variant.
pub(super) struct Kernels {
    pub(super) keys: Kernel,
    pub(super) count_digits: Kernel,
    pub(super) move_keys: Kernel,
    /// Scan of blocks, of their sums, and the addition of the sums.
    pub(super) scan: [Kernel; 3],
    pub(super) tree: Option<TreeKernels>,
    /// For one color and for several, drawing and counting.
    pixels: Vec<Kernel>,
}

/// Shaders of the tree.
pub(super) struct TreeKernels {
    pub(super) emit: Kernel,
    /// For one color and for several.
    pub(super) fit: [Kernel; 2],
    pub(super) quality: Kernel,
}

impl Kernels {
    /// Compiles all shaders.
    ///
    /// # Errors
    /// When the device rejects a shader.
    pub(super) fn new(
        gpu: &Gpu,
        structure: Structure,
        options: &TreeOptions,
    ) -> Result<Self, DeviceError> {
        let flag = |is_set: bool| f64::from(u8::from(is_set));
        let threads = ("WORKGROUP", f64::from(WORKGROUP));
        let sort_threads = ("SORT_THREADS", f64::from(SORT_THREADS));
        let scan_threads = [("SCAN_THREADS", f64::from(SCAN_THREADS))];
        let lines = ("LINES", f64::from(options.lines_per_segment()));
        let is_quadtree = ("QUADTREE", flag(structure == Structure::Quadtree));
        let fit_for =
            |ranked| Kernel::new(gpu, &fit(), &[threads, lines, ("RANKED", flag(ranked))]);
        let tree = match structure {
            Structure::Quadtree => None,
            Structure::Tree => Some(TreeKernels {
                emit: Kernel::new(gpu, &emit(), &[threads])?,
                fit: [fit_for(false)?, fit_for(true)?],
                quality: Kernel::new(
                    gpu,
                    &quality(),
                    &[threads, ("NODES", f64::from(NODES_PER_THREAD))],
                )?,
            }),
        };
        let can_rank = options.antialias == Antialias::Subpixel;
        let mut kernels = Vec::new();
        for (ranked, counts) in [(false, false), (false, true), (true, false), (true, true)] {
            if ranked && !can_rank {
                continue;
            }
            let mut constants = vec![
                lines,
                ("TILE_PX", f64::from(TILE_PX)),
                ("EXIT", flag(options.early_exit)),
                ("COUNT", flag(counts)),
                ("RANKED", flag(ranked)),
            ];
            if !can_rank {
                constants.push(("SMOOTH", flag(options.antialias == Antialias::Smooth)));
                constants.push(("HALF_EDGE_PX", f64::from(HALF_EDGE_PX)));
            }
            kernels.push(Kernel::new(gpu, &pixels(structure, options), &constants)?);
        }
        Ok(Self {
            keys: Kernel::new(gpu, &keys(), &[threads, lines, is_quadtree])?,
            count_digits: Kernel::new(gpu, &sort(), &[sort_threads, ("MOVES", 0.0)])?,
            move_keys: Kernel::new(gpu, &sort(), &[sort_threads, ("MOVES", 1.0)])?,
            scan: [
                Kernel::new(gpu, &SCAN_BLOCKS, &scan_threads)?,
                Kernel::new(gpu, &SCAN_SUMS, &scan_threads)?,
                Kernel::new(gpu, &ADD_SUMS, &scan_threads)?,
            ],
            tree,
            pixels: kernels,
        })
    }

    /// The shader of pixels; `None` for several colors without samples.
    pub(super) fn pixels(&self, is_ranked: bool, purpose: Purpose) -> Option<&Kernel> {
        let counts = usize::from(purpose == Purpose::Work);
        self.pixels.get(2 * usize::from(is_ranked) + counts)
    }
}

#[cfg(test)]
mod tests {
    use guideway_gpu::testing::reflection::{assert_bindings, assert_layout, members};

    use super::*;

    #[test]
    fn shaders_match_the_rust_layouts() {
        let mut sources = vec![keys(), sort(), emit(), fit(), quality()];
        for structure in [Structure::Tree, Structure::Quadtree] {
            for words in ["", "tiles", "aa=subpixel", "tiles+aa=subpixel"] {
                sources.push(pixels(structure, &TreeOptions::parse(words).unwrap()));
            }
        }
        sources.iter().for_each(assert_bindings);
        let sources: Vec<_> = sources.iter().collect();
        let build = members!(BuildParams: origin_m, side_m, leaves, max_level, measures_depth);
        assert_layout(&sources, "Build", &build);
        assert_layout(
            &sources,
            "Digit",
            &members!(DigitParams: keys, shift, blocks),
        );
        let view = members!(ViewParams: center_m, half_size_px, origin_m, side_m, reach_m,
            m_per_px, px_per_m, radius_m, color, background, width_px, first_row, rows,
            first_tile, end_tile, leaves, limit, max_level, is_first_chunk, is_last_chunk,
            is_start);
        assert_layout(&sources, "View", &view);
    }
}
