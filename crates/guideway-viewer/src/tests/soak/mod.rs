//! Hours of a person who does anything: what is saved is what the journal says was done, a crash loses nothing, and
//! memory stays flat.

mod memory;
mod saves;
mod shelf;

use std::collections::BTreeMap;
use std::fmt::Write;
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
use super::desk::Desk;
use super::hand::{Chance, act, calm_down, keep_open};
use super::table::lanes;
use crate::app::command::Command;
use crate::work::recovery::written;
use shelf::Shelf;

/// Events from one rest, with the file as it was at first, to the next.
const EVENTS_A_CHAPTER: usize = 200;

/// When a run is over.
enum Length {
    Chapters(usize),
    Minutes(f64),
}

struct Soak {
    shelf: Arc<Shelf>,
    desk: Desk,
    first: Layout,
    chance: Chance,
    record: Record,
}

/// What was done, and what it took.
#[derive(Default)]
struct Record {
    counts: BTreeMap<&'static str, u64>,
    /// Minutes since the start, and megabytes, at the end of each chapter.
    rests: Vec<(f64, f64)>,
}

/// Panics of any thread, also of those that the viewer goes on without.
static PANICS: AtomicU64 = AtomicU64::new(0);

fn count_panics() {
    let show = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        PANICS.fetch_add(1, Ordering::Relaxed);
        show(panic);
    }));
}

impl Record {
    fn count(&mut self, what: &'static str) {
        *self.counts.entry(what).or_default() += 1;
    }

    fn at_rest_mb(&self) -> Vec<f64> {
        self.rests.iter().map(|&(_, mb)| mb).collect()
    }

    /// All of it, as text.
    fn text(&self, seed: u64, minutes: f64) -> String {
        let mut text = format!("seed {seed}, {minutes:.1} minutes\n");
        for (what, count) in &self.counts {
            let _ = writeln!(text, "{count:>9}  {what}");
        }
        let growth_mb = memory::growth_mb(&self.at_rest_mb());
        let _ = writeln!(
            text,
            "memory at rest grew by {growth_mb:.1} MB\n\nminute  MB at rest"
        );
        let step = self.rests.len().div_ceil(60).max(1);
        for (minute, mb) in self.rests.iter().step_by(step) {
            let _ = writeln!(text, "{minute:>6.1}  {mb:.1}");
        }
        text
    }
}

impl Soak {
    fn new(seed: u64) -> Self {
        let first = lanes(60);
        let shelf = Shelf::with(&first);
        let desk = desk_at(&shelf);
        Self {
            shelf,
            desk,
            first,
            chance: Chance(seed),
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
            (0..EVENTS_A_CHAPTER).try_for_each(|_| self.act())?;
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
            // Other tests share the memory of the process.
            Length::Chapters(_) => Ok(()),
            Length::Minutes(_) => memory::check(&self.record.at_rest_mb()),
        }
    }

    /// Something that hands do, or that befalls them.
    fn act(&mut self) -> Result<(), String> {
        match self.chance.below(400) {
            0 => self.save()?,
            1 => self.crash()?,
            2 | 3 => {
                self.shelf.table.lose_device();
                self.record.count("device lost");
            }
            4 | 5 => {
                let choices = [None, Some("cpu".to_owned()), Some("device".to_owned())];
                let chosen = choices[self.chance.below(3)].clone();
                self.desk.app().set_method(chosen);
                self.record.count("other method");
            }
            6 => self.fail_to_save()?,
            _ => {
                let what = act(&mut self.desk, &mut self.chance);
                self.record.count(what);
            }
        }
        let file = self.file();
        keep_open(&mut self.desk, &file);
        Ok(())
    }

    /// Saves, and compares what is written with what the journal says was done.
    fn save(&mut self) -> Result<(), String> {
        let base = self
            .shelf
            .layout(&self.shelf.file)
            .expect("the file is there");
        self.press_save();
        self.desk.wait(|app| {
            app.document()
                .is_some_and(|document| !document.is_changed())
        });
        self.record.count("save");
        let saved = self
            .shelf
            .layout(&self.shelf.file)
            .expect("the file is there");
        let is = self.desk.document().to_layout();
        if let Some(lines) = difference(&saved, &is) {
            return Err(format!("what is saved is not what is there: {lines}"));
        }
        let replayed = match written(&self.shelf.file) {
            None => base,
            Some((acts, from)) => {
                let from = self
                    .shelf
                    .layout(&from)
                    .expect("the file as it was read is kept");
                let mut document = document(from);
                if replay(&acts, &mut document, |_| true).bytes != acts.len() {
                    return Err("the journal cannot be done again".into());
                }
                document.to_layout()
            }
        };
        let lines = difference(&saved, &replayed);
        lines.map_or(Ok(()), |lines| {
            Err(format!("what is saved is not what was done: {lines}"))
        })
    }

