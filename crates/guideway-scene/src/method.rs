//! The contract of render methods: prepare a scene once, then render, edit and measure it.
//!
//! [`Method::prepare`] turns a [`Scene`] into a [`Prepared`], which renders any [`View`] into a
//! [`Frame`] and returns a [`Report`].

use std::any::Any;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::{
    Coloring, DevicePicture, Edit, Frame, Gesture, Preparation, RenderError, Report, Scene, Strip,
    Style, View, Work,
};

/// A renderer. Immutable, so threads can share it.
pub trait Method: Send + Sync {
    /// Name, summary and device.
    fn info(&self) -> MethodInfo;

    /// Prepares a scene for rendering any view of it.
    ///
    /// # Errors
    /// When the scene does not fit the budget.
    fn prepare(&self, scene: Arc<Scene>, budget: &Budget)
    -> Result<Box<dyn Prepared>, RenderError>;
}

/// A scene prepared by a [`Method`].
pub trait Prepared: Send {
    /// Renders a view into `frame`, which is resized to the view.
    ///
    /// # Errors
    /// When the method does not support the style or the view, exceeds its budget, or `cancel` is
    /// set. The pixels of the frame are then undefined.
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError>;

    /// Most pixels of a strip that [`Self::render_strip`] renders. The default is for methods that
    /// render only whole pictures.
    fn strip_pixels(&self) -> usize {
        Frame::MAX_PIXELS
    }

    /// Renders some rows of a view into `frame`, which is resized to the strip. The pixels are
    /// those of [`Self::render`]. Each path counts in one strip; [`Report::join`] adds the reports
    /// up.
    ///
    /// # Errors
    /// As [`Self::render`]; [`RenderError::Strips`] if the method renders only whole pictures.
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

    /// Counts the paths that cover each pixel of a view, as density shading does: their mean number
    /// over the pixel, row by row from the top. The shading of `style` does not matter. `None` if
    /// the method keeps no counts.
    ///
    /// # Errors
    /// As [`Self::render`].
    fn count_paths(
        &mut self,
        _view: &View,
        _style: &Style,
        _cancel: &Cancel,
        _counts: &mut Vec<f32>,
    ) -> Result<Option<Report>, RenderError> {
        Ok(None)
    }

    /// The graphics device that the method draws on, as an object of its library, such as a
    /// `wgpu::Device`; `None` if it draws in main memory. A caller that shares the device shows
    /// the pictures of [`Self::render_on_device`] without a copy.
    fn device(&self) -> Option<&(dyn Any + Send + Sync)> {
        None
    }

    /// Renders a view into memory of [`Self::device`]. The pixels are those of [`Self::render`].
    /// The device may still draw when this returns; what the caller submits later comes after it.
    /// `None` if the method renders this style only into main memory.
    ///
    /// # Errors
    /// As [`Self::render`].
    fn render_on_device(
        &mut self,
        _view: &View,
        _style: &Style,
        _cancel: &Cancel,
    ) -> Result<Option<(DevicePicture, Report)>, RenderError> {
        Ok(None)
    }

    /// Applies an edit to the prepared scene, at a cost proportional to what the edit touches. The
    /// next frame shows it.
    ///
    /// # Errors
    /// [`RenderError::Edit`] when the scene rejects the edit and is unchanged.
    /// [`RenderError::Budget`] or [`RenderError::Device`] when memory does not suffice; prepare the
    /// scene again then.
    fn edit(&mut self, _edit: &Edit) -> Result<EditOutcome, RenderError> {
        Ok(EditOutcome::NotInPlace)
    }

    /// Takes other colors for the paths of the prepared scene, which keep their curves: nothing of
    /// them is computed or sent again. [`EditOutcome::NotInPlace`] if the method cannot, or the
    /// colors are those of another layout. Ends the gesture.
    ///
    /// # Errors
    /// As [`Self::edit`].
    fn recolor(&mut self, _coloring: &Coloring) -> Result<EditOutcome, RenderError> {
        Ok(EditOutcome::NotInPlace)
    }

    /// Shows the paths of a gesture of this scene as its map leaves them, within the tolerance of
    /// the method, until the next call; `None` shows the scene, to the bit as before the gesture.
    /// The first call for some paths may take time in proportion to their number; later calls with
    /// the same paths and another map take much less. An edit ends the gesture.
    ///
    /// # Errors
    /// As [`Self::edit`]; frames then show the scene.
    fn show_gesture(&mut self, _gesture: Option<&Gesture>) -> Result<EditOutcome, RenderError> {
        Ok(EditOutcome::NotInPlace)
    }

    /// Cost of the preparation.
    fn preparation(&self) -> &Preparation;

    /// Counts the work of a frame of this view. Separate from [`Prepared::render`], so that
    /// counting does not slow down frames. `None` for a kind of work that the method does not
    /// count.
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

/// Outcome of an edit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EditOutcome {
    /// The method applied the edit; the next frame shows it.
    InPlace {
        /// Bytes uploaded to the device; 0 if the method works in main memory.
        moved_bytes: u64,
    },
    /// The method cannot edit in place; prepare the changed scene with [`Method::prepare`].
    NotInPlace,
}

/// Name, summary and device of a method.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodInfo {
    /// Stable name, as in `--method`.
    pub name: &'static str,
    /// One line that describes the method.
    pub summary: &'static str,
    /// Device that the method runs on.
    pub device: String,
}

/// Memory and threads that a method may use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// Memory limit for prepared data and frames, in bytes.
    pub memory_bytes: u64,
    /// Number of threads; 0 means one per core.
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

/// A cancellation flag that stops long work at its next check. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Requests cancellation.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Fails once cancellation is requested.
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
