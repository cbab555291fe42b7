use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use guideway_cpu::Cpu;
use guideway_layout::{Layout, NewPath, Value};
use guideway_render::{
    Budget, Cancel, Frame, Method, MethodInfo, Preparation, Prepared, RenderError, Report, Style,
    View,
};
use guideway_scene::Scene;
use guideway_spline::{Point, Runs};

use crate::host::{Host, Load, MethodChoice, Trouble};

/// Files that are only there for the test.
#[derive(Default)]
pub(super) struct Table {
    pub(super) files: Mutex<HashMap<PathBuf, Layout>>,
    /// Whether the disk is full.
    pub(super) is_full: Mutex<bool>,
}

/// A method that is let down by its device with every frame.
struct Broken;

impl Table {
    pub(super) fn with(files: impl IntoIterator<Item = (&'static str, Layout)>) -> Arc<Self> {
        let files = files
            .into_iter()
            .map(|(name, layout)| (name.into(), layout))
            .collect();
        Arc::new(Self {
            files: Mutex::new(files),
            is_full: Mutex::new(false),
        })
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

impl Host for Table {
    fn open(&self, path: &Path, load: &Load) -> Result<Layout, Trouble> {
        load.advance(1, 2);
        let files = self
            .files
            .lock()
            .expect("no test panics while it holds this");
        files
            .get(path)
            .cloned()
            .ok_or_else(|| Self::trouble("there is no such file"))
    }

    fn save(&self, layout: &Layout, path: &Path) -> Result<Vec<String>, Trouble> {
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

    fn save_picture(&self, _frame: &Frame, _path: &Path) -> Result<(), Trouble> {
        Ok(())
    }

    fn save_drawing(&self, _: &Scene, _: &View, _: &Style, _: &Path) -> Result<(), Trouble> {
        Ok(())
    }

    fn methods(&self) -> Vec<MethodChoice> {
        let choice = |name: &str| MethodChoice {
            name: name.into(),
            summary: String::new(),
            why_not: None,
        };
        ["cpu", "broken"].map(choice).into()
    }

    fn method(&self, name: &str) -> Result<Box<dyn Method>, Trouble> {
        match name {
            "cpu" => Ok(Box::new(Cpu)),
            "broken" => Ok(Box::new(Broken)),
            _ => Err(Self::trouble("there is no such method")),
        }
    }
}

impl Method for Broken {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            name: "broken",
            summary: "",
            device: String::new(),
        }
    }

    fn plan_bytes(&self, _scene: &Scene, _budget: &Budget) -> u64 {
        0
    }

    fn prepare(&self, _: Arc<Scene>, _: &Budget) -> Result<Box<dyn Prepared>, RenderError> {
        Ok(Box::new(Lost(Preparation::default())))
    }
}

struct Lost(Preparation);

impl Prepared for Lost {
    fn render(
        &mut self,
        _view: &View,
        _style: &Style,
        _cancel: &Cancel,
        _frame: &mut Frame,
    ) -> Result<Report, RenderError> {
        Err(RenderError::Device {
            method: "broken",
            what: "the device was lost".into(),
        })
    }

    fn preparation(&self) -> &Preparation {
        &self.0
    }
}
