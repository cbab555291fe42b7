//! Projects: writes what the window shows into a file, and opens what such a file remembers.

use std::path::{Path, PathBuf};

use guideway_document::Document;
use guideway_layout::shown_path;
use guideway_scene::{ClassBreaks, Palette};
use guideway_spline::Point;

use super::open_project::{OpenProject, ReadProject};
use super::state::App;
use crate::action::Action;
use crate::background::BackgroundTask;
use crate::command::Command;
use crate::display_settings::DisplaySettings;
use crate::editing::EditTask;
use crate::file_purpose::PromptKind;
use crate::files::{LayerContext, WriteOutcome, WriteTarget};
use crate::language::{say, t};
use crate::panels::dialogs::{Question, Risk};
use crate::project::{
    Project, ProjectFile, ProjectPlan, ProjectView, SUFFIX, absolute_from, is_project, relative_to,
};

impl App {
    /// Saves the project where it was opened or saved before; else asks for a name.
    pub(super) fn save_project_in_place(&mut self) {
        match self.project.path.clone() {
            Some(path) => self.save_project(path),
            None => self.ask_for_file(PromptKind::SaveProject),
        }
    }

    /// Saves the project under this name; asks before it replaces a file.
    pub(super) fn save_project_as(&mut self, path: PathBuf) {
        let path = with_suffix(path);
        let question = Question {
            file: path.clone(),
            risk: Risk::ReplacesFile(Command::SaveProject),
            confirmed: Action::SaveProjectOver(path.clone()),
        };
        self.start_project_save(path, Some(question));
    }

    /// Saves the project under this name, over what is there.
    pub(super) fn save_project(&mut self, path: PathBuf) {
        self.start_project_save(path, None);
    }

    /// Starts to save the project. With a question, the save asks it if a file is there.
    fn start_project_save(&mut self, path: PathBuf, question: Option<Question>) {
        let text = match self.project_of(&path).and_then(|project| project.text()) {
            Ok(text) => text,
            Err(error) => return self.dialogs.notices.add(error),
        };
        if self.is_writer_busy() {
            return;
        }
        let asks = question.is_some();
        self.question_of_write = question;
        let (services, file) = (std::sync::Arc::clone(&self.context.services), path.clone());
        let write = move || {
            if asks && services.file_stamp(&file).is_some() {
                return Ok(WriteOutcome::Exists);
            }
            services.write_project(&file, &text)?;
            let saved = say!("Saved {name}", name = shown_path(&file));
            Ok(WriteOutcome::Written(saved))
        };
        let (target, repaint) = (WriteTarget::Project(path), &self.context.repaint);
        self.writer.start(target, None, repaint, write);
    }

    /// Remembers a project that was saved.
    pub(super) fn end_project_save(&mut self, path: PathBuf) {
        let notices = &mut self.dialogs.notices;
        let layers = self.files.layers().iter();
        let untitled = layers.filter(|layer| layer.is_untitled()).count();
        if untitled > 0 {
            notices.add(t(
                "Layouts without a file are not in the project: save them, then save it",
            ));
        }
        let error = self.files.remember_path(&path);
        self.project.path = Some(path);
        self.notify_all(error);
    }

    /// The project of what the window shows, for a file at `path`.
    fn project_of(&self, path: &Path) -> Result<Project, String> {
        let name = |file: &Path| relative_to(path, file).map_err(|error| error.to_string());
        let layers = self.files.layers().iter();
        let saved: Vec<_> = layers.filter(|layer| !layer.is_untitled()).collect();
        let active = self.files.active();
        let active = active.and_then(|active| saved.iter().position(|l| std::ptr::eq(*l, active)));
        let file = saved.iter().map(|layer| {
            Ok(ProjectFile {
                path: name(layer.path())?,
                is_shown: layer.is_visible,
            })
        });
        let plan = &self.floor_plan;
        let floor_plan = plan.placement().map(|placement| {
            let (text, file) = (placement.text(), &placement.file);
            let place = text[file.len()..].trim_start_matches('@');
            Ok::<_, String>(ProjectPlan {
                path: name(Path::new(file))?,
                place: place.to_owned(),
                is_shown: plan.is_visible,
                is_locked: plan.is_locked,
                opacity: plan.opacity,
            })
        });
        let view = self.canvas.camera.view();
        let palette = self.settings.palette;
        let [color_from, color_to] = self.settings.range;
        let breaks = self.settings.breaks.breaks();
        Ok(Project {
            active: active.unwrap_or(0),
            level: self.document().and_then(shown_level),
            color_by: self.settings.color_by.clone(),
            palette: (palette != Palette::default()).then(|| palette.name().to_owned()),
            color_from,
            color_to,
            breaks: breaks.map_or_else(Vec::new, |breaks| breaks.numbers().to_vec()),
            view: view.map(|view| ProjectView {
                center_m: [view.center_m().x, view.center_m().y],
                px_per_m: view.px_per_m(),
            }),
            floor_plan: floor_plan.transpose()?,
            look: self.settings.clone(),
            file: file.collect::<Result<_, String>>()?,
            ..Project::default()
        })
    }

    /// Starts to read a project; the disk may be slow.
    pub(super) fn open_project(&mut self, path: PathBuf) {
        let (services, file) = (std::sync::Arc::clone(&self.context.services), path.clone());
        let read = move || ReadProject::read(&file, &*services);
        let task = BackgroundTask::start(&self.context.repaint, read);
        self.project_reader.start(path, task);
    }

