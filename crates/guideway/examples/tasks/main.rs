//! A worked example per task, each in a file of its own. Runs those that are named, or all:
//!
//!     cargo run --example tasks -- check route

mod check;
mod convert;
mod edit;
mod network;
mod open;
mod render;
mod route;

use std::error::Error;
use std::path::Path;

/// The example site.
const SITE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/site.lif.json");

/// Reads the site, leaves files in a folder, and returns what it has to say.
type Task = fn(site: &Path, folder: &Path) -> Result<String, Box<dyn Error>>;

const TASKS: [(&str, Task); 7] = [
    ("open", open::run),
    ("check", check::run),
    ("render", render::run),
    ("edit", edit::run),
    ("convert", convert::run),
    ("network", network::run),
    ("route", route::run),
];

fn main() -> Result<(), Box<dyn Error>> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    let folder = std::env::temp_dir();
    for (name, said) in run_all(&names, &folder)? {
        println!("{name}: {said}");
    }
    println!("The files are in {}.", folder.display());
    Ok(())
}

/// Runs the tasks of these names, or all without any; returns each name with what the task says.
///
/// # Errors
/// When a task fails.
pub(crate) fn run_all(
    names: &[String],
    folder: &Path,
) -> Result<Vec<(&'static str, String)>, Box<dyn Error>> {
    let is_asked = |name: &str| names.is_empty() || names.iter().any(|asked| asked == name);
    let tasks = TASKS.iter().filter(|(name, _)| is_asked(name));
    tasks
        .map(|(name, run)| Ok((*name, run(Path::new(SITE), folder)?)))
        .collect()
}
