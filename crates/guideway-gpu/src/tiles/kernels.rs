//! The shaders of a frame, compiled.

use super::params::{
    CLUSTER_STROKES, COLUMNS, COUNTED_EACH, ENOUGH_GROUPS, ENOUGH_LISTS, Found, LEAST_ALONE,
    LINE_THREADS, PROCESSOR_LANES, ROUNDS_A_LINE, SAMPLE_ROWS, STARTS_THREADS, Samples, TILE_PX,
    TILE_THREADS, WAITED_FOR, WORKGROUP,
};
use super::shaders::{
    COVERS, COVERS_APART, COVERS_IN_STEP, CULL, FLATTEN, FLATTEN_IN_STEP, LAYERS, LIST_KEPT,
    OPAQUE, OPAQUE_TEAMS, RECOUNT, SCATTER, SHARE, SHIFT, SORT, STARTS, STRIKE,
};
use crate::device::{Gpu, Kernel, Source};

#[derive(Clone)]
pub(super) struct Kernels {
    pub(super) cull: Kernel,
    /// Strikes out lines of clusters that were touched, in place of `cull`.
    pub(super) strike: Kernel,
    /// For many clusters and for few, by [`super::params::Points`].
    pub(super) flatten: [[Kernel; 2]; 2],
    /// Counts lines that are there already.
    pub(super) recount: Kernel,
    /// Lists them at once, where each tile has places for as many.
    pub(super) list_kept: Kernel,
    pub(super) starts: Kernel,
    /// Shares out long lists.
    pub(super) share: Kernel,
    pub(super) scatter: Kernel,
    /// Of short lists, and of all others.
    pub(super) sort: [Kernel; 2],
    pub(super) shift: Kernel,
    /// Coarse and fine.
    painters: [Painters; 2],
}

/// Kernels that paint tiles, by so many samples a pixel.
#[derive(Clone)]
pub(super) struct Painters {
    pub(super) cover: Kernel,
    /// Where several workgroups cover some tiles: what covers, and what shows those tiles. None where a shader may not see
    /// so many buffers.
    pub(super) shared: Option<[Kernel; 2]>,
    pub(super) opaque: Kernel,
    pub(super) translucent: Kernel,
    pub(super) density: Kernel,
}

impl Kernels {
    pub(super) fn new(gpu: &Gpu) -> Result<Self, String> {
        let tile = constant("TILE_PX", TILE_PX);
        let [cull, recount, list_kept, starts, share, scatter] = stages(gpu, &[])?;
        Ok(Self {
            cull,
            strike: Kernel::new(gpu, &STRIKE, &[tile, constant("WORKGROUP", WORKGROUP)])?,
            flatten: flatten(gpu, &[])?,
            recount,
            list_kept,
            starts,
            share,
            scatter,
            sort: sorts(gpu, &[])?,
            shift: Kernel::new(gpu, &SHIFT, &[constant("THREADS", WORKGROUP)])?,
            painters: [
                Painters::new(gpu, Samples::Coarse)?,
                Painters::new(gpu, Samples::Fine)?,
            ],
        })
    }

    /// The same, but those of a frame of colors count what they do.
    pub(super) fn counting(&self, gpu: &Gpu) -> Result<Self, String> {
        let counts = [("COUNTS", 1.0)];
        let mut all = self.clone();
        [
            all.cull,
            all.recount,
            all.list_kept,
            all.starts,
            all.share,
            all.scatter,
        ] = stages(gpu, &counts)?;
        all.flatten = flatten(gpu, &counts)?;
        all.sort = sorts(gpu, &counts)?;
        for samples in [Samples::Coarse, Samples::Fine] {
            let painters = &mut all.painters[samples as usize];
            (painters.cover, painters.shared) = covers(gpu, samples, &counts)?;
            painters.opaque = opaque(gpu, samples, &counts)?;
            painters.translucent = layers(gpu, samples, false, &counts)?;
        }
        Ok(all)
    }

    pub(super) fn painters(&self, samples: Samples) -> &Painters {
        &self.painters[samples as usize]
    }
}

