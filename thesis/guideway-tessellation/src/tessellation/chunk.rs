//! A chunk of a scene on the device: fills its buffers, culls its paths and draws them.
//!
//! Input: a planned range of paths. Output: draws, and the counts of visible paths and segments.

use std::rc::Rc;

use bytemuck::Pod;
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point};

use super::plan::{ChunkPlan, Plan};
use super::shared::{
    COMMANDS, COUNTERS, Counters, DrawElements, PATCH_VERTICES, PATCHES, PATHS, POINT, POINTS,
    PathRecord, SEGMENTS, WORKGROUP,
};
use crate::error::GlError;
use crate::options::Commands;
use crate::sys::{Buffer, Gl, Program, VertexArray, dispatch, draw_command, draw_commands};

/// The buffers of some paths.
pub(super) struct Chunk {
    path_count: u32,
    commands: Commands,
    points: Buffer,
    paths: Buffer,
    /// Counters of the culling pass.
    counters: Buffer,
    /// Commands or patches that the culling pass appends.
    output: Buffer,
    segments: Buffer,
    vertices: VertexArray,
}

/// Counts of the visible parts of a chunk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct VisibleCounts {
    pub(super) paths: u64,
    pub(super) segments: u64,
}

impl Chunk {
    /// Allocates the planned buffers.
    ///
    /// # Errors
    /// When the device is out of memory.
    pub(super) fn new(gl: &Rc<Gl>, plan: &ChunkPlan, commands: Commands) -> Result<Self, GlError> {
        let bytes = plan.bytes(commands);
        let points = Buffer::new(gl, "control points", bytes.points)?;
        let (written, read) = match commands {
            Commands::PerPath => ("draw commands", "the index buffer"),
            Commands::Compact => ("visible patches", "segments"),
        };
        let segments = Buffer::new(gl, read, bytes.segments)?;
        Ok(Self {
            path_count: plan.paths,
            commands,
            vertices: match commands {
                Commands::PerPath => VertexArray::indexed(gl, POINT, &points, &segments)?,
                Commands::Compact => VertexArray::pulled(gl)?,
            },
            points,
            paths: Buffer::new(gl, "paths", bytes.paths)?,
            counters: Buffer::of(gl, "counters", &Counters::INITIAL)?,
            output: Buffer::new(gl, written, bytes.output)?,
            segments,
        })
    }

    /// Copies the paths to the buffers.
    pub(super) fn fill(&self, scene: &Scene, plan: &Plan, chunk: &ChunkPlan) {
        let mut points = Upload::new(&self.points);
        let mut paths = Upload::new(&self.paths);
        let mut segments = Upload::new(&self.segments);
        for &row in &scene.draw_order()[chunk.order.clone()] {
            let first_segment = segments.written;
            let mut hull: Option<Bounds<f32>> = None;
            for run in scene.layout().paths.get(row as usize).runs() {
                let count = run.segments().len() as u32;
                if count == 0 {
                    continue;
                }
                for first in (points.written..).take(count as usize) {
                    match self.commands {
                        Commands::PerPath => {
                            (first..first + PATCH_VERTICES).for_each(|i| segments.push(i));
                        }
                        Commands::Compact => segments.push(first),
                    }
                }
                for point_m in run.iter() {
                    let p: Point<f32> = (point_m - plan.origin_m).to_f32();
                    points.push([p.x, p.y]);
                    let here = Bounds { min: p, max: p };
                    hull = Some(hull.map_or(here, |hull| hull.union(here)));
                }
            }
            if let Some(hull) = hull {
                let per_segment = self.entries_per_segment();
                paths.push(PathRecord {
                    min_m: [hull.min.x, hull.min.y],
                    max_m: [hull.max.x, hull.max.y],
                    first_segment: first_segment / per_segment,
                    segment_count: (segments.written - first_segment) / per_segment,
                });
            }
        }
        points.flush();
        paths.flush();
        segments.flush();
    }

