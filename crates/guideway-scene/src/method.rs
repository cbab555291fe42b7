use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::{Edit, Frame, Preparation, RenderError, Report, Scene, Strip, Style, View, Work};

/// One way of turning a scene into pixels. Immutable once made: share it between threads.
pub trait Method: Send + Sync {
    /// What it is called and where it runs.
    fn info(&self) -> MethodInfo;

    /// Makes a scene ready to be drawn from any view.
    ///
    /// # Errors
    /// When the scene does not fit the budget.
    fn prepare(&self, scene: Arc<Scene>, budget: &Budget)
    -> Result<Box<dyn Prepared>, RenderError>;
}

/// A scene made ready by a [`Method`].
pub trait Prepared: Send {
    /// Draws a view into `frame`, which takes the view's size.
    ///
    /// # Errors
    /// When the view is not usable, the budget does not do, or `cancel` was set. The frame's pixels are
    /// then undefined.
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError>;

    /// Most pixels of a strip that [`Self::render_strip`] draws. A method that takes all of a frame draws pictures
    /// only whole.
    fn strip_pixels(&self) -> usize {
        Frame::MAX_PIXELS
    }

    /// Draws some rows of a view, the same pixels as [`Self::render`] draws there, into `frame`, which takes the
    /// strip's size. Each path is counted with one strip: [`Report::join`] gives that of the whole picture.
    ///
    /// # Errors
    /// As [`Self::render`]; [`RenderError::Strips`] if the method draws pictures only whole.
    fn render_strip(
        &mut self,
        strip: &Strip,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        if !strip.is_whole() {
            return Err(RenderError::Strips {
                width: strip.view().size().width(),
                height: strip.view().size().height(),
            });
        }
        self.render(strip.view(), style, cancel, frame)
    }

    /// Changes the scene; the next frame shows it, at a cost that goes with what the edit touches.
    ///
    /// # Errors
    /// [`RenderError::Edit`] when the edit cannot be done; the scene is then as it was. [`RenderError::Budget`]
    /// or [`RenderError::Device`] when there is no room for it: what was made ready is then of no more use.
    fn edit(&mut self, _edit: &Edit) -> Result<Edited, RenderError> {
        Ok(Edited::NotInPlace)
    }

    /// What making the scene ready took.
    fn preparation(&self) -> &Preparation;

    /// Counts the work of one frame of this view, apart from [`Prepared::render`] so that counting slows no
    /// frame. What a method does not count is none.
    ///
    /// # Errors
    /// As [`Prepared::render`].
    fn count_work(
        &mut self,
        _view: &View,
        _style: &Style,
        _cancel: &Cancel,
    ) -> Result<Work, RenderError> {
        Ok(Work::default())
    }
}

/// What became of an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Edited {
    /// The next frame shows it.
    InPlace {
        /// Bytes brought to the device for it; none if the method works on the scene itself.
        moved_bytes: u64,
    },
    /// Nothing: this method takes a changed scene only by [`Method::prepare`].
    NotInPlace,
}

/// What a method is called and where it runs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodInfo {
    /// Stable name, as in `--method`.
    pub name: &'static str,
    /// One line on what it does.
    pub summary: &'static str,
    /// The device that it runs on.
    pub device: String,
}

/// What a method may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Most bytes of memory for what a method makes from the scene, frames included.
    pub memory_bytes: u64,
    /// Threads to use; 0 means one a core.
    pub threads: usize,
}

impl Default for Budget {
    fn default() -> Self {
        Self {
            memory_bytes: 1 << 30,
            threads: 0,
        }
    }
}

/// A flag that stops long work at its next step. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Asks the work to stop.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Fails once the work was asked to stop.
    ///
    /// # Errors
    /// [`RenderError::Cancelled`].
    pub fn check(&self) -> Result<(), RenderError> {
        if self.0.load(Ordering::Relaxed) {
            Err(RenderError::Cancelled)
        } else {
            Ok(())
        }
    }
}
