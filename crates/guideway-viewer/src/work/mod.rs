//! What is done beside the window: reading, drawing, saving, watching files. Each on a thread of its own that
//! wakes the window when there is news.

pub(crate) mod beside;
pub(crate) mod findings;
pub(crate) mod loader;
pub(crate) mod recovery;
pub(crate) mod renderer;
pub(crate) mod task;
pub(crate) mod watcher;

use std::sync::Arc;

/// Has the window look for news.
pub(crate) type Wake = Arc<dyn Fn() + Send + Sync>;
