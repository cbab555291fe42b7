//! The way of a frame through its stages, and the buffers that it leaves to the next.

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use guideway_scene::density::{ToneMap, ToneScale};
use guideway_scene::{Frame, RenderError, Shading, Stage, Style, View, elapsed_ms};
use rayon::prelude::*;

use super::bins::Bins;
use super::cluster::Scratch;
use super::crossings::Drawn;
use super::extent::ask_for;
use super::filled::{Filled, Known};
use super::index::{Index, Made};
use super::kept::Kept;
use super::paint::{Band, Filling};
use super::painter::Painter;
use super::shot::{Precision, Shot};
use super::sight::{Sight, Sights};
use super::threads::{own, sum};
use super::tiles::{Grid, Parts};

/// What a frame needs; kept for the next.
pub(super) struct Buffers {
    pub(super) sights: Sights,
    pub(super) parts: Parts,
    pub(super) bins: Bins,
    /// Keys of clusters whose lines have to be made.
    pub(super) todo: Vec<u32>,
    pub(super) counts: Vec<f32>,
    scratches: Vec<Mutex<Scratch>>,
    painters: Vec<Mutex<Painter>>,
    pub(super) stages: Vec<Stage>,
    pub(super) peak_bytes: u64,
    pub(super) drawn: u64,
    pub(super) made: u64,
}

/// There is more than the memory allowed: so many bytes, at least.
pub(super) struct TooMuch(pub(super) u64);

/// A picture being drawn.
pub(super) struct Easel<'a, 'p> {
    pub(super) shot: &'a Shot<'a>,
    pub(super) frame: &'p mut Frame,
    /// What is not drawn shows this.
    pub(super) kept: Option<&'a Kept>,
    /// What is full for certain, and where it is found out what will be.
    pub(super) known: Known<'a>,
    pub(super) filled: Option<(&'a Filled, Known<'a>)>,
    /// Most bytes for lines, and for what lies where.
    pub(super) limit_bytes: u64,
}

impl Buffers {
    pub(super) fn new(threads: usize) -> Self {
        Self {
            sights: Sights::default(),
            parts: Parts::default(),
            bins: Bins::new(),
            todo: Vec::new(),
            counts: Vec::new(),
            scratches: (0..threads).map(|_| Mutex::default()).collect(),
            painters: (0..threads).map(|_| Mutex::new(Painter::new())).collect(),
            stages: Vec::new(),
            peak_bytes: 0,
            drawn: 0,
            made: 0,
        }
    }

    pub(super) fn start(&mut self) {
        self.stages.clear();
        (self.peak_bytes, self.drawn, self.made) = (0, 0, 0);
    }

    /// Does one stage, and adds its time to what it took in other bands.
    pub(super) fn time<R>(&mut self, name: &'static str, work: impl FnOnce(&mut Self) -> R) -> R {
        let start = Instant::now();
        let result = work(self);
        Stage::merge(&mut self.stages, [Stage::host(name, elapsed_ms(start))]);
        result
    }

    /// Bytes of what is neither lines nor what lies where.
    fn scratch_bytes(&self) -> u64 {
        let todo = self.todo.capacity() * size_of::<u32>();
        let of_threads =
            sum(&self.scratches, Scratch::bytes) + sum(&self.painters, Painter::list_bytes);
        self.sights.bytes() + self.parts.bytes() + todo as u64 + of_threads
    }

    /// Counts paths and colors the counts; says in how many bands. A part of a picture is colored by how all of it
    /// is, which is looked at once.
    pub(super) fn draw_density(
        &mut self,
        easel: &mut Easel<'_, '_>,
        index: &mut Index,
        tone: ToneMap,
        known: &mut Option<(View, Style, ToneScale)>,
    ) -> Result<Result<u32, TooMuch>, RenderError> {
        let shot = easel.shot;
        let mut tones = ToneScale::new(tone);
        if !shot.strip.is_whole() {
            let of_picture = known.take();
            let of_picture =
                of_picture.filter(|(view, style, _)| view == shot.view && style == shot.style);
            if let Some((_, _, of_picture)) = of_picture {
                tones = of_picture;
            } else {
                for strip in shot.view.strips(shot.strip.size().pixels()) {
                    let mut easel = Easel {
                        shot: &Shot {
                            strip: &strip,
                            ..*shot
                        },
                        frame: &mut *easel.frame,
                        ..*easel
                    };
                    self.parts.fill(&strip);
                    if let Err(too_much) = self.draw(&mut easel, index)? {
                        return Ok(Err(too_much));
                    }
                    tones.observe(&self.counts);
                }
                self.parts.fill(shot.strip);
                (self.drawn, self.made) = (0, 0);
            }
        }
        let drawn = self.draw(easel, index)?;
        self.time("shade", |b| {
            if shot.strip.is_whole() {
                tones.observe(&b.counts);
            }
            tones.shade(&b.counts, shot.style.background, easel.frame);
        });
        *known = Some((*shot.view, *shot.style, tones));
        Ok(drawn)
    }

