//! A chunk: some segments with their structure, in buffers that fit one binding, and its build.
//!
//! Input: packed segments. Output: the buffers that the shader of pixels reads.

use guideway_gpu::device::{
    Bindings, DeviceBuffer, DeviceError, Gpu, Kernel, READBACK_USAGE, Runner,
};
use guideway_grid::per_pixel::LocalScene;
use guideway_scene::{RenderError, Stage};

use crate::options::Structure;
use crate::pack::Packed;
use crate::params::{BuildParams, COUNTERS, MAX_LEVEL, NODES_PER_THREAD, WORKGROUP};
use crate::step::{Builder, Sorter, Step, WORD, dispatches};

const BOX_BYTES: u64 = size_of::<[u32; 4]>() as u64;

/// Root square of the quadtree, and of the keys of the tree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Root {
    pub(super) origin_m: [f32; 2],
    pub(super) side_m: f32,
    /// Deepest level of the quadtree.
    pub(super) max_level: u32,
}

impl Root {
    /// The root square for lines that reach `reach_m` beyond their axis.
    pub(super) fn of(local: &LocalScene, reach_m: f64) -> Self {
        let size_m = local.bounds_m.size();
        let longer_m = size_m.x.max(size_m.y);
        // A little larger, to cover rounding.
        let side_m = if longer_m > 0.0 {
            1.001 * longer_m
        } else {
            1.0
        };
        let center = local.bounds_m.center();
        let is_wide = |level: &u32| side_m / f64::from(1_u32 << level) >= 2.0 * reach_m;
        Self {
            origin_m: [center.x, center.y].map(|at| (at - side_m / 2.0) as f32),
            side_m: side_m as f32,
            max_level: (0..=MAX_LEVEL).rev().find(is_wide).unwrap_or(0),
        }
    }
}

/// A measure of how closely the boxes of a tree fit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Quality {
    /// Half perimeters of inner nodes, relative to those of the leaves.
    pub(super) cost: f64,
    /// Levels above the deepest leaf; 0 if not measured.
    pub(super) depth: u32,
}

/// Segments and their structure on the device.
pub(super) struct Chunk {
    pub(super) leaves: u32,
    points_m: DeviceBuffer,
    segments: DeviceBuffer,
    order: DeviceBuffer,
    boxes: DeviceBuffer,
    pub(super) counters: DeviceBuffer,
    build: DeviceBuffer,
    index: Index,
}

/// A chunk, with the quality of its tree when it was built.
pub(super) type BuiltChunk = (Chunk, Option<Quality>);

enum Index {
    Tree(TreeIndex),
    Quadtree { sorter: Sorter, keys: Step },
}

struct TreeIndex {
    children: DeviceBuffer,
    parents: DeviceBuffer,
    top_ranks: DeviceBuffer,
    sums: DeviceBuffer,
    fetched_sums: DeviceBuffer,
    fit: Step,
    quality: Step,
}

