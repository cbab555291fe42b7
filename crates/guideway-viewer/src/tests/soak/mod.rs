//! The soak test: random input for hours. Every save equals the replayed journal, no crash loses
//! work, no thread panics, and memory at rest stays flat.

mod file_store;
mod memory;
mod record;
mod saves;
mod two_windows;

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use guideway_document::{Document, replay};
use guideway_layout::Layout;

use super::content::difference;
use super::lane_network::network;
use super::random_input::{RandomSource, act, close_dialogs, keep_open};
use super::test_window::TestWindow;
use crate::command::Command;
use crate::editing::entries_on_disk;
use file_store::FileStore;
use record::Record;

/// Events per chapter. A chapter ends at rest, with the first file loaded again.
const EVENTS_PER_CHAPTER: usize = 200;

/// Length of a run.
enum Length {
    Chapters(usize),
    Minutes(f64),
}

struct Soak {
    store: Arc<FileStore>,
    window: TestWindow,
    first: Layout,
    random: RandomSource,
    record: Record,
}

/// Panics of all threads, also of those that the window replaces.
static PANICS: AtomicU64 = AtomicU64::new(0);

fn count_panics() {
    let show = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        PANICS.fetch_add(1, Ordering::Relaxed);
        show(panic);
    }));
}

impl Soak {
    fn new(seed: u64) -> Self {
        let first = network(40);
        let store = FileStore::with(&first);
        let window = open_window(&store);
        Self {
            store,
            window,
            first,
            random: RandomSource(seed),
            record: Record::default(),
        }
    }

    fn run(&mut self, length: &Length) -> Result<(), String> {
        count_panics();
        let started = Instant::now();
        let minutes = || started.elapsed().as_secs_f64() / 60.0;
        for chapter in 0.. {
            let is_over = match length {
                Length::Chapters(most) => chapter >= *most,
                Length::Minutes(most) => minutes() >= *most,
            };
            if is_over {
                break;
            }
            (0..EVENTS_PER_CHAPTER).try_for_each(|_| self.act())?;
            self.save()?;
            self.rest();
            if let Some(mb) = memory::resident_mb() {
                self.record.rests.push((minutes(), mb));
            }
        }
        let panics = PANICS.load(Ordering::Relaxed);
        if panics > 0 {
            return Err(format!("threads panicked, {panics} of them"));
        }
        match length {
            // Other tests share the process, so its memory says nothing.
            Length::Chapters(_) => Ok(()),
            Length::Minutes(_) => memory::check(&self.record.at_rest_mb()),
        }
    }

    /// Random input, or a random fault.
    fn act(&mut self) -> Result<(), String> {
        match self.random.below(400) {
            7 => self.open_second_window()?,
            0 => self.save()?,
            1 => self.crash()?,
            2 | 3 => {
                self.store.disk.lose_device();
                self.record.count("device lost");
            }
            4 | 5 => {
                let choices = [None, Some("cpu".to_owned()), Some("device".to_owned())];
                let chosen = choices[self.random.below(3)].clone();
                self.window.app().set_method(chosen);
                self.record.count("other method");
            }
            6 => self.fail_to_save()?,
            _ => {
                let before = self.window.app().document().map(Document::state);
                let what = act(&mut self.window, &mut self.random);
                self.record.count(what);
                let document = self.window.app().document();
                let document = document.filter(|document| Some(document.state()) != before);
                if let Some(step) = document.and_then(|document| document.undo_redo_names().0) {
                    *self.record.steps.entry(step).or_default() += 1;
                }
            }
        }
        let file = self.file();
        keep_open(&mut self.window, &file);
        Ok(())
    }

    /// Saves, and compares the file with the replayed journal.
    fn save(&mut self) -> Result<(), String> {
        let base = self
            .store
            .layout(&self.store.file)
            .expect("the file is there");
        self.press_save();
        self.window.wait(|app| {
            app.document()
                .is_some_and(|document| !document.is_changed())
        });
        self.record.count("save");
        let saved = self
            .store
            .layout(&self.store.file)
            .expect("the file is there");
        let is = self.window.document().to_layout();
        if let Some(lines) = difference(&saved, &is) {
            return Err(format!("the saved file differs from the document: {lines}"));
        }
        let replayed = match entries_on_disk(&self.store.file) {
            None => base,
            Some((acts, from)) => {
                let from = self
                    .store
                    .layout(&from)
                    .expect("the file as it was read is kept");
                let mut document = document(from);
                if replay(&acts, &mut document, |_| true).bytes != acts.len() {
                    return Err("the journal cannot be replayed".into());
                }
                document.to_layout()
            }
        };
        let lines = difference(&saved, &replayed);
        lines.map_or(Ok(()), |lines| {
            Err(format!(
                "the saved file differs from the replayed journal: {lines}"
            ))
        })
    }

    /// Saves to a full disk: the file must stay unchanged.
    fn fail_to_save(&mut self) -> Result<(), String> {
        let before = self
            .store
            .layout(&self.store.file)
            .expect("the file is there");
        let set_full = |soak: &Self, is_full| {
            let disk = soak.store.disk.is_full.lock();
            *disk.expect("no test panics while it holds the lock") = is_full;
        };
        set_full(self, true);
        self.press_save();
        self.window.wait(|app| {
            app.dialogs
                .notices
                .texts()
                .iter()
                .any(|notice| notice.contains("disk is full"))
        });
        set_full(self, false);
        self.record.count("save to a full disk");
        let after = self
            .store
            .layout(&self.store.file)
            .expect("the file is there");
        let lines = difference(&before, &after);
        lines.map_or(Ok(()), |lines| Err(format!("a failed save left: {lines}")))
    }