    /// Saves to a disk that is full: the file must stay what it is.
    fn fail_to_save(&mut self) -> Result<(), String> {
        let before = self
            .shelf
            .layout(&self.shelf.file)
            .expect("the file is there");
        let set_full = |soak: &Self, is_full| {
            let disk = soak.shelf.table.is_full.lock();
            *disk.expect("no test panics while it holds this") = is_full;
        };
        set_full(self, true);
        self.press_save();
        self.desk.wait(|app| {
            app.notices
                .iter()
                .any(|notice| notice.contains("disk is full"))
        });
        set_full(self, false);
        self.record.count("save to a full disk");
        let after = self
            .shelf
            .layout(&self.shelf.file)
            .expect("the file is there");
        let lines = difference(&before, &after);
        lines.map_or(Ok(()), |lines| Err(format!("a failed save left: {lines}")))
    }

    fn press_save(&mut self) {
        calm_down(&mut self.desk);
        self.desk.wait(|app| !app.is_writing());
        self.desk.app().notices.clear();
        self.desk.key(Modifiers::COMMAND, Key::S);
        self.desk.wait(|app| !app.is_writing());
    }

    /// The program ends without a chance to tidy up, and is started again.
    fn crash(&mut self) -> Result<(), String> {
        calm_down(&mut self.desk);
        self.desk.wait(|app| !app.is_writing());
        let before = self.desk.document().to_layout();
        let is_changed = self.desk.document().is_changed();
        let folder = self.shelf.file.parent().expect("it is in a folder");
        let names = fs::read_dir(folder).expect("the folder is there");
        let left: Vec<(PathBuf, Vec<u8>)> = names
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| *path != self.shelf.file)
            .filter_map(|path| Some((path.clone(), fs::read(path).ok()?)))
            .collect();
        self.desk.app().layers.clear();
        for (path, bytes) in left {
            fs::write(path, bytes).expect("there is room for it");
        }
        self.desk = desk_at(&self.shelf);
        self.record.count("crash");
        if is_changed {
            self.desk.wait(|app| app.layers[0].has_found_work());
        }
        // What was done and undone may be done again, too.
        if self.desk.app().layers[0].has_found_work() {
            self.desk.harness.run_steps(3);
            self.desk.harness.get_by_label("Do it again").click();
            self.desk
                .wait(|app| app.notices.iter().any(|n| n.contains("done again")));
        }
        let lines = difference(&before, &self.desk.document().to_layout());
        lines.map_or(Ok(()), |lines| Err(format!("a crash lost work: {lines}")))
    }

    /// Puts the file as it was at first and reads it again, so that the memory held can be compared.
    fn rest(&mut self) {
        self.shelf.put(&self.first);
        let app = self.desk.app();
        app.look = crate::app::Look::default();
        app.reload(0, true);
        self.desk.wait(|app| !app.layers[0].is_reading());
        let paths = self.first.paths.len();
        let ctx = self.desk.harness.ctx.clone();
        self.desk.app().perform(Command::Fit, &ctx);
        let is_whole = |report: &guideway_scene::Report| report.drawn == paths as u64;
        self.desk.wait(|app| {
            let shown = app.layers[0].shown.as_ref();
            shown.is_some_and(|shown| is_whole(&shown.report))
        });
        self.record.count("rest");
    }

    fn file(&self) -> String {
        self.shelf.file.display().to_string()
    }
}

fn desk_at(shelf: &Arc<Shelf>) -> Desk {
    let services = Arc::clone(shelf);
    let mut desk = Desk::of(
        services,
        &shelf.table,
        &[&shelf.file.display().to_string()],
        None,
    );
    desk.wait(|app| app.document().is_some() && app.layers[0].shown.is_some());
    desk
}

fn document(layout: Layout) -> Document {
    Document::new(Arc::new(layout), &Default::default()).expect("no column is asked for")
}

#[test]
fn a_short_day_of_anything() {
    let mut soak = Soak::new(11);
    let outcome = soak.run(&Length::Chapters(5));
    println!("{}", soak.record.text(11, 0.0));
    assert_eq!(outcome, Ok(()));
    // It would have told of a thread that panics, too.
    let thread = std::thread::spawn(|| panic!("on purpose"));
    assert!(thread.join().is_err());
    assert!(soak.run(&Length::Chapters(0)).is_err());
}

/// As long as asked: `cargo xtask soak --minutes 60`.
#[test]
#[ignore = "takes as long as it is told to"]
fn a_day_of_anything() {
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
fn an_undo_that_is_not_written_down_is_caught() {
    let mut soak = Soak::new(3);
    soak.desk.document().select_all();
    soak.desk.document().delete_selection().unwrap();
    soak.desk.harness.step();
    soak.save().unwrap();
    soak.desk.document().undo();
    soak.desk.document().take_journal_entries();
    let caught = soak.save().unwrap_err();
    assert!(caught.contains("not what was done"), "{caught}");
}

#[test]
fn an_undo_that_does_something_else_is_caught() {
    let mut soak = Soak::new(3);
    soak.desk.document().select_all();
    soak.desk.document().delete_selection().unwrap();
    soak.desk.harness.step();
    soak.desk.document().undo();
    soak.desk.harness.step();
    // What the journal does not know of, as if undoing had put a node aside.
    let aside = guideway_spline::Point::new(0.0, 0.5);
    soak.desk.document().move_node(0, aside).unwrap();
    soak.desk.document().take_journal_entries();
    let caught = soak.save().unwrap_err();
    assert!(caught.contains("not what was done"), "{caught}");
}
