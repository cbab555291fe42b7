//! The four phases before the first picture (thesis, figure 4.3), chunk by chunk.

use std::ops::Range;
use std::time::Instant;

use guideway_scene::{RenderError, Stage, elapsed_ms};
use wgpu::BufferUsages;

use crate::cut::Cutter;
use crate::kernels::{Kernels, Prefix};
use crate::options::GridOptions;
use crate::pack::{Cursor, Packed, Packer};
use crate::params::{Items, LINE_BYTES, SCAN_THREADS, WORKGROUP};
use crate::pass::parts;
use crate::table::Table;
use crate::unsupported;
use guideway_gpu::device::{
    DeviceBuffer, DeviceError, Dispatch, Gpu, Kernel, Memory, READBACK_USAGE, Reservation, Runner,
};

/// The lines of some of the paths, sorted into the cells of the grid.
pub(super) struct Chunk {
    /// Where the list of each cell begins.
    pub(super) starts: DeviceBuffer,
    /// How many lines each cell has.
    pub(super) counts: DeviceBuffer,
    /// Lines, cell by cell.
    pub(super) lists_m: DeviceBuffer,
    /// The counts once more, for this side to know how much work a picture is.
    pub(super) table: Table,
    _table_held: Reservation,
}

/// All lines, sorted.
#[derive(Default)]
pub(super) struct Built {
    pub(super) chunks: Vec<Chunk>,
    pub(super) stages: Vec<Stage>,
    /// Atomic operations that it took.
    pub(super) atomics: u64,
}

/// What a build needs.
pub(super) struct Builder<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) options: &'a GridOptions,
    pub(super) kernels: &'a Kernels,
    pub(super) memory: &'a mut Memory,
    pub(super) runner: &'a Runner,
    /// The grid, as shaders have it.
    pub(super) grid: &'a DeviceBuffer,
}

/// Milliseconds of each phase.
#[derive(Default)]
struct Phases {
    pack: f64,
    sample: f64,
    count: f64,
    prefix_sum: f64,
    bin: f64,
}

/// Buffers that all chunks use in turn.
struct Scratch {
    items: DeviceBuffer,
    lines_m: DeviceBuffer,
    fetched_counts: DeviceBuffer,
}

/// A chunk whose lines are counted, but not sorted yet.
struct Counted {
    counts: DeviceBuffer,
    table: Table,
    /// Lines to submit at a time.
    slices: Vec<Range<u32>>,
    /// Rows of the cells of each line to go over at a time.
    rows: Vec<Range<u32>>,
}

