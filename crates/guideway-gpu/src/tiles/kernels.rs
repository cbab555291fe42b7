//! Compiles the kernels of a frame.

use super::constants::{
    CLUSTER_STROKES, CLUSTER_THREADS, COUNTED_LINES_EACH, FIRST_COLUMNS, LINE_THREADS,
    LIST_THREADS, MAX_PARTS_LOG2, SAMPLE_ROWS, Samples, TARGET_LISTS, TARGET_WORKGROUPS, TILE_PX,
    TILE_THREADS,
};
use super::layouts::PointFormat;
use super::list_limits::unsplit_limits;
use super::shaders::{self, SortedLists, Team};
use crate::device::{DeviceError, Gpu, Kernel, Source, patch_kernel};

/// All kernels of the method.
#[derive(Clone)]
pub(crate) struct Kernels {
    pub(crate) cull: Kernel,
    pub(crate) invalidate_lines: Kernel,
    /// For many and for few visible clusters, each by [`PointFormat`].
    pub(crate) flatten: [[Kernel; 2]; 2],
    pub(crate) count_cached: Kernel,
    pub(crate) bin_cached: Kernel,
    pub(crate) tile_offsets: Kernel,
    pub(crate) split_tiles: Kernel,
    pub(crate) bin_lines: Kernel,
    /// For short lists and for all others.
    pub(crate) sort_lists: [Kernel; 2],
    pub(crate) scroll: Kernel,
    /// Takes changes of a scene to their places.
    pub(crate) patch: Kernel,
    /// By [`Samples`].
    tile_kernels: [TileKernels; 2],
}

/// Kernels that draw tiles.
#[derive(Clone)]
pub(crate) struct TileKernels {
    pub(crate) cover: Kernel,
    /// Covers list parts, and resolves split tiles. `None` on devices with too few bindings.
    pub(crate) cover_split: Option<[Kernel; 2]>,
    pub(crate) opaque: Kernel,
    pub(crate) translucent: Kernel,
    pub(crate) density: Kernel,
}

impl Kernels {
    pub(crate) fn new(gpu: &Gpu) -> Result<Self, DeviceError> {
        let tile_px = constant("TILE_PX", TILE_PX);
        let threads = constant("THREADS", CLUSTER_THREADS);
        let [
            cull,
            count_cached,
            bin_cached,
            tile_offsets,
            split_tiles,
            bin_lines,
        ] = bin_kernels(gpu, &[])?;
        Ok(Self {
            cull,
            invalidate_lines: Kernel::new(
                gpu,
                &shaders::INVALIDATE_LINES.source(),
                &[tile_px, threads],
            )?,
            flatten: flatten(gpu, &[])?,
            count_cached,
            bin_cached,
            tile_offsets,
            split_tiles,
            bin_lines,
            sort_lists: sort_lists(gpu, &[])?,
            scroll: Kernel::new(gpu, &shaders::SCROLL.source(), &[threads])?,
            patch: patch_kernel(gpu)?,
            tile_kernels: [
                TileKernels::new(gpu, Samples::Coarse)?,
                TileKernels::new(gpu, Samples::Fine)?,
            ],
        })
    }

    /// The kernel that writes a picture to a texture.
    pub(crate) fn presenting(gpu: &Gpu) -> Result<Kernel, DeviceError> {
        let threads = constant("THREADS", CLUSTER_THREADS);
        Kernel::new(gpu, &shaders::PRESENT.source(), &[threads])
    }

    /// The same kernels for gestures that turn, mirror or scale paths.
    pub(crate) fn mapping(&self, gpu: &Gpu) -> Result<Self, DeviceError> {
        Ok(Self {
            flatten: flatten(gpu, &[MAPS])?,
            ..self.clone()
        })
    }

    /// The same kernels, but those of a frame of colors count their work.
    pub(crate) fn counting(&self, gpu: &Gpu) -> Result<Self, DeviceError> {
        let counts = [("COUNTS", 1.0)];
        let mut all = self.clone();
        [
            all.cull,
            all.count_cached,
            all.bin_cached,
            all.tile_offsets,
            all.split_tiles,
            all.bin_lines,
        ] = bin_kernels(gpu, &counts)?;
        all.flatten = flatten(gpu, &[counts[0], MAPS])?;
        all.sort_lists = sort_lists(gpu, &counts)?;
        for samples in [Samples::Coarse, Samples::Fine] {
            let kernels = &mut all.tile_kernels[samples as usize];
            (kernels.cover, kernels.cover_split) = cover(gpu, samples, &counts)?;
            kernels.opaque = opaque(gpu, samples, &counts)?;
            kernels.translucent = layers(gpu, samples, false, &counts)?;
        }
        Ok(all)
    }

    pub(crate) fn of_tiles(&self, samples: Samples) -> &TileKernels {
        &self.tile_kernels[samples as usize]
    }
}

impl TileKernels {
    fn new(gpu: &Gpu, samples: Samples) -> Result<Self, DeviceError> {
        let (cover, cover_split) = cover(gpu, samples, &[])?;
        Ok(Self {
            cover,
            cover_split,
            opaque: opaque(gpu, samples, &[])?,
            translucent: layers(gpu, samples, false, &[])?,
            density: layers(gpu, samples, true, &[])?,
        })
    }
}

