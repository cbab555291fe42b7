//! A runner prepares a scene once with one method, then draws frames and returns their times.

use std::sync::Arc;
use std::time::Instant;

use guideway_scene::{
    Budget, Cancel, EditOutcome, Frame, FrameSize, Method, Prepared, RenderError, Report, Scene,
    Style, View, Work, elapsed_ms,
};

use crate::Motion;
use crate::edits::{Change, Edits};
use crate::measured::Prepare;

/// A method with a prepared scene.
pub struct Runner<'m> {
    method: &'m dyn Method,
    budget: Budget,
    prepared: Box<dyn Prepared>,
    prepare: Prepare,
    frame: Frame,
}

/// The view, motion and style of the frames to draw, and their number.
#[derive(Clone)]
pub struct FrameRequest {
    /// View of the first frame.
    pub view: View,
    /// Change from frame to frame.
    pub motion: Motion,
    /// Edits of [`Motion::Edit`]; `None` for other motions.
    pub edits: Option<Edits>,
    /// Style of the frames.
    pub style: Style,
    /// Number of frames.
    pub frames: Frames,
}

/// Number of frames per method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// Unmeasured frames after the first.
    pub warmup: usize,
    /// Measured frames.
    pub count: usize,
    /// Drawing time in milliseconds after which one measured frame suffices.
    pub enough_ms: f64,
}

/// One drawn frame.
pub struct Sample {
    /// Time in milliseconds until the picture is complete in the memory of the method, including
    /// the update.
    pub frame_ms: f64,
    /// Wall time of the call, in milliseconds.
    pub wall_ms: f64,
    /// Update to the changed scene; `None` without an edit.
    pub update: Option<Update>,
    /// Report of the method.
    pub report: Report,
}

/// The update of a prepared scene to an edit.
#[derive(Clone, Copy)]
pub struct Update {
    /// Wall time in milliseconds.
    pub ms: f64,
    /// Bytes uploaded to the device; `None` if the method prepared the whole scene again.
    pub bytes: Option<u64>,
    /// True if a gesture shows the change, and the scene stays.
    pub is_gesture: bool,
}

impl<'m> Runner<'m> {
    /// Prepares a scene.
    ///
    /// # Errors
    /// When the method refuses the scene or the budget.
    pub fn new(
        method: &'m dyn Method,
        scene: &Arc<Scene>,
        budget: Budget,
    ) -> Result<Self, RenderError> {
        let (prepared, prepare) = prepare(method, scene, &budget)?;
        Ok(Self {
            method,
            budget,
            prepared,
            prepare,
            frame: Frame::new(FrameSize::new(1, 1)?),
        })
    }

    /// Times and work of the first preparation.
    pub fn preparation(&self) -> &Prepare {
        &self.prepare
    }

    /// Bytes held between frames, and peak bytes of the preparation.
    pub fn held_and_peak_bytes(&self) -> (u64, u64) {
        let preparation = self.prepared.preparation();
        (preparation.held_bytes, preparation.peak_bytes)
    }