    /// Draws a strip: pixels, or the counts of paths for them. Says in how many bands.
    pub(super) fn draw(
        &mut self,
        easel: &mut Easel<'_, '_>,
        index: &mut Index,
    ) -> Result<Result<u32, TooMuch>, RenderError> {
        let strip = easel.shot.strip;
        if easel.shot.style.shading != Shading::Color {
            self.counts.resize(strip.size().pixels(), 0.0);
        }
        self.draw_rows(easel, index, Grid::of(strip).rows)
    }

    /// Draws some rows of tiles, at once or, if that takes too much memory, one half after the other; says
    /// in how many bands.
    fn draw_rows(
        &mut self,
        easel: &mut Easel<'_, '_>,
        index: &mut Index,
        rows: Range<usize>,
    ) -> Result<Result<u32, TooMuch>, RenderError> {
        let drawn = self.band(easel, index, rows.clone())?;
        if drawn.is_ok() || rows.len() == 1 {
            return Ok(drawn.map(|()| 1));
        }
        // What a whole band held is more than its half needs.
        index.forget_lines(|_| false);
        for scratch in &mut self.scratches {
            *scratch = Mutex::default();
        }
        let middle = rows.start + rows.len() / 2;
        let mut bands = 0;
        for half in [rows.start..middle, middle..rows.end] {
            match self.draw_rows(easel, index, half)? {
                Ok(of_half) => bands += of_half,
                Err(too_much) => return Ok(Err(too_much)),
            }
        }
        Ok(Ok(bands))
    }

    /// Draws one band, unless it takes too much memory.
    fn band(
        &mut self,
        easel: &mut Easel<'_, '_>,
        index: &mut Index,
        rows: Range<usize>,
    ) -> Result<Result<(), TooMuch>, RenderError> {
        let shot = easel.shot;
        let grid = Grid {
            rows: rows.clone(),
            ..Grid::of(shot.strip)
        };
        let flattened = self.time("flatten", |b| {
            b.flatten(shot, index, &rows, easel.limit_bytes)
        })?;
        let others_bytes = match flattened {
            Ok(lines_bytes) => lines_bytes + self.scratch_bytes(),
            Err(too_much) => return Ok(Err(too_much)),
        };
        let spare_bytes = easel.limit_bytes.saturating_sub(others_bytes);
        let binned: Result<_, u64> = self.time("bin", |b| {
            let drawn = Drawn {
                shot,
                index,
                sights: &b.sights,
                parts: &b.parts,
                grid: &grid,
            };
            let (bins, sights) = (&mut b.bins, &b.sights);
            let (filled, counts) = rayon::join(
                || bins.fill(drawn, spare_bytes),
                || count(sights, shot, index, &rows),
            );
            if filled.is_ok() {
                (b.drawn, b.made) = (b.drawn + counts[0], b.made + counts[1]);
            }
            filled
        });
        if let Err(needed) = binned {
            return Ok(Err(TooMuch(others_bytes + needed)));
        }
        self.time("cover", |b| {
            let mut counts = std::mem::take(&mut b.counts);
            let thinner = easel.filled.map(|(filled, _)| shot.thinner(filled.nearer));
            let filling = easel.filled.zip(thinner.as_ref());
            let filling = filling.map(|((filled, known), shot)| Filling {
                shot,
                filled,
                known,
            });
            let band = Band {
                shot,
                grid: &grid,
                index,
                sights: &b.sights,
                bins: &b.bins,
                parts: &b.parts,
                kept: easel.kept,
                known: easel.known,
                filling,
                common_radius_px: shot.common_radius_px(),
                widest_px: shot.widest_px(),
                painters: &b.painters,
            };
            let within = shot.pixels_of(&rows);
            let done = match shot.style.shading {
                Shading::Color => band.color(&mut easel.frame.pixels_mut()[within], shot.solid),
                Shading::Density(_) => band.density(&mut counts[within]),
            };
            b.counts = counts;
            done
        })?;
        let bytes = index.lines_bytes + self.bins.bytes() + self.scratch_bytes();
        self.peak_bytes = self.peak_bytes.max(bytes);
        Ok(Ok(()))
    }

