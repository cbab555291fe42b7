//! From a view to pixels: windows, room for what they find, and what of a picture is fetched.

use std::ops::Range;
use std::time::Instant;

use guideway_scene::{Cancel, RenderError, Stage, View, elapsed_ms};
use wgpu::BufferUsages;

use super::NAME;
use super::bound::{Bound, Buffers, Manner};
use super::canvas::Canvas;
use super::easel::list_room;
use super::kept::Kept;
use super::kernels::keeps_waiting;
use super::paint::Paint;
use super::params::{
    FEW_CLUSTERS, Found, SAMPLE_ROWS, SHARED_PARTS, SHARED_TILES, Samples, TILE_PX,
};
use super::prepared::PreparedTiles;
use super::room::{Room, Size};
use super::shot::{Lines, Shot};
use super::touched::KeptLines;
use super::window::Window;
use super::work::Counted;
use crate::device::Memory;

/// What is told of shared tiles: `Shares` of `shares.wgsl`.
const SHARE_BYTES: u64 = {
    let samples = TILE_PX * TILE_PX * SAMPLE_ROWS * Samples::Fine.a_row() / u32::BITS;
    let words = SHARED_TILES * (1 + samples) + SHARED_PARTS * 4;
    words as u64 * size_of::<u32>() as u64
};

/// What became of one picture.
#[derive(Default)]
pub(super) struct Drawing {
    pub(super) stages: Vec<Stage>,
    pub(super) lines: u64,
    /// Paths that the device has counted in the last window, if it has.
    drawn: Option<u32>,
    pub(super) windows: u32,
    /// Whether the rest was kept from before.
    is_part: bool,
    /// What was counted, if the kernels count.
    pub(super) work: Counted,
}

fn too_long(found: &Found) -> RenderError {
    RenderError::Unsupported {
        method: NAME,
        what: format!(
            "{} lines on {TILE_PX} x {TILE_PX} pixels, for this device ends a thread that takes so long",
            found.longest
        ),
        remedy: "Zoom in, or use `--method cpu`.".to_owned(),
    }
}

impl PreparedTiles {
    /// Has buffers for pictures of this size, and room for the lines of so many strokes at first, with ranks if they
    /// are needed.
    pub(super) fn make_ready(
        &mut self,
        view: &View,
        strokes: u32,
        has_ranks: bool,
    ) -> Result<(), RenderError> {
        let gpu = &self.shared.gpu;
        let easel = &mut self.easel;
        if easel.canvas.as_ref().is_none_or(|c| c.size != view.size()) {
            (easel.canvas, easel.kept, easel.shifter) = (None, None, None);
            easel.unbind();
            easel.canvas = Some(Canvas::new(gpu, &mut self.memory, view.size())?);
        }
        if (easel.room.as_ref()).is_none_or(|room| has_ranks && !room.size.has_ranks) {
            easel.unbind();
            let first = Size::first(strokes, has_ranks);
            let size = easel.room.take().map_or(first, |room| Size {
                has_ranks,
                ..room.size
            });
            let size = size.within(gpu, &self.memory);
            easel.room = Some(Room::new(&mut self.memory, size)?);
        }
        if easel.has_long {
            self.share()?;
        }
        Ok(())
    }

    /// Has bytes to spare, if need be by giving back what lines have room for. False if there cannot be so many.
    pub(super) fn make_spare(&mut self, bytes: u64) -> Result<bool, RenderError> {
        if self.memory.spare_bytes() < bytes {
            self.unbind();
            let has_ranks = (self.easel.room.as_ref()).is_some_and(|room| room.size.has_ranks);
            self.easel.room = None;
            self.easel.shares = None;
            let least = Size::first(0, has_ranks).within(&self.shared.gpu, &self.memory);
            self.easel.room = Some(Room::new(&mut self.memory, least)?);
        }
        Ok(self.memory.spare_bytes() >= bytes)
    }

