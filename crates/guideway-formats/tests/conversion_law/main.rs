//! Law of conversion: what a written file does not hold is in the list of losses, and every loss in
//! the list is a difference. Held over real files and random layouts, for every target.

mod law;
mod random_layout;

use std::ops::Range;
use std::path::{Path, PathBuf};

use guideway_formats::{ReadOptions, Target, read_file};
use guideway_layout::{Direction, Layout, Level, PathRef};
use guideway_spline::Point;
use rayon::prelude::*;

use law::{Breach, breaches, breaches_in_memory};
use random_layout::random_layout;

/// Folders of real files beside the repository. Their licenses keep them out of it.
const REAL: [&str; 3] = ["layouts", "cases", "conformance/real"];

/// A folder of attacks on readers: they are written to exceed limits, not to be converted.
const ATTACKS: &str = "hostile";

/// Paths above which a real file is left out: the comparison of curves would take minutes.
const MAX_PATHS: usize = 20_000;

/// Environment variable with the seeds of random layouts: a number of them, or `FIRST..END`.
const SEEDS_VARIABLE: &str = "GUIDEWAY_RANDOM_LAYOUTS";

#[test]
fn real_files_lose_what_is_listed() {
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared");
    let mut files = Vec::new();
    for folder in REAL.map(|folder| shared.join(folder)) {
        if folder.is_dir() {
            collect(&folder, &mut files);
        } else {
            println!("SKIPPED: the real files are not at {}", folder.display());
        }
    }
    let read = |file: &PathBuf| {
        let layout = read_file(file, &ReadOptions::default()).ok()?;
        let name = file.strip_prefix(&shared).unwrap_or(file).display();
        (layout.paths.len() <= MAX_PATHS).then(|| (name.to_string(), layout))
    };
    let found = files
        .par_iter()
        .filter_map(read)
        .flat_map_iter(|(name, layout)| {
            let targets = Target::ALL.iter();
            let mut found: Vec<Breach> = targets
                .flat_map(|&target| breaches(&name, &layout, target))
                .collect();
            found.extend(breaches_in_memory(&name, &layout));
            found
        });
    assert_none(found.collect());
}

#[test]
fn random_layouts_lose_what_is_listed() {
    let found = seeds(200).into_par_iter().flat_map_iter(|seed: u64| {
        let layout = random_layout(seed);
        let name = format!("random layout {seed}");
        let targets = Target::ALL.iter();
        let mut found: Vec<Breach> = targets
            .flat_map(|&target| breaches(&name, &layout, target))
            .collect();
        found.extend(breaches_in_memory(&name, &layout));
        found
    });
    assert_none(found.collect());
}

/// A layout that a reader of each format made has more, and elsewhere, than one from memory.
#[test]
fn random_files_of_every_format_lose_what_is_listed() {
    let found = seeds(120).into_par_iter().flat_map_iter(|seed: u64| {
        let source = Target::ALL[seed as usize % Target::ALL.len()];
        let converted = law::converted(&random_layout(seed), source);
        let name = format!("random {} file {seed}", source.id());
        let found = match converted {
            Ok(Some((_, layout))) => Target::ALL
                .iter()
                .flat_map(|&target| breaches(&name, &layout, target))
                .collect(),
            // The other laws say so.
            Ok(None) | Err(_) => Vec::new(),
        };
        found.into_iter()
    });
    assert_none(found.collect());
}

/// A saved file has the levels and vehicle types of the layout, not those that it had before.
#[test]
fn random_files_with_other_levels_and_types_lose_what_is_listed() {
    let found = seeds(120).into_par_iter().flat_map_iter(|seed: u64| {
        let source = Target::ALL[seed as usize % Target::ALL.len()];
        let converted = law::converted(&random_layout(seed), source);
        let name = format!("random {} file {seed} with other levels", source.id());
        let found = match converted {
            Ok(Some((_, mut layout))) => {
                change_groups(&mut layout, seed);
                let targets = Target::ALL.iter();
                targets
                    .flat_map(|&target| breaches(&name, &layout, target))
                    .collect()
            }
            Ok(None) | Err(_) => Vec::new(),
        };
        found.into_iter()
    });
    assert_none(found.collect());
}

/// Adds, renames and removes levels and vehicle types.
fn change_groups(layout: &mut Layout, seed: u64) {
    let new = |id: &str| Level {
        id: id.into(),
        ..Level::default()
    };
    if seed.is_multiple_of(2) {
        let row = layout.levels.len() as u32;
        layout.insert_level(row, new("new level"));
        for node in (0..layout.nodes.len() as u32).step_by(3) {
            layout.nodes.set_level(node, Some(row));
        }
    }
    if let Some(level) = layout.levels.first_mut().filter(|_| seed.is_multiple_of(3)) {
        level.id = "renamed level".into();
    }
    if seed.is_multiple_of(5) && layout.levels.len() > 1 {
        for path in 0..layout.paths.len() {
            if layout.paths.get(path).level() == Some(0) {
                layout.paths.set_level(path, Some(1));
            }
        }
        for row in 0..layout.nodes.len() as u32 {
            if layout.nodes.level(row) == Some(0) {
                layout.nodes.set_level(row, Some(1));
            }
        }
        for row in 0..layout.stations.len() as u32 {
            if layout.stations.level(row) == Some(0) {
                layout.stations.set_level(row, Some(1));
            }
        }
        for zone in layout.zones.iter_mut().filter(|zone| zone.level == Some(0)) {
            zone.level = Some(1);
        }
        layout.remove_level(0);
    }
    let first = layout
        .vehicle_type_names()
        .first()
        .map(|&name| name.to_owned());
    if let Some(name) = first.filter(|_| seed.is_multiple_of(2)) {
        let new = "renamed type";
        layout.paths.vehicle_types_mut().rename(&name, new);
        layout.nodes.vehicle_types_mut().rename(&name, new);
        for of_name in layout.vehicle_types.iter_mut().filter(|t| t.id == name) {
            new.clone_into(&mut of_name.id);
        }
    }
}

