//! The method `cpu`, which keeps its last preparation: a page draws many views of one scene.

use std::sync::{Arc, Mutex, PoisonError};

use guideway::cpu::Cpu;
use guideway::scene::{
    Budget, Cancel, Frame, Method, MethodInfo, Preparation, Prepared, RenderError, Report, Scene,
    Strip, Style, View,
};

/// The last preparation, with its scene.
type Slot = Arc<Mutex<Option<(Arc<Scene>, Box<dyn Prepared>)>>>;

/// The method `cpu`; clones share what they prepared.
#[derive(Clone, Default)]
pub(crate) struct KeptMethod(Slot);

impl Method for KeptMethod {
    fn info(&self) -> MethodInfo {
        Cpu.info()
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        let mut slot = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = slot.take();
        let kept = kept.filter(|(of, _)| Arc::ptr_eq(of, &scene));
        let prepared = match kept {
            Some((_, prepared)) => prepared,
            None => Cpu.prepare(Arc::clone(&scene), budget)?,
        };
        Ok(Box::new(Lent {
            scene,
            prepared: Some(prepared),
            slot: Arc::clone(&self.0),
        }))
    }
}

/// A preparation that returns to its slot when it is dropped.
struct Lent {
    scene: Arc<Scene>,
    /// `None` while it is dropped.
    prepared: Option<Box<dyn Prepared>>,
    slot: Slot,
}

impl Lent {
    fn prepared(&self) -> &dyn Prepared {
        self.prepared.as_deref().expect("it is here until dropped")
    }

    fn prepared_mut(&mut self) -> &mut Box<dyn Prepared> {
        self.prepared.as_mut().expect("it is here until dropped")
    }
}

impl Prepared for Lent {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.prepared_mut().render(view, style, cancel, frame)
    }

    fn strip_pixels(&self) -> usize {
        self.prepared().strip_pixels()
    }

    fn render_strip(
        &mut self,
        strip: &Strip,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        let prepared = self.prepared_mut();
        prepared.render_strip(strip, style, cancel, frame)
    }

    fn preparation(&self) -> &Preparation {
        self.prepared().preparation()
    }
}

impl Drop for Lent {
    fn drop(&mut self) {
        let mut slot = self.slot.lock().unwrap_or_else(PoisonError::into_inner);
        let scene = Arc::clone(&self.scene);
        *slot = self.prepared.take().map(|prepared| (scene, prepared));
    }
}
