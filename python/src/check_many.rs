//! [`check_many`]: findings of many files as one table, for the workers of an engine.

use std::path::{Path, PathBuf};

use arrow_array::{StringArray, UInt32Array};
use guideway::formats::Progress;
use guideway::layout::{Diagnostic, Severity, UserError};
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::answers::severity;
use crate::error::bad_argument;
use crate::items::items;
use crate::signals::Watch;
use crate::tables::{Columns, Table};

/// Files between two looks at signals.
const CHUNK: usize = 64;

/// A row of the table.
struct Row {
    path: usize,
    code: String,
    severity: Severity,
    element: String,
    line: Option<u32>,
    column: Option<u32>,
    message: String,
    remedy: String,
}

/// The findings of many files, on all cores: a table with the columns `path`, `code`, `severity`,
/// `element`, `line`, `column`, `message` and `remedy`, in the order of the paths.
///
/// A file that cannot be read is an error in the table, and the others are checked. `at_least` is
/// the least severity, `"info"`, `"warning"` or `"error"`; `progress` is called with the finished
/// share, from 0 to 1.
#[pyfunction]
#[pyo3(signature = (paths, *, at_least = "info", progress = None))]
pub(crate) fn check_many(
    py: Python<'_>,
    paths: &Bound<'_, PyAny>,
    at_least: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<Table> {
    let at_least = severity(at_least)?;
    let paths = items(paths).and_then(|paths| {
        let paths = paths.into_iter();
        paths
            .map(|path| path.extract::<PathBuf>())
            .collect::<PyResult<Vec<_>>>()
    });
    let paths = paths.map_err(|error| {
        let message = format!("paths is no list of paths: {error}");
        bad_argument(
            message,
            "Give a list such as [\"a.lif.json\", \"b.lif.json\"]",
        )
    })?;
    let watch = Watch::new(progress);
    let rows = py.detach(|| {
        let mut rows = Vec::new();
        for (first, chunk) in (0..).step_by(CHUNK).zip(paths.chunks(CHUNK)) {
            if watch.cancelled() {
                break;
            }
            let checked = (first..).zip(chunk).collect::<Vec<_>>().into_par_iter();
            let checked: Vec<_> = checked
                .map(|(number, path)| check(number, path, at_least))
                .collect();
            rows.extend(checked.into_iter().flatten());
            watch.advance((first + chunk.len()) as u64, paths.len() as u64);
        }
        rows
    });
    let rows = watch.result(Ok(rows))?;
    table(&paths, &rows)
}

fn check(number: usize, path: &Path, at_least: Severity) -> Vec<Row> {
    let layout = match guideway::open(path) {
        Ok(layout) => layout,
        Err(error) => {
            let place = error.problem.place();
            let problem = error.problem.to_string();
            let UserError { code, remedy, .. } = error.into();
            return vec![Row {
                path: number,
                code: code.to_owned(),
                severity: Severity::Error,
                element: place.element,
                line: place.line,
                column: place.column,
                message: problem,
                remedy,
            }];
        }
    };
    let found = guideway::check(&layout);
    let found = found.iter().filter(|finding| finding.severity >= at_least);
    let row = |finding: &Diagnostic| Row {
        path: number,
        code: finding.code.name().to_owned(),
        severity: finding.severity,
        element: finding.place.element.clone(),
        line: finding.place.line,
        column: finding.place.column,
        message: finding.message.clone(),
        remedy: finding.remedy.clone(),
    };
    found.map(row).collect()
}

fn table(paths: &[PathBuf], rows: &[Row]) -> PyResult<Table> {
    fn texts<'a>(rows: &'a [Row], of: impl Fn(&'a Row) -> &'a str) -> StringArray {
        StringArray::from_iter_values(rows.iter().map(of))
    }
    let mut columns = Columns::default();
    let names = rows.iter().map(|row| paths[row.path].to_string_lossy());
    columns.push("path", StringArray::from_iter_values(names));
    columns.push("code", texts(rows, |row| &row.code));
    let severities = rows.iter().map(|row| row.severity.to_string());
    columns.push("severity", StringArray::from_iter_values(severities));
    columns.push("element", texts(rows, |row| &row.element));
    let lines = rows.iter().map(|row| row.line);
    columns.push("line", lines.collect::<UInt32Array>());
    let characters = rows.iter().map(|row| row.column);
    columns.push("column", characters.collect::<UInt32Array>());
    columns.push("message", texts(rows, |row| &row.message));
    columns.push("remedy", texts(rows, |row| &row.remedy));
    columns.table()
}
