//! The shaders of a frame, compiled.

use super::params::{
    CLUSTER_STROKES, COLUMNS, COVER, COVER_APART, CULL, ENOUGH_GROUPS, FLATTEN, IDS, LAYERS,
    Layers, SAMPLE_ROWS, SCATTER, SCATTER_THREADS, SHIFT, SORT, STARTS, STARTS_THREADS, Samples,
    TILE_PX, TILE_THREADS, TOUCH, WORKGROUP,
};
use crate::device::{Gpu, Kernel};

#[derive(Clone)]
pub(super) struct Kernels {
    pub(super) cull: Kernel,
    /// For many clusters and for few, by [`super::params::Points`].
    pub(super) flatten: [[Kernel; 2]; 2],
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
#[derive(Clone)]
pub(super) struct Painters {
    pub(super) cover: Kernel,
    pub(super) opaque: Kernel,
    pub(super) translucent: Kernel,
    pub(super) density: Kernel,
    pub(super) ids: Kernel,
}

impl Kernels {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, String> {
        let tile = constant("TILE_PX", TILE_PX);
        let tile_threads = constant("THREADS", TILE_THREADS);
        let [cull, starts, scatter] = stages(gpu, &[])?;
        Ok(Self {
            cull,
            flatten: flatten(gpu, &[])?,
            starts,
            scatter,
            sort: [
                Kernel::new(gpu, &SORT[0], &[tile, tile_threads])?,
                Kernel::new(gpu, &SORT[1], &[tile, tile_threads])?,
            ],
            shift: Kernel::new(gpu, &SHIFT, &[constant("THREADS", WORKGROUP)])?,
            touch: Kernel::new(gpu, &TOUCH, &[tile, constant("WORKGROUP", WORKGROUP)])?,
            painters: [
                Painters::new(gpu, Samples::Coarse)?,
                Painters::new(gpu, Samples::Fine)?,
            ],
        })
    }

    /// The same, but those of a frame of one opaque colour count what they do.
    pub(super) fn counting(&self, gpu: &Gpu) -> Result<Self, String> {
        let counts = [("COUNTS", 1.0)];
        let mut all = self.clone();
        [all.cull, all.starts, all.scatter] = stages(gpu, &counts)?;
        all.flatten = flatten(gpu, &counts)?;
        for samples in [Samples::Coarse, Samples::Fine] {
            all.painters[samples as usize].cover = cover(gpu, samples, &counts)?;
        }
        Ok(all)
    }

    pub(super) fn painters(&self, samples: Samples) -> &Painters {
        &self.painters[samples as usize]
    }
}

impl Painters {
    fn new(gpu: &Gpu, samples: Samples) -> Result<Self, String> {
        let painted = [&PAINTED[..], &[constant("THREADS", TILE_THREADS)]].concat();
        let layers = |layers: Layers| {
            let shading = constant("SHADING", layers as u32);
            let constants = [&painted[..], &[shading]].concat();
            Kernel::new(gpu, &LAYERS[samples as usize], &constants)
        };
        Ok(Self {
            cover: cover(gpu, samples, &[])?,
            opaque: layers(Layers::Opaque)?,
            translucent: layers(Layers::Translucent)?,
            density: layers(Layers::Density)?,
            ids: Kernel::new(gpu, &IDS[samples as usize], &painted)?,
        })
    }
}

type Constant = (&'static str, f64);

/// Of all kernels that paint tiles, beside how many threads they have.
const PAINTED: [Constant; 3] = [
    constant("TILE_PX", TILE_PX),
    constant("SAMPLE_ROWS", SAMPLE_ROWS),
    constant("COLUMNS", COLUMNS),
];

/// Most workgroups that share one of few clusters, as a power of two.
const MOST_PARTS_BITS: u32 = 3;

/// With more constants.
fn flatten(gpu: &Gpu, more: &[Constant]) -> Result<[[Kernel; 2]; 2], String> {
    let kernel = |source, bits| {
        let own = [
            constant("TILE_PX", TILE_PX),
            constant("THREADS", CLUSTER_STROKES),
            constant("ENOUGH_GROUPS", ENOUGH_GROUPS),
            constant("MOST_PARTS_BITS", bits),
        ];
        Kernel::new(gpu, source, &[&own, more].concat())
    };
    let of = |bits| Ok::<_, String>([kernel(&FLATTEN[0], bits)?, kernel(&FLATTEN[1], bits)?]);
    Ok([of(0)?, of(MOST_PARTS_BITS)?])
}

/// From clusters to lists, but for flattening: cull, starts, scatter; with more constants.
fn stages(gpu: &Gpu, more: &[Constant]) -> Result<[Kernel; 3], String> {
    let kernel = |source, name, value| {
        let own = [constant("TILE_PX", TILE_PX), constant(name, value)];
        Kernel::new(gpu, source, &[&own, more].concat())
    };
    Ok([
        kernel(&CULL, "WORKGROUP", WORKGROUP)?,
        kernel(&STARTS, "THREADS", STARTS_THREADS)?,
        kernel(&SCATTER, "THREADS", SCATTER_THREADS)?,
    ])
}

/// Paints one opaque colour; with more constants.
fn cover(gpu: &Gpu, samples: Samples, more: &[Constant]) -> Result<Kernel, String> {
    let threads = constant("THREADS", samples.cover_threads());
    let (source, own) = match gpu.most_lanes() {
        Some(most) => {
            let lanes = constant("MOST_LANES", most);
            (&COVER[samples as usize], vec![threads, lanes])
        }
        None => (&COVER_APART[samples as usize], vec![threads]),
    };
    Kernel::new(gpu, source, &[&PAINTED[..], &own, more].concat())
}

const fn constant(name: &'static str, value: u32) -> Constant {
    (name, value as f64)
}
