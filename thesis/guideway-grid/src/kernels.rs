//! The compiled shaders of one variant, with its options as pipeline constants.

use crate::options::{Antialias, GridOptions, PrefixSum};
use crate::params::{
    ADD_SUMS, BIN, COUNT, HALF_EDGE_PX, PIXELS_NEAREST, PIXELS_SAMPLES, PREFIX_NAIVE, SAMPLE,
    SCAN_BLOCKS, SCAN_SUMS, SCAN_THREADS, TILE_PX, WORKGROUP,
};
use crate::picture_buffers::Purpose;
use guideway_gpu::device::{DeviceError, Gpu, Kernel};

/// All shaders of a variant.
pub(super) struct Kernels {
    pub(super) sample: Kernel,
    pub(super) count: Kernel,
    pub(super) prefix: Prefix,
    pub(super) bin: Kernel,
    pixels: Kernel,
    /// Like `pixels`, and counts the work.
    pixels_with_counts: Kernel,
}

/// Shaders of the prefix sum.
pub(super) enum Prefix {
    Naive(Kernel),
    Scan {
        blocks: Kernel,
        sums: Kernel,
        add: Kernel,
    },
}

impl Kernels {
    /// Compiles all shaders.
    ///
    /// # Errors
    /// When the device rejects a shader.
    pub(super) fn new(gpu: &Gpu, options: &GridOptions) -> Result<Self, DeviceError> {
        let threads = ("WORKGROUP", f64::from(WORKGROUP));
        let scan_threads = [("SCAN_THREADS", f64::from(SCAN_THREADS))];
        let cells = ("CELLS", f64::from(options.cells));
        let lines = ("LINES", f64::from(options.lines_per_segment()));
        let prefix = match options.prefix_sum {
            PrefixSum::Naive => Prefix::Naive(Kernel::new(gpu, &PREFIX_NAIVE, &[threads])?),
            PrefixSum::Scan => Prefix::Scan {
                blocks: Kernel::new(gpu, &SCAN_BLOCKS, &scan_threads)?,
                sums: Kernel::new(gpu, &SCAN_SUMS, &scan_threads)?,
                add: Kernel::new(gpu, &ADD_SUMS, &scan_threads)?,
            },
        };
        Ok(Self {
            sample: Kernel::new(gpu, &SAMPLE, &[threads, lines])?,
            count: Kernel::new(gpu, &COUNT, &[threads, cells])?,
            prefix,
            bin: Kernel::new(gpu, &BIN, &[threads, cells])?,
            pixels: pixels(gpu, options, false)?,
            pixels_with_counts: pixels(gpu, options, true)?,
        })
    }
}

impl Kernels {
    /// The shader that computes a result of pixels.
    pub(super) fn for_result(&self, purpose: Purpose) -> &Kernel {
        match purpose {
            Purpose::Picture => &self.pixels,
            Purpose::Work => &self.pixels_with_counts,
        }
    }
}

fn pixels(gpu: &Gpu, options: &GridOptions, counts: bool) -> Result<Kernel, DeviceError> {
    let flag = |is_set: bool| f64::from(u8::from(is_set));
    let mut constants = vec![
        ("CELLS", f64::from(options.cells)),
        ("TILE_PX", f64::from(TILE_PX)),
        ("EARLY_EXIT", flag(options.early_exit)),
        ("COUNT", flag(counts)),
    ];
    let source = match options.antialias {
        Antialias::Subpixel => &PIXELS_SAMPLES,
        Antialias::Smooth | Antialias::None => {
            let is_smooth = options.antialias == Antialias::Smooth;
            constants.push(("SMOOTH", flag(is_smooth)));
            constants.push(("HALF_EDGE_PX", f64::from(HALF_EDGE_PX)));
            &PIXELS_NEAREST
        }
    };
    Kernel::new(gpu, source, &constants)
}
