use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use guideway_scene::{Budget, Cancel, Frame, FrameSize, Method, RenderError, Style, View};
use guideway_scene::{LineRule, Scene};

use super::run::OUT_OF_TIME;
use super::{MethodFacts, Plan};
use guideway_bench::Fault;
use guideway_bench::runner::{Frames, Runner, Shot};
use guideway_bench::{Dataset, Measured, Motion, Outcome, Start, interleaved};

/// Most paths of all datasets that are kept for later.
const KEPT_PATHS: usize = 5_000_000;

/// Even shares of the time that one piece of a part may take.
const PATIENCE: u32 = 4;

/// What every part of a run measures with.
pub(crate) struct Lab<'a> {
    pub(crate) plan: &'a Plan,
    pub(crate) size: FrameSize,
    pub(crate) cancel: &'a Cancel,
    start: Start<'a>,
    progress: &'a dyn Fn(&str),
    methods: RefCell<HashMap<String, Started>>,
    scenes: RefCell<Vec<(Dataset, usize, Arc<Scene>)>>,
    is_cut: Cell<bool>,
}

type Started = Result<Rc<dyn Method>, String>;

/// When something has to be over, if ever.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deadline(Option<Instant>);

impl Deadline {
    pub(crate) fn after(seconds: f64) -> Self {
        let wait = Duration::try_from_secs_f64(seconds.max(0.0)).ok();
        Self(wait.and_then(|wait| Instant::now().checked_add(wait)))
    }

    /// The deadline of the first of so many pieces of what is left. It may take a few times its even share,
    /// for most take less.
    pub(crate) fn share(self, pieces: usize) -> Self {
        let now = Instant::now();
        Self(self.0.map(|end| {
            let left = end.saturating_duration_since(now);
            now + (left * PATIENCE / u32::try_from(pieces.max(1)).unwrap_or(u32::MAX)).min(left)
        }))
    }

    /// No end.
    pub(crate) fn never() -> Self {
        Self(None)
    }

    fn is_over(self) -> bool {
        self.0.is_some_and(|end| Instant::now() >= end)
    }
}

impl<'a> Lab<'a> {
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

    /// Tells what is being done.
    pub(crate) fn tell(&self, what: &str) {
        (self.progress)(what);
    }

    /// Whether the time is over, so that something has to be left out.
    pub(crate) fn is_over(&self, time: Deadline) -> bool {
        let is_over = time.is_over();
        self.is_cut.set(self.is_cut.get() || is_over);
        is_over
    }

    /// Whether something was left out since this was asked last.
    pub(crate) fn take_is_cut(&self) -> bool {
        self.is_cut.take()
    }

    /// The method of this name, started once.
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

    /// A dataset of so many paths, from memory if it was used lately.
    pub(crate) fn scene(&self, dataset: Dataset, paths: usize) -> Arc<Scene> {
        let mut scenes = self.scenes.borrow_mut();
        let place = scenes.iter().position(|s| (s.0, s.1) == (dataset, paths));
        let scene = match place {
            Some(place) => scenes.remove(place).2,
            None => {
                let larger = scenes.iter().position(|s| s.0 == dataset && s.1 > paths);
                let part = larger.and_then(|place| {
                    let part = dataset.part(&scenes[place].2, paths)?;
                    // It was of use, so it is kept.
                    scenes[place..].rotate_left(1);
                    Some(part)
                });
                part.unwrap_or_else(|| dataset.scene(paths))
            }
        };
        scenes.push((dataset, paths, Arc::clone(&scene)));
        while scenes.len() > 1 && scenes.iter().map(|s| s.1).sum::<usize>() > KEPT_PATHS {
            scenes.remove(0);
        }
        scene
    }

    /// What methods may use.
    pub(crate) fn budget(&self) -> Budget {
        Budget {
            memory_bytes: self.plan.memory_bytes,
            threads: 0,
        }
    }

    /// How the thesis draws.
    pub(crate) fn style(&self) -> Style {
        Style {
            line_rule: LineRule::Thesis,
            ..Style::default()
        }
    }

    /// Measures one view with a scene that was made ready.
    ///
    /// # Errors
    /// Only when the caller cancels.
    pub(crate) fn measure(
        &self,
        runner: &mut Runner<'_>,
        view: &View,
    ) -> Result<Result<Measured, Fault>, RenderError> {
        let shot = Shot {
            view: *view,
            motion: Motion::Still,
            edits: None,
            style: self.style(),
            frames: Frames {
                warmup: self.plan.warmup,
                count: self.plan.frames,
                enough_ms: self.plan.enough_ms,
            },
        };
        let mut results = interleaved::measure(std::slice::from_mut(runner), &shot, self.cancel)?;
        Ok(results.remove(0))
    }

    /// Measures several views of one scene with one method, as far as the time does.
    ///
    /// # Errors
    /// Only when the caller cancels.
    pub(crate) fn measure_all(
        &self,
        spec: &str,
        scene: &Arc<Scene>,
        views: &[View],
        time: Deadline,
    ) -> Result<Vec<Outcome>, RenderError> {
        let same = |why: String| vec![Outcome::WhyNot(why); views.len()];
        if self.is_over(time) {
            return Ok(same(OUT_OF_TIME.to_owned()));
        }
        let method = match self.method(spec) {
            Ok(method) => method,
            Err(why) => return Ok(same(why)),
        };
        let mut runner = match self.ready(spec, &*method, scene) {
            Ok(runner) => runner,
            Err(fault) => return Ok(same(fault.to_string())),
        };
        let mut outcomes = Vec::with_capacity(views.len());
        for view in views {
            outcomes.push(if self.is_over(time) {
                Outcome::WhyNot(OUT_OF_TIME.to_owned())
            } else {
                Outcome::from(self.measure(&mut runner, view)?)
            });
        }
        Ok(outcomes)
    }

    /// Which methods of the plan run, and where.
    pub(crate) fn facts(&self) -> impl Iterator<Item = MethodFacts> {
        self.plan.methods.iter().map(|spec| {
            let started = self.method(spec);
            MethodFacts {
                method: spec.clone(),
                device: started.as_ref().ok().map(|method| method.info().device),
                why_not: started.err(),
            }
        })
    }

    /// Makes a scene ready. A method whose device gave up is started anew the next time.
    pub(crate) fn ready<'m>(
        &self,
        spec: &str,
        method: &'m dyn Method,
        scene: &Arc<Scene>,
    ) -> Result<Runner<'m>, Fault> {
        let runner = Runner::new(method, scene, self.budget());
        if let Err(RenderError::Device { .. }) = runner {
            self.methods.borrow_mut().remove(spec);
        }
        Ok(runner?)
    }

    /// One picture by one method, or why there is none.
    ///
    /// # Errors
    /// Only when the caller cancels.
    pub(crate) fn picture(
        &self,
        spec: &str,
        scene: &Arc<Scene>,
        view: &View,
    ) -> Result<Result<Frame, String>, RenderError> {
        self.cancel.check()?;
        let method = match self.method(spec) {
            Ok(method) => method,
            Err(why) => return Ok(Err(why)),
        };
        let picture = self.ready(spec, &*method, scene).and_then(|mut runner| {
            let picture = runner.picture(view, &self.style(), self.cancel);
            Ok(picture.cloned()?)
        });
        self.cancel.check()?;
        Ok(picture.map_err(|fault| fault.to_string()))
    }
}
