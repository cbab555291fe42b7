use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use guideway_cpu::Cpu;
use guideway_layout::{Layout, NewPath, Value};
use guideway_scene::{
    Budget, Cancel, Edited, Frame, Method, MethodInfo, Preparation, Prepared, RenderError, Report,
    Style, View,
};
use guideway_scene::{Edit, Scene};
use guideway_spline::{Bounds, Point, Runs};

use crate::host::{Export, FloorPlan, Host, Job, MethodChoice, Trouble};

/// Files that are only there for the test.
#[derive(Default)]
pub(super) struct Table {
    pub(super) files: Mutex<HashMap<PathBuf, Layout>>,
    /// Whether the disk is full.
    pub(super) is_full: Mutex<bool>,
    /// Whether reading and writing come to no end.
    pub(super) is_slow: Mutex<bool>,
    /// What is remembered from one run to the next.
    pub(super) state: Mutex<Option<PathBuf>>,
    /// Paths whose areas were last drawn.
    pub(super) swept: Mutex<Vec<u32>>,
    /// Pictures that were written.
    pub(super) pictures: Mutex<Vec<(PathBuf, Export)>>,
    /// Whether the graphics device is lost; another one takes its place when one is asked for.
    is_device_lost: Mutex<Arc<AtomicBool>>,
}

/// The method of the graphics device, which is better than the processor.
const DEVICE: &str = "device";

/// A graphics device that can be lost. It draws as the processor does.
struct Device {
    is_lost: Arc<AtomicBool>,
}

/// A scene on it.
struct OnDevice {
    is_lost: Arc<AtomicBool>,
    prepared: Box<dyn Prepared>,
}

impl Table {
    pub(super) fn with(files: impl IntoIterator<Item = (&'static str, Layout)>) -> Arc<Self> {
        let files = files
            .into_iter()
            .map(|(name, layout)| (name.into(), layout))
            .collect();
        Arc::new(Self {
            files: Mutex::new(files),
            ..Self::default()
        })
    }

    /// Takes the graphics device away, as a driver that crashed does.
    pub(super) fn lose_device(&self) {
        let lost = self.is_device_lost.lock();
        let lost = lost.expect("no test panics while it holds this");
        lost.store(true, Ordering::Relaxed);
    }

    fn device(&self) -> Device {
        let lost = self.is_device_lost.lock();
        let mut lost = lost.expect("no test panics while it holds this");
        *lost = Arc::default();
        Device {
            is_lost: Arc::clone(&lost),
        }
    }

    fn wait_for_disk(&self, job: &Job) -> Result<(), Trouble> {
        while *self
            .is_slow
            .lock()
            .expect("no test panics while it holds this")
        {
            if job.is_cancelled() {
                return Err(Self::trouble("cancelled"));
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        Ok(())
    }

    fn trouble(message: &str) -> Trouble {
        Trouble {
            message: message.to_owned(),
            remedy: "Look elsewhere".into(),
        }
    }
}

/// Paths of 10 m along x, 2 m apart, between nodes of their own.
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

/// A floor of 40 m by 30 m, all red.
struct Hall;

impl FloorPlan for Hall {
    fn bounds(&self) -> Option<Bounds<f64>> {
        let (min, max) = (Point::new(-20.0, -15.0), Point::new(20.0, 15.0));
        Some(Bounds { min, max })
    }

    fn draw(&self, view: &View) -> Result<Frame, Trouble> {
        let mut frame = Frame::new(view.size());
        frame.pixels_mut().fill([255, 0, 0, 255]);
        Ok(frame)
    }
}

impl Host for Table {
    fn open(&self, path: &Path, job: &Job) -> Result<Layout, Trouble> {
        job.advance(1, 2);
        self.wait_for_disk(job)?;
        let files = self
            .files
            .lock()
            .expect("no test panics while it holds this");
        files
            .get(path)
            .cloned()
            .ok_or_else(|| Self::trouble("there is no such file"))
    }

    fn check_in_place(&self, _: &Layout, file: &Path) -> Result<(), Trouble> {
        match file.extension().is_some_and(|ending| ending == "dxf") {
            true => Err(Self::trouble("it is a drawing")),
            false => Ok(()),
        }
    }

    fn save(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, Trouble> {
        self.wait_for_disk(&Job::default())?;
        if *self
            .is_full
            .lock()
            .expect("no test panics while it holds this")
        {
            return Err(Self::trouble("the disk is full"));
        }
        let mut files = self
            .files
            .lock()
            .expect("no test panics while it holds this");
        files.insert(path.to_owned(), layout.clone());
        Ok(vec!["nothing of it is kept for long".into()])
    }

    fn save_picture(
        &self,
        export: &Export,
        _method: &str,
        job: &Job,
        path: &Path,
    ) -> Result<(), Trouble> {
        let height = export.view.size().height();
        for row in 0..height {
            job.advance(row.into(), height.into());
            self.wait_for_disk(job)?;
        }
        let mut pictures = self
            .pictures
            .lock()
            .expect("no test panics while it holds this");
        pictures.push((path.to_owned(), export.clone()));
        Ok(())
    }

    fn picture(&self, export: &Export, _method: &str) -> Result<Frame, Trouble> {
        Ok(Frame::new(export.view.size()))
    }

    fn save_drawing(&self, _: &Export, _: &Path) -> Result<(), Trouble> {
        Ok(())
    }

    fn floor_plan(&self, plan: &str) -> Result<Arc<dyn FloorPlan>, Trouble> {
        match plan {
            "hall.png@px-per-m=20" => Ok(Arc::new(Hall)),
            _ => Err(Self::trouble("that is no floor plan")),
        }
    }

    fn swept(
        &self,
        _layout: &Layout,
        rows: &[u32],
        vehicle: &str,
        view: &View,
    ) -> Result<Frame, Trouble> {
        match vehicle {
            "2x1.2" => {
                let mut swept = self
                    .swept
                    .lock()
                    .expect("no test panics while it holds this");
                *swept = rows.to_vec();
                Ok(Frame::new(view.size()))
            }
            _ => Err(Self::trouble("that is no vehicle")),
        }
    }

    fn state_folder(&self) -> Option<PathBuf> {
        let state = self.state.lock();
        state.expect("no test panics while it holds this").clone()
    }

    fn methods(&self) -> Vec<MethodChoice> {
        let choice = |name: &str| MethodChoice {
            name: name.into(),
            summary: String::new(),
            why_not: None,
        };
        [DEVICE, "cpu"].map(choice).into()
    }

    fn method(&self, name: &str) -> Result<Box<dyn Method>, Trouble> {
        match name {
            "cpu" => Ok(Box::new(Cpu)),
            DEVICE => Ok(Box::new(self.device())),
            _ => Err(Self::trouble("there is no such method")),
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
        Ok(Box::new(OnDevice {
            is_lost: Arc::clone(&self.is_lost),
            prepared: Cpu.prepare(scene, budget)?,
        }))
    }
}

impl OnDevice {
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

impl Prepared for OnDevice {
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

    fn edit(&mut self, edit: &Edit) -> Result<Edited, RenderError> {
        self.check()?;
        self.prepared.edit(edit)
    }

    fn preparation(&self) -> &Preparation {
        self.prepared.preparation()
    }
}
