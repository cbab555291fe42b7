//! Services of the tests: files in memory, and a graphics device that can be lost.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread::{self, ThreadId};
use std::time::{Duration, SystemTime};

use guideway_compose::{ComposeError, FloorPlan, VectorFormat};
use guideway_cpu::Cpu;
use guideway_envelope::EnvelopeSource;
use guideway_layout::{Layout, NewPath, Value};
use guideway_scene::{
    Budget, Cancel, Edit, EditOutcome, Frame, Gesture, Method, MethodInfo, Preparation, Prepared,
    RenderError, Report, Scene, Style, View,
};
use guideway_spline::{Point, Runs};

use super::plan_files::read_plan;
use crate::services::{
    AppServices, FileAnswer, FileFormat, FileQuestion, FileStamp, Job, LostPart, MethodChoice,
    PendingFileAnswer, PictureRequest, Saved, WINDOW_ERROR, names_in,
};
use guideway_layout::UserError;

/// Files in memory and switches for faults.
#[derive(Default)]
pub(crate) struct TestServices {
    pub(crate) files: Mutex<HashMap<PathBuf, Layout>>,
    /// True if the disk is full.
    pub(crate) is_full: Mutex<bool>,
    /// True if reading and writing block.
    pub(crate) is_blocked: Mutex<bool>,
    /// Parts that the format of saved files cannot hold.
    pub(crate) losses: Mutex<Vec<LostPart>>,
    /// Answers of the desktop's dialog for file names, the last one first; without any there is no
    /// such dialog.
    pub(crate) answers: Mutex<Vec<FileAnswer>>,
    /// The last question of the desktop's dialog.
    pub(crate) question: Mutex<Option<FileQuestion>>,
    /// Number of writes of each file.
    pub(crate) writes: Mutex<HashMap<PathBuf, u64>>,
    /// The state folder.
    pub(crate) state: Mutex<Option<PathBuf>>,
    /// Paths of the last rendered swept areas.
    pub(crate) swept: Mutex<Vec<u32>>,
    /// The thread of the window, and what reached the disk from it.
    window: Option<ThreadId>,
    pub(crate) on_window: Mutex<Vec<&'static str>>,
    /// Exported pictures.
    pub(crate) pictures: Mutex<Vec<(PathBuf, PictureRequest)>>,
    /// True if the graphics device is lost. The next start of the method resets it.
    is_device_lost: Mutex<Arc<AtomicBool>>,
}

/// The method of the graphics device; it ranks above `cpu`.
const DEVICE: &str = "device";

/// A graphics device that can be lost; renders as `cpu` does.
struct Device {
    is_lost: Arc<AtomicBool>,
}

/// A scene prepared on the device.
struct PreparedOnDevice {
    is_lost: Arc<AtomicBool>,
    prepared: Box<dyn Prepared>,
}

impl TestServices {
    pub(crate) fn with(files: impl IntoIterator<Item = (&'static str, Layout)>) -> Arc<Self> {
        let files = files
            .into_iter()
            .map(|(name, layout)| (name.into(), layout));
        Arc::new(Self {
            files: Mutex::new(files.collect()),
            window: Some(thread::current().id()),
            ..Self::default()
        })
    }

    /// Loses the graphics device, as a driver crash does.
    pub(crate) fn lose_device(&self) {
        let lost = locked(&self.is_device_lost);
        lost.store(true, Ordering::Relaxed);
    }

    fn device(&self) -> Device {
        let mut lost = locked(&self.is_device_lost);
        *lost = Arc::default();
        Device {
            is_lost: Arc::clone(&lost),
        }
    }

    fn note_thread(&self, what: &'static str) {
        if self.window == Some(thread::current().id()) {
            locked(&self.on_window).push(what);
        }
    }

    fn wait_for_disk(&self, job: &Job) -> Result<(), UserError> {
        self.note_thread("reading or writing");
        while *locked(&self.is_blocked) {
            if job.is_cancelled() {
                return Err(Self::error("cancelled"));
            }
            thread::sleep(Duration::from_millis(1));
        }
        Ok(())
    }

    /// Replaces a file, as another program does.
    pub(crate) fn overwrite(&self, path: &str, layout: Layout) {
        let mut files = locked(&self.files);
        files.insert(path.into(), layout);
        drop(files);
        self.note_write(Path::new(path));
    }

    fn note_write(&self, path: &Path) {
        let mut writes = locked(&self.writes);
        *writes.entry(path.to_owned()).or_default() += 1;
    }

    fn error(message: &str) -> UserError {
        UserError {
            code: WINDOW_ERROR,
            message: message.to_owned(),
            remedy: "Try another one".into(),
        }
    }
}

/// The content of a lock.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex
        .lock()
        .expect("no test panics while it holds the lock")
}

