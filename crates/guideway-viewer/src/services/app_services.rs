//! The trait that connects the window with files and render methods.

use std::path::{Path, PathBuf};

use eframe::wgpu;
use guideway_compose::{FloorPlan, VectorFormat};
use guideway_envelope::EnvelopeSource;
use guideway_layout::{Layout, UserError};
use guideway_scene::{Frame, Method, View};

use super::{
    FileFormat, FileQuestion, FileStamp, Job, LostPart, PendingFileAnswer, PictureRequest, Saved,
    names_in,
};

/// Longest project file, in bytes: ten thousand files with names of a hundred letters.
pub const MAX_PROJECT_BYTES: u64 = 1 << 20;

/// Code of errors that the window itself reports.
pub(crate) const WINDOW_ERROR: &str = "window";

/// Files, pictures and render methods, as the window calls them. Calls come from several threads.
pub trait AppServices: Send + Sync {
    /// Reads a layout file. Reports progress to `job` and stops when the job is cancelled.
    ///
    /// # Errors
    /// When the file cannot be read, or the job was cancelled.
    fn read_layout(&self, path: &Path, job: &Job) -> Result<Layout, UserError>;

    /// The layout of an example site.
    ///
    /// # Errors
    /// When the program has none.
    fn example_site(&self) -> Result<Layout, UserError> {
        Err(UserError::new(
            WINDOW_ERROR,
            "this program has no example site",
            "Open a file",
        ))
    }

    /// Checks that saving `layout` over the file that it was read from loses nothing of the file.
    ///
    /// # Errors
    /// When the format has no writer, or the file may hold more than a layout, as drawings do.
    fn check_save_in_place(&self, layout: &Layout, file: &Path) -> Result<(), UserError>;

    /// Writes a layout file atomically, unless the format lacks parts of the layout and `accepts`
    /// returns `false` for them. The extension selects the format; without a known one, the format
    /// of the source file applies.
    ///
    /// # Errors
    /// When the format has no writer, or the file cannot be written.
    fn save_layout(
        &self,
        layout: &Layout,
        path: &Path,
        accepts: &dyn Fn(&[LostPart]) -> bool,
    ) -> Result<Saved, UserError>;

    /// Reads the text of a project file of at most [`MAX_PROJECT_BYTES`].
    ///
    /// # Errors
    /// When the file cannot be read, is too long, or is no text.
    fn read_project(&self, path: &Path) -> Result<String, UserError>;

    /// Writes the text of a project file atomically.
    ///
    /// # Errors
    /// When the file cannot be written.
    fn write_project(&self, path: &Path, text: &str) -> Result<(), UserError>;

    /// The formats that layouts can be written in.
    fn layout_formats(&self) -> Vec<FileFormat> {
        Vec::new()
    }

    /// Opens the desktop's dialog for a file name, without waiting for the answer. `None` if there
    /// is no such dialog. Called on the thread of the window.
    fn ask_for_file(&self, question: &FileQuestion) -> Option<PendingFileAnswer> {
        let _ = question;
        None
    }

    /// The state of a file on disk, by which changes of other programs are noticed; `None` without
    /// a file.
    fn file_stamp(&self, path: &Path) -> Option<FileStamp> {
        FileStamp::of(path)
    }

    /// Names of the entries of a folder that `accepts` a name, of its first `limit` entries; names
    /// of folders end with `/`. Empty without the folder.
    fn names_in(&self, folder: &Path, limit: usize, accepts: &dyn Fn(&str) -> bool) -> Vec<String> {
        names_in(folder, limit, accepts)
    }

    /// Reads a floor plan. `plan` is a file name with an optional placement, such as
    /// `hall.png@px-per-m=20` or `map.yaml`.
    ///
    /// # Errors
    /// When `plan` has another form, or the file cannot be read.
    fn read_floor_plan(&self, plan: &str) -> Result<FloorPlan, UserError>;

    /// Renders a picture with the named method.
    ///
    /// # Errors
    /// When the method is not available, or the picture cannot be rendered.
    fn render(&self, picture: &PictureRequest, method: &str) -> Result<Frame, UserError>;

    /// Renders a picture with the named method into a PNG file, atomically and in strips, so that
    /// memory does not grow with the picture. Reports progress to `job`.
    ///
    /// # Errors
    /// When the picture cannot be rendered, the file cannot be written, or the job was cancelled.
    fn export_png(
        &self,
        picture: &PictureRequest,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), UserError>;

    /// Writes a picture as SVG or PDF with exact curves, atomically.
    ///
    /// # Errors
    /// When the file cannot be written, or the format cannot express the style.
    fn export_vector(
        &self,
        picture: &PictureRequest,
        format: VectorFormat,
        path: &Path,
    ) -> Result<(), UserError>;

    /// Renders the areas that a vehicle sweeps along paths of a layout, on a transparent
    /// background.
    ///
    /// # Errors
    /// When none of the paths has a swept area.
    fn render_swept_areas(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
    ) -> Result<Frame, UserError>;

    /// All render methods, the best for this computer first.
    fn methods(&self) -> Vec<MethodChoice>;

    /// Starts the render method of this name.
    ///
    /// # Errors
    /// When the method is unknown or does not run on this computer.
    fn start_method(&self, name: &str) -> Result<Box<dyn Method>, UserError>;

    /// The adapter that draws the window, of those that `can_present` accepts.
    ///
    /// # Errors
    /// Why there is none.
    fn choose_adapter(
        &self,
        adapters: &[wgpu::Adapter],
        can_present: &dyn Fn(&wgpu::Adapter) -> bool,
    ) -> Result<wgpu::Adapter, String> {
        let first = adapters.iter().find(|adapter| can_present(adapter));
        first
            .cloned()
            .ok_or_else(|| "no graphics adapter can draw a window".to_owned())
    }

    /// The limits and features that a device of this adapter needs, so that render methods can
    /// draw on the device of the window; `None` if none can.
    fn device_descriptor(
        &self,
        adapter: &wgpu::Adapter,
    ) -> Option<wgpu::DeviceDescriptor<'static>> {
        let _ = adapter;
        None
    }

    /// Lets the render methods that start from now on draw on the device of the window.
    fn share_device(&self, adapter: &wgpu::Adapter, device: &wgpu::Device, queue: &wgpu::Queue) {
        let _ = (adapter, device, queue);
    }

    /// Called once when a file reaches a stage, for timing output.
    fn on_stage(&self, stage: LoadStage, file: &Path) {
        let _ = (stage, file);
    }

    /// Returns `true` if unsaved work is recorded in a journal beside the file.
    fn keeps_journals(&self) -> bool {
        true
    }

    /// The locale of the desktop, such as `de_DE.UTF-8`.
    fn locale(&self) -> Option<String> {
        None
    }

    /// Folder for state that outlives a run, such as recent files; `None` keeps no state.
    fn state_folder(&self) -> Option<PathBuf> {
        None
    }
}

/// Progress of one file from disk to editable document.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadStage {
    /// The file is read.
    Read,
    /// The first picture of the file is on screen.
    Shown,
    /// The document accepts edits.
    Editable,
    /// The check of the layout is complete.
    Checked,
}

/// A render method that the user can select.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodChoice {
    /// Name for [`AppServices::start_method`].
    pub name: String,
    /// One line on how it renders.
    pub summary: String,
    /// Why it does not run on this computer; `None` if it runs.
    pub unavailable: Option<String>,
}