    /// Draws a window of tiles, and says what was found: all of it may not have fitted.
    fn draw(
        &mut self,
        shot: &Shot<'_>,
        paint: Paint,
        window: &Window,
        first_row: u32,
        lines: Lines,
        drawing: &mut Drawing,
    ) -> Result<Found, RenderError> {
        // Where it fails, nothing is kept.
        let kept = self.easel.room.as_mut().and_then(|room| room.kept.take());
        let bound = self.easel.bound.take();
        let easel = &self.easel;
        let (Some(store), Some(room), Some(canvas)) = (&self.store, &easel.room, &easel.canvas)
        else {
            return Ok(Found::default());
        };
        let trouble = |what| self.memory.trouble(what);
        let renews = matches!(lines, Lines::Renewed(..));
        let has_lines = renews || matches!(lines, Lines::Kept(_));
        let shares = easel.shares.is_some() && easel.has_long && paint == Paint::One;
        let list_room = if has_lines && !renews && !shares && paint == Paint::One {
            list_room(&self.shared.gpu, room.size, window, easel.longest)
        } else {
            0
        };
        let manner = Manner {
            has_lines,
            renews,
            lists_at_once: list_room > 0,
            is_in_rounds: easel.rounds.are_on && paint == Paint::One,
            has_few: easel.has_few,
            shares,
        };
        let params = shot.params(canvas, room, window, first_row, lines, list_room);
        let buffers = Buffers {
            gpu: &self.shared.gpu,
            kernels: &self.kernels,
            store,
            room,
            canvas,
            shares: easel.shares.as_ref(),
            touched: easel.touched.as_ref(),
            times_stages: self.shared.options.times_stages,
        };
        let samples = shot.samples();
        let is_alike = |bound: &Bound| bound.is_for(paint, samples, manner);
        let bound = match bound.filter(is_alike) {
            Some(bound) => bound,
            None => Bound::new(&buffers, paint, samples, manner).map_err(trouble)?,
        };
        let set = self.runner.set("the view", &canvas.frame, &params);
        set.map_err(trouble)?;
        let run = bound.run(&buffers, &params, &self.runner);
        Stage::merge(&mut drawing.stages, run.map_err(trouble)?);
        let mut found = Found::default();
        let fetched = self.runner.fetch(
            "the counters",
            &store.found,
            &self.found_fetched,
            size_of::<Found>() as u64,
            |bytes| bytemuck::bytes_of_mut(&mut found).copy_from_slice(bytes),
        );
        fetched.map_err(trouble)?;
        let end = lines.first().saturating_add(found.lines);
        let fits = end <= room.size.lines;
        let is_whole = fits && found.missing == 0;
        let drawn = (*shot.view, found.drawn);
        let of_view = kept.as_ref().and_then(|kept| kept.drawn);
        let easel = &mut self.easel;
        easel.bound = Some(bound);
        if let Some(room) = &mut easel.room {
            room.kept = match lines {
                Lines::OfWindow(first) => kept.filter(|_| first > 0),
                Lines::OfLevel => is_whole.then(|| KeptLines::new(shot.level, end, drawn)),
                Lines::Kept(_) => kept,
                Lines::Renewed(..) => kept.filter(|_| is_whole).and_then(|kept| kept.renewed(end)),
            };
        }
        if lines.first() > 0 && !fits {
            // Behind the lines that were kept is too little room: they may do for a part of the picture, too.
            let lines = match self.lines_for(shot, false)? {
                Lines::OfLevel => Lines::OfWindow(0),
                there => there,
            };
            return self.draw(shot, paint, window, first_row, lines, drawing);
        }
        if has_lines {
            found.lines = end;
            let of_view = of_view.filter(|(view, _)| !renews && view == shot.view);
            drawing.drawn = of_view.map(|(_, paths)| paths);
        } else {
            drawing.drawn = Some(found.drawn);
            easel.has_few = found.rounded + found.exact <= FEW_CLUSTERS;
        }
        easel.longest = found.longest;
        if list_room > 0 && found.longest > 0 {
            // A list has had too few places.
            return self.draw(shot, paint, window, first_row, lines, drawing);
        }
        let is_too_long = self.is_too_long(&found, paint);
        let is_long = is_too_long || keeps_waiting(&self.shared.gpu, &found);
        self.easel.has_long = paint == Paint::One && is_long;
        if manner.shares {
            found.longest = found.longest_alone;
        }
        Ok(found)
    }