/// Parallel paths of 10 m along x, 2 m apart, each between its own two nodes.
pub(crate) fn lanes(count: u32) -> Layout {
    let mut layout = Layout::default();
    for row in 0..count {
        let y = 2.0 * f64::from(row);
        let ends = [Point::new(0.0, y), Point::new(10.0, y)];
        let [start, end] = ends.map(|at| layout.nodes.push(&format!("n{row} {}", at.x), at, None));
        let mut runs = Runs::default();
        runs.push_line(ends[0], ends[1]);
        let path = NewPath {
            id: &format!("lane {row}"),
            runs: &runs,
            start_node: Some(start),
            end_node: Some(end),
            ..NewPath::default()
        };
        let row = layout.paths.push(&path);
        let speed = Value::Float(f64::from(row as u32) / 2.0);
        layout.paths.attributes.set(row, "speed", speed);
    }
    layout
}

impl AppServices for TestServices {
    fn read_layout(&self, path: &Path, job: &Job) -> Result<Layout, UserError> {
        job.advance(1, 2);
        self.wait_for_disk(job)?;
        let file = locked(&self.files).get(path).cloned();
        file.ok_or_else(|| Self::error("no such file"))
    }

    fn example_site(&self) -> Result<Layout, UserError> {
        Ok(lanes(6))
    }

    fn read_project(&self, path: &Path) -> Result<String, UserError> {
        self.note_thread("reading a project");
        std::fs::read_to_string(path).map_err(|error| Self::error(&error.to_string()))
    }

    fn write_project(&self, path: &Path, text: &str) -> Result<(), UserError> {
        self.note_thread("writing a project");
        // Names that random input types would lie among the sources.
        let path = path.is_absolute().then_some(path);
        let path = path.ok_or_else(|| Self::error("no folder"))?;
        std::fs::write(path, text).map_err(|error| Self::error(&error.to_string()))
    }

    fn layout_formats(&self) -> Vec<FileFormat> {
        let format = |name: &str, extension: &str| FileFormat {
            name: name.into(),
            extensions: vec![extension.into()],
        };
        vec![format("LIF", "lif.json"), format("Arrow", "arrow")]
    }

    fn ask_for_file(&self, question: &FileQuestion) -> Option<PendingFileAnswer> {
        let answer = locked(&self.answers).pop()?;
        *locked(&self.question) = Some(question.clone());
        Some(Box::new(move || answer))
    }

    fn check_save_in_place(&self, _: &Layout, file: &Path) -> Result<(), UserError> {
        let is_drawing = file.extension().is_some_and(|ending| ending == "dxf");
        let problem = || Self::error("the file is a drawing");
        (!is_drawing).then_some(()).ok_or_else(problem)
    }

    fn file_stamp(&self, path: &Path) -> Option<FileStamp> {
        self.note_thread("looking at a file");
        let writes = locked(&self.writes);
        let files = locked(&self.files);
        files.contains_key(path).then(|| FileStamp {
            modified: SystemTime::UNIX_EPOCH,
            bytes: writes.get(path).copied().unwrap_or(0),
        })
    }

    fn names_in(&self, at: &Path, limit: usize, accepts: &dyn Fn(&str) -> bool) -> Vec<String> {
        self.note_thread("listing a folder");
        names_in(at, limit, accepts)
    }

