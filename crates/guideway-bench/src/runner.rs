//! One method under measurement: prepares a scene once, then draws and times its frames.

use std::sync::Arc;
use std::time::Instant;

use guideway_scene::Scene;
use guideway_scene::{
    Budget, Cancel, Edited, Frame, FrameSize, Method, Prepared, RenderError, Report, Style, View,
    Work, elapsed_ms,
};

use crate::Motion;
use crate::edits::Edits;
use crate::measured::Prepare;

/// A method with a scene made ready.
pub struct Runner<'m> {
    method: &'m dyn Method,
    budget: Budget,
    prepared: Box<dyn Prepared>,
    prepare: Prepare,
    frame: Frame,
}

/// What is drawn, and how often.
#[derive(Clone)]
pub struct Shot {
    /// What the first frame sees.
    pub view: View,
    /// What changes from frame to frame.
    pub motion: Motion,
    /// What [`Motion::Edit`] changes.
    pub edits: Option<Edits>,
    /// How it looks.
    pub style: Style,
    /// How often.
    pub frames: Frames,
}

/// How many frames are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    /// Frames after the first that do not count.
    pub warmup: usize,
    /// Frames that count.
    pub count: usize,
    /// Once a method has drawn for so long, one frame that counts is enough.
    pub enough_ms: f64,
}

/// One drawn frame.
pub struct Sample {
    /// Until the picture was complete where it was made, with the update.
    pub frame_ms: f64,
    /// Seen from outside.
    pub wall_ms: f64,
    /// Making the changed scene ready.
    pub update: Option<Update>,
    /// What the method says.
    pub report: Report,
}

/// Making a changed scene ready.
#[derive(Clone, Copy)]
pub struct Update {
    /// Wall time in milliseconds.
    pub ms: f64,
    /// Brought to the device; none where all of the scene was made ready anew.
    pub bytes: Option<u64>,
}

impl<'m> Runner<'m> {
    /// Makes a scene ready.
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

    /// What making the scene ready took, the first time.
    pub fn preparation(&self) -> &Prepare {
        &self.prepare
    }

    /// Bytes held from frame to frame, and most held while making ready.
    pub fn held_and_peak_bytes(&self) -> (u64, u64) {
        let preparation = self.prepared.preparation();
        (preparation.held_bytes, preparation.peak_bytes)
    }

    /// Draws one picture and returns it.
    pub fn picture(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<&Frame, RenderError> {
        self.prepared.render(view, style, cancel, &mut self.frame)?;
        Ok(&self.frame)
    }

    /// Draws frame `number` of a shot.
    pub fn draw(
        &mut self,
        shot: &Shot,
        number: usize,
        cancel: &Cancel,
    ) -> Result<Sample, RenderError> {
        cancel.check()?;
        let view = shot.motion.view(&shot.view, number)?;
        let started = Instant::now();
        let edits = shot.edits.as_ref();
        let update = edits.map(|edits| self.update(edits, number)).transpose()?;
        let report = self
            .prepared
            .render(&view, &shot.style, cancel, &mut self.frame)?;
        Ok(Sample {
            frame_ms: report.frame_ms() + update.map_or(0.0, |update| update.ms),
            wall_ms: elapsed_ms(started),
            update,
            report,
        })
    }

    /// Changes the scene in place, or makes the changed one ready if the method cannot do that.
    fn update(&mut self, edits: &Edits, number: usize) -> Result<Update, RenderError> {
        let started = Instant::now();
        if let Edited::InPlace { moved_bytes } = self.prepared.edit(edits.edit(number))? {
            return Ok(Update {
                ms: elapsed_ms(started),
                bytes: Some(moved_bytes),
            });
        }
        let (prepared, prepare) = prepare(self.method, edits.scene(number)?, &self.budget)?;
        self.prepared = prepared;
        Ok(Update {
            ms: prepare.ms,
            bytes: None,
        })
    }

    /// Counts the work of the first frame of a shot.
    pub fn count_work(&mut self, shot: &Shot, cancel: &Cancel) -> Result<Work, RenderError> {
        self.prepared.count_work(&shot.view, &shot.style, cancel)
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
    use crate::{Dataset, Moves};

    /// A method that takes a changed scene only by preparing it.
    struct Anew;
    struct PreparedAnew(Box<dyn Prepared>);

    impl Method for Anew {
        fn info(&self) -> MethodInfo {
            Oracle.info()
        }

        fn prepare(
            &self,
            scene: Arc<Scene>,
            budget: &Budget,
        ) -> Result<Box<dyn Prepared>, RenderError> {
            Ok(Box::new(PreparedAnew(Oracle.prepare(scene, budget)?)))
        }
    }

    impl Prepared for PreparedAnew {
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
    fn an_edit_shows_in_turn_in_place_and_anew() {
        let scene = Dataset::D1.scene(30);
        let size = FrameSize::new(96, 54).unwrap();
        let shot = Shot {
            view: View::fit(size, scene.bounds()).unwrap(),
            motion: Motion::Edit,
            edits: Some(Edits::new(
                &scene,
                Moves {
                    share: 0.5,
                    is_apart: false,
                },
            )),
            style: Style::default(),
            frames: Frames {
                warmup: 0,
                count: 1,
                enough_ms: f64::INFINITY,
            },
        };
        let cancel = Cancel::default();
        let runner = |method| Runner::new(method, &scene, Budget::default()).unwrap();
        let (mut in_place, mut anew) = (runner(&Oracle), runner(&Anew));
        let before = in_place.picture(&shot.view, &shot.style, &cancel).unwrap();
        let before = before.clone();
        for number in 0..4 {
            let sample = in_place.draw(&shot, number, &cancel).unwrap();
            assert_eq!(sample.update.unwrap().bytes, Some(0));
            let sample = anew.draw(&shot, number, &cancel).unwrap();
            assert_eq!(sample.update.unwrap().bytes, None);
            assert_eq!(in_place.frame == before, number % 2 == 1);
            assert!(in_place.frame == anew.frame, "frame {number}");
        }
    }
}
