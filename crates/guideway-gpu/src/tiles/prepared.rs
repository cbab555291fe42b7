use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;

use guideway_render::{
    Budget, Cancel, Edited, Frame, Preparation, Prepared, RenderError, Report, Shading, Stage,
    Style, View, density, elapsed_ms,
};
use guideway_scene::{Edit, Scene};
use guideway_spline::Bounds;

use super::bound::{Bound, Buffers, Paint};
use super::canvas::Canvas;
use super::edit::Places;
use super::kept::{Kept, Shifter};
use super::pack::Packed;
use super::params::{Found, Stroke, TILE_PX};
use super::ranks::Ranks;
use super::room::{Room, Size};
use super::rounds::Rounds;
use super::shot::Shot;
use super::store::{Store, all_parts, is_plain};
use super::window::Window;
use super::{NAME, Shared};
use crate::device::{DeviceBuffer, FETCHED, Memory, Patcher, Runner};

/// Largest frame that is planned for.
const PLANNED_PIXELS: u64 = 3840 * 2160;

/// A scene on the device, and the buffers of the last frame.
pub(super) struct PreparedTiles {
    pub(super) shared: Arc<Shared>,
    pub(super) scene: Arc<Scene>,
    pub(super) memory: Memory,
    pub(super) runner: Runner,
    /// None if nothing is drawn.
    pub(super) store: Option<Store>,
    found_fetched: DeviceBuffer,
    pub(super) facts: Facts,
    /// Paths of several strokes, which the device does not count.
    pub(super) parted: BTreeSet<u32>,
    /// Where paths are; found out when one changes.
    pub(super) places: Option<Places>,
    pub(super) patcher: Option<Patcher>,
    pub(super) easel: Easel,
    /// For questions about a few pixels, so that the picture stays.
    pub(super) probe: Easel,
    /// A bit a path, while paths are marked.
    pub(super) marks: Option<DeviceBuffer>,
    preparation: Preparation,
}

/// What a picture is made with.
#[derive(Default)]
pub(super) struct Easel {
    pub(super) room: Option<Room>,
    pub(super) canvas: Option<Canvas>,
    /// For the buffers above; none once one of them is another.
    pub(super) bound: Option<Bound>,
    /// What the canvas shows, if it is a finished picture of the scene as it is.
    pub(super) kept: Option<Kept>,
    pub(super) shifter: Option<Shifter>,
    pub(super) rounds: Rounds,
}

impl Easel {
    /// After one of the buffers that a frame binds has become another.
    fn unbind(&mut self) {
        self.bound = None;
        if let Some(shifter) = &mut self.shifter {
            shifter.bound = None;
        }
    }
}

/// What the processor needs to know of the scene in every frame.
#[derive(Clone, Copy)]
pub(super) struct Facts {
    pub(super) clusters: u32,
    pub(super) styles: u32,
    /// Greatest distance of a control point from its cluster's origin, along an axis.
    pub(super) reach_m: f64,
    pub(super) has_widths: bool,
    /// One colour, and no widths.
    pub(super) is_plain: bool,
    paint: Paint,
}

impl Facts {
    fn of(scene: &Scene) -> Self {
        let drawn = scene.draw_order().iter();
        Self {
            clusters: 0,
            styles: 0,
            reach_m: 0.0,
            has_widths: drawn.into_iter().any(|&path| scene.width_m(path).is_some()),
            is_plain: is_plain(scene),
            paint: Paint::of(scene),
        }
    }
}

/// See [`guideway_render::Method::plan_bytes`].
pub(super) fn plan_bytes(scene: &Scene, budget: &Budget) -> u64 {
    let geometry = scene.layout().paths.geometry();
    let paths = scene.draw_order().len() as u64;
    let points = (geometry.segment_count() as u64 + 3 * paths) * size_of::<[f32; 2]>() as u64;
    let strokes = paths * size_of::<Stroke>() as u64;
    let room = Size::first(u32::try_from(paths).unwrap_or(u32::MAX)).bytes();
    let pixels = 2 * PLANNED_PIXELS * size_of::<u32>() as u64;
    (points + strokes + room + pixels).min(budget.memory_bytes)
}