    fn entries_per_segment(&self) -> u32 {
        match self.commands {
            Commands::PerPath => PATCH_VERTICES,
            Commands::Compact => 1,
        }
    }

    /// Lists the draws of all visible paths.
    pub(super) fn cull(&self, gl: &Gl, program: &Program) {
        self.counters.write(0, &[Counters::INITIAL]);
        self.paths.bind_storage(PATHS);
        self.counters.bind_storage(COUNTERS);
        match self.commands {
            Commands::PerPath => self.output.bind_storage(COMMANDS),
            Commands::Compact => {
                self.segments.bind_storage(SEGMENTS);
                self.output.bind_storage(PATCHES);
            }
        }
        dispatch(gl, program, self.path_count.div_ceil(WORKGROUP));
    }

    /// Draws the listed paths.
    pub(super) fn draw(&self, gl: &Gl, program: &Program) {
        match self.commands {
            Commands::PerPath => draw_commands(
                gl,
                program,
                &self.vertices,
                &self.output,
                &self.counters,
                self.path_count,
            ),
            Commands::Compact => {
                self.output.bind_storage(PATCHES);
                self.points.bind_storage(POINTS);
                let offset_bytes = Counters::COMMAND_OFFSET;
                draw_command(gl, program, &self.vertices, &self.counters, offset_bytes);
            }
        }
    }

    /// Visible paths of the last culling pass. Waits for it.
    pub(super) fn visible_paths(&self) -> u64 {
        u64::from(self.counters().drawn)
    }

    /// Visible paths and segments of the last culling pass. Waits for it; with one command per path
    /// it reads all commands back.
    pub(super) fn visible(&self) -> VisibleCounts {
        let counters = self.counters();
        let vertices = match self.commands {
            Commands::PerPath => {
                let mut commands = vec![DrawElements::default(); counters.drawn as usize];
                self.output.read(&mut commands);
                commands.iter().map(|c| u64::from(c.index_count)).sum()
            }
            Commands::Compact => u64::from(counters.vertex_count),
        };
        VisibleCounts {
            paths: u64::from(counters.drawn),
            segments: vertices / u64::from(PATCH_VERTICES),
        }
    }

    fn counters(&self) -> Counters {
        let mut counters = [Counters::INITIAL];
        self.counters.read(&mut counters);
        counters[0]
    }

    pub(super) fn path_count(&self) -> u64 {
        u64::from(self.path_count)
    }

    /// Bytes of all buffers.
    pub(super) fn bytes(&self) -> u64 {
        let buffers = [
            &self.points,
            &self.paths,
            &self.counters,
            &self.output,
            &self.segments,
        ];
        buffers.iter().map(|buffer| buffer.bytes()).sum()
    }
}

/// Bytes of host memory that [`Chunk::fill`] holds.
pub(super) const STAGING_BYTES: u64 = 3 * Upload::<u32>::PIECE_BYTES as u64;

/// A buffered writer to a device buffer.
struct Upload<'a, T> {
    buffer: &'a Buffer,
    piece: Vec<T>,
    /// Items pushed so far.
    written: u32,
}

impl<'a, T: Pod> Upload<'a, T> {
    /// Bytes of host memory per writer, and so of each write to the device.
    const PIECE_BYTES: usize = 1 << 20;

    fn new(buffer: &'a Buffer) -> Self {
        Self {
            buffer,
            piece: Vec::with_capacity(Self::PIECE_BYTES / size_of::<T>()),
            written: 0,
        }
    }

    fn push(&mut self, item: T) {
        if self.piece.len() == Self::PIECE_BYTES / size_of::<T>() {
            self.flush();
        }
        self.piece.push(item);
        self.written += 1;
    }

    fn flush(&mut self) {
        let first = self.written as usize - self.piece.len();
        self.buffer.write(first, &self.piece);
        self.piece.clear();
    }
}