    /// Whether a thread of a tile may not go on to the end of its list.
    fn is_too_long(&self, found: &Found, paint: Paint) -> bool {
        paint.rounds(found) > u64::from(self.shared.gpu.rounds_a_thread())
    }

    /// Has room for what several workgroups cover of a tile. False if there cannot be.
    fn share(&mut self) -> Result<bool, RenderError> {
        if self.easel.shares.is_some() {
            return Ok(true);
        }
        let most_bytes = (self.shared.gpu.binding_bytes()).min(self.memory.spare_bytes());
        if SHARE_BYTES > most_bytes || self.kernels.painters(Samples::Fine).shared.is_none() {
            return Ok(false);
        }
        let storage = BufferUsages::STORAGE;
        self.easel.shares = Some(self.memory.zeros("shared tiles", SHARE_BYTES, storage)?);
        Ok(true)
    }

    /// More room for what was found, if there can be; exact points go for it where none is needed.
    fn grow(&mut self, shot: &Shot<'_>, found: &Found) -> Result<bool, RenderError> {
        let Some(room) = self.easel.room.take() else {
            return Ok(false);
        };
        self.unbind();
        let (old, size) = (room.size, room.size.for_found(found));
        let is_short = |memory: &Memory| size.bytes() > memory.spare_bytes() + old.bytes();
        if is_short(&self.memory) {
            self.easel.shares = None;
        }
        if let Some(store) = &mut self.store
            && is_short(&self.memory)
            && !shot.is_near()
        {
            store.twins = None;
        }
        let fits = size.fits(&self.shared.gpu) && !is_short(&self.memory);
        self.easel.room = Some(if fits {
            room.grown(&mut self.memory, size)?
        } else {
            room
        });
        Ok(fits)
    }

    /// Draws windows, the first ones first, in halves where there is no room for all that is found.
    fn draw_windows(
        &mut self,
        shot: &Shot<'_>,
        paint: Paint,
        mut windows: Vec<Window>,
        first_row: u32,
        cancel: &Cancel,
        drawing: &mut Drawing,
    ) -> Result<(), RenderError> {
        windows.reverse();
        while let Some(window) = windows.pop() {
            cancel.check()?;
            self.come_near(shot)?;
            let lines = self.lines_for(shot, drawing.is_part)?;
            let found = self.draw(shot, paint, &window, first_row, lines, drawing)?;
            if found.missing > 0 {
                match (self.bring_twins(shot, &found)?, window.halves()) {
                    (None, _) => windows.push(window),
                    (Some(_), _) if lines == Lines::OfLevel => {
                        self.easel.too_large = Some(shot.level);
                        windows.push(window);
                    }
                    (Some(_), Some([first, second])) => windows.extend([second, first]),
                    (Some(points), None) => return Err(self.no_room_for_twins(points)),
                }
                continue;
            }
            let holds = |room: &Room| room.size.holds(&found);
            let is_too_long = self.is_too_long(&found, paint);
            if !is_too_long && self.easel.room.as_ref().is_some_and(holds) {
                // A part of a picture says little of all of it.
                if paint == Paint::One && !drawing.is_part {
                    self.easel.rounds.learn(&window, &found);
                }
                drawing.lines += u64::from(found.lines);
                drawing.work.add(&found);
                drawing.windows += 1;
            } else if paint == Paint::One && self.easel.may_help(&found) {
                windows.push(window);
            } else if is_too_long {
                let is_shared = found.longest_alone > 0;
                let is_short = found.shared_tiles > SHARED_TILES || found.parts > SHARED_PARTS;
                if paint == Paint::One && !is_shared && self.share()? {
                    windows.push(window);
                } else if let Some([first, second]) = window.halves().filter(|_| is_short) {
                    windows.extend([second, first]);
                } else {
                    return Err(too_long(&found));
                }
            } else if self.grow(shot, &found)? {
                windows.push(window);
            } else if lines == Lines::OfLevel {
                self.easel.too_large = Some(shot.level);
                windows.push(window);
            } else if let Some([first, second]) = window.halves() {
                windows.extend([second, first]);
            } else {
                let size = Size::first(0, shot.needs_ranks(paint)).for_found(&found);
                return Err(size.refused(&self.memory));
            }
        }
        Ok(())
    }