impl PreparedTiles {
    pub(super) fn new(
        shared: Arc<Shared>,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Self, RenderError> {
        let mut memory = Memory::new(Arc::clone(&shared.gpu), NAME, budget);
        let runner = Runner::new(Arc::clone(&shared.gpu), &mut memory)?;
        let found_bytes = size_of::<Found>() as u64;
        let found_fetched = memory.zeros("the counters", found_bytes, FETCHED)?;
        let mut prepared = Self {
            facts: Facts::of(&scene),
            parted: BTreeSet::new(),
            places: None,
            patcher: None,
            shared,
            scene,
            preparation: Preparation::default(),
            memory,
            runner,
            store: None,
            found_fetched,
            easel: Easel::default(),
            probe: Easel::default(),
            marks: None,
        };
        prepared.bring()?;
        Ok(prepared)
    }

    /// Brings the scene to the device, in place of what is there.
    pub(super) fn bring(&mut self) -> Result<(), RenderError> {
        (self.store, self.places) = (None, None);
        self.unbind();
        self.facts = Facts::of(&self.scene);
        let start = Instant::now();
        let ranks = Ranks::of(&self.scene);
        let parts = all_parts(&self.scene, &ranks);
        self.parted = parts
            .iter()
            .filter(|p| !p.is_whole)
            .map(|p| p.path)
            .collect();
        let packed = Packed::of(&self.scene, parts);
        let reach_m = packed.clusters.iter().map(|c| f64::from(c.reach_m()));
        self.facts.reach_m = reach_m.fold(0.0, f64::max);
        let packed_ms = elapsed_ms(start);
        let start = Instant::now();
        let gpu = &self.shared.gpu;
        self.store = Store::new(gpu, &mut self.memory, &self.scene, packed, ranks)?;
        if let Some(store) = &self.store {
            self.facts.clusters = store.cluster_list.len() as u32;
            self.facts.styles = store.style_count;
        }
        self.set_chunks()?;
        self.preparation = Preparation {
            stages: vec![
                Stage::host("pack", packed_ms),
                Stage::host("upload", elapsed_ms(start)),
            ],
            held_bytes: self.memory.held_bytes(),
            peak_bytes: self.memory.take_peak_bytes(),
            ..Preparation::default()
        };
        Ok(())
    }

    /// Tells the device which clusters each chunk has.
    pub(super) fn set_chunks(&self) -> Result<(), RenderError> {
        for chunk in self.store.iter().flat_map(|store| &store.chunks) {
            for (params, round) in chunk.params.iter().zip(0..) {
                let set = self
                    .runner
                    .set("the clusters", params, &chunk.params_of(round));
                set.map_err(|what| self.memory.trouble(what))?;
            }
        }
        Ok(())
    }

    /// After colours, widths or states have changed.
    pub(super) fn look_anew(&mut self) {
        let facts = Facts::of(&self.scene);
        self.facts = Facts {
            clusters: self.facts.clusters,
            styles: self.facts.styles,
            reach_m: self.facts.reach_m,
            ..facts
        };
    }

    /// After a buffer of the scene has become another.
    pub(super) fn unbind(&mut self) {
        self.easel.unbind();
        self.probe.unbind();
    }

    /// Has buffers for pictures of this size, and room for the lines of so many strokes at first.
    pub(super) fn make_ready(&mut self, view: &View, strokes: u32) -> Result<(), RenderError> {
        let gpu = &self.shared.gpu;
        let easel = &mut self.easel;
        if easel.canvas.as_ref().is_none_or(|c| c.size != view.size()) {
            (easel.canvas, easel.kept, easel.shifter) = (None, None, None);
            easel.unbind();
            easel.canvas = Some(Canvas::new(gpu, &mut self.memory, view.size())?);
        }
        if easel.room.is_none() {
            easel.unbind();
            let size = Size::first(strokes).within(gpu, &self.memory);
            easel.room = Some(Room::new(&mut self.memory, size)?);
        }
        Ok(())
    }

    /// Draws a window of tiles, and says what was found: all of it may not have fitted.
    fn draw(
        &mut self,
        shot: &Shot<'_>,
        paint: Paint,
        window: &Window,
        first_row: u32,
        stages: &mut Vec<Stage>,
    ) -> Result<Found, RenderError> {
        let easel = &mut self.easel;
        let (Some(store), Some(room), Some(canvas)) = (&self.store, &easel.room, &easel.canvas)
        else {
            return Ok(Found::default());
        };
        let trouble = |what| self.memory.trouble(what);
        let params = shot.params(canvas, room, window, first_row);
        let buffers = Buffers {
            gpu: &self.shared.gpu,
            kernels: &self.shared.kernels,
            store,
            room,
            canvas,
            marks: self.marks.as_ref(),
        };
        let samples = shot.samples();
        let in_rounds = easel.rounds.are_on && paint == Paint::One;
        let is_alike = |bound: &Bound| bound.is_for(paint, samples, in_rounds);
        let bound = match easel.bound.take().filter(is_alike) {
            Some(bound) => bound,
            None => Bound::new(&buffers, paint, samples, in_rounds).map_err(trouble)?,
        };
        let set = self.runner.set("the view", &canvas.frame, &params);
        set.map_err(trouble)?;
        let run = bound.run(&buffers, &params, &self.runner);
        merge(stages, run.map_err(trouble)?);
        let mut found = Found::default();
        let fetched = self.runner.fetch(
            "the counters",
            &store.found,
            &self.found_fetched,
            size_of::<Found>() as u64,
            |bytes| bytemuck::bytes_of_mut(&mut found).copy_from_slice(bytes),
        );
        fetched.map_err(trouble)?;
        self.easel.bound = Some(bound);
        Ok(found)
    }

    /// Whether a thread of a tile may not go on to the end of its list.
    fn is_too_long(&self, found: &Found, paint: Paint) -> bool {
        u64::from(found.longest) * u64::from(paint.rounds_a_line())
            > u64::from(self.shared.gpu.rounds_a_thread())
    }

    /// More room for what was found, if there can be.
    fn grow(&mut self, found: &Found) -> Result<bool, RenderError> {
        let Some(room) = self.easel.room.take() else {
            return Ok(false);
        };
        self.easel.unbind();
        let (old, size) = (room.size, room.size.for_found(found));
        drop(room);
        let fits = size.fits(&self.shared.gpu) && size.bytes() <= self.memory.spare_bytes();
        let size = if fits { size } else { old };
        self.easel.room = Some(Room::new(&mut self.memory, size)?);
        Ok(fits)
    }

    /// Draws windows, the first ones first, in halves where there is no room for all that is found.
    pub(super) fn draw_windows(
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
            let found = self.draw(shot, paint, &window, first_row, &mut drawing.stages)?;
            let holds = |room: &Room| room.size.holds(&found);
            let is_too_long = self.is_too_long(&found, paint);
            if !is_too_long && self.easel.room.as_ref().is_some_and(holds) {
                if paint == Paint::One {
                    self.easel.rounds.learn(&window, &found);
                }
                drawing.lines += u64::from(found.lines);
                drawing.drawn = found.drawn;
                drawing.windows += 1;
            } else if paint == Paint::One && self.easel.rounds.may_help(&found) {
                windows.push(window);
            } else if is_too_long {
                return Err(too_long(&found));
            } else if self.grow(&found)? {
                windows.push(window);
            } else if let Some([first, second]) = window.halves() {
                windows.extend([second, first]);
            } else {
                let size = Size::first(0).for_found(&found);
                return Err(size.refused(&self.memory));
            }
        }
        Ok(())
    }

