//! Runs the stages flatten, bin and cover for the bands of a frame, and keeps their buffers for the
//! next.
//!
//! A band is a range of rows of tiles. The whole frame is one band, unless its lines and lists
//! exceed the memory budget: then each half is a band, and so on down to one row of tiles.

use std::ops::Range;
use std::sync::Mutex;

use bytemuck::cast_slice_mut;
use guideway_layout::clock::Instant;
use guideway_scene::density::{ToneMap, ToneScale};
use guideway_scene::{Frame, RenderError, Shading, Stage, Style, View, elapsed_ms};

use super::clusters::PreparedClusters;
use super::flatten_visible::{DrawError, FlattenInput, count_drawn, flatten_visible};
use super::picture_cache::PictureCache;
use crate::cpu::bin::cull::VisibleClusters;
use crate::cpu::bin::line_lists::BinInput;
use crate::cpu::bin::tile_lists::TileLists;
use crate::cpu::flatten::cluster_lines::FlattenScratch;
use crate::cpu::ground::damage::{DamageMap, TileGrid};
use crate::cpu::ground::frame_context::FrameContext;
use crate::cpu::ground::per_thread::sum;
use crate::cpu::raster::full_pixel_cache::{FullPixelBand, FullPixelLookup};
use crate::cpu::raster::job::{BandJob, BandProbe, ScenePart};
use crate::cpu::raster::resting_coverage::RestingCoverage;
use crate::cpu::raster::thread_scratch::ThreadScratch;
use crate::cpu::raster::tiles::{draw_colors, draw_densities};

/// Buffers of the stages, and counters of the frame.
pub(crate) struct FramePipeline {
    pub(crate) visible: VisibleClusters,
    pub(crate) damage: DamageMap,
    pub(crate) lists: TileLists,
    /// Keys of the visible clusters that have to be flattened.
    pub(crate) dirty_clusters: Vec<u32>,
    /// Number of paths per pixel, if the frame shows densities.
    pub(crate) counts: Vec<f32>,
    flatten_scratches: Vec<Mutex<FlattenScratch>>,
    raster_scratches: Vec<Mutex<ThreadScratch>>,
    pub(crate) stages: Vec<Stage>,
    pub(crate) peak_bytes: u64,
    /// Number of paths and of lines that were drawn.
    pub(crate) path_count: u64,
    pub(crate) line_count: u64,
}

/// A picture that is being drawn.
pub(crate) struct FrameTarget<'a, 'p> {
    pub(crate) ctx: &'a FrameContext<'a>,
    pub(crate) frame: &'p mut Frame,
    /// Pixels of the undamaged parts.
    pub(crate) cached: Option<&'a PictureCache>,
    /// Coverage of the paths that rest while a gesture moves others.
    pub(crate) resting: Option<&'a RestingCoverage>,
    /// Pixels that are known to be full.
    pub(crate) full_pixels: FullPixelLookup<'a>,
    /// Band that receives full pixels, and the pixels that are known to stay full.
    pub(crate) probe: Option<(&'a FullPixelBand, FullPixelLookup<'a>)>,
    /// Most bytes of lines and lists.
    pub(crate) limit_bytes: u64,
}

impl FramePipeline {
    pub(crate) fn new(threads: usize) -> Self {
        let scratch = |_| Mutex::new(ThreadScratch::new());
        Self {
            visible: VisibleClusters::default(),
            damage: DamageMap::default(),
            lists: TileLists::new(),
            dirty_clusters: Vec::new(),
            counts: Vec::new(),
            flatten_scratches: (0..threads).map(|_| Mutex::default()).collect(),
            raster_scratches: (0..threads).map(scratch).collect(),
            stages: Vec::new(),
            peak_bytes: 0,
            path_count: 0,
            line_count: 0,
        }
    }

    /// Resets the counters for a new frame.
    pub(crate) fn start(&mut self) {
        self.stages.clear();
        (self.peak_bytes, self.path_count, self.line_count) = (0, 0, 0);
    }

