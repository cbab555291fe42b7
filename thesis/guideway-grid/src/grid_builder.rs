//! Builds the grid of a scene in the four phases of the thesis (figure 4.3).
//!
//! Input: packed control points. Output: the lines of every cell, in chunks that fit one binding.
//!
//! ```text
//! segments --sample--> lines --count--> lines per cell --prefix sum--> starts --bin--> lists
//! ```

use std::ops::Range;
use std::time::Instant;

use guideway_gpu::device::{
    DeviceBuffer, DeviceError, Dispatch, Gpu, Kernel, Memory, READBACK_USAGE, Runner,
};
use guideway_scene::{RenderError, Stage, elapsed_ms};
use wgpu::BufferUsages;

use crate::chunk::Chunk;
use crate::count_table::CountTable;
use crate::kernels::{Kernels, Prefix};
use crate::options::GridOptions;
use crate::pack::{Cursor, Packed, Packer};
use crate::params::{Items, LINE_BYTES, SCAN_THREADS, WORKGROUP};
use crate::split::{WorkSplitter, equal_ranges};
use crate::variant::NAME;

/// The grid of a scene: all lines, sorted by cell.
#[derive(Default)]
pub(super) struct BuiltGrid {
    pub(super) chunks: Vec<Chunk>,
    pub(super) stages: Vec<Stage>,
    /// Atomic operations of all phases.
    pub(super) atomics: u64,
}

/// Runs the four phases on a device.
pub(super) struct GridBuilder<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) options: &'a GridOptions,
    pub(super) kernels: &'a Kernels,
    pub(super) memory: &'a mut Memory,
    pub(super) runner: &'a Runner,
    /// The uniform buffer of [`crate::params::GridParams`].
    pub(super) grid: &'a DeviceBuffer,
}

/// Milliseconds per phase.
#[derive(Default)]
struct PhaseTimes {
    pack: f64,
    sample: f64,
    count: f64,
    prefix_sum: f64,
    bin: f64,
}

/// Buffers that all chunks share, one after the other.
struct Scratch {
    items: DeviceBuffer,
    lines_m: DeviceBuffer,
    fetched_counts: DeviceBuffer,
}

/// A chunk whose lines are counted, but not yet sorted.
struct CountedChunk {
    counts: DeviceBuffer,
    table: CountTable,
    /// Ranges of lines, one per submission.
    slices: Vec<Range<u32>>,
    /// Ranges of cell rows per line, one per submission.
    rows: Vec<Range<u32>>,
}

