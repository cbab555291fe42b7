//! Methods draw the same frames in turns, one frame each, so that whatever drifts hits all alike.

use std::time::Instant;

use guideway_scene::{Cancel, Clock, RenderError, Report, elapsed_ms};

use crate::Summary;
use crate::measured::{Fault, FrameTime, Measured, PathCounts, StageTime, WorkCounts};
use crate::runner::{Frames, Runner, Sample, Shot};

/// Draws a shot with every runner and returns one result for each.
///
/// # Errors
/// Only when the caller cancels; other failures are results.
pub fn measure(
    runners: &mut [Runner<'_>],
    shot: &Shot,
    cancel: &Cancel,
) -> Result<Vec<Result<Measured, Fault>>, RenderError> {
    let mut tracks: Vec<Result<Track, Fault>> =
        runners.iter().map(|_| Ok(Track::default())).collect();
    let mut turn = 0;
    let is_open = |track: &Result<Track, _>| matches!(track, Ok(t) if !t.is_done(&shot.frames));
    while tracks.iter().any(is_open) {
        for step in 0..runners.len() {
            // Another one begins each time, so that none always comes after the same neighbor.
            let who = (turn + step) % runners.len();
            let Ok(track) = &mut tracks[who] else {
                continue;
            };
            if !track.is_done(&shot.frames)
                && let Err(error) = track.advance(&mut runners[who], shot, cancel)
            {
                tracks[who] = Err(error);
            }
            cancel.check()?;
        }
        turn += 1;
    }
    let mut results = Vec::with_capacity(runners.len());
    for (runner, track) in runners.iter_mut().zip(tracks) {
        results.push(track.and_then(|track| track.finish(runner, shot, cancel)));
        cancel.check()?;
    }
    Ok(results)
}

/// What one method has drawn so far.
#[derive(Default)]
struct Track {
    drawn: usize,
    spent_ms: f64,
    first: FrameTime,
    frame_ms: Vec<f64>,
    wall_ms: Vec<f64>,
    update_ms: Vec<f64>,
    update_bytes: Option<u64>,
    stages: Vec<(&'static str, Clock, Vec<f64>)>,
    last: Report,
}

impl Track {
    fn is_done(&self, frames: &Frames) -> bool {
        self.frame_ms.len() >= frames.count.max(1)
            || (!self.frame_ms.is_empty() && self.spent_ms > frames.enough_ms)
    }

    fn advance(
        &mut self,
        runner: &mut Runner<'_>,
        shot: &Shot,
        cancel: &Cancel,
    ) -> Result<(), Fault> {
        let started = Instant::now();
        let sample = runner.draw(shot, self.drawn, cancel)?;
        if self.drawn == 0 {
            self.first = FrameTime {
                ms: sample.frame_ms,
                wall_ms: sample.wall_ms,
                update_ms: sample.update.map(|update| update.ms),
            };
        } else if self.drawn > shot.frames.warmup || self.spent_ms > shot.frames.enough_ms {
            self.keep(sample);
        }
        self.drawn += 1;
        self.spent_ms += elapsed_ms(started);
        Ok(())
    }

    fn keep(&mut self, sample: Sample) {
        self.frame_ms.push(sample.frame_ms);
        self.wall_ms.push(sample.wall_ms);
        self.update_ms.extend(sample.update.map(|update| update.ms));
        self.update_bytes = sample.update.and_then(|update| update.bytes);
        for stage in &sample.report.stages {
            let known = self
                .stages
                .iter_mut()
                .find(|(name, ..)| *name == stage.name);
            match known {
                Some((.., samples)) => samples.push(stage.elapsed_ms),
                None => self
                    .stages
                    .push((stage.name, stage.clock, vec![stage.elapsed_ms])),
            }
        }
        self.last = sample.report;
    }

    fn finish(
        self,
        runner: &mut Runner<'_>,
        shot: &Shot,
        cancel: &Cancel,
    ) -> Result<Measured, Fault> {
        let report = &self.last;
        if !report.accounts_for_all() {
            return Err(Fault::Report("does not account for every path"));
        }
        let summary = |samples: &[f64]| {
            Summary::of(samples).ok_or(Fault::Report("has a time that is not a number"))
        };
        let stages = self.stages.iter().map(|(name, clock, samples)| {
            Ok(StageTime::new(name, *clock, summary(samples)?.median))
        });
        let work = runner.count_work(shot, cancel)?;
        let (held_bytes, prepare_peak_bytes) = runner.held_and_peak_bytes();
        Ok(Measured {
            prepare: runner.preparation().clone(),
            first_frame: self.first,
            frame_ms: summary(&self.frame_ms)?,
            wall_ms: summary(&self.wall_ms)?,
            update_ms: Summary::of(&self.update_ms),
            update_bytes: self.update_bytes,
            stages: stages.collect::<Result<_, Fault>>()?,
            paths: PathCounts::from(report),
            lines: report.lines,
            bands: report.bands,
            held_bytes,
            peak_bytes: prepare_peak_bytes.max(report.peak_bytes),
            work: WorkCounts::of_frame(work, shot.view.size().pixels()),
            notes: report.notes.clone(),
        })
    }
}