    /// Runs one stage and adds its time to that of the same stage in other bands.
    pub(crate) fn time<R>(&mut self, name: &'static str, work: impl FnOnce(&mut Self) -> R) -> R {
        let start = Instant::now();
        let result = work(self);
        Stage::merge(&mut self.stages, [Stage::host(name, elapsed_ms(start))]);
        result
    }

    /// Heap bytes of all buffers but lines and tile lists.
    fn scratch_bytes(&self) -> u64 {
        let dirty = self.dirty_clusters.capacity() * size_of::<u32>();
        let of_threads = sum(&self.flatten_scratches, FlattenScratch::bytes)
            + sum(&self.raster_scratches, ThreadScratch::list_bytes);
        self.visible.bytes() + self.damage.bytes() + dirty as u64 + of_threads
    }

    /// Counts the paths per pixel and shades the counts; returns the number of bands.
    ///
    /// The shades of a strip depend on the counts of the whole picture: these are counted once,
    /// strip by strip, and passed from strip to strip in `known`.
    pub(crate) fn draw_density(
        &mut self,
        target: &mut FrameTarget<'_, '_>,
        clusters: &mut PreparedClusters,
        tone: ToneMap,
        known: &mut Option<(View, Style, ToneScale)>,
    ) -> Result<u32, DrawError> {
        let ctx = target.ctx;
        let mut tones = ToneScale::new(tone, ctx.style.background);
        if !ctx.strip.is_whole() {
            let of_picture = known.take();
            let of_picture =
                of_picture.filter(|(view, style, _)| view == ctx.view && style == ctx.style);
            if let Some((_, _, of_picture)) = of_picture {
                tones = of_picture;
            } else {
                for strip in ctx.view.strips(ctx.strip.size().pixels()) {
                    let mut target = FrameTarget {
                        ctx: &FrameContext {
                            strip: &strip,
                            ..*ctx
                        },
                        frame: &mut *target.frame,
                        ..*target
                    };
                    self.damage.fill(&strip);
                    self.draw(&mut target, clusters)?;
                    tones.observe(&self.counts);
                }
                self.damage.fill(ctx.strip);
                (self.path_count, self.line_count) = (0, 0);
            }
        }
        let bands = self.draw(target, clusters)?;
        self.time("shade", |p| {
            if ctx.strip.is_whole() {
                tones.observe(&p.counts);
            }
            tones.shade(&p.counts, target.frame);
        });
        *known = Some((*ctx.view, *ctx.style, tones));
        Ok(bands)
    }

    /// Draws a strip: colors, or the counts of paths per pixel. Returns the number of bands.
    pub(crate) fn draw(
        &mut self,
        target: &mut FrameTarget<'_, '_>,
        clusters: &mut PreparedClusters,
    ) -> Result<u32, DrawError> {
        let strip = target.ctx.strip;
        if target.ctx.style.shading != Shading::Color {
            self.counts.resize(strip.size().pixels(), 0.0);
        }
        self.draw_rows(target, clusters, TileGrid::of(strip).rows)
    }

    /// Draws rows of tiles as one band or, if it exceeds the memory limit, one half after the
    /// other. Returns the number of bands.
    fn draw_rows(
        &mut self,
        target: &mut FrameTarget<'_, '_>,
        clusters: &mut PreparedClusters,
        rows: Range<usize>,
    ) -> Result<u32, DrawError> {
        match self.draw_band(target, clusters, rows.clone()) {
            Ok(()) => return Ok(1),
            Err(DrawError::OverBudget(_)) if rows.len() > 1 => {}
            Err(error) => return Err(error),
        }
        // The buffers of the band are larger than those of its half.
        clusters.cache.evict(|_| false);
        for scratch in &mut self.flatten_scratches {
            *scratch = Mutex::default();
        }
        let middle = rows.start + rows.len() / 2;
        let above = self.draw_rows(target, clusters, rows.start..middle)?;
        let below = self.draw_rows(target, clusters, middle..rows.end)?;
        Ok(above + below)
    }