/// An order holds one route, which random layouts rarely are: a single path is one.
#[test]
fn random_routes_lose_what_is_listed() {
    let found = seeds(400).into_par_iter().flat_map_iter(|seed: u64| {
        let mut layout = random_layout(seed);
        let has_node = |path: &PathRef<'_>| path.start_node().or(path.end_node()).is_some();
        let row = layout.paths.iter().find(has_node).map(|path| path.row());
        let targets: &[Target] = match row {
            Some(row) => {
                layout.retain_paths(&[row]);
                &[Target::Vda2, Target::Vda3]
            }
            None => &[],
        };
        let name = format!("random route {seed}");
        let found = targets
            .iter()
            .map(|&target| breaches(&name, &layout, target));
        found.flatten().collect::<Vec<_>>()
    });
    assert_none(found.collect());
}

/// The law must notice a difference that is not listed, and a loss that is none.
#[test]
fn the_law_can_fail() {
    let mut layouts = (0..).map(random_layout);
    let before = layouts.find(|layout| !layout.nodes.is_empty());
    let before = before.expect("a random layout with nodes");
    let mut after = before.clone();
    after.nodes.set_position_m(0, Point::new(1e4, 0.0));
    let unlisted = law::compare(&before, &after, &[], 1e-6);
    assert_eq!(unlisted.len(), 1, "{unlisted:?}");
    assert!(
        unlisted[0].starts_with("positions not listed"),
        "{unlisted:?}"
    );
    let listed = ["positions".to_owned()];
    assert!(law::compare(&before, &after, &listed, 1e-6).is_empty());
    let idle = law::compare(&before, &before.clone(), &listed, 1e-6);
    assert_eq!(idle, ["positions listed without a difference"]);
    assert!(law::compare(&before, &before.clone(), &[], 1e-6).is_empty());
}

/// Random layouts must have the features that the law is about.
#[test]
fn random_layouts_have_all_features() {
    let layouts: Vec<Layout> = (0..50).map(random_layout).collect();
    type Feature = fn(&Layout) -> bool;
    let features: [(&str, Feature); 9] = [
        ("two-way paths", |l| {
            l.paths.iter().any(|p| p.direction() == Direction::Both)
        }),
        ("vehicle types", |l| {
            !l.paths.vehicle_types().names().is_empty()
        }),
        ("values per type", |l| {
            !l.paths.vehicle_types().attributes.is_empty()
        }),
        ("stations", |l| !l.stations.is_empty()),
        ("levels", |l| l.levels.len() > 1),
        ("blocks", |l| !l.blocks.is_empty()),
        ("zones", |l| !l.zones.is_empty()),
        ("written curves", |l| !l.paths.written_curves().is_empty()),
        ("JSON", |l| l.paths.column("actions").is_some()),
    ];
    for (name, has) in features {
        assert!(layouts.iter().any(has), "no random layout has {name}");
    }
}

/// Returns the seeds of the environment variable, or else the first `count`.
fn seeds(count: u64) -> Range<u64> {
    let number = |text: &str| -> u64 { text.parse().expect("a number of layouts") };
    match std::env::var(SEEDS_VARIABLE) {
        Ok(seeds) => match seeds.split_once("..") {
            Some((first, end)) => number(first)..number(end),
            None => 0..number(&seeds),
        },
        Err(_) => 0..count,
    }
}

/// Panics with the breaches, one line for each kind of breach of each target.
fn assert_none(found: Vec<Breach>) {
    let mut kinds: Vec<(String, usize, &Breach)> = Vec::new();
    for breach in &found {
        let kind = format!("{} {}", breach.target.name(), breach.kind());
        match kinds.iter_mut().find(|(known, ..)| *known == kind) {
            Some((_, count, _)) => *count += 1,
            None => kinds.push((kind, 1, breach)),
        }
    }
    kinds.sort_by(|a, b| a.0.cmp(&b.0));
    let line = |(kind, count, first): &(String, usize, &Breach)| {
        format!(
            "{kind}: {count} layouts, first {}: {}",
            first.layout, first.message
        )
    };
    let lines: Vec<String> = kinds.iter().map(line).collect();
    assert!(
        lines.is_empty(),
        "{} kinds of breaches:\n{}",
        lines.len(),
        lines.join("\n")
    );
}

/// Collects all files of a folder and its subfolders.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let entries = std::fs::read_dir(folder).expect("a readable folder");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    for path in paths {
        match path.is_dir() {
            true if path.ends_with(ATTACKS) => {}
            true => collect(&path, files),
            false => files.push(path),
        }
    }
}
