use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use guideway_render::density::{ToneMap, Tones};
use guideway_render::{
    Budget, Cancel, Edited, Frame, Preparation, Prepared, RenderError, Report, Shading, Stage,
    Strip, Style, View, elapsed_ms,
};
use guideway_scene::{Edit, Scene};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::NAME;
use super::cluster::{CLUSTER_PATHS, Cluster, Lines, Scratch};
use super::index::Index;
use super::paint::{Band, Painter};
use super::shot::{LaneWidth, Shot};
use super::tiles::{Bins, Grid};

/// Largest frame that is planned for.
const PLANNED_PIXELS: u64 = 3840 * 2160;
/// Pixels that are drawn at once of a picture that is drawn in strips.
const STRIP_PIXELS: usize = 1 << 25;
/// Bytes that a path's lines take where all are seen, about: more are there only for fewer paths.
const PLANNED_PATH_BYTES: u64 = 100;

/// A scene with what stays the same from frame to frame, and the buffers of the last one.
pub(super) struct CpuPrepared {
    scene: Arc<Scene>,
    budget: Budget,
    /// None for the threads that the process shares.
    pool: Option<ThreadPool>,
    index: Index,
    preparation: Preparation,
    buffers: Buffers,
    /// Of the last picture that was drawn in strips by density.
    tones: Option<(View, Style, Tones)>,
    pub(super) lane_width: LaneWidth,
}

/// What a frame needs; kept for the next.
struct Buffers {
    bins: Bins,
    counts: Vec<f32>,
    scratches: Vec<Mutex<Scratch>>,
    painters: Vec<Mutex<Painter>>,
    stages: Vec<Stage>,
    peak_bytes: u64,
    drawn: u64,
    made: u64,
}

/// There is more than the memory allowed: so many bytes, at least.
struct TooMuch(u64);

/// See [`guideway_render::Method::plan_bytes`].
pub(super) fn plan_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let frame = PLANNED_PIXELS * size_of::<[u8; 4]>() as u64;
    let lines = scene.row_count() as u64 * PLANNED_PATH_BYTES;
    let all = fixed_bytes(scene, budget) + 2 * frame + lines;
    all.min(budget.memory_bytes)
}

/// Bytes that are needed however small the picture.
fn fixed_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let clusters = scene.row_count().div_ceil(CLUSTER_PATHS) * size_of::<Cluster>();
    let rows = scene.row_count() * 3 * size_of::<u32>();
    (clusters + rows) as u64 + threads(budget) as u64 * Painter::bytes(scene.is_opaque())
}

fn threads(budget: &Budget) -> usize {
    if budget.threads > 0 {
        budget.threads
    } else {
        rayon::current_num_threads()
    }
}

fn too_small(what: &'static str, needed_bytes: u64, budget: &Budget) -> RenderError {
    RenderError::Budget {
        method: NAME,
        what,
        needed_bytes,
        budget_bytes: budget.memory_bytes,
    }
}

impl CpuPrepared {
    pub(super) fn new(scene: Arc<Scene>, budget: &Budget) -> Result<Self, RenderError> {
        let fixed = fixed_bytes(&scene, budget);
        if fixed > budget.memory_bytes {
            return Err(too_small("the index of the paths", fixed, budget));
        }
        // If the system gives no more threads, those that the process shares do.
        let builder = ThreadPoolBuilder::new().num_threads(budget.threads);
        let pool = (budget.threads > 0).then(|| builder.build().ok()).flatten();
        let start = Instant::now();
        let index = install(pool.as_ref(), || Index::new(&scene));
        let held_bytes = index.bytes();
        let threads = threads(budget);
        Ok(Self {
            scene,
            budget: *budget,
            pool,
            index,
            preparation: Preparation {
                stages: vec![Stage::host("sort", elapsed_ms(start))],
                held_bytes,
                peak_bytes: held_bytes,
                ..Preparation::default()
            },
            buffers: Buffers::new(threads),
            tones: None,
            lane_width: LaneWidth::default(),
        })
    }
}

fn install<R: Send>(pool: Option<&ThreadPool>, work: impl FnOnce() -> R + Send) -> R {
    match pool {
        Some(pool) => pool.install(work),
        None => work(),
    }
}

