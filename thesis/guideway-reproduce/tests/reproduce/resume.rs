//! Tests the continuation of incomplete runs.

use std::cell::RefCell;

use guideway_bench::{Dataset, Outcome, StartError};
use guideway_reproduce::report::{PAGE, files};
use guideway_reproduce::reproduce::{
    Limit, PartFacts, Plan, Reading, ResumeError, Run, RunSession, reproduce, resume,
};
use guideway_scene::{Cancel, Method};

use super::fake::{FAKE, Fake};
use super::plan;

const METHODS: [&str; 2] = ["grid", "tessellation"];
const OUT_OF_TIME: &str = "the time for this part was over";

/// Continues a run; returns it with the progress messages.
fn resume_with(run: Run, fake: Fake) -> Result<(Run, Vec<String>), ResumeError> {
    let messages = RefCell::new(Vec::new());
    let show = |message: &str| messages.borrow_mut().push(message.to_owned());
    let start = |_: &str| -> Result<Box<dyn Method>, StartError> { Ok(Box::new(fake)) };
    let run = resume(run, &start, &Cancel::default(), &show)?;
    Ok((run, messages.into_inner()))
}

/// A run that the user stops at a progress message.
fn run(plan: &Plan, stop_at: &str) -> Run {
    let cancel = Cancel::default();
    let show = |message: &str| {
        if message == stop_at {
            cancel.set();
        }
    };
    let start = |_: &str| -> Result<Box<dyn Method>, StartError> { Ok(Box::new(FAKE)) };
    reproduce(plan, &start, &cancel, &show).unwrap()
}

fn whole() -> Run {
    run(&plan(&METHODS), "")
}

type Place = (Dataset, usize, f64, String, Option<f64>);

fn place(reading: &Reading) -> Place {
    let ms = reading.row.measured().map(|m| m.frame_ms.mean);
    let method = reading.row.method.clone();
    (reading.dataset, reading.paths, reading.at, method, ms)
}

/// Compares everything in two runs except times of the clock.
fn assert_same(a: &Run, b: &Run) {
    let (x, y) = (&a.results, &b.results);
    for (x, y) in [
        (&x.occupancy, &y.occupancy),
        (&x.zoom, &y.zoom),
        (&x.growth, &y.growth),
        (&x.changes, &y.changes),
    ] {
        let places = |readings: &[Reading]| readings.iter().map(place).collect::<Vec<_>>();
        assert_eq!(places(x), places(y));
    }
    assert_eq!(x.most_paths.len(), y.most_paths.len());
    for (x, y) in x.most_paths.iter().zip(&y.most_paths) {
        assert_eq!((x.dataset, &x.row.method), (y.dataset, &y.row.method));
        assert_eq!((x.paths, x.limit, &x.trials), (y.paths, y.limit, &y.trials));
    }
    assert_eq!(x.borders, y.borders);
    assert_eq!(x.pictures, y.pictures);
    assert_eq!((a.is_partial, a.is_whole()), (b.is_partial, b.is_whole()));
    let parts = |run: &Run| {
        let parts = run.parts.iter();
        let facts = parts.map(|p| (p.name.clone(), p.is_cut, p.failure.clone()));
        facts.collect::<Vec<_>>()
    };
    assert_eq!(parts(a), parts(b));
}

#[test]
fn resume_completes_a_run_cut_by_its_time_limit() {
    let short = Plan {
        minutes: 1e-9,
        ..plan(&METHODS)
    };
    let mut cut = run(&short, "");
    assert!(!cut.is_whole() && !cut.is_partial);
    cut.plan.minutes = 60.0;
    let (done, messages) = resume_with(cut, FAKE).unwrap();
    assert!(
        messages
            .iter()
            .all(|message| !message.starts_with("picture"))
    );
    assert!(done.is_whole());
    assert_same(&done, &whole());
    assert_eq!(done.sessions.len(), 2);
    let elapsed_s = |session: &RunSession| session.elapsed_s;
    let sum: f64 = done.sessions.iter().map(elapsed_s).sum();
    assert_eq!(done.elapsed_s(), sum);
}

#[test]
fn resume_completes_a_run_stopped_in_any_part() {
    let plan = plan(&METHODS);
    for stop_at in [
        "picture of figure 5.3",
        "coverage: tessellation against oracle",
        "pixels inside the grid: tessellation on D1",
        "changes: grid on D2",
        "most paths: grid on D2, trying 1000",
        "growth: tessellation on D2 with 50 paths",
    ] {
        let stopped = run(&plan, stop_at);
        assert!(stopped.is_partial && !stopped.is_whole(), "{stop_at}");
        let (done, messages) = resume_with(stopped, FAKE).unwrap();
        assert_eq!(messages[0], stop_at);
        assert_same(&done, &whole());
    }
}