    fn press_save(&mut self) {
        close_dialogs(&mut self.window);
        self.window.wait(|app| !app.writer.is_busy());
        self.window.app().dialogs.notices.clear();
        self.window.key(Modifiers::COMMAND, Key::S);
        self.window.wait(|app| !app.writer.is_busy());
    }

    /// Simulates a crash, in which no destructor runs, and restarts the window.
    fn crash(&mut self) -> Result<(), String> {
        close_dialogs(&mut self.window);
        self.window.wait(|app| !app.writer.is_busy());
        let before = self.window.document().to_layout();
        let is_changed = self.window.document().is_changed();
        let folder = self.store.file.parent().expect("it is in a folder");
        let names = fs::read_dir(folder).expect("the folder is there");
        let left: Vec<(PathBuf, Vec<u8>)> = names
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| *path != self.store.file)
            .filter_map(|path| Some((path.clone(), fs::read(path).ok()?)))
            .collect();
        while !self.window.app().files.layers().is_empty() {
            self.window.app().files.close(0);
        }
        for (path, bytes) in left {
            fs::write(path, bytes).expect("there is room for it");
        }
        self.window = open_window(&self.store);
        self.record.count("crash");
        if is_changed {
            self.window
                .wait(|app| app.files.layers()[0].has_unsaved_work());
        }
        // Undone edits are unsaved work too.
        if self.window.app().files.layers()[0].has_unsaved_work() {
            self.window.harness.run_steps(3);
            self.window.harness.get_by_label("Recover").click();
            self.window.wait(|app| {
                app.dialogs
                    .notices
                    .texts()
                    .iter()
                    .any(|n| n.contains("Recovered"))
            });
        }
        let lines = difference(&before, &self.window.document().to_layout());
        lines.map_or(Ok(()), |lines| Err(format!("a crash lost work: {lines}")))
    }

    /// Restores and reloads the first file, so that memory is comparable.
    fn rest(&mut self) {
        self.store.put(&self.first);
        let app = self.window.app();
        app.settings = crate::display_settings::DisplaySettings::default();
        app.files.layers_mut()[0].is_visible = true;
        app.reload(0, true);
        self.window.wait(|app| !app.files.layers()[0].is_loading());
        let paths = self.first.paths.len();
        let ctx = self.window.harness.ctx.clone();
        self.window.app().perform(Command::ZoomToAll, &ctx);
        let is_whole = |report: &guideway_scene::Report| report.drawn == paths as u64;
        self.window.wait(|app| {
            let shown = app.files.layers()[0].picture.shown();
            shown.is_some_and(|shown| is_whole(&shown.report))
        });
        self.record.count("rest");
    }

    fn file(&self) -> String {
        self.store.file.display().to_string()
    }
}

fn open_window(store: &Arc<FileStore>) -> TestWindow {
    let services = Arc::clone(store);
    let mut window = TestWindow::with_services(
        services,
        &store.disk,
        &[&store.file.display().to_string()],
        None,
    );
    window.wait(|app| app.document().is_some() && app.files.layers()[0].picture.shown().is_some());
    window
}

fn document(layout: Layout) -> Document {
    Document::new(Arc::new(layout), &Default::default()).expect("the options name no column")
}

#[test]
fn short_soak_loses_nothing() {
    let mut soak = Soak::new(11);
    let outcome = soak.run(&Length::Chapters(3));
    println!("{}", soak.record.text(11, 0.0));
    assert_eq!(outcome, Ok(()));
    // A thread that panics fails the run.
    let thread = std::thread::spawn(|| panic!("on purpose"));
    assert!(thread.join().is_err());
    assert!(soak.run(&Length::Chapters(0)).is_err());
}

/// Runs for GUIDEWAY_SOAK_MINUTES: `cargo xtask soak --minutes 60`.
#[test]
#[ignore = "runs for GUIDEWAY_SOAK_MINUTES"]
fn long_soak_loses_nothing() {
    let number = |name: &str| std::env::var(name).ok()?.parse::<f64>().ok();
    let minutes = number("GUIDEWAY_SOAK_MINUTES").unwrap_or(1.0);
    let seed = number("GUIDEWAY_SOAK_SEED").unwrap_or(1.0) as u64;
    let mut soak = Soak::new(seed);
    let started = Instant::now();
    let outcome = soak.run(&Length::Minutes(minutes));
    let minutes = started.elapsed().as_secs_f64() / 60.0;
    let text = soak.record.text(seed, minutes) + &format!("\noutcome: {outcome:?}\n");
    println!("{text}");
    if let Some(file) = std::env::var_os("GUIDEWAY_SOAK_RECORD") {
        fs::write(file, text).expect("the record can be written");
    }
    assert_eq!(outcome, Ok(()));
}

#[test]
fn detects_an_undo_without_journal_entry() {
    let mut soak = Soak::new(3);
    soak.window.document().select_all();
    soak.window.document().delete_selection().unwrap();
    soak.window.harness.step();
    soak.save().unwrap();
    soak.window.document().undo();
    soak.window.document().take_journal_entries();
    let caught = soak.save().unwrap_err();
    assert!(
        caught.contains("differs from the replayed journal"),
        "{caught}"
    );
}

#[test]
fn detects_an_undo_with_another_effect() {
    let mut soak = Soak::new(3);
    soak.window.document().select_all();
    soak.window.document().delete_selection().unwrap();
    soak.window.harness.step();
    soak.window.document().undo();
    soak.window.harness.step();
    // An edit without a journal entry, as if undo had moved a node.
    let aside = guideway_spline::Point::new(0.0, 0.5);
    soak.window.document().move_node(0, aside).unwrap();
    soak.window.document().take_journal_entries();
    let caught = soak.save().unwrap_err();
    assert!(
        caught.contains("differs from the replayed journal"),
        "{caught}"
    );
}
