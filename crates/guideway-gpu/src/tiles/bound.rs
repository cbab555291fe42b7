//! The dispatches of a frame, with what each of them binds: made once for as long as the buffers are the same.

use guideway_scene::Stage;

use super::canvas::Canvas;
use super::chunk::Drawn;
use super::kernels::{Kernels, MOST_PARTS_BITS};
use super::paint::Paint;
use super::params::{
    COUNTED_EACH, FEW_CLUSTERS, Found, FrameParams, LINE_THREADS, SHARED_PARTS, SHARED_TILES,
    STARTS_THREADS, Samples, WORKGROUP,
};
use super::room::Room;
use super::store::Store;
use crate::device::{Bindings, DeviceBuffer, Dispatch, Gpu, Kernel, Runner};

/// Most workgroups of a kernel that goes round until nothing is left.
const MOST_ROUNDS_GROUPS: u32 = 1 << 14;

/// The one stage of a frame whose stages are not told apart.
const WHOLE: &str = "draw";

/// All buffers of a frame.
pub(super) struct Buffers<'a> {
    pub(super) gpu: &'a Gpu,
    pub(super) kernels: &'a Kernels,
    pub(super) store: &'a Store,
    pub(super) room: &'a Room,
    pub(super) canvas: &'a Canvas,
    /// Tiles that several workgroups cover, where they may.
    pub(super) shares: Option<&'a DeviceBuffer>,
    /// Clusters that were touched, if any has been.
    pub(super) touched: Option<&'a DeviceBuffer>,
    /// Whether the clock tells stages apart.
    pub(super) times_stages: bool,
}

/// What frames before have left, or have shown to take less time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Manner {
    /// Lines are there.
    pub(super) has_lines: bool,
    /// But for those of clusters that were touched.
    pub(super) renews: bool,
    /// They are listed at once, where each tile has places for so many.
    pub(super) lists_at_once: bool,
    /// What is hidden is left out.
    pub(super) is_in_rounds: bool,
    /// Several workgroups flatten each cluster.
    pub(super) has_few: bool,
    /// Several workgroups cover some tiles.
    pub(super) shares: bool,
}

/// The stages of a frame, with all that they bind.
pub(super) struct Bound {
    paint: Paint,
    samples: Samples,
    manner: Manner,
    stages: Vec<(&'static str, Vec<Step>)>,
}

/// A kernel with its buffers.
struct Step {
    kernel: Kernel,
    bindings: Bindings,
    over: Over,
}

/// What a kernel has workgroups for.
#[derive(Clone, Copy)]
enum Over {
    /// Threads for all clusters.
    Clusters,
    /// A workgroup for each cluster that was touched.
    Touched,
    /// So many workgroups for clusters in turn, if any is drawn.
    Seen(u32, Drawn),
    /// Workgroups of so many threads for lines in turn.
    Lines(u32),
    /// Workgroups for lines that are there, with all threads of each.
    KeptLines,
    /// A workgroup a tile.
    Tiles,
    /// A workgroup for each part of a list that there may be, and then for each tile.
    PartsAndTiles,
    /// A workgroup for each shared tile that there may be.
    SharedTiles,
    /// Threads for all tiles.
    ThreadsForTiles,
}

impl Bound {
    pub(super) fn new(
        b: &Buffers<'_>,
        paint: Paint,
        samples: Samples,
        manner: Manner,
    ) -> Result<Self, String> {
        let mut bound = Self {
            paint,
            samples,
            manner,
            stages: Vec::new(),
        };
        let (kernels, found) = (b.kernels, &b.store.found);
        if manner.has_lines {
            if let Some(touched) = b.touched.filter(|_| manner.renews) {
                let buffers = [
                    &b.canvas.frame,
                    &b.store.clusters,
                    found,
                    &b.room.lines,
                    touched,
                ];
                bound.add("strike", b, &kernels.strike, Over::Touched, &buffers)?;
                bound.add_lines(b, 0)?;
            }
            bound.add_kept(b)?;
            return Ok(bound);
        }
        let cull = [&b.canvas.frame, &b.store.clusters, found];
        bound.add("cull", b, &kernels.cull, Over::Clusters, &cull)?;
        if manner.is_in_rounds {
            bound.add_round(b, 1)?;
            bound.add_round(b, 2)?;
        } else {
            bound.add_round(b, 0)?;
        }
        Ok(bound)
    }