    fn save_layout(
        &self,
        layout: &Layout,
        path: &Path,
        accepts: &dyn Fn(&[LostPart]) -> bool,
    ) -> Result<Saved, UserError> {
        self.wait_for_disk(&Job::default())?;
        if *locked(&self.is_full) {
            return Err(Self::error("the disk is full"));
        }
        let losses = locked(&self.losses).clone();
        if !losses.is_empty() && !accepts(&losses) {
            return Ok(Saved::TooLossy(losses));
        }
        let mut files = locked(&self.files);
        files.insert(path.to_owned(), layout.clone());
        drop(files);
        if path.is_absolute() {
            // The journal identifies the file by its state on disk.
            let written = std::fs::write(path, "");
            written.map_err(|error| Self::error(&error.to_string()))?;
        }
        self.note_write(path);
        Ok(Saved::Written(losses))
    }

    fn export_png(
        &self,
        export: &PictureRequest,
        _method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), UserError> {
        let height = export.view.size().height();
        for row in 0..height {
            job.advance(row.into(), height.into());
            self.wait_for_disk(job)?;
        }
        locked(&self.pictures).push((path.to_owned(), export.clone()));
        Ok(())
    }

    fn render(&self, export: &PictureRequest, _method: &str) -> Result<Frame, UserError> {
        Ok(Frame::new(export.view.size()))
    }

    fn export_vector(
        &self,
        export: &PictureRequest,
        _: VectorFormat,
        path: &Path,
    ) -> Result<(), UserError> {
        self.wait_for_disk(&Job::default())?;
        locked(&self.pictures).push((path.to_owned(), export.clone()));
        locked(&self.files).insert(path.to_owned(), Layout::default());
        Ok(())
    }

    fn read_floor_plan(&self, plan: &str) -> Result<FloorPlan, UserError> {
        read_plan(plan).ok_or_else(|| Self::error("not a floor plan"))
    }

    fn render_swept_areas(
        &self,
        layout: &Layout,
        rows: &[u32],
        vehicle: EnvelopeSource,
        view: &View,
    ) -> Result<Frame, UserError> {
        let any = vehicle.require_any(layout);
        any.map_err(|reason| ComposeError::NoEnvelope { reason })?;
        let mut swept = locked(&self.swept);
        *swept = rows.to_vec();
        Ok(Frame::new(view.size()))
    }

    fn state_folder(&self) -> Option<PathBuf> {
        locked(&self.state).clone()
    }

    fn methods(&self) -> Vec<MethodChoice> {
        let choice = |name: &str| MethodChoice {
            name: name.into(),
            summary: String::new(),
            unavailable: None,
        };
        [DEVICE, "cpu"].map(choice).into()
    }

    fn start_method(&self, name: &str) -> Result<Box<dyn Method>, UserError> {
        match name {
            "cpu" => Ok(Box::new(Cpu)),
            DEVICE => Ok(Box::new(self.device())),
            _ => Err(Self::error("no such method")),
        }
    }
}

impl Method for Device {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: DEVICE,
            ..Cpu.info()
        }
    }

    fn prepare(
        &self,
        scene: Arc<Scene>,
        budget: &Budget,
    ) -> Result<Box<dyn Prepared>, RenderError> {
        Ok(Box::new(PreparedOnDevice {
            is_lost: Arc::clone(&self.is_lost),
            prepared: Cpu.prepare(scene, budget)?,
        }))
    }
}

impl PreparedOnDevice {
    fn check(&self) -> Result<(), RenderError> {
        match self.is_lost.load(Ordering::Relaxed) {
            false => Ok(()),
            true => Err(RenderError::Device {
                method: DEVICE,
                what: "the device was lost".into(),
            }),
        }
    }
}

impl Prepared for PreparedOnDevice {
    fn render(
        &mut self,
        view: &View,
        style: &Style,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        self.check()?;
        let report = self.prepared.render(view, style, cancel, frame)?;
        Ok(Report {
            method: DEVICE,
            ..report
        })
    }

    fn edit(&mut self, edit: &Edit) -> Result<EditOutcome, RenderError> {
        self.check()?;
        self.prepared.edit(edit)
    }

    fn show_gesture(&mut self, gesture: Option<&Gesture>) -> Result<EditOutcome, RenderError> {
        self.check()?;
        self.prepared.show_gesture(gesture)
    }

    fn preparation(&self) -> &Preparation {
        self.prepared.preparation()
    }
}
