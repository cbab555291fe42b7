//! Draws the frames of a request with several runners in turns, one frame each, and returns one
//! result per runner. A drift of the machine (heat, other load) thus affects all methods alike.

use std::time::Instant;

use guideway_scene::{Cancel, Clock, RenderError, Report, elapsed_ms};

use crate::Summary;
use crate::measured::{FrameTime, MeasureError, Measured, PathCounts, StageTime, WorkCounts};
use crate::runner::{FrameRequest, Frames, Runner, Sample};

/// Draws a request with every runner and returns one result per runner.
///
/// # Errors
/// Only when the caller cancels; other failures are part of the results.
pub fn measure(
    runners: &mut [Runner<'_>],
    request: &FrameRequest,
    cancel: &Cancel,
) -> Result<Vec<Result<Measured, MeasureError>>, RenderError> {
    let mut tracks: Vec<Result<Track, MeasureError>> =
        runners.iter().map(|_| Ok(Track::default())).collect();
    let mut turn = 0;
    let is_open = |track: &Result<Track, _>| matches!(track, Ok(t) if !t.is_done(&request.frames));
    while tracks.iter().any(is_open) {
        for step in 0..runners.len() {
            // The first runner changes each turn, so that none always follows the same neighbor.
            let index = (turn + step) % runners.len();
            let Ok(track) = &mut tracks[index] else {
                continue;
            };
            if !track.is_done(&request.frames)
                && let Err(error) = track.advance(&mut runners[index], request, cancel)
            {
                tracks[index] = Err(error);
            }
            cancel.check()?;
        }
        turn += 1;
    }
    let mut results = Vec::with_capacity(runners.len());
    for (runner, track) in runners.iter_mut().zip(tracks) {
        results.push(track.and_then(|track| track.finish(runner, request, cancel)));
        cancel.check()?;
    }
    Ok(results)
}

/// Samples of one method so far.
#[derive(Default)]
struct Track {
    drawn: usize,
    spent_ms: f64,
    first: FrameTime,
    frame_ms: Vec<f64>,
    wall_ms: Vec<f64>,
    update_ms: Vec<f64>,
    update_bytes: Option<u64>,
    update_is_gesture: Option<bool>,
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
        request: &FrameRequest,
        cancel: &Cancel,
    ) -> Result<(), MeasureError> {
        let started = Instant::now();
        let sample = runner.draw(request, self.drawn, cancel)?;
        if self.drawn == 0 {
            self.first = FrameTime {
                ms: sample.frame_ms,
                wall_ms: sample.wall_ms,
                update_ms: sample.update.map(|update| update.ms),
            };
        } else if self.drawn > request.frames.warmup || self.spent_ms > request.frames.enough_ms {
            self.record(sample);
        }
        self.drawn += 1;
        self.spent_ms += elapsed_ms(started);
        Ok(())
    }

    fn record(&mut self, sample: Sample) {
        self.frame_ms.push(sample.frame_ms);
        self.wall_ms.push(sample.wall_ms);
        self.update_ms.extend(sample.update.map(|update| update.ms));
        self.update_bytes = sample.update.and_then(|update| update.bytes);
        self.update_is_gesture = sample.update.map(|update| update.is_gesture);
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

    /// Wall times of as many frames, one after the other, whose pictures stay on the device; empty
    /// if the method draws only into main memory.
    fn device_wall_ms(
        &self,
        runner: &mut Runner<'_>,
        request: &FrameRequest,
        cancel: &Cancel,
    ) -> Result<Vec<f64>, MeasureError> {
        let mut all = Vec::new();
        let frames = request.frames.warmup + self.frame_ms.len();
        for number in self.drawn..self.drawn + frames {
            match runner.draw_on_device(request, number, cancel)? {
                Some(wall_ms) => all.push(wall_ms),
                None => return Ok(Vec::new()),
            }
        }
        Ok(all.split_off(request.frames.warmup))
    }

    fn finish(
        self,
        runner: &mut Runner<'_>,
        request: &FrameRequest,
        cancel: &Cancel,
    ) -> Result<Measured, MeasureError> {
        let report = &self.last;
        if !report.accounts_for_all() {
            return Err(MeasureError::Report("does not account for every path"));
        }
        let summary = |samples: &[f64]| {
            Summary::of(samples).ok_or(MeasureError::Report("has a time that is not finite"))
        };
        let stages = self.stages.iter().map(|(name, clock, samples)| {
            Ok(StageTime::new(name, *clock, summary(samples)?.median))
        });
        let device_wall_ms = self.device_wall_ms(runner, request, cancel)?;
        let work = runner.count_work(request, cancel)?;
        let (held_bytes, prepare_peak_bytes) = runner.held_and_peak_bytes();
        Ok(Measured {
            prepare: runner.preparation().clone(),
            first_frame: self.first,
            frame_ms: summary(&self.frame_ms)?,
            wall_ms: summary(&self.wall_ms)?,
            device_wall_ms: Summary::of(&device_wall_ms),
            update_ms: Summary::of(&self.update_ms),
            update_bytes: self.update_bytes,
            update_is_gesture: self.update_is_gesture,
            stages: stages.collect::<Result<_, MeasureError>>()?,
            paths: PathCounts::from(report),
            lines: report.lines,
            bands: report.bands,
            held_bytes,
            peak_bytes: prepare_peak_bytes.max(report.peak_bytes),
            work: WorkCounts::of_frame(work, request.view.size().pixels()),
            notes: report.notes.clone(),
        })
    }
}