    /// Draws one band.
    fn draw_band(
        &mut self,
        target: &mut FrameTarget<'_, '_>,
        clusters: &mut PreparedClusters,
        rows: Range<usize>,
    ) -> Result<(), DrawError> {
        let ctx = target.ctx;
        let grid = TileGrid {
            rows: rows.clone(),
            ..TileGrid::of(ctx.strip)
        };
        let line_bytes = self.time("flatten", |p| {
            let input = FlattenInput {
                ctx,
                index: &clusters.index,
                visible: &p.visible,
                rows: &rows,
                limit_bytes: target.limit_bytes,
            };
            let cache = &mut clusters.cache;
            flatten_visible(input, cache, &p.flatten_scratches, &mut p.dirty_clusters)
        })?;
        let used_bytes = line_bytes + self.scratch_bytes();
        let spare_bytes = target.limit_bytes.saturating_sub(used_bytes);
        let needed = self.time("bin", |p| p.bin(ctx, clusters, &grid, spare_bytes));
        needed.map_err(|needed| DrawError::OverBudget(used_bytes + needed))?;
        self.time("cover", |p| p.cover(target, clusters, &grid))?;
        let bytes = clusters.cache.bytes + self.lists.bytes() + self.scratch_bytes();
        self.peak_bytes = self.peak_bytes.max(bytes);
        Ok(())
    }

    /// Lists what may touch each tile, and counts the paths and lines of the band.
    ///
    /// # Errors
    /// If the lists need more than `limit_bytes`: the bytes they need.
    fn bin(
        &mut self,
        ctx: &FrameContext<'_>,
        clusters: &PreparedClusters,
        grid: &TileGrid,
        limit_bytes: u64,
    ) -> Result<(), u64> {
        let PreparedClusters { index, cache, .. } = clusters;
        let input = BinInput {
            ctx,
            index,
            cache,
            visible: &self.visible,
            damage: &self.damage,
            grid,
        };
        let (lists, visible) = (&mut self.lists, &self.visible);
        let (filled, counts) = rayon::join(
            || lists.fill(input, limit_bytes),
            || count_drawn(visible, ctx, cache, &grid.rows),
        );
        filled?;
        self.path_count += counts[0];
        self.line_count += counts[1];
        Ok(())
    }

    /// Rasterizes the tiles of the band.
    fn cover(
        &mut self,
        target: &mut FrameTarget<'_, '_>,
        clusters: &PreparedClusters,
        grid: &TileGrid,
    ) -> Result<(), RenderError> {
        let ctx = target.ctx;
        let inset = target
            .probe
            .map(|(found, _)| ctx.with_inset_strokes(found.max_zoom));
        let probe = target.probe.zip(inset.as_ref());
        let probe = probe.map(|((found, full_pixels), ctx)| BandProbe {
            ctx,
            found,
            full_pixels,
        });
        let job = BandJob {
            ctx,
            grid,
            index: &clusters.index,
            cache: &clusters.cache,
            ranks: clusters.style.ranks.as_deref(),
            visible: &self.visible,
            lists: &self.lists,
            damage: &self.damage,
            part: ScenePart::All,
            resting: target.resting,
            full_pixels: target.full_pixels,
            probe,
            common_radius_px: ctx.common_radius_px(),
            max_radius_px: ctx.max_radius_px(),
        };
        let (cached, scratches) = (target.cached, &self.raster_scratches);
        let load = |row_px: usize, pixels: &mut [[u8; 4]]| {
            if let Some(cached) = cached {
                cached.load(row_px, pixels);
            }
        };
        let within = ctx.pixels_of(&grid.rows);
        match ctx.style.shading {
            Shading::Color => {
                let pixels = &mut target.frame.pixels_mut()[within];
                draw_colors(&job, scratches, pixels, load)
            }
            Shading::Density(_) => {
                let load = |row_px: usize, counts: &mut [f32]| load(row_px, cast_slice_mut(counts));
                draw_densities(&job, scratches, &mut self.counts[within], load)
            }
        }
    }
}
