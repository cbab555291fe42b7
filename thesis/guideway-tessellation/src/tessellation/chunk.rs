//! The buffers of one chunk of a scene, filled and drawn.

use std::rc::Rc;

use bytemuck::Pod;
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point};

use super::plan::{ChunkPlan, Plan};
use super::shared::{
    COMMANDS, CORNERS, DrawElements, PATCHES, PATHS, POINT, POINTS, PathRecord, SEGMENTS, TALLY,
    Tally, WORKGROUP,
};
use crate::options::Commands;
use crate::sys::{Buffer, Gl, Program, Vertices};

/// Paths on the device.
pub(super) struct Chunk {
    path_count: u32,
    commands: Commands,
    points: Buffer,
    paths: Buffer,
    /// What the pre-pass counts, and what it appends to.
    tally: Buffer,
    output: Buffer,
    segments: Buffer,
    vertices: Vertices,
}

/// What one frame showed of a chunk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Seen {
    pub(super) paths: u64,
    pub(super) segments: u64,
}

impl Chunk {
    /// Takes the memory that was planned.
    pub(super) fn new(gl: &Rc<Gl>, plan: &ChunkPlan, commands: Commands) -> Result<Self, String> {
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
                Commands::PerPath => Vertices::indexed(gl, POINT, &points, &segments)?,
                Commands::Compact => Vertices::pulled(gl)?,
            },
            points,
            paths: Buffer::new(gl, "paths", bytes.paths)?,
            tally: Buffer::of(gl, "counters", &Tally::NONE)?,
            output: Buffer::new(gl, written, bytes.output)?,
            segments,
        })
    }

    /// Copies the paths there.
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
                            (first..first + CORNERS).for_each(|i| segments.push(i));
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
            Commands::PerPath => CORNERS,
            Commands::Compact => 1,
        }
    }

    /// Finds the paths that are seen, and lists what to draw.
    pub(super) fn cull(&self, gl: &Gl, program: &Program) {
        self.tally.write(0, &[Tally::NONE]);
        self.paths.bind_storage(PATHS);
        self.tally.bind_storage(TALLY);
        match self.commands {
            Commands::PerPath => self.output.bind_storage(COMMANDS),
            Commands::Compact => {
                self.segments.bind_storage(SEGMENTS);
                self.output.bind_storage(PATCHES);
            }
        }
        gl.dispatch(program, self.path_count.div_ceil(WORKGROUP));
    }

    /// Draws what was listed.
    pub(super) fn draw(&self, gl: &Gl, program: &Program) {
        match self.commands {
            Commands::PerPath => gl.draw_commands(
                program,
                &self.vertices,
                &self.output,
                &self.tally,
                self.path_count,
            ),
            Commands::Compact => {
                self.output.bind_storage(PATCHES);
                self.points.bind_storage(POINTS);
                gl.draw_command(program, &self.vertices, &self.tally, Tally::COMMAND_OFFSET);
            }
        }
    }

    /// Paths that the last pre-pass found; waits for it.
    pub(super) fn seen_paths(&self) -> u64 {
        u64::from(self.tally().drawn)
    }

    /// All that the last pre-pass found; waits for it, and reads commands back where nothing else tells.
    pub(super) fn seen(&self) -> Seen {
        let tally = self.tally();
        let vertices = match self.commands {
            Commands::PerPath => {
                let mut commands = vec![DrawElements::default(); tally.drawn as usize];
                self.output.read(&mut commands);
                commands.iter().map(|c| u64::from(c.index_count)).sum()
            }
            Commands::Compact => u64::from(tally.vertex_count),
        };
        Seen {
            paths: u64::from(tally.drawn),
            segments: vertices / u64::from(CORNERS),
        }
    }

    fn tally(&self) -> Tally {
        let mut tally = [Tally::NONE];
        self.tally.read(&mut tally);
        tally[0]
    }

    pub(super) fn path_count(&self) -> u64 {
        u64::from(self.path_count)
    }

    /// Bytes of all buffers.
    pub(super) fn bytes(&self) -> u64 {
        let buffers = [
            &self.points,
            &self.paths,
            &self.tally,
            &self.output,
            &self.segments,
        ];
        buffers.iter().map(|buffer| buffer.bytes()).sum()
    }
}

/// Bytes that [`Chunk::fill`] holds in host memory.
pub(super) const STAGING_BYTES: u64 = 3 * Upload::<u32>::PIECE_BYTES as u64;

/// A buffer being written, piece by piece.
struct Upload<'a, T> {
    buffer: &'a Buffer,
    piece: Vec<T>,
    /// Items so far.
    written: u32,
}

impl<'a, T: Pod> Upload<'a, T> {
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
