//! A session starts each method once, caches recent scenes, and measures views of them for the
//! parts of a run.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use guideway_scene::{
    Budget, Cancel, Frame, FrameSize, LineRule, Method, RenderError, Scene, Style, View,
};

use super::deadline::Deadline;
use super::plan::Plan;
use super::run::{MethodFacts, OUT_OF_TIME};
use guideway_bench::MeasureError;
use guideway_bench::runner::{FrameRequest, Frames, Runner};
use guideway_bench::{Dataset, Edits, Measured, Motion, Outcome, Start, StartError, interleaved};

/// Most paths of all cached scenes: at eight segments per path, some 500 MB.
const CACHED_PATHS: usize = 5_000_000;

/// Methods, scenes and settings that all parts of a run share.
pub(crate) struct Session<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) size: FrameSize,
    pub(crate) cancel: &'a Cancel,
    start: Start<'a>,
    progress: &'a dyn Fn(&str),
    methods: RefCell<HashMap<String, Started>>,
    scenes: RefCell<Vec<(Dataset, usize, Arc<Scene>)>>,
    is_cut: Cell<bool>,
}

type Started = Result<Rc<dyn Method>, StartError>;

impl<'a> Session<'a> {
    pub(crate) fn new(
        plan: &'a Plan,
        start: Start<'a>,
        cancel: &'a Cancel,
        progress: &'a dyn Fn(&str),
    ) -> Result<Self, RenderError> {
        Ok(Self {
            plan,
            size: FrameSize::new(plan.size_px[0], plan.size_px[1])?,
            cancel,
            start,
            progress,
            methods: RefCell::default(),
            scenes: RefCell::default(),
            is_cut: Cell::default(),
        })
    }

    /// Reports the current measurement to the caller.
    pub(crate) fn show_progress(&self, current: &str) {
        (self.progress)(current);
    }

    /// Returns `true` if the time is over. If so, the part counts as cut.
    pub(crate) fn is_over(&self, time: Deadline) -> bool {
        let is_over = time.is_over();
        self.is_cut.set(self.is_cut.get() || is_over);
        is_over
    }

    /// Returns `true` if the time cut the part since the last call.
    pub(crate) fn take_is_cut(&self) -> bool {
        self.is_cut.take()
    }

    /// The method with this name and options, started on first use.
    pub(crate) fn method(&self, spec: &str) -> Started {
        let mut methods = self.methods.borrow_mut();
        let entry = methods.entry(spec.to_owned());
        entry
            .or_insert_with(|| (self.start)(spec).map(Rc::from))
            .clone()
    }