    /// Fetches the first rows of pixels of the canvas.
    fn fetch(
        &self,
        rows_px: u32,
        stages: &mut Vec<Stage>,
        take: impl FnOnce(&[u8]),
    ) -> Result<(), RenderError> {
        let Some(canvas) = &self.easel.canvas else {
            return Ok(());
        };
        let start = Instant::now();
        let bytes = u64::from(rows_px) * u64::from(canvas.size.width()) * size_of::<u32>() as u64;
        let what = "the picture";
        let fetched = self
            .runner
            .fetch(what, &canvas.pixels, &canvas.fetched, bytes, take);
        fetched.map_err(|what| self.memory.trouble(what))?;
        let read = Stage::host(Stage::READ_BACK, elapsed_ms(start));
        merge(stages, vec![read]);
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
            self.fetch(rows_px.len() as u32, &mut drawing.stages, |bytes| {
                take(pixels, bytes);
            })?;
        }
        if self.shared.options.keeps {
            self.easel.kept = Some(next);
        }
        Ok(drawing)
    }

    /// Paths that are not proven to be outside the view.
    fn count_drawn(&self, shot: &Shot<'_>, drawing: &Drawing) -> u64 {
        let canvas = self.easel.canvas.as_ref();
        let bands = canvas.map_or(1, |c| c.rows.div_ceil(c.band_rows));
        let is_counted = !drawing.is_part && drawing.windows == bands;
        let alone = match &self.store {
            Some(_) if is_counted => u64::from(drawing.drawn),
            // Of windows, the device counts what each sees; clusters are a little less exact.
            Some(store) => store.whole_paths_seen(|bounds, width_m| shot.is_seen(bounds, width_m)),
            None => 0,
        };
        let paths = &self.scene.layout().paths;
        let is_seen = |path: &&u32| {
            let hull = paths.get(**path as usize).hull_bounds();
            hull.is_some_and(|hull: Bounds<f64>| shot.is_seen(hull, self.scene.width_m(**path)))
        };
        alone + self.parted.iter().filter(is_seen).count() as u64
    }
}

