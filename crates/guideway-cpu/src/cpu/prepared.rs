use std::sync::Arc;
use std::time::Instant;

use bytemuck::cast_slice;
use guideway_scene::density::Tones;
use guideway_scene::{
    Budget, Cancel, Edited, Frame, Preparation, Prepared, RenderError, Report, Shading, Stage,
    Strip, Style, View, elapsed_ms,
};
use guideway_scene::{Edit, Scene};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::NAME;
use super::filled::{Filled, Fills};
use super::frame::{Buffers, Easel, TooMuch};
use super::index::Index;
use super::kept::Kept;
use super::painter::Painter;
use super::vectors::LaneWidth;

/// Pixels that are drawn at once of a picture that is drawn in strips.
const STRIP_PIXELS: usize = 1 << 25;

/// A scene with what stays the same from frame to frame, and the buffers of the last one.
pub(super) struct CpuPrepared {
    scene: Arc<Scene>,
    budget: Budget,
    /// None for the threads that the process shares.
    pool: Option<ThreadPool>,
    index: Index,
    preparation: Preparation,
    buffers: Buffers,
    kept: Option<Kept>,
    fills: Fills,
    /// Of the last picture that was drawn in strips by density.
    tones: Option<(View, Style, Tones)>,
    pub(super) lane_width: LaneWidth,
}

/// Bytes that are needed however small the picture.
fn fixed_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let painters = threads(budget) as u64 * Painter::bytes(scene.is_opaque());
    Index::planned_bytes(scene.row_count()) + painters
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
            kept: None,
            fills: Fills::default(),
            tones: None,
            lane_width: LaneWidth::default(),
        })
    }
}

#[cfg(test)]
impl CpuPrepared {
    /// Whether the last frame drew only a part of the picture.
    pub(super) fn has_reused(&self) -> bool {
        self.buffers
            .parts
            .pixels()
            .map(|(x, y)| x.len() * y.len())
            .sum::<usize>()
            < self.kept.as_ref().map_or(0, Kept::pixel_count)
    }

    /// Number of pixels of a picture that are known to be full.
    pub(super) fn known_pixels(&self, view: &View, style: &Style) -> u32 {
        let (strip, cancel) = (Strip::whole(view), Cancel::default());
        let shot = (self.index).shot(&self.scene, self.lane_width, (&strip, style, &cancel));
        self.fills.known(&shot, 0.0).count(&shot)
    }

    /// Lists lines by tiles of clusters that cover so many.
    pub(super) fn list_lines_from(&mut self, least_tiles: usize) {
        self.buffers.bins.found.least_tiles = least_tiles;
    }

    /// Number of clusters that the last frame made lines for.
    pub(super) fn made_clusters(&self) -> usize {
        self.buffers.todo.len()
    }

