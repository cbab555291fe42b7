//! The shaders of a frame, compiled.

use super::params::{
    CLUSTER_STROKES, COLUMNS, COVER, CULL, FLATTEN, IDS, LAYERS, Layers, SAMPLE_ROWS, SCATTER,
    SCATTER_THREADS, SHIFT, SORT, STARTS, STARTS_THREADS, Samples, TILE_PX, TILE_THREADS, TOUCH,
    WORKGROUP,
};
use crate::device::{Gpu, Kernel};

pub(super) struct Kernels {
    pub(super) cull: Kernel,
    pub(super) flatten: Kernel,
    pub(super) starts: Kernel,
    pub(super) scatter: Kernel,
    /// Of short lists, and of all others.
    pub(super) sort: [Kernel; 2],
    pub(super) shift: Kernel,
    pub(super) touch: Kernel,
    /// Coarse and fine.
    painters: [Painters; 2],
}

/// Kernels that paint tiles, by so many samples a pixel.
pub(super) struct Painters {
    pub(super) cover: Kernel,
    pub(super) opaque: Kernel,
    pub(super) translucent: Kernel,
    pub(super) density: Kernel,
    pub(super) ids: Kernel,
}

impl Kernels {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, String> {
        Self::with(gpu, &[])
    }

    /// Those of a frame of one opaque colour count what they do.
    pub(super) fn counting(gpu: &Gpu) -> Result<Self, String> {
        Self::with(gpu, &[("COUNTS", 1.0)])
    }

    /// With constants for all kernels that may count.
    fn with(gpu: &Gpu, counts: &[(&'static str, f64)]) -> Result<Self, String> {
        let kernel =
            |source, constants: &[_]| Kernel::new(gpu, source, &[constants, counts].concat());
        let tile = constant("TILE_PX", TILE_PX);
        let workgroup = constant("WORKGROUP", WORKGROUP);
        let strokes = constant("STROKES", CLUSTER_STROKES);
        let starts_threads = constant("THREADS", STARTS_THREADS);
        let tile_threads = constant("THREADS", TILE_THREADS);
        Ok(Self {
            cull: kernel(&CULL, &[tile, workgroup])?,
            flatten: kernel(&FLATTEN, &[tile, strokes])?,
            starts: kernel(&STARTS, &[tile, starts_threads])?,
            scatter: kernel(&SCATTER, &[tile, constant("THREADS", SCATTER_THREADS)])?,
            sort: [
                Kernel::new(gpu, &SORT[0], &[tile, tile_threads])?,
                Kernel::new(gpu, &SORT[1], &[tile, tile_threads])?,
            ],
            shift: Kernel::new(gpu, &SHIFT, &[constant("THREADS", WORKGROUP)])?,
            touch: Kernel::new(gpu, &TOUCH, &[tile, workgroup])?,
            painters: [
                Painters::new(gpu, Samples::Coarse, counts)?,
                Painters::new(gpu, Samples::Fine, counts)?,
            ],
        })
    }

    pub(super) fn painters(&self, samples: Samples) -> &Painters {
        &self.painters[samples as usize]
    }
}

impl Painters {
    fn new(gpu: &Gpu, samples: Samples, counts: &[(&'static str, f64)]) -> Result<Self, String> {
        let cover = vec![
            constant("TILE_PX", TILE_PX),
            constant("THREADS", TILE_THREADS),
            constant("SAMPLE_ROWS", SAMPLE_ROWS),
            constant("COLUMNS", COLUMNS),
        ];
        let layers = |layers: Layers| {
            let mut constants = cover.clone();
            constants.push(constant("SHADING", layers as u32));
            Kernel::new(gpu, &LAYERS[samples as usize], &constants)
        };
        Ok(Self {
            cover: Kernel::new(gpu, &COVER[samples as usize], &[&cover, counts].concat())?,
            opaque: layers(Layers::Opaque)?,
            translucent: layers(Layers::Translucent)?,
            density: layers(Layers::Density)?,
            ids: Kernel::new(gpu, &IDS[samples as usize], &cover)?,
        })
    }
}

fn constant(name: &'static str, value: u32) -> (&'static str, f64) {
    (name, f64::from(value))
}