/// What became of one picture.
#[derive(Default)]
pub(super) struct Drawing {
    stages: Vec<Stage>,
    lines: u64,
    /// Paths that the last window's device has counted.
    drawn: u32,
    windows: u32,
    /// Whether the rest was kept from before.
    is_part: bool,
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

/// Adds stages to those of the same name.
pub(super) fn merge(stages: &mut Vec<Stage>, more: Vec<Stage>) {
    for stage in more {
        match stages.iter_mut().find(|s| s.name == stage.name) {
            Some(same) => same.elapsed_ms += stage.elapsed_ms,
            None => stages.push(stage),
        }
    }
}

impl Prepared for PreparedTiles {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let scene = Arc::clone(&self.scene);
        let shot = Shot::new(view, style, &scene, self.facts)?;
        let size = view.size();
        frame.resize(size);
        let mut counts = Vec::new();
        if style.shading != Shading::Color {
            counts.resize(size.pixels(), 0.0_f32);
        }
        let mut drawing = Drawing::default();
        if self.store.is_none() {
            let background = style.background;
            let pixel = [background.r, background.g, background.b, background.a];
            frame.pixels_mut().fill(pixel);
        } else {
            let strokes = self
                .store
                .as_ref()
                .map_or(0, |s| s.stroke_list.len() as u32);
            self.make_ready(view, strokes)?;
            let paint = match style.shading {
                Shading::Color => self.facts.paint,
                Shading::Density(_) => Paint::Density,
            };
            drawing = self.draw_all(&shot, paint, cancel, |pixels, bytes| {
                let words = bytes.as_chunks().0;
                if counts.is_empty() {
                    frame.pixels_mut()[pixels].copy_from_slice(words);
                } else {
                    for (count, word) in counts[pixels].iter_mut().zip(words) {
                        *count = f32::from_le_bytes(*word);
                    }
                }
            })?;
        }
        if let Shading::Density(tone) = style.shading {
            let start = Instant::now();
            density::shade(&counts, tone, style.background, frame);
            drawing.stages.push(Stage::host("shade", elapsed_ms(start)));
        }
        let drawn = self.count_drawn(&shot, &drawing);
        Ok(Report {
            lines: drawing.lines,
            stages: drawing.stages,
            peak_bytes: self.memory.take_peak_bytes(),
            bands: drawing.windows.max(1),
            ..Report::of(NAME, &scene, drawn)
        })
    }

    fn edit(&mut self, edit: &Edit) -> Result<Edited, RenderError> {
        self.change(edit)
    }

    fn top_paths(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Option<Vec<u32>>, RenderError> {
        self.tops(view, style, cancel).map(Some)
    }

    fn paths_in(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Option<Vec<u32>>, RenderError> {
        self.touching(view, style, cancel).map(Some)
    }

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }
}