    /// Fetches the first pixels of the canvas, which are these of the picture.
    fn fetch(
        &self,
        pixels: Range<usize>,
        stages: &mut Vec<Stage>,
        mut take: impl FnMut(Range<usize>, &[u8]),
    ) -> Result<(), RenderError> {
        let Some(canvas) = &self.easel.canvas else {
            return Ok(());
        };
        let start = Instant::now();
        let bytes = (pixels.len() * size_of::<u32>()) as u64;
        let (what, through) = ("the picture", &canvas.fetched);
        let mut first = pixels.start;
        let taken = |bytes: &[u8]| {
            let end = first + bytes.len() / size_of::<u32>();
            take(first..end, bytes);
            first = end;
        };
        let fetched = self
            .runner
            .fetch_in_parts(what, &canvas.pixels, through, bytes, taken);
        fetched.map_err(|what| self.memory.trouble(what))?;
        let read = Stage::host(Stage::READ_BACK, elapsed_ms(start));
        Stage::merge(stages, [read]);
        Ok(())
    }

    /// Draws the picture, or what of it came into view; `take` gets the bytes of rows of pixels.
    pub(super) fn draw_all(
        &mut self,
        shot: &Shot<'_>,
        paint: Paint,
        cancel: &Cancel,
        mut take: impl FnMut(Range<usize>, &[u8]),
    ) -> Result<Drawing, RenderError> {
        let mut drawing = Drawing::default();
        let Some(canvas) = &self.easel.canvas else {
            return Ok(drawing);
        };
        let (columns, rows, band_rows) = (canvas.columns, canvas.rows, canvas.band_rows);
        let size = shot.view.size();
        let moved = self.move_kept(shot, &mut drawing.stages)?;
        let mut next = Kept::new(shot.view, shot.style);
        for first_row in (0..rows).step_by(band_rows as usize) {
            let end_row = rows.min(first_row + band_rows);
            let mut windows = vec![Window {
                columns: 0..columns,
                rows: first_row..end_row,
            }];
            if let Some(moved) = &moved {
                (windows, next) = (moved.windows.clone(), moved.kept);
                drawing.is_part = true;
            }
            self.draw_windows(shot, paint, windows, first_row, cancel, &mut drawing)?;
            let rows_px = first_row * TILE_PX..size.height().min(end_row * TILE_PX);
            let pixels =
                (rows_px.start * size.width()) as usize..(rows_px.end * size.width()) as usize;
            self.fetch(pixels, &mut drawing.stages, &mut take)?;
        }
        if self.easel.keeps {
            self.easel.kept = Some(next);
        }
        Ok(drawing)
    }

    /// Paths that are not proven to be outside the view.
    pub(super) fn count_drawn(&self, shot: &Shot<'_>, drawing: &Drawing) -> u64 {
        let is_whole = !drawing.is_part && drawing.windows == 1;
        let alone = match (&self.store, drawing.drawn) {
            (Some(_), Some(drawn)) if is_whole => u64::from(drawn),
            // Of windows, the device counts what each sees, and of kept lines nothing; clusters are a little less exact.
            (Some(store), _) => store.whole_paths_seen(shot),
            (None, _) => 0,
        };
        let paths = &self.scene.layout().paths;
        let is_seen = |path: &&u32| {
            let hull = paths.get(**path as usize).hull_bounds();
            hull.is_some_and(|hull| hull.intersects(shot.seen_m(self.scene.width_m(**path))))
        };
        alone + self.parted.iter().filter(is_seen).count() as u64
    }
}