impl Painters {
    fn new(gpu: &Gpu, samples: Samples) -> Result<Self, String> {
        let (cover, shared) = covers(gpu, samples, &[])?;
        Ok(Self {
            cover,
            shared,
            opaque: opaque(gpu, samples, &[])?,
            translucent: layers(gpu, samples, false, &[])?,
            density: layers(gpu, samples, true, &[])?,
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
pub(super) const MOST_PARTS_BITS: u32 = 3;

/// Whether a device gets the kernels for threads that run in step on a processor.
pub(super) fn is_in_step(gpu: &Gpu) -> bool {
    gpu.processor_lanes() == Some(PROCESSOR_LANES)
}

/// With more constants.
fn flatten(gpu: &Gpu, more: &[Constant]) -> Result<[[Kernel; 2]; 2], String> {
    if is_in_step(gpu) {
        let own = [
            constant("TILE_PX", TILE_PX),
            constant("THREADS", PROCESSOR_LANES),
        ];
        let kernel = |source| Kernel::new(gpu, source, &[&own, more].concat());
        let all = [kernel(&FLATTEN_IN_STEP[0])?, kernel(&FLATTEN_IN_STEP[1])?];
        return Ok([all.clone(), all]);
    }
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

/// From clusters to lists, but for flattening: cull, recount, list_kept, starts, share, scatter; with more constants.
fn stages(gpu: &Gpu, more: &[Constant]) -> Result<[Kernel; 6], String> {
    let kernel = |source, own: &[Constant]| {
        let tile = constant("TILE_PX", TILE_PX);
        Kernel::new(gpu, source, &[&[tile], own, more].concat())
    };
    let starts = constant("THREADS", STARTS_THREADS);
    let [least, most] = bounds_alone(gpu);
    let share = [
        starts,
        constant("ENOUGH_LISTS", ENOUGH_LISTS),
        constant("LEAST_ALONE", least),
        constant("MOST_ALONE", most),
    ];
    Ok([
        kernel(&CULL, &[constant("WORKGROUP", WORKGROUP)])?,
        kernel(
            &RECOUNT,
            &[
                constant("THREADS", LINE_THREADS),
                constant("LINES_EACH", COUNTED_EACH),
            ],
        )?,
        kernel(&LIST_KEPT, &[constant("THREADS", LINE_THREADS)])?,
        kernel(&STARTS, &[starts])?,
        kernel(&SHARE, &share)?,
        kernel(&SCATTER, &[constant("THREADS", LINE_THREADS)])?,
    ])
}

/// What paints one opaque color, a workgroup a tile and several; with more constants.
fn covers(
    gpu: &Gpu,
    samples: Samples,
    more: &[Constant],
) -> Result<(Kernel, Option<[Kernel; 2]>), String> {
    let mut own = [&PAINTED[..], more].concat();
    own.push(constant("THREADS", samples.cover_threads()));
    let sources = match gpu.most_lanes() {
        Some(most) => {
            own.push(constant("MOST_LANES", most));
            &COVERS
        }
        None => &COVERS_APART,
    };
    let alone = if is_in_step(gpu) {
        let threads = constant("THREADS", PROCESSOR_LANES);
        let own = [&PAINTED[..], more, &[threads]].concat();
        Kernel::new(gpu, &COVERS_IN_STEP[samples as usize], &own)?
    } else {
        Kernel::new(gpu, &sources.alone[samples as usize], &own)?
    };
    let source = &sources.shared[samples as usize];
    // All but the first one are of storage.
    if (gpu.storage_bindings() as usize) < source.bindings.len() - 1 {
        return Ok((alone, None));
    }
    let shared = |shows| Kernel::new(gpu, source, &[&own[..], &[("SHOWS", shows)]].concat());
    Ok((alone, Some([shared(0.0)?, shared(1.0)?])))
}

/// What brings short lists, and all others, into order; with more constants.
fn sorts(gpu: &Gpu, more: &[Constant]) -> Result<[Kernel; 2], String> {
    let own = [
        constant("TILE_PX", TILE_PX),
        constant("THREADS", TILE_THREADS),
    ];
    let kernel = |source| Kernel::new(gpu, source, &[&own, more].concat());
    Ok([kernel(&SORT[0])?, kernel(&SORT[1])?])
}

/// What paints opaque paths in many colors; with more constants.
fn opaque(gpu: &Gpu, samples: Samples, more: &[Constant]) -> Result<Kernel, String> {
    // Teams take longer where all samples are needed, and on a processor.
    let is_for_teams = samples == Samples::Coarse && !is_in_step(gpu);
    match gpu.most_lanes().filter(|_| is_for_teams) {
        Some(most) => {
            let own = [constant("MOST_LANES", most)];
            painter(gpu, &OPAQUE_TEAMS, &[&own, more].concat())
        }
        None => painter(gpu, &OPAQUE[samples as usize], more),
    }
}

/// What paints translucent paths, or density; with more constants.
fn layers(
    gpu: &Gpu,
    samples: Samples,
    is_density: bool,
    more: &[Constant],
) -> Result<Kernel, String> {
    let own = [("IS_DENSITY", f64::from(u8::from(is_density)))];
    painter(gpu, &LAYERS[samples as usize], &[&own[..], more].concat())
}

/// What paints a tile by a thread for each row of samples; with more constants.
fn painter(gpu: &Gpu, source: &Source, more: &[Constant]) -> Result<Kernel, String> {
    let threads = constant("THREADS", TILE_THREADS);
    let constants = [&PAINTED[..], &[threads], more].concat();
    Kernel::new(gpu, source, &constants)
}

/// What the longest list that one workgroup covers, where several may, is held between.
pub(super) fn bounds_alone(gpu: &Gpu) -> [u32; 2] {
    let most = gpu.rounds_a_thread() / ROUNDS_A_LINE;
    match gpu.options().longest_alone {
        Some(asked) => [asked.min(most); 2],
        None => [LEAST_ALONE.min(most), most],
    }
}

/// Whether one workgroup would take longer for its list than others do for all of theirs.
pub(super) fn keeps_waiting(gpu: &Gpu, found: &Found) -> bool {
    let [least, most] = bounds_alone(gpu);
    found.longest > (found.references / WAITED_FOR).clamp(least, most)
}

const fn constant(name: &'static str, value: u32) -> Constant {
    (name, value as f64)
}