    /// Every dataset with every method of the plan.
    pub(crate) fn cases(&self) -> impl Iterator<Item = (Dataset, &'a str)> + use<'a> {
        let methods = &self.plan.methods;
        let with_all = |dataset| methods.iter().map(move |spec| (dataset, spec.as_str()));
        Dataset::ALL.into_iter().flat_map(with_all)
    }

    /// A dataset with this number of paths, from the cache of recent scenes or from a larger one in
    /// it.
    pub(crate) fn scene(&self, dataset: Dataset, paths: usize) -> Arc<Scene> {
        let mut scenes = self.scenes.borrow_mut();
        let cached = scenes.iter().position(|s| (s.0, s.1) == (dataset, paths));
        let scene = match cached {
            Some(index) => scenes.remove(index).2,
            None => {
                let larger = scenes.iter().position(|s| s.0 == dataset && s.1 > paths);
                let part = larger.and_then(|index| {
                    let part = dataset.part(&scenes[index].2, paths)?;
                    // Eviction removes the least recently used scene first.
                    scenes[index..].rotate_left(1);
                    Some(part)
                });
                part.unwrap_or_else(|| dataset.scene(paths))
            }
        };
        scenes.push((dataset, paths, Arc::clone(&scene)));
        while scenes.len() > 1 && scenes.iter().map(|s| s.1).sum::<usize>() > CACHED_PATHS {
            scenes.remove(0);
        }
        scene
    }

    /// Memory and threads per method.
    pub(crate) fn budget(&self) -> Budget {
        Budget {
            memory_bytes: self.plan.memory_bytes,
            threads: 0,
        }
    }

    /// The style of the thesis.
    pub(crate) fn style(&self) -> Style {
        Style {
            line_rule: LineRule::Thesis,
            ..Style::default()
        }
    }

    /// Measures one view of a prepared scene, with edits before its frames or without.
    ///
    /// # Errors
    /// Only when the caller cancels.
    pub(crate) fn measure(
        &self,
        runner: &mut Runner<'_>,
        view: &View,
        edits: Option<&Edits>,
    ) -> Result<Result<Measured, MeasureError>, RenderError> {
        let request = FrameRequest {
            view: *view,
            motion: match edits {
                Some(_) => Motion::Edit,
                None => Motion::Still,
            },
            edits: edits.cloned(),
            style: self.style(),
            frames: Frames {
                warmup: self.plan.warmup,
                count: self.plan.frames,
                enough_ms: self.plan.enough_ms,
            },
        };
        let mut results =
            interleaved::measure(std::slice::from_mut(runner), &request, self.cancel)?;
        Ok(results.remove(0))
    }

    /// Measures several views of one scene with one method until the time is over, with edits
    /// before their frames or without.
    ///
    /// # Errors
    /// Only when the caller cancels.
    pub(crate) fn measure_all(
        &self,
        spec: &str,
        scene: &Arc<Scene>,
        views: &[View],
        edits: Option<&Edits>,
        time: Deadline,
    ) -> Result<Vec<Outcome>, RenderError> {
        let all_missing = |reason: String| vec![Outcome::NotMeasured(reason); views.len()];
        if self.is_over(time) {
            return Ok(all_missing(OUT_OF_TIME.to_owned()));
        }
        let method = match self.method(spec) {
            Ok(method) => method,
            Err(error) => return Ok(all_missing(error.to_string())),
        };
        let mut runner = match self.prepare(spec, &*method, scene) {
            Ok(runner) => runner,
            Err(error) => return Ok(all_missing(error.to_string())),
        };
        let mut outcomes = Vec::with_capacity(views.len());
        for view in views {
            outcomes.push(if self.is_over(time) {
                Outcome::NotMeasured(OUT_OF_TIME.to_owned())
            } else {
                Outcome::from(self.measure(&mut runner, view, edits)?)
            });
        }
        Ok(outcomes)
    }

    /// Device of each method of the plan, or the reason why it does not run.
    pub(crate) fn facts(&self) -> impl Iterator<Item = MethodFacts> {
        self.plan.methods.iter().map(|spec| {
            let started = self.method(spec);
            MethodFacts {
                method: spec.clone(),
                device: started.as_ref().ok().map(|method| method.info().device),
                why_not: started.err().map(|error| error.to_string()),
            }
        })
    }

    /// Prepares a scene. After a device error, the next use starts the method again.
    pub(crate) fn prepare<'m>(
        &self,
        spec: &str,
        method: &'m dyn Method,
        scene: &Arc<Scene>,
    ) -> Result<Runner<'m>, MeasureError> {
        let runner = Runner::new(method, scene, self.budget());
        if let Err(RenderError::Device { .. }) = runner {
            self.methods.borrow_mut().remove(spec);
        }
        Ok(runner?)
    }

    /// One picture by one method, or the reason for its absence.
    ///
    /// # Errors
    /// Only when the caller cancels.
    pub(crate) fn picture(
        &self,
        spec: &str,
        scene: &Arc<Scene>,
        view: &View,
    ) -> Result<Result<Frame, MeasureError>, RenderError> {
        self.cancel.check()?;
        let method = match self.method(spec) {
            Ok(method) => method,
            Err(error) => return Ok(Err(error.into())),
        };
        let picture = self.prepare(spec, &*method, scene).and_then(|mut runner| {
            let picture = runner.picture(view, &self.style(), self.cancel);
            Ok(picture.cloned()?)
        });
        self.cancel.check()?;
        Ok(picture)
    }
}