impl Prepared for CpuPrepared {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.render_strip(&Strip::whole(view), style, cancel, frame)
    }

    fn strip_pixels(&self) -> usize {
        STRIP_PIXELS
    }

    fn render_strip(
        &mut self,
        strip: &Strip,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let pixels = strip.size().pixels();
        let is_density = style.shading != Shading::Color;
        let mut needed = fixed_bytes(&self.scene, &self.budget);
        needed += (pixels * size_of::<[u8; 4]>()) as u64;
        if is_density {
            needed += (pixels * size_of::<f32>()) as u64;
        }
        let Some(spare_bytes) = self.budget.memory_bytes.checked_sub(needed) else {
            return Err(too_small("the picture", needed, &self.budget));
        };
        frame.resize(strip.size());
        let Self {
            scene,
            budget,
            pool,
            index,
            buffers,
            tones,
            lane_width,
            ..
        } = self;
        let shot = Shot {
            scene,
            strip,
            view: strip.view(),
            style,
            cancel,
            widths: index.widths,
            lane_width: *lane_width,
            solid: index.solid.filter(|_| !is_density),
        };
        buffers.start();
        let bands = install(pool.as_ref(), || {
            buffers.time("cull", |_| {
                index
                    .clusters
                    .par_iter_mut()
                    .for_each(|cluster| cluster.look(&shot));
            });
            let bands = match style.shading {
                Shading::Color => buffers.draw(&shot, index, spare_bytes, frame)?,
                Shading::Density(tone) => {
                    buffers.draw_density(&shot, index, spare_bytes, tone, tones, frame)?
                }
            };
            bands.map_err(|TooMuch(bytes)| {
                too_small("the lines of one row of tiles", needed + bytes, budget)
            })
        })?;
        Ok(Report {
            stages: std::mem::take(&mut buffers.stages),
            lines: buffers.made,
            peak_bytes: needed - (pixels * size_of::<[u8; 4]>()) as u64 + buffers.peak_bytes,
            bands,
            ..Report::of(NAME, scene, buffers.drawn)
        })
    }

    fn edit(&mut self, edit: &Edit) -> Result<Edited, RenderError> {
        let Self {
            scene,
            budget,
            pool,
            index,
            tones,
            ..
        } = self;
        Arc::make_mut(scene).edit(edit).map_err(RenderError::Edit)?;
        *tones = None;
        let fixed = fixed_bytes(scene, budget);
        if fixed > budget.memory_bytes {
            return Err(too_small("the index of the paths", fixed, budget));
        }
        install(pool.as_ref(), || match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => {
                index.touch(scene, paths);
            }
            Edit::Restyle(_) => index.order_anew(scene),
            Edit::SetStates(_) => {
                index.touch(scene, &edit.paths().collect::<Vec<_>>());
                index.order_anew(scene);
            }
            Edit::Insert(_) => {
                index.append(scene);
                index.order_anew(scene);
            }
        });
        Ok(Edited::InPlace { moved_bytes: 0 })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}

impl Buffers {
    fn new(threads: usize) -> Self {
        Self {
            bins: Bins::default(),
            counts: Vec::new(),
            scratches: (0..threads).map(|_| Mutex::default()).collect(),
            painters: (0..threads).map(|_| Mutex::new(Painter::new())).collect(),
            stages: Vec::new(),
            peak_bytes: 0,
            drawn: 0,
            made: 0,
        }
    }

    fn start(&mut self) {
        self.stages.clear();
        (self.peak_bytes, self.drawn, self.made) = (0, 0, 0);
    }

    /// Does one stage, and adds its time to what it took in other bands.
    fn time<R>(&mut self, name: &'static str, work: impl FnOnce(&mut Self) -> R) -> R {
        let start = Instant::now();
        let result = work(self);
        let elapsed_ms = elapsed_ms(start);
        match self.stages.iter_mut().find(|s| s.name == name) {
            Some(stage) => stage.elapsed_ms += elapsed_ms,
            None => self.stages.push(Stage::host(name, elapsed_ms)),
        }
        result
    }

    /// Counts paths and colours the counts; says in how many bands. A part of a picture is coloured by how all of it
    /// is, which is looked at once.
    fn draw_density(
        &mut self,
        shot: &Shot<'_>,
        index: &mut Index,
        limit_bytes: u64,
        tone: ToneMap,
        kept: &mut Option<(View, Style, Tones)>,
        frame: &mut Frame,
    ) -> Result<Result<u32, TooMuch>, RenderError> {
        let mut tones = Tones::new(tone);
        if !shot.strip.is_whole() {
            let known = kept.take();
            let known = known.filter(|(view, style, _)| view == shot.view && style == shot.style);
            if let Some((_, _, known)) = known {
                tones = known;
            } else {
                for strip in shot.view.strips(shot.strip.size().pixels()) {
                    let strip = &strip;
                    let counted = self.draw(&Shot { strip, ..*shot }, index, limit_bytes, frame)?;
                    if let Err(too_much) = counted {
                        return Ok(Err(too_much));
                    }
                    tones.look(&self.counts);
                }
                (self.drawn, self.made) = (0, 0);
            }
        }
        let drawn = self.draw(shot, index, limit_bytes, frame)?;
        self.time("shade", |b| {
            if shot.strip.is_whole() {
                tones.look(&b.counts);
            }
            tones.shade(&b.counts, shot.style.background, frame);
        });
        *kept = Some((*shot.view, *shot.style, tones));
        Ok(drawn)
    }

    /// Draws a strip: pixels, or the counts of paths for them. Says in how many bands.
    fn draw(
        &mut self,
        shot: &Shot<'_>,
        index: &mut Index,
        limit_bytes: u64,
        frame: &mut Frame,
    ) -> Result<Result<u32, TooMuch>, RenderError> {
        if shot.style.shading != Shading::Color {
            self.counts.resize(shot.strip.size().pixels(), 0.0);
        }
        self.draw_rows(shot, index, shot.tile_rows(), limit_bytes, frame)
    }