    /// Opens a project that has been read, and what waits for it.
    pub(super) fn poll_project(&mut self) {
        let Some((path, read)) = self.project_reader.poll() else {
            return;
        };
        match read {
            Ok(read) => self.show_project(&path, &read),
            Err(error) => {
                let file = shown_path(&path);
                self.dialogs.notices.add(format!("{file}: {error}"));
            }
        }
        for file in std::mem::take(&mut self.project_reader.files_after) {
            self.open(file);
        }
        let plan = std::mem::take(&mut self.project_reader.plan_after);
        if !plan.is_empty() {
            self.show_floor_plan(&plan);
        }
    }

    /// Opens what a project remembers, and closes the other files unless they have changes. Names
    /// the files that are missing.
    fn show_project(&mut self, path: &Path, read: &ReadProject) {
        let project = &read.project;
        self.close_unchanged();
        self.project = OpenProject {
            path: Some(path.to_owned()),
            view: project.view.map(|view| {
                let [x, y] = view.center_m;
                (Point::new(x, y), view.px_per_m)
            }),
            level: project.level.clone(),
        };
        let palette = project.palette.as_deref();
        self.settings = DisplaySettings {
            theme: self.settings.theme,
            is_dark: self.settings.is_dark,
            color_by: project.color_by.clone(),
            palette: palette.and_then(Palette::named).unwrap_or_default(),
            range: [project.color_from, project.color_to],
            breaks: ClassBreaks::new(&project.breaks).ok().into(),
            uses_desktop_dialogs: self.settings.uses_desktop_dialogs,
            language: self.settings.language,
            ..project.look.clone()
        };
        self.recolor();
        let missing = self.open_project_files(path, read);
        if !missing.is_empty() {
            let names = missing.join(", ");
            let notice = say!("Files of the project that do not exist: {names}", names);
            self.dialogs.notices.add(notice);
        }
        // Without a file nothing arrives that would set the view.
        if let (true, Some((center_m, px_per_m))) =
            (self.files.layers().is_empty(), self.project.view)
        {
            self.canvas.camera.look_at(center_m, px_per_m);
        }
        let error = self.files.remember_path(path);
        self.notify_all(error);
    }

    /// Opens the files and the floor plan of a project. Returns the names of missing ones.
    fn open_project_files(&mut self, path: &Path, read: &ReadProject) -> Vec<String> {
        let project = &read.project;
        let mut missing = Vec::new();
        let mut is_there = |file: &Path| {
            let is_there = !read.missing.contains(file);
            if !is_there {
                missing.push(shown_path(file));
            }
            is_there
        };
        let mut active = None;
        for (number, file) in project.file.iter().enumerate() {
            let full = absolute_from(path, &file.path);
            if !is_there(&full) {
                continue;
            }
            self.open(full);
            let index = self.files.active_index();
            if let Some(layer) = self.files.active_mut() {
                layer.is_visible = file.is_shown;
            }
            if number == project.active {
                active = Some(index);
            }
        }
        self.files.activate(active.unwrap_or(0));
        let plan = project.floor_plan.as_ref();
        let full = plan.map(|plan| (plan, absolute_from(path, &plan.path)));
        match full.filter(|(_, full)| is_there(full)) {
            Some((plan, full)) => self.open_project_plan(plan, &full),
            None => self.floor_plan = Default::default(),
        }
        missing
    }

    fn open_project_plan(&mut self, plan: &ProjectPlan, file: &Path) {
        let file = file.to_string_lossy();
        let text = match plan.place.is_empty() {
            true => file.into_owned(),
            false => format!("{file}@{}", plan.place),
        };
        self.show_floor_plan(&text);
        // The user was asked before.
        self.plan_editor.asks_unit = false;
        self.floor_plan.is_visible = plan.is_shown;
        self.floor_plan.is_locked = plan.is_locked;
        self.floor_plan.opacity = plan.opacity;
    }

    /// Starts to read a floor plan.
    pub(super) fn show_floor_plan(&mut self, text: &str) {
        self.plan_editor.asks_unit = true;
        let LayerContext {
            services, repaint, ..
        } = &self.context;
        self.floor_plan.set(text, services, repaint);
    }

    fn close_unchanged(&mut self) {
        for index in (0..self.files.layers().len()).rev() {
            if !self.files.layers()[index].is_changed() {
                self.close(index);
            }
        }
    }

    /// Shows the level of the project once the active file is loaded.
    pub(super) fn restore_level(&mut self, index: usize) {
        if index != self.files.active_index() {
            return;
        }
        if let Some(level) = self.project.level.take() {
            self.edit(EditTask::view_change(move |document| {
                let mut levels = document.layout().levels.iter();
                let row = levels.position(|other| other.id == level);
                if let Some(row) = row {
                    document.show_level(Some(row as u32));
                }
            }));
        }
    }
}

/// The identifier of the level that is shown alone.
fn shown_level(document: &Document) -> Option<String> {
    let level = document.layout().levels.get(document.level()? as usize);
    level.map(|level| level.id.clone())
}

/// The name with the end by which projects are known.
fn with_suffix(path: PathBuf) -> PathBuf {
    if is_project(&path) {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(SUFFIX);
    PathBuf::from(name)
}
