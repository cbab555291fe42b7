use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{
    Budget, Cancel, Edited, Frame, Preparation, Prepared, RenderError, Report, Shading, Stage,
    Style, View, Work, density, elapsed_ms,
};
use guideway_scene::{Edit, Scene};

use super::draw::Drawing;
use super::easel::Easel;
use super::kernels::Kernels;
use super::pack::{Packed, Packing};
use super::paint::Paint;
use super::params::Found;
use super::places::Places;
use super::ranks::Ranks;
use super::shot::Shot;
use super::store::{Store, all_parts, is_plain};
use super::{NAME, Shared};
use crate::device::{DeviceBuffer, FETCHED, Memory, Patcher, Runner};

/// A scene on the device, and the buffers of the last frame.
pub(super) struct PreparedTiles {
    pub(super) shared: Arc<Shared>,
    pub(super) kernels: Arc<Kernels>,
    pub(super) scene: Arc<Scene>,
    pub(super) memory: Memory,
    pub(super) runner: Runner,
    /// None if nothing is drawn.
    pub(super) store: Option<Store>,
    pub(super) found_fetched: DeviceBuffer,
    pub(super) facts: Facts,
    pub(super) packing: Packing,
    /// Paths of several strokes, which the device does not count.
    pub(super) parted: BTreeSet<u32>,
    /// Where paths are; found out when one changes.
    pub(super) places: Option<Places>,
    pub(super) patcher: Option<Patcher>,
    pub(super) easel: Easel,
    /// Whether a change did not come to its end, so that paths may be missing from the store.
    pub(super) is_torn: bool,
    preparation: Preparation,
}

/// What the processor needs to know of the scene in every frame.
#[derive(Clone, Copy)]
pub(super) struct Facts {
    pub(super) clusters: u32,
    pub(super) styles: u32,
    /// Greatest distance of a control point from its cluster's origin, along an axis.
    pub(super) reach_m: f64,
    /// The largest steps that points of a cluster are rounded to.
    pub(super) greatest_step_m: f32,
    /// The greatest width that a path has of its own.
    pub(super) widest_m: Option<f32>,
    /// One color, and no widths.
    pub(super) is_plain: bool,
    pub(super) paint: Paint,
}

impl Facts {
    /// What of it says how all of a picture is drawn.
    pub(super) fn looks(&self) -> (Paint, bool, Option<f32>) {
        (self.paint, self.is_plain, self.widest_m)
    }

    fn of(scene: &Scene) -> Self {
        let drawn = scene.draw_order().iter();
        let widths = drawn.filter_map(|&path| scene.width_m(path));
        Self {
            clusters: 0,
            styles: 0,
            reach_m: 0.0,
            greatest_step_m: 0.0,
            widest_m: widths.reduce(f32::max),
            is_plain: is_plain(scene),
            paint: Paint::of(scene),
        }
    }
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
        let easel = Easel {
            keeps: shared.options.keeps,
            ..Easel::default()
        };
        let mut prepared = Self {
            facts: Facts::of(&scene),
            packing: Packing::of(&scene),
            parted: BTreeSet::new(),
            places: None,
            patcher: None,
            kernels: Arc::clone(&shared.kernels),
            shared,
            scene,
            preparation: Preparation::default(),
            memory,
            runner,
            store: None,
            found_fetched,
            easel,
            is_torn: false,
        };
        prepared.bring(prepared.packing)?;
        Ok(prepared)
    }

    /// Brings the scene to the device, in place of what is there.
    pub(super) fn bring(&mut self, packing: Packing) -> Result<(), RenderError> {
        (self.store, self.places) = (None, None);
        self.packing = packing;
        self.is_torn = true;
        self.unbind();
        self.easel.forget();
        self.facts = Facts::of(&self.scene);
        let start = Instant::now();
        let ranks = Ranks::of(&self.scene);
        let parts = all_parts(&self.scene, &ranks);
        self.parted = parts
            .iter()
            .filter(|p| !p.is_whole)
            .map(|p| p.path)
            .collect();
        let packed = Packed::of(&self.scene, parts, packing);
        let facts = &mut self.facts;
        for cluster in &packed.clusters {
            facts.reach_m = facts.reach_m.max(f64::from(cluster.reach_m()));
            facts.greatest_step_m = facts.greatest_step_m.max(cluster.step_m);
        }
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
        self.is_torn = false;
        Ok(())
    }

    /// Makes good a change that did not come to its end. Nothing is drawn before.
    pub(super) fn mend(&mut self) -> Result<(), RenderError> {
        if self.is_torn {
            self.bring(Packing::of(&self.scene))
        } else {
            Ok(())
        }
    }

    /// Tells the device which clusters each chunk has.
    pub(super) fn set_chunks(&self) -> Result<(), RenderError> {
        for chunk in self.store.iter().flat_map(Store::all_chunks) {
            for (params, round) in chunk.params.iter().zip(0..) {
                let set = self
                    .runner
                    .set("the clusters", params, &chunk.params_of(round));
                set.map_err(|what| self.memory.trouble(what))?;
            }
        }
        Ok(())
    }

    /// After colors, widths or states have changed.
    pub(super) fn look_anew(&mut self) {
        let facts = Facts::of(&self.scene);
        self.facts = Facts {
            clusters: self.facts.clusters,
            styles: self.facts.styles,
            reach_m: self.facts.reach_m,
            greatest_step_m: self.facts.greatest_step_m,
            ..facts
        };
    }

    /// After a buffer of the scene has become another.
    pub(super) fn unbind(&mut self) {
        self.easel.unbind();
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
        self.mend()?;
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
            let paint = match style.shading {
                Shading::Color => self.facts.paint,
                Shading::Density(_) => Paint::Density,
            };
            self.make_ready(view, strokes, shot.needs_ranks(paint))?;
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

    fn preparation(&self) -> &Preparation {
        &self.preparation
    }

    fn count_work(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        self.counted(view, style, cancel)
    }
}
