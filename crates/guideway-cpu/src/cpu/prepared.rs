use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use guideway_render::{
    Budget, Cancel, Frame, Preparation, Prepared, RenderError, Report, Shading, Stage, Style, View,
    density, elapsed_ms,
};
use guideway_scene::Scene;
use guideway_spline::{Bounds, Point};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::NAME;
use super::bin::{Bins, Grid};
use super::canvas::Canvas;
use super::cover::Band;
use super::cull::{CLUSTER_PATHS, cluster_bounds, cluster_paths};
use super::lines::{Line, Lines, Shot, TooMuch};
use super::span::TILE_PX;

/// Groups of lines a thread: enough that none waits long for the last.
const GROUPS_A_THREAD: usize = 4;
/// Largest frame that is planned for.
const PLANNED_PIXELS: u64 = 3840 * 2160;

/// A scene with what stays the same from frame to frame, and the buffers of the last one.
pub(super) struct CpuPrepared {
    scene: Arc<Scene>,
    budget: Budget,
    /// None for the threads that the process shares.
    pool: Option<ThreadPool>,
    clusters: Vec<Option<Bounds<f64>>>,
    widest_m: Option<f32>,
    preparation: Preparation,
    buffers: Buffers,
}

/// What a frame needs; kept for the next.
#[derive(Default)]
struct Buffers {
    visible: Vec<u32>,
    lines: Lines,
    bins: Bins,
    counts: Vec<f32>,
    stages: Vec<Stage>,
    peak_bytes: u64,
}

/// See [`guideway_render::Method::plan_bytes`].
pub(super) fn plan_bytes(scene: &Scene, budget: &Budget) -> u64 {
    // Two lines a segment on three tiles each are far more than a view of all paths takes; closer views
    // have more lines of fewer paths. Whatever it is, bands keep it within the budget.
    let segments = scene.layout().paths.geometry().segment_count() as u64;
    let a_line = Lines::bytes_for(1) + 3 * size_of::<u32>() as u64;
    let frame = PLANNED_PIXELS * size_of::<[u8; 4]>() as u64;
    let all = fixed_bytes(scene, budget) + 2 * frame + 2 * segments * a_line;
    all.min(budget.memory_bytes)
}