impl Builder<'_> {
    /// Sorts the lines of all segments, of which there are so many.
    pub(super) fn build(
        mut self,
        packer: &Packer<'_>,
        segments: u64,
    ) -> Result<Built, RenderError> {
        let mut built = Built::default();
        let mut phases = Phases::default();
        let mut most = self.most_segments().min(segments) as u32;
        if most == 0 {
            return Ok(built);
        }
        if self.cell_bytes() > self.gpu.max_binding_bytes() {
            return Err(self.too_much(format!("{} cells", self.options.cell_count())));
        }
        let scratch = self.scratch(most)?;
        let mut cursor = Cursor::default();
        loop {
            let start = Instant::now();
            let (packed, next) = packer.pack(cursor, most);
            phases.pack += elapsed_ms(start);
            let segments = packed.segments();
            if segments == 0 {
                break;
            }
            let counted = self.count(packed, &scratch, &mut phases)?;
            let entries = counted.table.total();
            if entries * LINE_BYTES > self.gpu.max_binding_bytes() {
                if segments == 1 {
                    let what = format!("a segment whose lines meet {entries} cells");
                    return Err(self.too_much(what));
                }
                most = segments / 2;
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

    /// Segments whose control points and lines fit one binding each.
    fn most_segments(&self) -> u64 {
        let lines_bytes = u64::from(self.options.lines_a_segment()) * LINE_BYTES;
        let points_bytes = 4 * size_of::<[f32; 2]>() as u64;
        self.gpu.max_binding_bytes() / lines_bytes.max(points_bytes)
    }

    fn too_much(&self, what: String) -> RenderError {
        let most = self.gpu.max_binding_bytes();
        unsupported(
            format!("{what}: this device lets a shader see only {most} bytes at once"),
            "Ask for fewer cells or samples.",
        )
    }

    fn scratch(&mut self, most_segments: u32) -> Result<Scratch, RenderError> {
        let lines = u64::from(most_segments) * u64::from(self.options.lines_a_segment());
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

    /// A buffer for shaders.
    fn zeros(&mut self, what: &'static str, bytes: u64) -> Result<DeviceBuffer, RenderError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC;
        self.memory.zeros(what, bytes, usage)
    }

    /// Bytes of one number a cell.
    fn cell_bytes(&self) -> u64 {
        u64::from(self.options.cell_count()) * size_of::<u32>() as u64
    }

    /// Phases 1 and 2: from control points to lines, and how many of them each cell has.
    fn count(
        &mut self,
        packed: Packed,
        scratch: &Scratch,
        phases: &mut Phases,
    ) -> Result<Counted, RenderError> {
        let (slices, most_rows) = (packed.slices.clone(), packed.most_rows);
        let (points_m, first_points) = self.upload(packed)?;
        let line_count = self.zeros("the line counter", size_of::<u32>() as u64)?;
        let buffers = [
            &scratch.items,
            &points_m,
            &first_points,
            &line_count,
            &scratch.lines_m,
        ];
        let whole = parts(1, 1);
        phases.sample += self.over("sampling", &self.kernels.sample, &buffers, &slices, &whole)?;

        let counts = self.zeros("the counts of the cells", self.cell_bytes())?;
        let lines = self.options.lines_a_segment();
        let of_lines = |slice: &Range<u32>| slice.start * lines..slice.end * lines;
        let slices: Vec<_> = slices.iter().map(of_lines).collect();
        // A row of cells is a round, and a round for each of its cells.
        let rows_at_once = self.gpu.loops_per_thread() / (1 + self.options.cells);
        let rows = parts(most_rows, rows_at_once);
        let buffers = [&scratch.items, self.grid, &scratch.lines_m, &counts];
        phases.count += self.over("counting", &self.kernels.count, &buffers, &slices, &rows)?;

        let mut table = None;
        let (through, bytes) = (&scratch.fetched_counts, counts.bytes());
        let fetched = self.runner.fetch(
            "the counts of the cells",
            &counts,
            through,
            bytes,
            |counts| {
                table = Some(Table::new(counts, self.options.cells));
            },
        );
        self.ok(fetched)?;
        Ok(Counted {
            table: table.expect("what is fetched is looked at"),
            counts,
            slices,
            rows,
        })
    }

    fn upload(&mut self, packed: Packed) -> Result<(DeviceBuffer, DeviceBuffer), RenderError> {
        let host_bytes = size_of_val(&*packed.points_m) + size_of_val(&*packed.first_points);
        let _held = self
            .memory
            .reserve("the packed control points", host_bytes as u64)?;
        let points_m = self.memory.upload("the control points", &packed.points_m)?;
        let first_points = self.memory.upload("the segments", &packed.first_points)?;
        Ok((points_m, first_points))
    }

    /// Phases 3 and 4: where the list of each cell begins, and the lists.
    fn sort(
        &mut self,
        counted: Counted,
        scratch: &Scratch,
        phases: &mut Phases,
    ) -> Result<Chunk, RenderError> {
        let Counted {
            counts,
            table,
            slices,
            rows,
        } = counted;
        let table_held = self
            .memory
            .reserve("the table of counts", Table::bytes(self.options.cells))?;
        let starts = self.zeros("the starts of the lists", self.cell_bytes())?;
        phases.prefix_sum += self.prefix_sum(&counts, &starts, scratch)?;

        // A buffer cannot be empty.
        let lists_bytes = table.total().max(1) * LINE_BYTES;
        let lists_m = self.zeros("the lists of lines", lists_bytes)?;
        let filled = self.zeros("the filling of the lists", self.cell_bytes())?;
        let lines_m = &scratch.lines_m;
        let buffers = [
            &scratch.items,
            self.grid,
            lines_m,
            &starts,
            &filled,
            &lists_m,
        ];
        phases.bin += self.over("binning", &self.kernels.bin, &buffers, &slices, &rows)?;
        Ok(Chunk {
            starts,
            counts,
            lists_m,
            table,
            _table_held: table_held,
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
                let mut cutter = self.cutter();
                for first in (0..cells).step_by(WORKGROUP as usize) {
                    let items = WORKGROUP.min(cells - first);
                    cutter.push(items, u64::from(items) * u64::from(first + items));
                }
                let buffers = [&scratch.items, counts, starts];
                let parts = parts(cells, self.gpu.loops_per_thread());
                self.over("the prefix sum", kernel, &buffers, &cutter.finish(), &parts)
            }
            Prefix::Scan { blocks, sums, add } => {
                let block_count = cells.div_ceil(2 * SCAN_THREADS);
                let bytes = u64::from(block_count) * size_of::<u32>() as u64;
                let block_sums = self.zeros("the sums of blocks", bytes)?;
                let bind = |kernel: &Kernel, buffers: &[&DeviceBuffer]| {
                    self.ok(kernel.bind(self.gpu, buffers))
                };
                let of_blocks = bind(blocks, &[counts, starts, &block_sums])?;
                let of_sums = bind(sums, &[&block_sums])?;
                let of_cells = bind(add, &[starts, &block_sums])?;
                let dispatch = |kernel, bindings, workgroups| Dispatch {
                    kernel,
                    bindings,
                    workgroups,
                };
                self.ok(self.runner.run(
                    "the prefix sum",
                    &[
                        dispatch(blocks, &of_blocks, block_count),
                        dispatch(sums, &of_sums, 1),
                        dispatch(add, &of_cells, block_count),
                    ],
                ))
            }
        }
    }

    /// Work and items of one submit.
    fn cutter(&self) -> Cutter {
        let most_items = self.gpu.max_workgroups().saturating_mul(WORKGROUP);
        Cutter::new(self.gpu.tests_per_submit(), most_items)
    }

    /// Runs a kernel over ranges of items and parts of their work, one submit each, and returns
    /// milliseconds.
    fn over(
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
