//! The law itself: writes a layout, reads it back, and holds the differences against the losses.

use guideway_formats::arrow::{RecordBatchIterator, RecordBatchReader, batches, read_batches};
use guideway_formats::{Losses, ReadOptions, Target, WriteProblem, read_file};
use guideway_layout::{CompareOptions, Layout, differences};

/// A difference that no loss lists, or a loss without a difference.
pub(crate) struct Breach {
    pub(crate) target: Target,
    pub(crate) layout: String,
    pub(crate) message: String,
}

impl Breach {
    /// The message up to the example.
    pub(crate) fn kind(&self) -> &str {
        self.message.split(':').next().unwrap_or_default()
    }
}

/// Differences that follow from a loss of another name.
const IMPLIED: [(&str, &str); 3] = [
    ("ends", "nodes"),
    ("ends", "stations"),
    ("ends", "directions"),
];

/// Largest deviation of curves and positions that a target may have without listing it, in meters.
fn tolerance_m(target: Target) -> f64 {
    match target {
        // Coordinates in `f32` where that suffices.
        Target::Arrow => 1e-5,
        // Lines within the default tolerance of the writer, twice: of the line from the curve, and
        // of samples.
        Target::GeoJson => 2.1e-3,
        _ => 1e-5,
    }
}

/// Returns all breaches of the law by one conversion.
pub(crate) fn breaches(name: &str, layout: &Layout, target: Target) -> Vec<Breach> {
    let breach = |message: String| Breach {
        target,
        layout: name.to_owned(),
        message,
    };
    let (losses, again) = match converted(layout, target) {
        Ok(Some(converted)) => converted,
        Ok(None) => return Vec::new(),
        Err(message) => return vec![breach(message)],
    };
    let listed: Vec<String> = losses.iter().map(|loss| loss.what.clone()).collect();
    let found = compare(layout, &again, &listed, tolerance_m(target));
    found.into_iter().map(breach).collect()
}

/// Returns all breaches by record batches in memory, which lose nothing. Every batch comes in two
/// slices.
pub(crate) fn breaches_in_memory(name: &str, layout: &Layout) -> Vec<Breach> {
    let again = || -> Result<Layout, Box<dyn std::error::Error>> {
        let whole = batches(layout)?;
        let schema = whole.schema();
        let slices = whole.flat_map(|batch| match batch {
            Ok(batch) => {
                let (rows, middle) = (batch.num_rows(), batch.num_rows() / 2);
                vec![
                    Ok(batch.slice(0, middle)),
                    Ok(batch.slice(middle, rows - middle)),
                ]
            }
            error => vec![error],
        });
        let slices = RecordBatchIterator::new(slices, schema);
        Ok(read_batches(slices, &ReadOptions::default())?)
    };
    let found = match again() {
        Ok(again) => compare(layout, &again, &[], 0.0),
        Err(error) => vec![error.to_string()],
    };
    let breach = |message| Breach {
        target: Target::Arrow,
        layout: name.to_owned(),
        message: format!("in memory, {message}"),
    };
    found.into_iter().map(breach).collect()
}

/// Writes a layout and reads it back, with its losses; `None` if it is no route, which the target
/// needs.
pub(crate) fn converted(
    layout: &Layout,
    target: Target,
) -> Result<Option<(Losses, Layout)>, String> {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let extension = target.extensions().first().unwrap_or(&".lif.json");
    let file = folder.path().join(format!("layout{extension}"));
    let losses = match target.write_file(layout, &file) {
        Ok(losses) => losses,
        // A refusal that names the reason: nothing was written.
        Err(error) if matches!(error.problem, WriteProblem::NotARoute { .. }) => return Ok(None),
        Err(error) => return Err(format!("cannot be written: {error}")),
    };
    let again = read_file(&file, &ReadOptions::default());
    let again = again.map_err(|error| format!("cannot be read back: {error}"))?;
    Ok(Some((losses, again)))
}

/// Returns the differences of two layouts that are not listed, and the listed ones that are none.
pub(crate) fn compare(a: &Layout, b: &Layout, listed: &[String], tolerance_m: f64) -> Vec<String> {
    let options = CompareOptions {
        tolerance_m,
        relative_tolerance: 1e-9,
    };
    let found = differences(a, b, &options);
    let is_listed = |what: &str| listed.iter().any(|listed| listed == what);
    let is_implied = |what: &str| {
        let mut causes = IMPLIED.iter().filter(|(effect, _)| *effect == what);
        causes.any(|(_, cause)| is_listed(cause))
    };
    // An addition, such as a node that the format requires, is no loss.
    let lost = found.iter().filter(|d| !d.what.starts_with("new "));
    let unlisted = lost.filter(|d| !is_listed(&d.what) && !is_implied(&d.what));
    let unlisted =
        unlisted.map(|d| format!("{} not listed: {} times, {}", d.what, d.count, d.example));
    let is_found = |what: &String| {
        let mut kinds = found.iter().map(|d| d.what.trim_start_matches("new "));
        kinds.any(|kind| kind == *what)
    };
    // A lost element takes its values with it: they are rightly listed, but compared no more.
    let is_lost = ["paths", "nodes", "stations"].map(str::to_owned);
    let loses_elements = is_lost.iter().any(&is_found);
    // Lost vehicle types take the values of their entries with them.
    let loses_types = is_found(&"vehicle types".to_owned());
    let is_idle = |what: &&String| {
        let is_of_type = loses_types && what.starts_with("column ");
        !loses_elements && !is_of_type && !is_found(what)
    };
    let idle = listed.iter().filter(is_idle);
    let idle = idle.map(|what| format!("{what} listed without a difference"));
    unlisted.chain(idle).collect()
}
