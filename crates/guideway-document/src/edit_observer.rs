//! Edit observer: a callback that receives each change of a document's scene.

use std::fmt;

use guideway_scene::{Edit, Scene};

/// A change of a scene, for those who keep another one of the same content.
#[derive(Clone, Copy, Debug)]
pub enum SceneChange<'a> {
    /// An accepted edit, before it is applied.
    Edit(&'a Edit),
    /// The scene lost its last rows, which no edit does: this is the whole of it.
    Replaced(&'a Scene),
}

/// The callback of [`Document::on_edit`](crate::Document::on_edit), if one is set.
#[derive(Default)]
pub(crate) struct EditObserver(Option<Box<Callback>>);

type Callback = dyn Fn(SceneChange<'_>) + Send + Sync;

impl EditObserver {
    pub(crate) fn new(callback: impl Fn(SceneChange<'_>) + Send + Sync + 'static) -> Self {
        Self(Some(Box::new(callback)))
    }

    pub(crate) fn notify(&self, edit: &Edit) {
        self.notify_change(SceneChange::Edit(edit));
    }

    pub(crate) fn notify_change(&self, change: SceneChange<'_>) {
        if let Some(callback) = &self.0 {
            callback(change);
        }
    }
}

impl fmt::Debug for EditObserver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "set" } else { "unset" })
    }
}