    /// Draws some rows of tiles, at once or, if that takes too much memory, one half after the other; says
    /// in how many bands.
    fn draw_rows(
        &mut self,
        shot: &Shot<'_>,
        index: &mut Index,
        rows: Range<usize>,
        limit_bytes: u64,
        frame: &mut Frame,
    ) -> Result<Result<u32, TooMuch>, RenderError> {
        let drawn = self.band(shot, index, rows.clone(), limit_bytes, frame)?;
        if drawn.is_ok() || rows.len() == 1 {
            return Ok(drawn.map(|()| 1));
        }
        let middle = rows.start + rows.len() / 2;
        let mut bands = 0;
        for half in [rows.start..middle, middle..rows.end] {
            match self.draw_rows(shot, index, half, limit_bytes, frame)? {
                Ok(of_half) => bands += of_half,
                Err(too_much) => return Ok(Err(too_much)),
            }
        }
        Ok(Ok(bands))
    }

    /// Draws one band, unless it takes too much memory.
    fn band(
        &mut self,
        shot: &Shot<'_>,
        index: &mut Index,
        rows: Range<usize>,
        limit_bytes: u64,
        frame: &mut Frame,
    ) -> Result<Result<(), TooMuch>, RenderError> {
        let grid = Grid {
            rows: rows.clone(),
            ..Grid::whole(shot.view.size())
        };
        let flattened = self.time("flatten", |b| b.flatten(shot, index, &rows, limit_bytes))?;
        let lines_bytes = match flattened {
            Ok(bytes) => bytes,
            Err(too_much) => return Ok(Err(too_much)),
        };
        let spare_bytes = limit_bytes - lines_bytes;
        if let Err(needed) = self.time("bin", |b| b.bins.fill(&index.clusters, &grid, spare_bytes))
        {
            return Ok(Err(TooMuch(lines_bytes + needed)));
        }
        self.peak_bytes = self.peak_bytes.max(lines_bytes + self.bins.bytes());
        for sight in index.clusters.iter().filter_map(|c| c.sight.as_ref()) {
            // Each cluster is counted with the band where it begins.
            if rows.contains(&sight.rows.start) {
                self.drawn += u64::from(sight.drawn);
                self.made += u64::from(sight.made);
            }
        }
        self.time("cover", |b| {
            let mut counts = std::mem::take(&mut b.counts);
            let band = Band {
                shot,
                grid: &grid,
                paths: &index.paths,
                clusters: &index.clusters,
                bins: &b.bins,
                ranks: index.ranks.as_deref(),
                common_radius_px: shot.common_radius_px(),
                widest_px: shot.widest_px(),
                painters: &b.painters,
            };
            let within = shot.pixels_of(&rows);
            let done = match shot.style.shading {
                Shading::Color => band.color(&mut frame.pixels_mut()[within], shot.solid),
                Shading::Density(_) => band.density(&mut counts[within]),
            };
            b.counts = counts;
            done
        })?;
        Ok(Ok(()))
    }

    /// Makes the lines of a band; says how many bytes all lines take.
    fn flatten(
        &mut self,
        shot: &Shot<'_>,
        index: &mut Index,
        rows: &Range<usize>,
        limit_bytes: u64,
    ) -> Result<Result<u64, TooMuch>, RenderError> {
        let is_in_band = |cluster: &Cluster| {
            let sight = cluster.sight.as_ref();
            sight.is_some_and(|s| s.rows.start < rows.end && rows.start < s.rows.end)
        };
        let mut held: u64 = index.clusters.par_iter().map(Cluster::bytes).sum();
        if held > limit_bytes / 2 {
            let others = index.clusters.par_iter_mut().filter(|c| !is_in_band(c));
            others.for_each(|cluster| cluster.lines = Lines::None);
            held = index.clusters.par_iter().map(Cluster::bytes).sum();
        }
        let total = AtomicU64::new(held);
        let scratches = &self.scratches;
        let paths = index.paths.par_chunks(CLUSTER_PATHS);
        index
            .clusters
            .par_iter_mut()
            .zip(paths)
            .try_for_each(|(cluster, paths)| {
                if !is_in_band(cluster) || total.load(Ordering::Relaxed) > limit_bytes {
                    return Ok(());
                }
                shot.cancel.check()?;
                let scratch =
                    &scratches[rayon::current_thread_index().unwrap_or(0) % scratches.len()];
                let mut scratch = scratch.lock().unwrap_or_else(PoisonError::into_inner);
                let before = cluster.bytes();
                cluster.flatten(shot, paths, rows, &mut scratch);
                total.fetch_add(cluster.bytes().wrapping_sub(before), Ordering::Relaxed);
                Ok(())
            })?;
        let total = total.into_inner();
        if total > limit_bytes {
            index
                .clusters
                .par_iter_mut()
                .for_each(|cluster| cluster.lines = Lines::None);
            return Ok(Err(TooMuch(total)));
        }
        Ok(Ok(total))
    }
}
