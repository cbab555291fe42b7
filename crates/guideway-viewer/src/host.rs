use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use guideway_layout::Layout;
use guideway_scene::Scene;
use guideway_scene::{DrawList, Frame, Method, Style, View};
use guideway_spline::Bounds;

/// What the viewer needs of the program around it: files and ways of drawing. Called from several threads.
pub trait Host: Send + Sync {
    /// Reads a layout file. Asks `job` whether to go on, and tells it how far it is.
    ///
    /// # Errors
    /// When the file cannot be read, or the job was cancelled.
    fn open(&self, path: &Path, job: &Job) -> Result<Layout, Trouble>;

    /// Whether a layout may be saved in place of the file that it was read from.
    ///
    /// # Errors
    /// When its format cannot be written, or the file may hold more than a layout has of it, as drawings do.
    fn check_in_place(&self, layout: &Layout, file: &Path) -> Result<(), Trouble>;

    /// Writes a layout file, whole or not at all, in the format that its name says, or else the one that it was read
    /// from. Returns what the format cannot hold, a sentence each.
    ///
    /// # Errors
    /// When the format is not one that can be written, or the file cannot be.
    fn save(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, Trouble>;

    /// Draws a view by the method of this name.
    ///
    /// # Errors
    /// When the picture cannot be drawn.
    fn picture(&self, export: &Export, method: &str) -> Result<Frame, Trouble>;

    /// Draws a view by the method of this name and writes it as PNG, whole or not at all, in memory that does not grow
    /// with the picture. Asks `job` whether to go on, and tells it how far it is.
    ///
    /// # Errors
    /// When the picture cannot be drawn, the file cannot be written, or the job was cancelled.
    fn save_picture(
        &self,
        export: &Export,
        method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), Trouble>;

    /// Writes a view as SVG with true curves, whole or not at all.
    ///
    /// # Errors
    /// When the file cannot be written, or a drawing cannot look as the style says.
    fn save_drawing(&self, export: &Export, path: &Path) -> Result<(), Trouble>;

    /// Reads what is to lie below all layouts. `plan` is what a person wrote: a file, and how it is put.
    ///
    /// # Errors
    /// When it cannot be understood, or the file cannot be read.
    fn floor_plan(&self, plan: &str) -> Result<Arc<dyn FloorPlan>, Trouble>;

    /// Draws the areas that a vehicle sweeps along some paths of a layout, over nothing, in a picture of the view.
    /// `vehicle` is what a person wrote.
    ///
    /// # Errors
    /// When the vehicle cannot be understood, or no path has such an area.
    fn swept(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: &str,
        view: &View,
    ) -> Result<Frame, Trouble>;

    /// Is told what has come about since the window was asked for, each once: for whoever wants to know how long that
    /// took.
    fn reached(&self, stage: Stage, file: &Path) {
        let _ = (stage, file);
    }

    /// Folder for what is remembered from one run to the next; none if nothing is.
    fn state_folder(&self) -> Option<PathBuf> {
        None
    }

    /// The ways of drawing, the best first.
    fn methods(&self) -> Vec<MethodChoice>;

    /// Starts a way of drawing by its name.
    ///
    /// # Errors
    /// When it does not run on this computer.
    fn method(&self, name: &str) -> Result<Box<dyn Method>, Trouble>;
}

/// How far a file has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// It is read.
    Read,
    /// Its first picture is shown.
    Shown,
    /// It can be edited.
    Editable,
    /// It was looked through for what is odd.
    Checked,
}

/// What a picture is to show, from the lowest: the floor plan, the grid, swept areas, other layouts, the layout, and
/// marks.
#[derive(Clone)]
pub struct Export {
    /// The scene on top.
    pub scene: Arc<Scene>,
    /// Those below it, from the lowest.
    pub others: Vec<Arc<Scene>>,
    /// Where all is looked at, and how large.
    pub view: View,
    /// How paths look, and what is behind everything.
    pub style: Style,
    /// What a person wrote of the floor plan.
    pub floor_plan: Option<String>,
    /// What a person wrote of the vehicle whose areas are shown, and the rows of the paths in the scene on top that they
    /// are of.
    pub swept: Option<(String, Vec<u32>)>,
    /// Lines below all paths.
    pub grid: DrawList,
    /// What lies over the paths.
    pub marks: DrawList,
}

/// What lies on the floor, ready to be drawn.
pub trait FloorPlan: Send + Sync {
    /// Where it is, in meters; none if it is empty.
    fn bounds(&self) -> Option<Bounds<f64>>;

    /// Draws it over nothing.
    ///
    /// # Errors
    /// When there is no room for it in memory.
    fn draw(&self, view: &View) -> Result<Frame, Trouble>;
}

/// A way of drawing that may be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodChoice {
    /// What it is started by.
    pub name: String,
    /// One line on what it does.
    pub summary: String,
    /// Why it does not run here, if so.
    pub why_not: Option<String>,
}

/// What went wrong, and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// What happened, where.
    pub message: String,
    /// What to do.
    pub remedy: String,
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}. {}", self.message, self.remedy)
    }
}

/// Something under way that takes long, seen from both of its ends.
#[derive(Debug, Default)]
pub struct Job {
    done: AtomicU64,
    total: AtomicU64,
    is_cancelled: AtomicBool,
}

impl Job {
    /// `done` of `total` steps are done.
    pub fn advance(&self, done: u64, total: u64) {
        self.done.store(done, Ordering::Relaxed);
        self.total.store(total, Ordering::Relaxed);
    }

    /// How much is done, from 0 to 1; none as long as nobody knows.
    pub fn fraction(&self) -> Option<f32> {
        let total = self.total.load(Ordering::Relaxed);
        let done = self.done.load(Ordering::Relaxed);
        (total > 0).then(|| (done as f32 / total as f32).min(1.0))
    }

    /// Asks it to stop.
    pub fn cancel(&self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether it was asked to stop.
    pub fn is_cancelled(&self) -> bool {
        self.is_cancelled.load(Ordering::Relaxed)
    }
}