    /// Draws one picture and returns it.
    ///
    /// # Errors
    /// When the method fails or the caller cancels.
    pub fn picture(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<&Frame, RenderError> {
        self.prepared.render(view, style, cancel, &mut self.frame)?;
        Ok(&self.frame)
    }

    /// Draws frame `number` of a request.
    ///
    /// # Errors
    /// When the method fails, the caller cancels, or no such view exists.
    pub fn draw(
        &mut self,
        request: &FrameRequest,
        number: usize,
        cancel: &Cancel,
    ) -> Result<Sample, RenderError> {
        cancel.check()?;
        let view = request.motion.view(&request.view, number)?;
        let started = Instant::now();
        let edits = request.edits.as_ref();
        let update = edits.map(|edits| self.update(edits, number)).transpose()?;
        let report = self
            .prepared
            .render(&view, &request.style, cancel, &mut self.frame)?;
        Ok(Sample {
            frame_ms: report.frame_ms() + update.map_or(0.0, |update| update.ms),
            wall_ms: elapsed_ms(started),
            update,
            report,
        })
    }

    /// Draws frame `number` of a request and leaves its picture on the device. Returns the wall
    /// time of the call in milliseconds; `None` if the method draws only into main memory.
    ///
    /// # Errors
    /// As [`Self::draw`].
    pub fn draw_on_device(
        &mut self,
        request: &FrameRequest,
        number: usize,
        cancel: &Cancel,
    ) -> Result<Option<f64>, RenderError> {
        cancel.check()?;
        let view = request.motion.view(&request.view, number)?;
        let started = Instant::now();
        if let Some(edits) = &request.edits {
            self.update(edits, number)?;
        }
        let drawn = self
            .prepared
            .render_on_device(&view, &request.style, cancel)?;
        Ok(drawn.map(|_| elapsed_ms(started)))
    }

    /// Shows a gesture, or edits the prepared scene in place, or prepares the edited scene if the
    /// method cannot.
    fn update(&mut self, edits: &Edits, number: usize) -> Result<Update, RenderError> {
        let started = Instant::now();
        if let Some(gesture) = edits.gesture(number)
            && let EditOutcome::InPlace { moved_bytes } =
                self.prepared.show_gesture(Some(gesture))?
        {
            return Ok(Update {
                ms: elapsed_ms(started),
                bytes: Some(moved_bytes),
                is_gesture: true,
            });
        }
        let changed = match edits.change(number) {
            Change::Edit(edit) => self.prepared.edit(edit)?,
            Change::Coloring(coloring) => self.prepared.recolor(coloring)?,
        };
        if let EditOutcome::InPlace { moved_bytes } = changed {
            return Ok(Update {
                ms: elapsed_ms(started),
                bytes: Some(moved_bytes),
                is_gesture: false,
            });
        }
        let (prepared, prepare) = prepare(self.method, edits.scene(number)?, &self.budget)?;
        self.prepared = prepared;
        Ok(Update {
            ms: prepare.ms,
            bytes: None,
            is_gesture: false,
        })
    }

    /// Counts the work of the first frame of a request.
    ///
    /// # Errors
    /// When the method fails or the caller cancels.
    pub fn count_work(
        &mut self,
        request: &FrameRequest,
        cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        self.prepared
            .count_work(&request.view, &request.style, cancel)
    }
}

fn prepare(
    method: &dyn Method,
    scene: &Arc<Scene>,
    budget: &Budget,
) -> Result<(Box<dyn Prepared>, Prepare), RenderError> {
    let started = Instant::now();
    let prepared = method.prepare(Arc::clone(scene), budget)?;
    let prepare = Prepare::new(prepared.preparation(), elapsed_ms(started));
    Ok((prepared, prepare))
}

#[cfg(test)]
mod tests {
    use guideway_cpu::Oracle;
    use guideway_scene::{MethodInfo, Preparation};

    use super::*;
    use crate::{Dataset, Moves, Way};

    /// A method that cannot edit in place: it prepares each edited scene again.
    struct Repreparing;
    struct Reprepared(Box<dyn Prepared>);

    impl Method for Repreparing {
        fn info(&self) -> MethodInfo {
            Oracle.info()
        }

        fn prepare(
            &self,
            scene: Arc<Scene>,
            budget: &Budget,
        ) -> Result<Box<dyn Prepared>, RenderError> {
            Ok(Box::new(Reprepared(Oracle.prepare(scene, budget)?)))
        }
    }

    impl Prepared for Reprepared {
        fn render(
            &mut self,
            view: &View,
            style: &Style,
            cancel: &Cancel,
            frame: &mut Frame,
        ) -> Result<Report, RenderError> {
            self.0.render(view, style, cancel, frame)
        }

        fn preparation(&self) -> &Preparation {
            self.0.preparation()
        }
    }

    #[test]
    fn edits_in_place_and_by_preparation_draw_equal_frames() {
        let scene = Dataset::D1.scene(30);
        let size = FrameSize::new(96, 54).unwrap();
        for way in [Way::Gesture, Way::Drop, Way::Recolor] {
            let request = FrameRequest {
                view: View::fit(size, scene.bounds()).unwrap(),
                motion: Motion::Edit,
                edits: Some(Edits::new(&scene, Moves { share: 0.5, way })),
                style: Style::default(),
                frames: Frames {
                    warmup: 0,
                    count: 1,
                    enough_ms: f64::INFINITY,
                },
            };
            let cancel = Cancel::default();
            let runner = |method| Runner::new(method, &scene, Budget::default()).unwrap();
            let (mut in_place, mut prepared_again) = (runner(&Oracle), runner(&Repreparing));
            let before = in_place
                .picture(&request.view, &request.style, &cancel)
                .unwrap();
            let before = before.clone();
            for number in 0..4 {
                let sample = in_place.draw(&request, number, &cancel).unwrap();
                assert_eq!(sample.update.unwrap().bytes, Some(0));
                let sample = prepared_again.draw(&request, number, &cancel).unwrap();
                assert_eq!(sample.update.unwrap().bytes, None);
                assert_eq!(in_place.frame == before, number % 2 == 1);
                assert!(in_place.frame == prepared_again.frame, "frame {number}");
            }
        }
    }
}
