//! The method `cpu`, which keeps its last preparation: for many views of one scene.

use std::sync::{Arc, Mutex, PoisonError};

use guideway_cpu::Cpu;
use guideway_scene::{
    Budget, Cancel, Frame, Method, MethodInfo, Preparation, Prepared, RenderError, Report, Scene,
    Strip, Style, View,
};

/// The last preparation, with its scene.
type Slot = Arc<Mutex<Option<(Arc<Scene>, Box<dyn Prepared>)>>>;

/// The method `cpu`; clones share what they prepared.
#[derive(Clone, Default)]
pub struct KeptMethod(Slot);

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

#[cfg(test)]
mod tests {
    use guideway_scene::SceneOptions;

    use super::*;
    use crate::test_layouts::straight_ways;

    #[test]
    fn a_scene_is_prepared_once_and_another_one_anew() {
        let scene = || {
            let ends = [[guideway_spline::Point::new(0.0, 0.0); 2]];
            let layout = straight_ways(ends);
            Arc::new(Scene::new(Arc::new(layout), &SceneOptions::default()).unwrap())
        };
        let method = KeptMethod::default();
        let kept = || {
            let slot = method.0.lock().unwrap();
            let (of, prepared) = slot.as_ref()?;
            Some((Arc::as_ptr(of), &raw const **prepared as *const ()))
        };
        let (first, second) = (scene(), scene());
        let budget = Budget::default();
        let lent = method.prepare(Arc::clone(&first), &budget).unwrap();
        assert!(kept().is_none(), "it is lent");
        drop(lent);
        let of_first = kept().unwrap();
        assert_eq!(of_first.0, Arc::as_ptr(&first));
        drop(method.clone().prepare(Arc::clone(&first), &budget).unwrap());
        assert_eq!(kept().unwrap(), of_first);
        drop(method.prepare(Arc::clone(&second), &budget).unwrap());
        assert_eq!(kept().unwrap().0, Arc::as_ptr(&second));
    }
}