    /// Makes the lines of a band that are not there; says how many bytes all lines take.
    fn flatten(
        &mut self,
        shot: &Shot<'_>,
        index: &mut Index,
        rows: &Range<usize>,
        limit_bytes: u64,
    ) -> Result<Result<u64, TooMuch>, RenderError> {
        if index.lines_bytes > limit_bytes / 2 {
            let mut is_kept = vec![false; index.lines.len()];
            for sight in self.sights.iter().filter(|sight| sight.is_in(rows)) {
                is_kept[sight.cluster as usize] = true;
            }
            index.forget_lines(|cluster| is_kept[cluster as usize]);
        }
        self.todo.clear();
        for (key, sight) in self.sights.with_keys() {
            if sight.is_in(rows) {
                let made = &mut index.made[sight.cluster as usize];
                if sight.is_large || !made.is_good(shot) {
                    self.todo.push(key);
                    // If this is not carried through, they have to be made anew.
                    made.precision = Precision::default();
                }
            }
        }
        let total = AtomicU64::new(index.lines_bytes);
        let mut lines = std::mem::take(&mut index.lines);
        let place = |key| self.sights.get(key).cluster as usize;
        let ask = |key| {
            let paths = index.paths_of(self.sights.get(key).cluster);
            ask_for(shot.scene, paths.iter().map(|&path| path as usize));
        };
        for_each_at(&mut lines, 0, &self.todo, (&place, &ask), &|key, lines| {
            let is_over = total.load(Ordering::Relaxed) > limit_bytes;
            let sight = self.sights.get(key);
            let Some(extent) = index.extents[sight.cluster as usize] else {
                return;
            };
            if is_over || shot.cancel.check().is_err() {
                return;
            }
            let mut scratch = own(&self.scratches);
            let before = lines.bytes();
            let paths = index.paths_of(sight.cluster);
            let cluster = (paths, extent.middle);
            lines.make(shot, sight, cluster, rows, &mut scratch);
            total.fetch_add(lines.bytes().wrapping_sub(before), Ordering::Relaxed);
        });
        index.lines = lines;
        index.lines_bytes = total.into_inner();
        shot.cancel.check()?;
        if index.lines_bytes > limit_bytes {
            return Ok(Err(TooMuch(index.lines_bytes)));
        }
        for &key in &self.todo {
            let sight = self.sights.get(key);
            let cluster = sight.cluster as usize;
            index.made[cluster] = Made {
                precision: if sight.is_large {
                    Precision::default()
                } else {
                    shot.precision()
                },
                drift_m: 0.0,
                paths_and_lines: index.lines[cluster].paths_and_lines(),
            };
        }
        Ok(Ok(index.lines_bytes))
    }
}

/// Counts the paths and the lines that may leave a mark: each cluster with the band where it begins.
fn count(sights: &Sights, shot: &Shot<'_>, index: &Index, rows: &Range<usize>) -> [u64; 2] {
    let of_chunk = |sights: &[Sight]| {
        let begin_here = sights.iter();
        let begin_here = begin_here.filter(|sight| rows.contains(&sight.rows().start));
        let counts = begin_here.map(|sight| {
            let cluster = sight.cluster as usize;
            if sight.is_whole {
                index.made[cluster].paths_and_lines
            } else {
                index.lines[cluster].count(shot, sight)
            }
        });
        counts.fold([0, 0], |sum, of_one| {
            [0, 1].map(|i| sum[i] + u64::from(of_one[i]))
        })
    };
    let counts = sights.par_chunks().map(of_chunk);
    counts.reduce(|| [0, 0], |a, b| [a[0] + b[0], a[1] + b[1]])
}

/// Calls `work` for some elements, in parallel: for each key, whose places rise, with that at its place. The first
/// of `all` has the place `first`. `ask` is called for each key while the one before it is worked on, so that what it needs is near by then.
fn for_each_at<T: Send, K: Copy + Sync>(
    all: &mut [T],
    first: usize,
    keys: &[K],
    (place, ask): (&(impl Fn(K) -> usize + Sync), &(impl Fn(K) + Sync)),
    work: &(impl Fn(K, &mut T) + Sync),
) {
    const AT_ONCE: usize = 8;
    if keys.len() <= AT_ONCE {
        if let Some(&key) = keys.first() {
            ask(key);
        }
        for (i, &key) in keys.iter().enumerate() {
            if let Some(&next) = keys.get(i + 1) {
                ask(next);
            }
            work(key, &mut all[place(key) - first]);
        }
        return;
    }
    let (left, right) = keys.split_at(keys.len() / 2);
    let middle = place(right[0]);
    let (before, behind) = all.split_at_mut(middle - first);
    rayon::join(
        || for_each_at(before, first, left, (place, ask), work),
        || for_each_at(behind, middle, right, (place, ask), work),
    );
}
