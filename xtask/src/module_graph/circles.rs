//! Finds the circles of a graph of files: groups in which each file reaches each other one.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use super::Arrow;

/// Files that import each other in a loop, and the arrows that tie them.
#[derive(Clone, Debug)]
pub struct Circle {
    /// The files, in order of name.
    pub files: Vec<String>,
    /// The arrows between them.
    pub arrows: Vec<Arrow>,
}

/// All circles, by name of their first file.
pub fn circles(arrows: &[Arrow]) -> Vec<Circle> {
    let mut next: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for arrow in arrows {
        next.entry(&arrow.from).or_default().push(&arrow.to);
    }
    let reached: BTreeMap<&str, BTreeSet<&str>> = next
        .keys()
        .map(|&file| (file, reach(&next, file)))
        .collect();
    let meets = |a: &str, b: &str| reached.get(a).is_some_and(|files| files.contains(b));
    let mut grouped = BTreeSet::new();
    let mut circles = Vec::new();
    for &file in next.keys() {
        if grouped.contains(file) || !meets(file, file) {
            continue;
        }
        let group: Vec<&str> = reached[file]
            .iter()
            .copied()
            .filter(|other| meets(other, file))
            .collect();
        grouped.extend(group.iter().copied());
        let inside = |arrow: &&Arrow| {
            group.contains(&arrow.from.as_str()) && group.contains(&arrow.to.as_str())
        };
        circles.push(Circle {
            arrows: arrows.iter().filter(inside).cloned().collect(),
            files: group.into_iter().map(str::to_owned).collect(),
        });
    }
    circles
}

/// The files that can be reached from one by one arrow or more.
fn reach<'a>(next: &BTreeMap<&'a str, Vec<&'a str>>, from: &str) -> BTreeSet<&'a str> {
    let mut found = BTreeSet::new();
    let mut open: Vec<&str> = next.get(from).cloned().unwrap_or_default();
    while let Some(file) = open.pop() {
        if found.insert(file) {
            open.extend(next.get(file).into_iter().flatten());
        }
    }
    found
}

impl fmt::Display for Circle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.files.join(", "))?;
        for arrow in &self.arrows {
            let names: Vec<&str> = arrow.names.iter().map(String::as_str).collect();
            writeln!(f, "  {} -> {}: {}", arrow.from, arrow.to, names.join(", "))?;
        }
        Ok(())
    }
}