/// Bytes that are needed however small the picture.
fn fixed_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let clusters = scene.draw_order().len().div_ceil(CLUSTER_PATHS) as u64;
    let a_cluster = size_of::<Option<Bounds<f64>>>() + size_of::<u32>();
    clusters * a_cluster as u64 + threads(budget) as u64 * Canvas::bytes()
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
        let clusters = install(pool.as_ref(), || cluster_bounds(&scene));
        let held_bytes = (clusters.len() * size_of::<Option<Bounds<f64>>>()) as u64;
        let drawn = scene.draw_order().iter();
        let widest_m = drawn
            .filter_map(|&path| scene.width_m(path))
            .reduce(f32::max);
        Ok(Self {
            scene,
            budget: *budget,
            pool,
            preparation: Preparation {
                stages: vec![Stage::host("bound", elapsed_ms(start))],
                held_bytes,
                peak_bytes: held_bytes,
                ..Preparation::default()
            },
            clusters,
            widest_m,
            buffers: Buffers::default(),
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
        let size = view.size();
        let mut needed = fixed_bytes(&self.scene, &self.budget);
        needed += (size.pixels() * size_of::<[u8; 4]>()) as u64;
        if style.shading != Shading::Color {
            needed += (size.pixels() * size_of::<f32>()) as u64;
        }
        let Some(spare_bytes) = self.budget.memory_bytes.checked_sub(needed) else {
            return Err(too_small("the picture", needed, &self.budget));
        };
        frame.resize(size);
        let Self {
            scene,
            budget,
            pool,
            clusters,
            widest_m,
            buffers,
            preparation: _,
        } = self;
        let shot = Shot {
            scene,
            view,
            style,
            cancel,
        };
        let groups = GROUPS_A_THREAD * threads(budget);
        buffers.start();
        let bands = install(pool.as_ref(), || {
            buffers.time("cull", |b| b.cull(&shot, clusters, *widest_m));
            buffers.draw(&shot, groups, spare_bytes, budget, frame)
        })?;
        let drawn = buffers.lines.drawn();
        Ok(Report {
            stages: std::mem::take(&mut buffers.stages),
            lines: buffers.lines.made(),
            peak_bytes: needed - (size.pixels() * size_of::<[u8; 4]>()) as u64 + buffers.peak_bytes,
            bands,
            ..Report::of(NAME, scene, drawn)
        })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}

impl Buffers {
    fn start(&mut self) {
        self.stages.clear();
        self.peak_bytes = 0;
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

    /// Finds the clusters that may leave a mark.
    fn cull(&mut self, shot: &Shot<'_>, clusters: &[Option<Bounds<f64>>], widest_m: Option<f32>) {
        let px_per_m = shot.view.px_per_m();
        let radius = |width_m| shot.style.line_rule.radius_px(width_m, px_per_m);
        let seen = shot.seen(radius(None).max(radius(widest_m)));
        let is_seen = |bounds: Bounds<f64>| {
            let corners = [bounds.min, bounds.max].map(|p| shot.view.pixel_from_world(p));
            Bounds::of_points(corners).is_some_and(|b| b.intersects(seen))
        };
        let in_sight = clusters
            .iter()
            .zip(0..)
            .filter(|(b, _)| b.is_some_and(is_seen));
        self.visible.clear();
        self.visible.extend(in_sight.map(|(_, cluster)| cluster));
    }

    /// Draws the picture in as many bands as the memory makes necessary, and says how many.
    fn draw(
        &mut self,
        shot: &Shot<'_>,
        groups: usize,
        spare_bytes: u64,
        budget: &Budget,
        frame: &mut Frame,
    ) -> Result<u32, RenderError> {
        let whole = Grid::whole(shot.view.size());
        let is_density = shot.style.shading != Shading::Color;
        let mut counts = std::mem::take(&mut self.counts);
        counts.resize(
            if is_density {
                shot.view.size().pixels()
            } else {
                0
            },
            0.0,
        );
        let mut bands = 1;
        if self
            .band(shot, groups, &whole, spare_bytes, frame, &mut counts)?
            .is_err()
        {
            let costs = self.time("plan", |b| b.row_costs(shot, groups, &whole))?;
            let planned = plan_bands(&costs, spare_bytes);
            let planned = planned.map_err(|needed| {
                let fixed = budget.memory_bytes - spare_bytes;
                too_small("the lines of one row of tiles", fixed + needed, budget)
            })?;
            bands = planned.len() as u32;
            for rows in planned {
                let grid = Grid { rows, ..whole };
                let done = self.band(shot, groups, &grid, spare_bytes, frame, &mut counts)?;
                debug_assert!(done.is_ok(), "the plan counts everything");
            }
        }
        if let Shading::Density(tone) = shot.style.shading {
            let background = shot.style.background;
            self.time("shade", |_| {
                density::shade(&counts, tone, background, frame);
            });
        }
        self.counts = counts;
        Ok(bands)
    }

    /// Draws one band, unless it takes too much memory.
    fn band(
        &mut self,
        shot: &Shot<'_>,
        groups: usize,
        grid: &Grid,
        limit_bytes: u64,
        frame: &mut Frame,
        counts: &mut [f32],
    ) -> Result<Result<(), TooMuch>, RenderError> {
        // What another band or view left behind may be large in other places than this one.
        self.lines.shrink(limit_bytes / 4);
        self.bins.shrink(limit_bytes / 4);
        let flattened = self.time("flatten", |b| {
            b.lines.fill(shot, &b.visible, groups, grid, limit_bytes)
        })?;
        if flattened.is_err() {
            return Ok(flattened);
        }
        let binned = self.time("bin", |b| b.bins.fill(shot, &b.lines, grid, limit_bytes))?;
        self.peak_bytes = self.peak_bytes.max(self.lines.bytes() + self.bins.bytes());
        if binned.is_err() {
            return Ok(binned);
        }
        self.time("cover", |b| {
            let band = Band {
                shot,
                grid,
                lines: &b.lines,
                bins: &b.bins,
            };
            let size = shot.view.size();
            let row_px = size.width() as usize * TILE_PX;
            let end = size.pixels().min(grid.rows.end * row_px);
            let within = grid.rows.start * row_px..end;
            match shot.style.shading {
                Shading::Color => band.color(&mut frame.pixels_mut()[within]),
                Shading::Density(_) => band.density(&mut counts[within]),
            }
        })?;
        Ok(Ok(()))
    }

    /// Bytes that the lines of each row of tiles take.
    fn row_costs(
        &self,
        shot: &Shot<'_>,
        groups: usize,
        whole: &Grid,
    ) -> Result<Vec<u64>, RenderError> {
        let tables = Bins::table_bytes(groups, whole.columns);
        let none = || vec![0; whole.rows.len()];
        let per_group = self.visible.len().div_ceil(groups).max(1);
        let lines = self.visible.par_chunks(per_group).map(|clusters| {
            let mut costs = none();
            let mut points: Vec<Point<f64>> = Vec::new();
            for &cluster in clusters {
                shot.cancel.check()?;
                for &path in cluster_paths(shot.scene, cluster) {
                    shot.flatten(path, &mut points, |line, radius_px| {
                        add_cost(&mut costs, whole, &line, radius_px);
                    });
                }
            }
            Ok(costs)
        });
        let add = |a: Vec<u64>, b: Vec<u64>| a.iter().zip(b).map(|(a, b)| a + b).collect();
        let mut costs = lines.try_reduce(none, |a, b| Ok(add(a, b)))?;
        costs.iter_mut().for_each(|cost| *cost += tables);
        Ok(costs)
    }
}

fn add_cost(costs: &mut [u64], grid: &Grid, line: &Line, radius_px: f32) {
    for row in grid.rows_of(line, radius_px) {
        let tiles = grid.columns_of(line, radius_px, row).len();
        costs[row] += Lines::bytes_for(1) + (tiles * size_of::<u32>()) as u64;
    }
}

/// Bands of rows, as few as a greedy search finds, that each cost no more than the limit; or what a row
/// costs that alone is too much.
fn plan_bands(costs: &[u64], limit_bytes: u64) -> Result<Vec<Range<usize>>, u64> {
    let mut bands = Vec::new();
    let (mut start, mut held) = (0, 0);
    for (row, &cost) in costs.iter().enumerate() {
        if cost > limit_bytes {
            return Err(cost);
        }
        if held + cost > limit_bytes {
            bands.push(start..row);
            (start, held) = (row, 0);
        }
        held += cost;
    }
    bands.push(start..costs.len());
    Ok(bands)
}
