//! `--limit NAME=VALUE` and `--formats A,B`: what the command accepts from files.

use std::sync::OnceLock;

use guideway::formats::{Format, Progress, ReadOptions};
use guideway::layout::Limits;

use super::values;

/// Limits and formats of this run, set once from the arguments.
static ACCEPTED: OnceLock<Accepted> = OnceLock::new();

#[derive(Default)]
struct Accepted {
    settings: Vec<Setting>,
    limits: Limits,
    formats: Option<Vec<Format>>,
}

/// A value of `--limit`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting {
    limit: &'static Limit,
    value: u64,
}

/// A limit that can be set.
#[derive(Debug)]
struct Limit {
    name: &'static str,
    /// Largest value: what the tables of a layout can count, or the stack of the readers can hold.
    max: u64,
    set: fn(&mut Limits, u64),
}

/// `usize::MAX` where a table is counted by it.
const SIZES: u64 = 1 << 40;

const LIMITS: [Limit; 9] = [
    Limit::new("file-bytes", SIZES, |limits, n| {
        limits.file_bytes = n;
    }),
    Limit::new("output-bytes", u64::MAX, |limits, n| {
        limits.output_bytes = n;
    }),
    Limit::new("paths", u32::MAX as u64, |limits, n| {
        limits.paths = n;
    }),
    Limit::new("control-points", u32::MAX as u64, |limits, n| {
        limits.control_points = n;
    }),
    Limit::new("curve-points", SIZES, |limits, n| {
        limits.curve_points = n as usize;
    }),
    Limit::new("elements", SIZES, |limits, n| {
        limits.elements = n;
    }),
    Limit::new("text-bytes", u32::MAX as u64, |limits, n| {
        limits.text_bytes = n as usize;
    }),
    Limit::new("depth", 256, |limits, n| {
        limits.depth = n as usize;
    }),
    Limit::new("coordinate", 1_000_000_000_000, |limits, n| {
        limits.coordinate_m = n as f64;
    }),
];

impl Limit {
    const fn new(name: &'static str, max: u64, set: fn(&mut Limits, u64)) -> Self {
        Self { name, max, set }
    }
}

/// Parses `NAME=VALUE`.
pub(crate) fn setting(text: &str) -> Result<Setting, String> {
    let names = || LIMITS.map(|limit| limit.name).join(", ");
    let (name, value) = text
        .split_once('=')
        .ok_or_else(|| format!("write NAME=VALUE; the names are {}", names()))?;
    let limit = LIMITS.iter().find(|limit| limit.name == name);
    let limit = limit.ok_or_else(|| format!("the names are {}", names()))?;
    match values::count(value) {
        Some(value) if (1..=limit.max).contains(&value) => Ok(Setting { limit, value }),
        _ => Err(format!(
            "write a whole number from 1 to {}, such as {name}=100",
            limit.max
        )),
    }
}

/// Parses the name of a format.
pub(crate) fn format(text: &str) -> Result<Format, String> {
    let found = Format::ALL.iter().find(|format| id(**format) == text);
    found.copied().ok_or_else(|| {
        let ids: Vec<String> = Format::ALL.iter().map(|format| id(*format)).collect();
        format!("the formats are {}", ids.join(", "))
    })
}

/// The name of a format in arguments: `vda5050`.
fn id(format: Format) -> String {
    format.name().to_lowercase().replace([' ', '-'], "")
}

/// Sets limits and formats of this run.
pub(crate) fn set(settings: &[Setting], formats: &[Format]) {
    let limits = with(Limits::default(), settings);
    let settings = settings.to_vec();
    let formats = (!formats.is_empty()).then(|| formats.to_vec());
    // Set before anything is read; a second call would change nothing.
    let _ = ACCEPTED.set(Accepted {
        settings,
        limits,
        formats,
    });
}

fn accepted() -> &'static Accepted {
    ACCEPTED.get_or_init(Accepted::default)
}

/// The limits of this run.
pub(crate) fn limits() -> &'static Limits {
    &accepted().limits
}

/// Some limits, changed by settings.
fn with(mut limits: Limits, settings: &[Setting]) -> Limits {
    for setting in settings {
        (setting.limit.set)(&mut limits, setting.value);
    }
    limits
}

/// The limits of files with settings of their own; those of the arguments override them.
pub(crate) fn limits_over(settings: &[Setting]) -> Limits {
    let limits = with(Limits::default(), settings);
    with(limits, &accepted().settings)
}

/// The options of every read of this run.
pub fn read_options(progress: Option<&dyn Progress>) -> ReadOptions<'_> {
    read_options_within(limits().clone(), progress)
}

/// The options of a read with limits of its own.
pub(crate) fn read_options_within(
    limits: Limits,
    progress: Option<&dyn Progress>,
) -> ReadOptions<'_> {
    ReadOptions {
        limits,
        formats: accepted().formats.as_deref(),
        progress,
        area: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parses_limits_and_formats_by_name() {
        let mut limits = Limits::default();
        for text in ["paths=1_000", "depth=256", "coordinate=5"] {
            let Setting { limit, value } = setting(text).unwrap();
            (limit.set)(&mut limits, value);
        }
        assert_eq!((limits.paths, limits.depth), (1000, 256));
        assert!((limits.coordinate_m - 5.0).abs() < 1e-9);
        for bad in ["paths", "size=3", "paths=0", "depth=257", "paths=x"] {
            assert!(setting(bad).is_err(), "{bad}");
        }
        assert_eq!(format("vda5050"), Ok(Format::Vda5050));
        assert_eq!(format("openrmf"), Ok(Format::Rmf));
        assert!(format("pdf").unwrap_err().contains("geojson"));
    }

    #[test]
    fn errors_of_limits_name_an_option() {
        for what in guideway::formats::LIMIT_OPTIONS {
            assert!(LIMITS.iter().any(|limit| limit.name == what.1), "{what:?}");
        }
    }
}