    /// Adds the stages from curves to pixels.
    fn add_round(&mut self, b: &Buffers<'_>, round: usize) -> Result<(), String> {
        self.add_lines(b, round)?;
        self.add_tiles(b)
    }

    /// Adds the stage from curves to lines.
    fn add_lines(&mut self, b: &Buffers<'_>, round: usize) -> Result<(), String> {
        let Store {
            strokes,
            clusters,
            styles,
            found,
            ..
        } = b.store;
        for chunk in b.store.all_chunks() {
            let buffers = [
                &b.canvas.frame,
                &chunk.params[round],
                &chunk.points,
                strokes,
                clusters,
                styles,
                found,
                &b.room.lines,
                &b.room.line_ranks,
                &b.canvas.counts,
            ];
            let (has_few, clusters) = (self.manner.has_few, chunk.clusters.len() as u32);
            // A few clusters beside many have a launch of their own, which is as long as its slowest workgroup.
            let are_few = clusters <= FEW_CLUSTERS && !has_few;
            let kernel = &b.kernels.flatten[usize::from(are_few || has_few)][chunk.held as usize];
            let parts_bits = if are_few { MOST_PARTS_BITS } else { 0 };
            let over = Over::Seen(clusters << parts_bits, chunk.drawn);
            self.add("flatten", b, kernel, over, &buffers)?;
        }
        Ok(())
    }

    /// Adds the stages from lines that are there to pixels.
    fn add_kept(&mut self, b: &Buffers<'_>) -> Result<(), String> {
        let (kernels, room, canvas) = (b.kernels, b.room, b.canvas);
        let mut buffers = vec![
            &canvas.frame,
            &b.store.found,
            &room.lines,
            &room.line_ranks,
            &b.store.styles,
            &canvas.counts,
        ];
        if self.manner.lists_at_once {
            buffers.push(&room.reference_list);
            self.add("list", b, &kernels.list_kept, Over::KeptLines, &buffers)?;
            return self.add_cover(b);
        }
        let over = Over::Lines(LINE_THREADS * COUNTED_EACH);
        self.add("count", b, &kernels.recount, over, &buffers)?;
        self.add_tiles(b)
    }

    /// Adds the stages from lines to pixels.
    fn add_tiles(&mut self, b: &Buffers<'_>) -> Result<(), String> {
        let kernels = b.kernels;
        let (
            Store { styles, found, .. },
            Room {
                lines,
                line_ranks,
                reference_list: references,
                ..
            },
        ) = (b.store, b.room);
        let Canvas {
            frame,
            counts,
            lists,
            filled,
            ..
        } = b.canvas;
        let buffers = [frame, counts, lists, filled, found];
        self.add(
            "starts",
            b,
            &kernels.starts,
            Over::ThreadsForTiles,
            &buffers,
        )?;
        let shares = b.shares.filter(|_| self.manner.shares);
        if let Some(shares) = shares {
            let buffers = [frame, lists, found, shares];
            self.add("starts", b, &kernels.share, Over::ThreadsForTiles, &buffers)?;
        }
        let buffers = [frame, found, lines, line_ranks, styles, filled, references];
        self.add(
            "list",
            b,
            &kernels.scatter,
            Over::Lines(LINE_THREADS),
            &buffers,
        )?;
        if self.paint.needs_order() {
            let buffers = [frame, lists, references, line_ranks, found];
            for sort in &kernels.sort {
                self.add("sort", b, sort, Over::Tiles, &buffers)?;
            }
        }
        self.add_cover(b)
    }

