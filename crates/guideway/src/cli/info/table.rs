//! The `info` report as text.

use guideway::layout::{Quantity, shown_text};

use super::columns::{Column, FrequentValue};
use super::summary::{Kind, Summary};
use crate::cli::text::{bytes, count, counted, meters, number, single_line, time};

/// Most characters of a name or value.
const MAX_CHARS: usize = 40;
/// Most files that are named.
const MAX_FILES: usize = 20;

/// The summary as lines of text.
pub(super) fn text(of: &Summary) -> String {
    let mut lines = Lines::default();
    lines.files(of);
    lines.put(
        "format",
        format!("{} {}", of.format, of.format_version).trim_end(),
    );
    lines.kinds("refused", &of.refused);
    lines.kinds("findings", &of.findings);
    lines.put("site", &bounds(of));
    lines.put("paths", &paths(of));
    lines.put("length", &length(of));
    lines.put("nodes", &count(of.nodes));
    lines.put("stations", &stations(of));
    let levels = of.levels.iter().map(|level| {
        let name = single_line(level.name.as_deref().unwrap_or(&level.id), MAX_CHARS);
        let height = level
            .elevation_m
            .map_or_else(String::new, |m| format!(" at {}", meters(m)));
        format!("{name}{height} ({})", counted(level.paths, "path"))
    });
    lines.put("levels", &join(levels));
    lines.put("vehicles", &frequent_values(&of.vehicle_types));
    lines.put("speeds", &speeds(of));
    lines.put(
        "curves",
        &format!(
            "{}, {}",
            counted(of.segments, "segment"),
            counted(of.control_points, "control point")
        ),
    );
    let parts = of.source_counts.iter();
    lines.put(
        "in the file",
        &join(parts.map(|part| match part.name.strip_suffix('s') {
            Some(one) => counted(part.count, one),
            None => format!("{} {}", count(part.count), part.name),
        })),
    );
    lines.put("memory", &bytes(of.memory_bytes));
    lines.columns("paths", &of.attributes.paths);
    lines.columns("nodes", &of.attributes.nodes);
    lines.columns("stations", &of.attributes.stations);
    let times = &of.ms;
    lines.0
        + &format!(
            "took {}: reading {}, measuring {}\n",
            time(times.total),
            time(times.read),
            time(times.measure)
        )
}

#[derive(Default)]
struct Lines(String);

impl Lines {
    /// Adds a line; an empty value adds none.
    fn put(&mut self, name: &str, value: &str) {
        if !value.is_empty() {
            self.0 += &format!("{name:<12}{value}\n");
        }
    }

    /// The file with its size, or each of several on a line of its own.
    fn files(&mut self, of: &Summary) {
        let name = |name: &String| shown_text(name).into_owned();
        let size = of.file_bytes.map(bytes);
        match &of.files[..] {
            [one] => {
                let size = size.map_or_else(String::new, |size| format!(" ({size})"));
                self.put("file", &(name(one) + &size));
            }
            several => {
                let size = size.map_or_else(String::new, |size| format!(", together {size}"));
                self.put("files", &(count(several.len() as u64) + &size));
                for file in several.iter().take(MAX_FILES) {
                    self.0 += &format!("  {}\n", name(file));
                }
                if let Some(more) = several.len().checked_sub(MAX_FILES + 1) {
                    self.0 += &format!("  and {} more\n", count(more as u64 + 1));
                }
            }
        }
    }

    fn columns(&mut self, table: &str, columns: &[Column]) {
        if columns.is_empty() {
            return;
        }
        self.0 += &format!("columns of {table}:\n");
        let names = columns
            .iter()
            .map(|column| single_line(&column.label(), MAX_CHARS));
        let width = names.clone().map(|n| n.chars().count()).max().unwrap_or(0);
        for (column, name) in columns.iter().zip(names) {
            self.0 += &format!("  {name:<width$}  {}\n", column_text(column));
        }
    }

    fn kinds(&mut self, title: &str, kinds: &[Kind]) {
        if kinds.is_empty() {
            return;
        }
        self.0 += &format!("{title}:\n");
        for kind in kinds {
            let Kind {
                code,
                severity,
                count: n,
                meaning,
            } = kind;
            self.0 += &format!("  {:>8}  {severity} {code}: {meaning}\n", count(*n));
        }
    }
}

fn paths(of: &Summary) -> String {
    let mut text = count(of.paths);
    if of.two_way_paths > 0 {
        text += &format!(", {} of them two-way", count(of.two_way_paths));
    }
    match of.refused_count() {
        0 => text,
        n => text + &format!("; {} refused", count(n)),
    }
}

/// The total length, and that of each kind if there are several.
fn length(of: &Summary) -> String {
    let kinds = of.kinds.iter().map(|kind| {
        let name = single_line(&kind.name, MAX_CHARS);
        format!(
            "{name} {} ({})",
            meters(kind.length_m),
            counted(kind.paths, "path")
        )
    });
    match of.kinds.len() {
        0 | 1 => meters(of.length_m),
        _ => format!("{}: {}", meters(of.length_m), join(kinds)),
    }
}

/// The number of stations, and of each kind if they have one.
fn stations(of: &Summary) -> String {
    let kind = of
        .attributes
        .stations
        .iter()
        .find(|column| column.name == "kind");
    match kind.filter(|kind| !kind.top.is_empty()) {
        Some(kind) => format!("{}: {}", count(of.stations), frequent_values(&kind.top)),
        None => count(of.stations),
    }
}

/// The range of each column of speeds of paths, and the commonest ones.
fn speeds(of: &Summary) -> String {
    let speeds = of.attributes.paths.iter();
    let speeds = speeds.filter(|column| column.unit == Some(Quantity::Speed.unit()));
    join(speeds.filter_map(|column| {
        let (min, max) = (number(column.min?), number(column.max?));
        let range = match min == max {
            true => min,
            false => format!("{min} to {max}"),
        };
        let mostly = column.top.first().filter(|_| column.distinct > 1);
        let mostly = mostly.map_or_else(String::new, |top| {
            format!(", mostly {} ({})", top.value, counted(top.count, "path"))
        });
        Some(format!("{} {range} m/s{mostly}", column.name))
    }))
}

fn bounds(of: &Summary) -> String {
    let Some(bounds) = &of.bounds_m else {
        return String::new();
    };
    let ([x0, y0], [x1, y1]) = (bounds.min, bounds.max);
    format!(
        "{} x {}, from ({x0:.3}, {y0:.3}) to ({x1:.3}, {y1:.3})",
        meters(x1 - x0),
        meters(y1 - y0)
    )
}

fn column_text(column: &Column) -> String {
    let mut text = format!("{}, {} distinct", column.kind, count(column.distinct));
    if let (Some(min), Some(max)) = (column.min, column.max) {
        text += &format!(", {} to {}", number(min), number(max));
    }
    if column.missing > 0 {
        text += &format!(", {} without", count(column.missing));
    }
    if column.per_type > 0 {
        text += &format!(", {} by vehicle type", count(column.per_type));
    }
    if !column.top.is_empty() {
        text += &format!(": {}", frequent_values(&column.top));
    }
    let rest = column.distinct.saturating_sub(column.top.len() as u64);
    if rest > 0 && !column.top.is_empty() {
        text += ", ...";
    }
    text
}

fn frequent_values(top: &[FrequentValue]) -> String {
    join(top.iter().map(|top| {
        format!(
            "{} ({})",
            single_line(&top.value, MAX_CHARS),
            count(top.count)
        )
    }))
}

fn join(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(", ")
}