    /// Draws all of the next frame, from the curves.
    pub(super) fn forget_picture(&mut self) {
        self.kept = None;
        self.fills.forget();
        self.index.forget_lines(|_| false);
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
        let frame_bytes = (pixels * size_of::<[u8; 4]>()) as u64;
        let mut own_bytes = fixed_bytes(&self.scene, &self.budget);
        if is_density {
            own_bytes += (pixels * size_of::<f32>()) as u64;
        }
        // Only whole pictures are kept. If the memory does not do, that of the last frame is not there any more.
        let can_keep = strip.is_whole();
        let kept = self.kept.take();
        let mut kept = kept.filter(|kept| {
            can_keep && own_bytes + frame_bytes + kept.bytes() <= self.budget.memory_bytes
        });
        let kept_bytes = kept.as_ref().map_or(0, Kept::bytes);
        let fills_bytes = self.fills.bytes() + Filled::planned_bytes(pixels);
        let with_fills = own_bytes + frame_bytes + kept_bytes + fills_bytes;
        let can_fill = can_keep && !is_density && with_fills <= self.budget.memory_bytes / 2;
        if can_fill {
            own_bytes += fills_bytes;
        } else {
            self.fills.forget();
        }
        let needed = own_bytes + frame_bytes + kept_bytes;
        let Some(limit_bytes) = self.budget.memory_bytes.checked_sub(needed) else {
            return Err(too_small("the picture", needed, &self.budget));
        };
        let Self {
            scene,
            budget,
            pool,
            index,
            buffers,
            tones,
            lane_width,
            fills,
            ..
        } = self;
        let shot = index.shot(scene, *lane_width, (strip, style, cancel));
        buffers.start();
        let bands = install(pool.as_ref(), || {
            let is_moved = buffers.time("cull", |b| {
                frame.resize(strip.size());
                b.sights.look(&index.extents, &shot);
                b.parts.clear(strip);
                let kept = kept.as_mut();
                let is_moved =
                    kept.is_some_and(|kept| kept.move_to(&shot, &b.sights, &mut b.parts));
                if !is_moved {
                    b.parts.fill(strip);
                }
                is_moved
            });
            let filled = (can_fill && !is_moved).then(|| fills.plan(&shot)).flatten();
            let mut easel = Easel {
                shot: &shot,
                frame,
                kept: kept.as_ref().filter(|_| is_moved),
                known: fills.known(&shot, 0.0),
                filled: filled.as_ref().map(|filled| {
                    let known = fills.known(&shot, filled.most_px_per_m());
                    (filled, known)
                }),
                limit_bytes,
            };
            let drawn = match style.shading {
                Shading::Color => buffers.draw(&mut easel, index)?,
                Shading::Density(tone) => buffers.draw_density(&mut easel, index, tone, tones)?,
            };
            let bands = drawn.map_err(|TooMuch(bytes)| {
                too_small("the lines of one row of tiles", needed + bytes, budget)
            })?;
            if let Some(filled) = filled {
                fills.keep(filled);
            }
            if can_keep {
                buffers.time("keep", |b| {
                    let pixels = if is_density {
                        cast_slice(&b.counts)
                    } else {
                        frame.pixels()
                    };
                    match &mut kept {
                        Some(kept) if is_moved => kept.store(&b.parts, pixels),
                        Some(kept) if kept.is_alike(&shot) => {
                            // Not where lines may soon need the room.
                            if own_bytes + frame_bytes + b.peak_bytes <= budget.memory_bytes / 2 {
                                kept.store_all(&shot, pixels);
                            }
                        }
                        _ => kept = Some(Kept::new(&shot)),
                    }
                });
            }
            Ok(bands)
        })?;
        let kept_bytes = kept_bytes.max(kept.as_ref().map_or(0, Kept::bytes));
        self.kept = kept;
        Ok(Report {
            stages: std::mem::take(&mut buffers.stages),
            lines: buffers.made,
            peak_bytes: own_bytes + kept_bytes + buffers.peak_bytes,
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
            kept,
            fills,
            tones,
            ..
        } = self;
        let mut leave = |paths: &[u32]| {
            let last = paths.iter().copied().max();
            let are_there = last.is_none_or(|path| (path as usize) < scene.row_count());
            are_there.then(|| install(pool.as_ref(), || index.leave(scene, paths)))
        };
        let leaving = match edit {
            Edit::Transform { paths, .. } | Edit::Reshape { paths, .. } => leave(paths),
            Edit::SetStates(_) => leave(&edit.paths().collect::<Vec<u32>>()),
            Edit::Restyle(_) | Edit::Insert(_) => None,
        };
        let leaving = leaving.unwrap_or_default();
        let scene_now = Arc::make_mut(scene);
        install(pool.as_ref(), || scene_now.edit(edit)).map_err(RenderError::Edit)?;
        *tones = None;
        fills.forget();
        let fixed = fixed_bytes(scene, budget);
        if fixed > budget.memory_bytes {
            return Err(too_small("the index of the paths", fixed, budget));
        }
        let before = (index.solid, index.widths);
        let changes = install(pool.as_ref(), || match edit {
            Edit::Transform { by, .. } => index.touch(scene, &leaving, Some(*by)),
            Edit::Reshape { .. } => index.touch(scene, &leaving, None),
            Edit::Restyle(_) => {
                index.order_anew(scene);
                index.bounds_of(&edit.paths().collect::<Vec<_>>())
            }
            Edit::SetStates(_) => {
                index.order_anew(scene);
                index.touch(scene, &leaving, None)
            }
            Edit::Insert(_) => {
                let changes = index.append(scene);
                index.order_anew(scene);
                changes
            }
        });
        if let Some(kept) = kept {
            // One color is covered otherwise than several.
            if before == (index.solid, index.widths) {
                kept.change(&changes);
            } else {
                kept.forget();
            }
        }
        Ok(Edited::InPlace { moved_bytes: 0 })
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}