#[test]
fn resume_measures_only_missing_rows() {
    let left_out = |reading: &mut Reading| {
        reading.row.outcome = Outcome::NotMeasured(OUT_OF_TIME.to_owned());
    };
    let mut cut = whole();
    // The last two views of a method in the middle, and a size of another.
    cut.results.zoom[6..8].iter_mut().for_each(left_out);
    cut.results.growth[1..2].iter_mut().for_each(left_out);
    let found = &mut cut.results.most_paths[2];
    found.trials.truncate(2);
    let trials = found.trials.clone();
    (found.limit, found.paths) = (Limit::Time, None);
    found.row.outcome = Outcome::NotMeasured(OUT_OF_TIME.to_owned());
    for part in &mut cut.parts[3..] {
        part.is_cut = true;
    }

    let slower = Fake { b_ms: 0.02, ..FAKE };
    let (done, messages) = resume_with(cut.clone(), slower).unwrap();
    let wanted = |message: &&String| !message.starts_with("most paths: grid on D2");
    let messages: Vec<&String> = messages.iter().filter(wanted).collect();
    assert_eq!(
        messages,
        [
            "magnification: tessellation on D1",
            "growth: tessellation on D1 with 50 paths"
        ]
    );
    let whole = whole();
    let (before, after) = (&whole.results, &done.results);
    let pairs = |a: &[Reading], b: &[Reading]| {
        let kept = a.iter().zip(b).map(|(a, b)| place(a) == place(b));
        kept.collect::<Vec<_>>()
    };
    let zoom = pairs(&before.zoom, &after.zoom);
    let growth = pairs(&before.growth, &after.growth);
    for (i, is_kept) in zoom.into_iter().enumerate() {
        assert_eq!(is_kept, !(6..8).contains(&i), "{i}");
    }
    for (i, is_kept) in growth.into_iter().enumerate() {
        assert_eq!(is_kept, i != 1, "{i}");
    }
    let at = |readings: &[Reading]| readings.iter().map(|r| r.at).collect::<Vec<_>>();
    assert_eq!(at(&before.zoom), at(&after.zoom));
    assert_eq!(before.occupancy.len(), after.occupancy.len());
    // The search continues from its trials.
    let found = &after.most_paths[2];
    assert_eq!(found.trials[..2], trials);
    assert!(found.trials.len() > 2 && found.limit == Limit::FrameTime);
    assert!(done.is_whole());
}

#[test]
fn resume_returns_a_complete_run_unchanged() {
    let whole = whole();
    let (same, messages) = resume_with(whole.clone(), FAKE).unwrap();
    assert_eq!(same, whole);
    assert!(messages.is_empty(), "{messages:?}");
}

#[test]
fn rejects_another_device() {
    let stopped = run(&plan(&METHODS), "magnification: grid on D1");
    let other = Fake {
        device: "another device",
        ..FAKE
    };
    let error = resume_with(stopped.clone(), other).unwrap_err();
    assert!(matches!(error, ResumeError::Device { .. }));
    assert_eq!(
        error.to_string(),
        "method `grid` ran on a made-up device; on this computer it runs on another device"
    );
    // A method without a device is rejected too.
    let unavailable = |spec: &str| -> Result<Box<dyn Method>, StartError> {
        match spec {
            "grid" => Ok(Box::new(FAKE)),
            _ => Err(StartError::new("no device")),
        }
    };
    let error = resume(stopped, &unavailable, &Cancel::default(), &|_| {}).unwrap_err();
    assert_eq!(
        error.to_string(),
        "method `tessellation` ran on a made-up device; on this computer it runs on no device"
    );
}

#[test]
fn rejects_path_counts_out_of_range() {
    let damage: [fn(&mut Run); 6] = [
        |run| run.plan.view_paths[1] = 0,
        |run| run.plan.sizes.push(usize::MAX),
        |run| run.plan.search.ceiling = usize::MAX,
        |run| run.plan.search.least = 0,
        |run| run.plan.search.least = run.plan.search.ceiling + 1,
        |run| run.results.most_paths[0].trials[0].paths = usize::MAX,
    ];
    let stopped = run(&plan(&METHODS), "growth: grid on D1 with 50 paths");
    for (i, damage) in damage.iter().enumerate() {
        let mut run = stopped.clone();
        damage(&mut run);
        let error = resume_with(run, FAKE).unwrap_err();
        assert!(matches!(error, ResumeError::Damaged(_)), "{i}: {error}");
        assert!(error.to_string().contains("paths"), "{i}: {error}");
    }
    let mut run = stopped;
    run.plan.size_px = [0, 0];
    assert!(matches!(
        resume_with(run, FAKE),
        Err(ResumeError::Render(_))
    ));
}

#[test]
fn contradictory_trials_end_the_search() {
    let mut cut = whole();
    let found = &mut cut.results.most_paths[0];
    found.limit = Limit::Time;
    // Beyond the target with fewer paths than within it.
    found.trials[0].paths = 3;
    found.trials[0].frame_ms = Some(1e9);
    found.trials.rotate_left(1);
    let most_paths = |part: &&mut PartFacts| part.name.starts_with("most paths");
    cut.parts.iter_mut().find(most_paths).unwrap().is_cut = true;
    let (done, _) = resume_with(cut, FAKE).unwrap();
    assert_eq!(done.results.most_paths[0].limit, Limit::FrameTime);
}

#[test]
fn the_page_lists_all_sessions() {
    let page = |run: &Run| {
        let mut files = files(run).into_iter();
        files.find(|file| file.name == PAGE).unwrap().text
    };
    let mut run = whole();
    assert!(!page(&run).contains("sessions"));
    run.sessions.push(run.sessions[0].clone());
    let same = page(&run);
    assert!(same.contains(", in 2 sessions of ") && same.contains("The run took 2 sessions"));
    assert!(!same.contains("different processors"));
    run.sessions[1].machine.cpu = Some("Another <CPU>".to_owned());
    let other = page(&run);
    assert!(other.contains("different processors") && other.contains("Another &lt;CPU&gt;"));
}