    /// Adds the stage from lists to pixels.
    fn add_cover(&mut self, b: &Buffers<'_>) -> Result<(), String> {
        let (kernels, room, canvas) = (b.kernels, b.room, b.canvas);
        let mut buffers = vec![
            &canvas.frame,
            &canvas.lists,
            &room.reference_list,
            &room.lines,
            &room.line_ranks,
            &b.store.styles,
            &canvas.pixels,
        ];
        match self.paint {
            Paint::One => buffers.extend([&canvas.counts, &b.store.found]),
            Paint::Opaque | Paint::Translucent | Paint::Density => buffers.push(&b.store.found),
        }
        let shares = b.shares.filter(|_| self.manner.shares);
        let shared = kernels.painters(self.samples).shared.as_ref();
        if let Some(([cover, show], shares)) = shared.zip(shares) {
            buffers.push(shares);
            self.add("cover", b, cover, Over::PartsAndTiles, &buffers)?;
            return self.add("cover", b, show, Over::SharedTiles, &buffers);
        }
        let kernel = self.paint.kernel(kernels, self.samples);
        self.add("cover", b, kernel, Over::Tiles, &buffers)
    }

    fn add(
        &mut self,
        name: &'static str,
        b: &Buffers<'_>,
        kernel: &Kernel,
        over: Over,
        buffers: &[&DeviceBuffer],
    ) -> Result<(), String> {
        let step = Step {
            kernel: kernel.clone(),
            bindings: kernel.bind(b.gpu, buffers)?,
            over,
        };
        let name = if b.times_stages { name } else { WHOLE };
        match self.stages.last_mut() {
            Some((last, steps)) if *last == name => steps.push(step),
            _ => self.stages.push((name, vec![step])),
        }
        Ok(())
    }

    pub(super) fn is_for(&self, paint: Paint, samples: Samples, manner: Manner) -> bool {
        (self.paint, self.samples, self.manner) == (paint, samples, manner)
    }

    /// Runs all stages one after the other.
    pub(super) fn run(
        &self,
        b: &Buffers<'_>,
        params: &FrameParams,
        runner: &Runner,
    ) -> Result<Vec<Stage>, String> {
        let in_turn = |items: u32| items.clamp(1, MOST_ROUNDS_GROUPS.min(b.gpu.most_workgroups()));
        let lines = match params.kept_lines {
            0 => b.room.size.lines,
            kept => kept,
        };
        let workgroups = |over| match over {
            Over::Clusters => params.clusters.div_ceil(WORKGROUP),
            Over::Touched => params.touched,
            Over::Seen(_, drawn) if !drawn.is_any(params.most_step_m) => 0,
            Over::Seen(clusters, _) if params.touched == 0 => in_turn(clusters),
            Over::Seen(clusters, _) => in_turn(clusters.min(params.touched << MOST_PARTS_BITS)),
            Over::Lines(threads) => in_turn(lines.div_ceil(threads)),
            Over::KeptLines => {
                let threads = params.kept_lines * params.threads_a_line;
                in_turn(threads.div_ceil(LINE_THREADS))
            }
            Over::Tiles => params.columns * params.rows,
            Over::PartsAndTiles => SHARED_PARTS + params.columns * params.rows,
            Over::SharedTiles => SHARED_TILES,
            Over::ThreadsForTiles => (params.columns * params.rows).div_ceil(STARTS_THREADS),
        };
        let dispatches: Vec<Vec<_>> = self
            .stages
            .iter()
            .map(|(_, steps)| {
                let dispatch = |step| dispatch(step, workgroups(step.over));
                steps.iter().map(dispatch).collect()
            })
            .collect();
        let names = self.stages.iter().map(|(name, _)| *name);
        let stages: Vec<_> = names.zip(dispatches.iter().map(Vec::as_slice)).collect();
        let counts = &b.canvas.counts;
        let cleared = [
            (&b.store.found, size_of::<Found>() as u64),
            (counts, counts.bytes()),
        ];
        runner.run_stages("the frame", &cleared, &stages)
    }
}

fn dispatch(step: &Step, workgroups: u32) -> Dispatch<'_> {
    Dispatch {
        kernel: &step.kernel,
        bindings: &step.bindings,
        workgroups,
    }
}
