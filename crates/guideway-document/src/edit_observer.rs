//! Edit observer: a callback that receives each accepted edit of a document's scene.

use std::fmt;

use guideway_scene::Edit;

/// The callback of [`Document::on_edit`](crate::Document::on_edit), if one is set.
#[derive(Default)]
pub(crate) struct EditObserver(Option<Box<Callback>>);

type Callback = dyn Fn(&Edit) + Send + Sync;

impl EditObserver {
    pub(crate) fn new(callback: impl Fn(&Edit) + Send + Sync + 'static) -> Self {
        Self(Some(Box::new(callback)))
    }

    pub(crate) fn notify(&self, edit: &Edit) {
        if let Some(callback) = &self.0 {
            callback(edit);
        }
    }
}

impl fmt::Debug for EditObserver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "set" } else { "unset" })
    }
}