impl GridBuilder<'_> {
    /// Sorts the lines of all `segments` segments into cells.
    ///
    /// # Errors
    /// When the device or the budget has too little memory, or the device fails.
    pub(super) fn build(
        mut self,
        packer: &Packer<'_>,
        segments: u64,
    ) -> Result<BuiltGrid, RenderError> {
        let mut built = BuiltGrid::default();
        let mut phases = PhaseTimes::default();
        let mut max_segments = self.max_segments().min(segments) as u32;
        if max_segments == 0 {
            return Ok(built);
        }
        if self.cell_bytes() > self.gpu.max_binding_bytes() {
            return Err(self.exceeds_binding(format!("{} cells", self.options.cell_count())));
        }
        let scratch = self.scratch(max_segments)?;
        let mut cursor = Cursor::default();
        loop {
            let start = Instant::now();
            let (packed, next) = packer.pack(cursor, max_segments);
            phases.pack += elapsed_ms(start);
            let segments = packed.segments();
            if segments == 0 {
                break;
            }
            let counted = self.count(packed, &scratch, &mut phases)?;
            let entries = counted.table.total();
            if entries * LINE_BYTES > self.gpu.max_binding_bytes() {
                if segments == 1 {
                    let what = format!("a segment whose lines overlap {entries} cells");
                    return Err(self.exceeds_binding(what));
                }
                // Pack the same segments again, in two chunks.
                max_segments = segments / 2;
                continue;
            }
            built
                .chunks
                .push(self.sort(counted, &scratch, &mut phases)?);
            built.atomics += u64::from(segments) + 2 * entries;
            cursor = next;
        }
        built.stages = vec![
            Stage::host("pack", phases.pack),
            self.runner.stage("sample", phases.sample),
            self.runner.stage("count", phases.count),
            self.runner.stage("prefix sum", phases.prefix_sum),
            self.runner.stage("bin", phases.bin),
        ];
        Ok(built)
    }

    /// Most segments whose control points and whose lines each fit one binding.
    fn max_segments(&self) -> u64 {
        let lines_bytes = u64::from(self.options.lines_per_segment()) * LINE_BYTES;
        let points_bytes = 4 * size_of::<[f32; 2]>() as u64;
        self.gpu.max_binding_bytes() / lines_bytes.max(points_bytes)
    }

    fn exceeds_binding(&self, what: String) -> RenderError {
        let limit = self.gpu.max_binding_bytes();
        RenderError::unsupported(
            NAME,
            format!("{what}: a shader of this device can bind at most {limit} bytes"),
            "Use fewer cells or samples.",
        )
    }

    fn scratch(&mut self, max_segments: u32) -> Result<Scratch, RenderError> {
        let lines = u64::from(max_segments) * u64::from(self.options.lines_per_segment());
        let items = size_of::<Items>() as u64;
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let cells = self.cell_bytes();
        Ok(Scratch {
            items: self.memory.zeros("the range of items", items, uniform)?,
            lines_m: self.zeros("the sampled lines", lines * LINE_BYTES)?,
            fetched_counts: self
                .memory
                .zeros("the counts of the cells", cells, READBACK_USAGE)?,
        })
    }

    /// Allocates a storage buffer that holds zeros.
    fn zeros(&mut self, what: &'static str, bytes: u64) -> Result<DeviceBuffer, RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        self.memory.zeros(what, bytes, usage)
    }

    /// Bytes of a buffer with one `u32` per cell.
    fn cell_bytes(&self) -> u64 {
        u64::from(self.options.cell_count()) * size_of::<u32>() as u64
    }

    /// Phases 1 and 2: samples control points into lines, and counts the lines per cell.
    fn count(
        &mut self,
        packed: Packed,
        scratch: &Scratch,
        phases: &mut PhaseTimes,
    ) -> Result<CountedChunk, RenderError> {
        let (slices, max_rows) = (packed.slices.clone(), packed.max_rows);
        let (points_m, first_points) = self.upload(packed)?;
        let line_count = self.zeros("the line counter", size_of::<u32>() as u64)?;
        let buffers = [
            &scratch.items,
            &points_m,
            &first_points,
            &line_count,
            &scratch.lines_m,
        ];
        let whole = equal_ranges(1, 1);
        let kernel = &self.kernels.sample;
        phases.sample += self.run_ranges("sampling", kernel, &buffers, &slices, &whole)?;

        let counts = self.zeros("the counts of the cells", self.cell_bytes())?;
        let lines = self.options.lines_per_segment();
        let line_range = |slice: &Range<u32>| slice.start * lines..slice.end * lines;
        let slices: Vec<_> = slices.iter().map(line_range).collect();
        // A thread loops once per row of cells, and once per cell of the row.
        let rows_at_once = self.gpu.loops_per_thread() / (1 + self.options.cells);
        let rows = equal_ranges(max_rows, rows_at_once);
        let buffers = [&scratch.items, self.grid, &scratch.lines_m, &counts];
        let kernel = &self.kernels.count;
        phases.count += self.run_ranges("counting", kernel, &buffers, &slices, &rows)?;

        let mut table = None;
        let fetched = self.runner.fetch(
            "the counts of the cells",
            &counts,
            &scratch.fetched_counts,
            counts.bytes(),
            |counts| {
                table = Some(CountTable::new(counts, self.options.cells));
            },
        );
        self.ok(fetched)?;
        Ok(CountedChunk {
            table: table.expect("a successful fetch calls its closure"),
            counts,
            slices,
            rows,
        })
    }

    fn upload(&mut self, packed: Packed) -> Result<(DeviceBuffer, DeviceBuffer), RenderError> {
        let host_bytes = size_of_val(&*packed.points_m) + size_of_val(&*packed.first_points);
        let _reservation = self
            .memory
            .reserve("the packed control points", host_bytes as u64)?;
        let points_m = self.memory.upload("the control points", &packed.points_m)?;
        let first_points = self.memory.upload("the segments", &packed.first_points)?;
        Ok((points_m, first_points))
    }

    /// Phases 3 and 4: computes the start of each cell's list, and fills the lists.
    fn sort(
        &mut self,
        counted: CountedChunk,
        scratch: &Scratch,
        phases: &mut PhaseTimes,
    ) -> Result<Chunk, RenderError> {
        let CountedChunk {
            counts,
            table,
            slices,
            rows,
        } = counted;
        let table_reservation = self
            .memory
            .reserve("the table of counts", CountTable::bytes(self.options.cells))?;
        let starts = self.zeros("the starts of the lists", self.cell_bytes())?;
        phases.prefix_sum += self.prefix_sum(&counts, &starts, scratch)?;

        // A buffer cannot be empty.
        let lists_bytes = table.total().max(1) * LINE_BYTES;
        let lists_m = self.zeros("the lists of lines", lists_bytes)?;
        let filled = self.zeros("the lengths of the lists", self.cell_bytes())?;
        let lines_m = &scratch.lines_m;
        let buffers = [
            &scratch.items,
            self.grid,
            lines_m,
            &starts,
            &filled,
            &lists_m,
        ];
        let kernel = &self.kernels.bin;
        phases.bin += self.run_ranges("binning", kernel, &buffers, &slices, &rows)?;
        Ok(Chunk {
            starts,
            counts,
            lists_m,
            table,
            _table_reservation: table_reservation,
        })
    }

    fn prefix_sum(
        &mut self,
        counts: &DeviceBuffer,
        starts: &DeviceBuffer,
        scratch: &Scratch,
    ) -> Result<f64, RenderError> {
        let cells = self.options.cell_count();
        match &self.kernels.prefix {
            Prefix::Naive(kernel) => {
                let mut splitter = self.splitter();
                for first in (0..cells).step_by(WORKGROUP as usize) {
                    let items = WORKGROUP.min(cells - first);
                    splitter.push(items, u64::from(items) * u64::from(first + items));
                }
                let buffers = [&scratch.items, counts, starts];
                let parts = equal_ranges(cells, self.gpu.loops_per_thread());
                let ranges = splitter.finish();
                self.run_ranges("the prefix sum", kernel, &buffers, &ranges, &parts)
            }
            Prefix::Scan { blocks, sums, add } => {
                let block_count = cells.div_ceil(2 * SCAN_THREADS);
                let bytes = u64::from(block_count) * size_of::<u32>() as u64;
                let block_sums = self.zeros("the sums of blocks", bytes)?;
                let bind = |kernel: &Kernel, buffers: &[&DeviceBuffer]| {
                    self.ok(kernel.bind(self.gpu, buffers))
                };
                let block_bindings = bind(blocks, &[counts, starts, &block_sums])?;
                let sum_bindings = bind(sums, &[&block_sums])?;
                let cell_bindings = bind(add, &[starts, &block_sums])?;
                let dispatch = |kernel, bindings, workgroups| Dispatch {
                    kernel,
                    bindings,
                    workgroups,
                };
                self.ok(self.runner.run(
                    "the prefix sum",
                    &[
                        dispatch(blocks, &block_bindings, block_count),
                        dispatch(sums, &sum_bindings, 1),
                        dispatch(add, &cell_bindings, block_count),
                    ],
                ))
            }
        }
    }

    /// A splitter with the device's limits per submission.
    fn splitter(&self) -> WorkSplitter {
        let max_items = self.gpu.max_workgroups().saturating_mul(WORKGROUP);
        WorkSplitter::new(self.gpu.tests_per_submit(), max_items)
    }

    /// Runs a kernel over every pair of an item range and a part of the items' work, one submission
    /// each. Returns the elapsed milliseconds.
    fn run_ranges(
        &self,
        what: &'static str,
        kernel: &Kernel,
        buffers: &[&DeviceBuffer],
        ranges: &[Range<u32>],
        parts: &[Range<u32>],
    ) -> Result<f64, RenderError> {
        let bindings = self.ok(kernel.bind(self.gpu, buffers))?;
        let mut elapsed_ms = 0.0;
        for (part, range) in parts
            .iter()
            .flat_map(|part| ranges.iter().map(move |r| (part, r)))
        {
            let items = Items {
                first: range.start,
                end: range.end,
                first_part: part.start,
                end_part: part.end,
            };
            self.ok(self.runner.write(what, buffers[0], &items))?;
            let dispatch = Dispatch {
                kernel,
                bindings: &bindings,
                workgroups: (range.end - range.start).div_ceil(WORKGROUP),
            };
            elapsed_ms += self.ok(self.runner.run(what, &[dispatch]))?;
        }
        Ok(elapsed_ms)
    }

    fn ok<R>(&self, result: Result<R, DeviceError>) -> Result<R, RenderError> {
        result.map_err(|error| self.memory.device_error(&error))
    }
}