impl Builder<'_> {
    /// Most segments of a chunk: each buffer fits one binding, and a build one submission.
    pub(super) fn max_leaves(&self) -> u32 {
        let fit = self.gpu().max_binding_bytes() / (2 * BOX_BYTES);
        // A build takes less time per segment than this number of distance tests.
        let quick = self.gpu().tests_per_submit() / 64;
        let items = self.gpu().max_workgroups().saturating_mul(WORKGROUP);
        fit.min(quick).min(items.into()) as u32
    }

    /// Uploads packed segments and builds their tree; the quadtree is built by [`Chunk::rebuild`].
    ///
    /// # Errors
    /// When the device or the budget has too little memory, or the device fails.
    pub(super) fn chunk(
        &mut self,
        packed: &Packed,
        is_ranked: bool,
        stages: &mut Vec<Stage>,
    ) -> Result<Chunk, RenderError> {
        let leaves = packed.segments.len() as u32;
        let count = u64::from(leaves);
        let points_m = self.upload("the control points", &packed.points_m)?;
        let segments = self.upload("the segments", &packed.segments)?;
        let order: Vec<u32> = (0..leaves).collect();
        let order = self.upload("the order of the segments", &order)?;
        let params = BuildParams {
            leaves,
            ..BuildParams::default()
        };
        let build = self.uniform("the parameters of the build", &params)?;
        let counters = self.storage("the counters", COUNTERS * WORD)?;
        let nodes = match self.variant.structure {
            Structure::Tree => 2 * count - 1,
            Structure::Quadtree => count,
        };
        let boxes = self.storage("the boxes", nodes * BOX_BYTES)?;
        let leaf_groups = leaves.div_ceil(WORKGROUP);
        let index = match &self.variant.kernels.tree {
            None => {
                let keys = self.storage("the keys", count * WORD)?;
                let sorter = self.sorter(keys, &order, leaves)?;
                let buffers = [
                    &build,
                    &points_m,
                    &segments,
                    &sorter.keys,
                    &order,
                    &boxes,
                    &counters,
                ];
                let keys = self.step(&self.variant.kernels.keys, &buffers, leaf_groups)?;
                Index::Quadtree { sorter, keys }
            }
            Some(kernels) => {
                let children = self.storage("the nodes", (2 * count - 1) * WORD)?;
                let parents = self.storage("the parents", nodes * WORD)?;
                let ranks = if is_ranked { nodes * WORD } else { WORD };
                let top_ranks = self.storage("the ranks of the nodes", ranks)?;
                let groups = (nodes as u32).div_ceil(WORKGROUP * NODES_PER_THREAD);
                let sum_bytes = u64::from(groups) * size_of::<[f32; 4]>() as u64;
                let sums = self.storage("the sums of perimeters", sum_bytes)?;
                let what = "the sums of perimeters";
                let fetched_sums = self.memory.zeros(what, sum_bytes, READBACK_USAGE)?;
                let fit = &kernels.fit[usize::from(is_ranked)];
                let fitted = [
                    &build, &points_m, &segments, &order, &parents, &boxes, &top_ranks,
                ];
                let fit = self.step(fit, &fitted, leaf_groups)?;
                let quality = [&build, &parents, &boxes, &sums];
                let quality = self.step(&kernels.quality, &quality, groups)?;
                Index::Tree(TreeIndex {
                    children,
                    parents,
                    top_ranks,
                    sums,
                    fetched_sums,
                    fit,
                    quality,
                })
            }
        };
        let chunk = Chunk {
            leaves,
            points_m,
            segments,
            order,
            boxes,
            counters,
            build,
            index,
        };
        if let Index::Tree(tree) = &chunk.index {
            let keys = self.upload("the keys", &packed.keys)?;
            let emit = self.emit(&chunk, tree, &keys)?;
            Stage::merge(stages, self.run(&chunk, &[("emit", &[emit])])?);
            Stage::merge(stages, self.fit(&chunk)?);
        }
        Ok(chunk)
    }

    fn emit(
        &mut self,
        chunk: &Chunk,
        tree: &TreeIndex,
        keys: &DeviceBuffer,
    ) -> Result<Step, RenderError> {
        let kernels = &self.variant.kernels.tree;
        let kernel = &kernels.as_ref().expect("a tree has its kernels").emit;
        let ends = self.storage("the ends of the nodes", u64::from(chunk.leaves) * WORD)?;
        let buffers = [&chunk.build, keys, &tree.children, &tree.parents, &ends];
        // The bindings keep the buffer of the ends until the step is done.
        self.step(kernel, &buffers, chunk.leaves.div_ceil(WORKGROUP))
    }

    /// Fits the boxes of a tree to its control points.
    ///
    /// # Errors
    /// When the device fails.
    pub(super) fn fit(&self, chunk: &Chunk) -> Result<Vec<Stage>, RenderError> {
        let Index::Tree(tree) = &chunk.index else {
            return Ok(Vec::new());
        };
        let fit = [tree.fit.dispatch()];
        let cleared = [&chunk.boxes, &tree.top_ranks].map(|buffer| (buffer, buffer.bytes()));
        self.ok(self.runner.run_stages("fit", &cleared, &[("fit", &fit)]))
    }

    fn run(
        &self,
        chunk: &Chunk,
        stages: &[(&'static str, &[Step])],
    ) -> Result<Vec<Stage>, RenderError> {
        let listed: Vec<_> = stages
            .iter()
            .map(|(name, steps)| (*name, dispatches(steps)))
            .collect();
        let listed: Vec<_> = listed
            .iter()
            .map(|(name, steps)| (*name, steps.as_slice()))
            .collect();
        let cleared = [(&chunk.counters, COUNTERS * WORD)];
        self.ok(self.runner.run_stages("the build", &cleared, &listed))
    }

    /// Builds the structure of a chunk anew from its control points.
    ///
    /// # Errors
    /// When the device or the budget has too little memory, or the device fails.
    pub(super) fn rebuild(&mut self, chunk: &Chunk, root: Root) -> Result<Vec<Stage>, RenderError> {
        self.write_build(chunk, Some(root), false)?;
        match &chunk.index {
            Index::Quadtree { sorter, keys } => {
                let keys = [keys.dispatch()];
                let sort = dispatches(&sorter.steps);
                let cleared = [(&chunk.counters, COUNTERS * WORD)];
                let stages: [(_, &[_]); 2] = [("keys", &keys), ("sort", &sort)];
                self.ok(self.runner.run_stages("the quadtree", &cleared, &stages))
            }
            Index::Tree(tree) => {
                let groups = chunk.leaves.div_ceil(WORKGROUP);
                let keys = self.storage("the keys", u64::from(chunk.leaves) * WORD)?;
                let sorter = self.sorter(keys, &chunk.order, chunk.leaves)?;
                let buffers = [
                    &chunk.build,
                    &chunk.points_m,
                    &chunk.segments,
                    &sorter.keys,
                    &chunk.order,
                    &chunk.boxes,
                    &chunk.counters,
                ];
                let keys = self.step(&self.variant.kernels.keys, &buffers, groups)?;
                let emit = self.emit(chunk, tree, &sorter.keys)?;
                let steps: [(_, &[Step]); 3] = [
                    ("keys", &[keys]),
                    ("sort", &sorter.steps),
                    ("emit", &[emit]),
                ];
                let mut stages = self.run(chunk, &steps)?;
                Stage::merge(&mut stages, self.fit(chunk)?);
                Ok(stages)
            }
        }
    }

    fn write_build(
        &self,
        chunk: &Chunk,
        root: Option<Root>,
        measures_depth: bool,
    ) -> Result<(), RenderError> {
        let root = root.unwrap_or(Root {
            origin_m: [0.0; 2],
            side_m: 1.0,
            max_level: 0,
        });
        let params = BuildParams {
            origin_m: root.origin_m,
            side_m: root.side_m,
            leaves: chunk.leaves,
            max_level: root.max_level,
            measures_depth: measures_depth.into(),
        };
        self.ok(self
            .runner
            .write("the parameters of the build", &chunk.build, &params))
    }

    /// Measures how well the boxes of a tree fit; `None` for the quadtree.
    ///
    /// # Errors
    /// When the device fails.
    pub(super) fn quality(
        &self,
        chunk: &Chunk,
        measures_depth: bool,
    ) -> Result<Option<Quality>, RenderError> {
        let Index::Tree(tree) = &chunk.index else {
            return Ok(None);
        };
        self.write_build(chunk, None, measures_depth)?;
        let step = [tree.quality.dispatch()];
        self.ok(self.runner.start("the quality of the tree", &step))?;
        let (mut inner, mut leaves, mut depth) = (0.0, 0.0, 0.0_f32);
        let (from, through) = (&tree.sums, &tree.fetched_sums);
        let fetched = self.runner.fetch(
            "the quality of the tree",
            from,
            through,
            from.bytes(),
            |sums| {
                for sum in sums.as_chunks::<4>().0.as_chunks::<4>().0 {
                    let [own_inner, own_leaves, own_depth, _] = sum.map(f32::from_le_bytes);
                    inner += f64::from(own_inner);
                    leaves += f64::from(own_leaves);
                    depth = depth.max(own_depth);
                }
            },
        );
        self.ok(fetched)?;
        Ok(Some(Quality {
            cost: if leaves > 0.0 { inner / leaves } else { 0.0 },
            depth: depth as u32,
        }))
    }
}

impl Chunk {
    /// Replaces control points from `first` on.
    ///
    /// # Errors
    /// When the device fails.
    pub(super) fn write_points(
        &self,
        runner: &Runner,
        first: u32,
        points_m: &[[f32; 2]],
    ) -> Result<(), DeviceError> {
        runner.write_at("the control points", &self.points_m, first, points_m)
    }

    /// Binds the shader of pixels.
    ///
    /// # Errors
    /// When the device fails.
    pub(super) fn bind(
        &self,
        gpu: &Gpu,
        kernel: &Kernel,
        [view, pixels, progress]: &[&DeviceBuffer; 3],
        colors: &DeviceBuffer,
    ) -> Result<Bindings, DeviceError> {
        let mut buffers = vec![
            *view,
            &self.points_m,
            &self.segments,
            &self.order,
            &self.boxes,
            colors,
            *pixels,
            *progress,
            &self.counters,
        ];
        match &self.index {
            Index::Tree(tree) => buffers.extend([&tree.children, &tree.top_ranks]),
            Index::Quadtree { sorter, .. } => buffers.push(&sorter.keys),
        }
        kernel.bind(gpu, &buffers)
    }
}
