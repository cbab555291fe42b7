use std::sync::Arc;
use std::time::Instant;

use guideway_render::{
    Budget, Cancel, Frame, FrameSize, Method, Prepared, RenderError, Report, Style, View, Work,
    elapsed_ms,
};
use guideway_scene::Scene;

use crate::Motion;
use crate::measured::Prepare;

/// A method with a scene made ready.
pub(crate) struct Runner<'m> {
    method: &'m dyn Method,
    budget: Budget,
    prepared: Box<dyn Prepared>,
    prepare: Prepare,
    frame: Frame,
}

/// What is drawn, and how often.
#[derive(Clone)]
pub(crate) struct Shot {
    /// What the first frame sees.
    pub(crate) view: View,
    /// What changes from frame to frame.
    pub(crate) motion: Motion,
    /// The scene before and after an edit, which [`Motion::Edit`] shows in turn.
    pub(crate) edits: Option<[Arc<Scene>; 2]>,
    /// How it looks.
    pub(crate) style: Style,
    /// How often.
    pub(crate) frames: Frames,
}

/// How many frames are taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frames {
    /// Frames after the first that do not count.
    pub(crate) warmup: usize,
    /// Frames that count.
    pub(crate) count: usize,
    /// Once a method has drawn for so long, one frame that counts is enough.
    pub(crate) enough_ms: f64,
}

/// One drawn frame.
pub(crate) struct Sample {
    /// Until the picture was complete where it was made, with `update_ms`.
    pub(crate) frame_ms: f64,
    /// Seen from outside.
    pub(crate) wall_ms: f64,
    /// Making the changed scene ready.
    pub(crate) update_ms: Option<f64>,
    /// What the method says.
    pub(crate) report: Report,
}

impl<'m> Runner<'m> {
    /// Makes a scene ready.
    pub(crate) fn new(
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
    pub(crate) fn preparation(&self) -> &Prepare {
        &self.prepare
    }

    /// Bytes held from frame to frame, and most held while making ready.
    pub(crate) fn held_and_peak_bytes(&self) -> (u64, u64) {
        let preparation = self.prepared.preparation();
        (preparation.held_bytes, preparation.peak_bytes)
    }

    /// Draws one picture and returns it.
    pub(crate) fn picture(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
    ) -> Result<&Frame, RenderError> {
        self.prepared.render(view, style, cancel, &mut self.frame)?;
        Ok(&self.frame)
    }

    /// Draws frame `number` of a shot.
    pub(crate) fn draw(
        &mut self,
        shot: &Shot,
        number: usize,
        cancel: &Cancel,
    ) -> Result<Sample, RenderError> {
        cancel.check()?;
        let view = shot.motion.view(&shot.view, number)?;
        let started = Instant::now();
        let update_ms = match &shot.edits {
            // No method takes a changed scene yet: all of it is made ready again.
            Some(scenes) => {
                let scene = &scenes[(number + 1) % scenes.len()];
                let (prepared, prepare) = prepare(self.method, scene, &self.budget)?;
                self.prepared = prepared;
                Some(prepare.ms)
            }
            None => None,
        };
        let report = self
            .prepared
            .render(&view, &shot.style, cancel, &mut self.frame)?;
        Ok(Sample {
            frame_ms: report.frame_ms() + update_ms.unwrap_or(0.0),
            wall_ms: elapsed_ms(started),
            update_ms,
            report,
        })
    }

    /// Counts the work of the first frame of a shot.
    pub(crate) fn count_work(&mut self, shot: &Shot, cancel: &Cancel) -> Result<Work, RenderError> {
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