type Constant = (&'static str, f64);

/// Override of kernels that map the points of a gesture.
const MAPS: Constant = ("MAPS", 1.0);

/// Overrides of all kernels that draw tiles, but for the number of threads.
const TILE_CONSTANTS: [Constant; 3] = [
    constant("TILE_PX", TILE_PX),
    constant("SAMPLE_ROWS", SAMPLE_ROWS),
    constant("FIRST_COLUMNS", FIRST_COLUMNS),
];

/// Flatten kernels for many and for few clusters, each by [`PointFormat`].
fn flatten(gpu: &Gpu, more: &[Constant]) -> Result<[[Kernel; 2]; 2], DeviceError> {
    let kernel = |format, max_parts_log2| {
        let own = [
            constant("TILE_PX", TILE_PX),
            constant("THREADS", CLUSTER_STROKES),
            constant("TARGET_WORKGROUPS", TARGET_WORKGROUPS),
            constant("MAX_PARTS_LOG2", max_parts_log2),
        ];
        Kernel::new(gpu, &shaders::flatten(format), &[&own, more].concat())
    };
    let both = |max_parts_log2| {
        Ok::<_, DeviceError>([
            kernel(PointFormat::Rounded, max_parts_log2)?,
            kernel(PointFormat::Exact, max_parts_log2)?,
        ])
    };
    Ok([both(0)?, both(MAX_PARTS_LOG2)?])
}

/// Kernels cull, count_cached, bin_cached, tile_offsets, split_tiles and bin_lines.
fn bin_kernels(gpu: &Gpu, more: &[Constant]) -> Result<[Kernel; 6], DeviceError> {
    let kernel = |source: Source, own: &[Constant]| {
        let tile_px = constant("TILE_PX", TILE_PX);
        Kernel::new(gpu, &source, &[&[tile_px], own, more].concat())
    };
    let line_threads = constant("THREADS", LINE_THREADS);
    let list_threads = constant("THREADS", LIST_THREADS);
    let [min_unsplit, max_unsplit] = unsplit_limits(gpu);
    let split = [
        list_threads,
        constant("TARGET_LISTS", TARGET_LISTS),
        constant("MIN_UNSPLIT", min_unsplit),
        constant("MAX_UNSPLIT", max_unsplit),
    ];
    let counted = [line_threads, constant("LINES_EACH", COUNTED_LINES_EACH)];
    Ok([
        kernel(
            shaders::CULL.source(),
            &[constant("THREADS", CLUSTER_THREADS)],
        )?,
        kernel(shaders::COUNT_CACHED.source(), &counted)?,
        kernel(shaders::BIN_CACHED.source(), &[line_threads])?,
        kernel(shaders::TILE_OFFSETS.source(), &[list_threads])?,
        kernel(shaders::SPLIT_TILES.source(), &split)?,
        kernel(shaders::BIN_LINES.source(), &[line_threads])?,
    ])
}

/// Kernels for tiles of one opaque color: one workgroup per tile, and several per split tile.
fn cover(
    gpu: &Gpu,
    samples: Samples,
    more: &[Constant],
) -> Result<(Kernel, Option<[Kernel; 2]>), DeviceError> {
    let mut constants = [&TILE_CONSTANTS[..], more].concat();
    constants.push(constant("THREADS", samples.cover_threads()));
    let team = match gpu.max_subgroup_size() {
        Some(lanes) => {
            constants.push(constant("MAX_LANES", lanes));
            Team::Subgroup
        }
        None => Team::Workgroup,
    };
    let whole = Kernel::new(gpu, &shaders::cover_tiles(samples, team), &constants)?;
    let source = shaders::cover_split_tiles(samples, team);
    // All bindings but the frame are storage buffers.
    if (gpu.max_storage_bindings() as usize) < source.bindings.len() - 1 {
        return Ok((whole, None));
    }
    let split = |resolves| {
        let resolves = [("RESOLVES", resolves)];
        Kernel::new(gpu, &source, &[&constants[..], &resolves].concat())
    };
    Ok((whole, Some([split(0.0)?, split(1.0)?])))
}

/// Kernels that sort short lists, and all others.
fn sort_lists(gpu: &Gpu, more: &[Constant]) -> Result<[Kernel; 2], DeviceError> {
    let own = [
        constant("TILE_PX", TILE_PX),
        constant("THREADS", TILE_THREADS),
    ];
    let kernel = |lists| Kernel::new(gpu, &shaders::sort_lists(lists), &[&own, more].concat());
    Ok([kernel(SortedLists::Short)?, kernel(SortedLists::Long)?])
}

/// The kernel for tiles of opaque paths in many colors.
fn opaque(gpu: &Gpu, samples: Samples, more: &[Constant]) -> Result<Kernel, DeviceError> {
    // Measured on an H200 with D1 in many colors and 256 samples per pixel: subgroups take 1.27 to
    // 1.29 ms, workgroups 1.18 ms.
    let lanes = gpu.max_subgroup_size();
    match lanes.filter(|_| samples == Samples::Coarse) {
        Some(lanes) => {
            let own = [constant("MAX_LANES", lanes)];
            let source = shaders::opaque(samples, Team::Subgroup);
            composite(gpu, &source, &[&own, more].concat())
        }
        None => composite(gpu, &shaders::opaque(samples, Team::Workgroup), more),
    }
}

/// The kernel for tiles of translucent paths, or for density.
fn layers(
    gpu: &Gpu,
    samples: Samples,
    is_density: bool,
    more: &[Constant],
) -> Result<Kernel, DeviceError> {
    let own = [("IS_DENSITY", f64::from(u8::from(is_density)))];
    composite(gpu, &shaders::layers(samples), &[&own[..], more].concat())
}

/// A kernel with one thread per sample row of a tile.
fn composite(gpu: &Gpu, source: &Source, more: &[Constant]) -> Result<Kernel, DeviceError> {
    let threads = constant("THREADS", TILE_THREADS);
    Kernel::new(
        gpu,
        source,
        &[&TILE_CONSTANTS[..], &[threads], more].concat(),
    )
}

const fn constant(name: &'static str, value: u32) -> Constant {
    (name, value as f64)
}
