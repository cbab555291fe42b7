use std::fmt;

use guideway_scene::Edit;

/// Who is told of each edit of a scene.
#[derive(Default)]
pub(crate) struct Audience(Option<Box<Ear>>);

type Ear = dyn Fn(&Edit) + Send + Sync;

impl Audience {
    pub(crate) fn new(ear: impl Fn(&Edit) + Send + Sync + 'static) -> Self {
        Self(Some(Box::new(ear)))
    }

    pub(crate) fn hear(&self, edit: &Edit) {
        if let Some(ear) = &self.0 {
            ear(edit);
        }
    }
}

impl fmt::Debug for Audience {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "one" } else { "none" })
    }
}
