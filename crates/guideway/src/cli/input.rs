//! Input files: parses `FILE@placement`, reads layouts and merges them; paths relative to a folder.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, ErrorKind, IsTerminal};
use std::path::{Component, Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser};
use guideway::SaveError;
use guideway::formats::{ReadError, ReadOptions, is_same_file, read_file, read_stream};
use guideway::layout::{Layout, Limits, UserError, merge, near_names, shown_path};
use guideway::spline::{Affine, Bounds, Point};

use super::error::{same_file_error, usage_error};
use super::output::{Output, is_stdout};
use super::{limits, values};

/// Help on placements, for every command that reads several files.
pub(crate) const PLACEMENT_HELP: &str = "Several files are merged into one layout. Each can be \
    scaled about the origin, then rotated counter-clockwise in degrees, then moved in meters:\n  \
    FILE@scale=0.001,rotate=90,offset=12.5,-3";

/// A file and its placement.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Input {
    pub(crate) path: PathBuf,
    pub(crate) scale: Option<f64>,
    pub(crate) rotate_deg: Option<f64>,
    pub(crate) offset_m: Option<Point<f64>>,
    /// Pixels per meter, for an image.
    pub(crate) px_per_m: Option<f64>,
    /// Page from 1, for a PDF.
    pub(crate) page: Option<u32>,
}

impl Input {
    /// The parser of an argument `FILE@key=value,key=value`.
    pub(crate) fn parser() -> impl TypedValueParser<Value = Self> {
        OsStringValueParser::new().try_map(Self::parse)
    }

    pub(crate) fn parse(argument: OsString) -> Result<Self, String> {
        let whole = Self {
            path: PathBuf::from(&argument),
            ..Self::default()
        };
        let Some((path, keys)) = argument.to_str().and_then(|text| text.rsplit_once('@')) else {
            return Ok(whole);
        };
        // The name of an existing file may contain `@` and `=`.
        if !keys.contains('=') || whole.path.exists() {
            return Ok(whole);
        }
        let mut input = Self {
            path: PathBuf::from(path),
            ..Self::default()
        };
        for (key, value) in pairs(keys) {
            input.set(key, &value).map_err(|e| format!("{key}: {e}"))?;
        }
        Ok(input)
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match key {
            "scale" => self.scale = Some(values::factor(value)?),
            "rotate" => self.rotate_deg = Some(values::degrees(value)?),
            "offset" => self.offset_m = Some(values::point(value)?),
            "px-per-m" => self.px_per_m = Some(values::factor(value)?),
            "page" => self.page = Some(values::page(value)?),
            _ => {
                let near = near_names(key, ["scale", "rotate", "offset", "px-per-m", "page"]);
                let near = near.first().map(|near| format!("did you mean `{near}`? "));
                return Err(format!(
                    "{}the keys are scale, rotate and offset; px-per-m for images, page for PDF",
                    near.unwrap_or_default()
                ));
            }
        }
        Ok(())
    }

    /// Rejects a key that applies only to images.
    pub(crate) fn check_keys(&self) -> Result<(), UserError> {
        let key = match (self.px_per_m, self.page) {
            (None, None) => return Ok(()),
            (Some(_), _) => "px-per-m",
            (None, Some(_)) => "page",
        };
        Err(usage_error(
            format!(
                "{}: `{key}` applies only to images and pages of PDF",
                shown_path(&self.path)
            ),
            "Use `scale` for a layout, such as `plan.dxf@scale=0.001`",
        ))
    }

    /// Returns `true` if it has a placement.
    pub(crate) fn is_placed(&self) -> bool {
        self.transform().is_some()
    }

    /// The transform of the placement; `None` without one.
    fn transform(&self) -> Option<Affine> {
        let Self {
            scale,
            rotate_deg,
            offset_m,
            ..
        } = *self;
        if scale.is_none() && rotate_deg.is_none() && offset_m.is_none() {
            return None;
        }
        let (origin, scale) = (Point::default(), scale.unwrap_or(1.0));
        let angle_rad = rotate_deg.unwrap_or(0.0).to_radians();
        let rotated = Affine::scale(scale, scale, origin).then(Affine::rotation(angle_rad, origin));
        Some(rotated.then(Affine::translation(offset_m.unwrap_or_default())))
    }
}

/// Splits keys and values; a value may contain commas.
fn pairs(keys: &str) -> Vec<(&str, String)> {
    let mut pairs: Vec<(&str, String)> = Vec::new();
    for part in keys.split(',') {
        match (part.split_once('='), pairs.last_mut()) {
            (Some((key, value)), _) => pairs.push((key.trim(), value.to_owned())),
            (None, Some((_, value))) => *value += &format!(",{part}"),
            (None, None) => pairs.push((part, String::new())),
        }
    }
    pairs
}

/// Reads a layout and shows the progress. Returns it and the duration in milliseconds.
pub(crate) fn read(path: &Path, out: &Output) -> Result<(Layout, f64), UserError> {
    read_within(path, None, out)
}

/// As [`read`], the paths in an area only where the file allows that; see [`ReadOptions::area`].
pub(crate) fn read_area(
    input: &Input,
    area: Option<Bounds<f64>>,
    out: &Output,
) -> Result<(Layout, f64), UserError> {
    input.check_keys()?;
    read_within(&input.path, area, out)
}

fn read_within(
    path: &Path,
    area: Option<Bounds<f64>>,
    out: &Output,
) -> Result<(Layout, f64), UserError> {
    let progress = out.progress(format!("reading {}", shown_path(path)));
    let options = ReadOptions {
        area,
        ..limits::read_options(Some(&progress))
    };
    let layout = read_input(path, &options)?;
    Ok((layout, progress.finish()))
}

/// Reads a file, or standard input if the path is `-`.
pub(crate) fn read_input(path: &Path, options: &ReadOptions<'_>) -> Result<Layout, ReadError> {
    if is_stdin(path) {
        return read_stream("standard input", &mut io::stdin().lock(), options);
    }
    // A shell names its pipes so: `guideway info <(unpack site.zip)`.
    let is_pipe = path.starts_with("/dev/fd") || path == Path::new("/dev/stdin");
    match File::open(path).ok().filter(|_| is_pipe) {
        Some(mut pipe) => read_stream(&path.to_string_lossy(), &mut pipe, options),
        None => read_file(path, options),
    }
}

/// Returns `true` if a path names standard input.
pub(crate) fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Rejects a second `-`, and one that would wait for what somebody types.
pub(crate) fn check_stdin(inputs: &[Input]) -> Result<(), UserError> {
    check_stdin_paths(inputs.iter().map(|input| input.path.as_path()))
}

/// As [`check_stdin`], for all files of a command.
pub(crate) fn check_stdin_paths<'a>(
    files: impl IntoIterator<Item = &'a Path>,
) -> Result<(), UserError> {
    match files.into_iter().filter(|file| is_stdin(file)).count() {
        0 => Ok(()),
        1 if !io::stdin().is_terminal() => Ok(()),
        1 => Err(usage_error(
            "`-` is standard input, which is a terminal here",
            "Pipe a file into it, such as `cat site.lif.json | guideway info -`",
        )),
        _ => Err(usage_error(
            "`-` is given twice, but standard input can be read once",
            "Give the other file by its name",
        )),
    }
}

/// Reads several layouts and applies their placements. Returns them and the total duration in
/// milliseconds.
pub(crate) fn read_each(inputs: &[Input], out: &Output) -> Result<(Vec<Layout>, f64), UserError> {
    check_stdin(inputs)?;
    let (mut layouts, mut all_ms) = (Vec::new(), 0.0);
    for input in inputs {
        input.check_keys()?;
        let (mut layout, ms) = read(&input.path, out)?;
        place(&mut layout, input, limits::limits())?;
        layouts.push(layout);
        all_ms += ms;
    }
    Ok((layouts, all_ms))
}

/// Moves a layout to its placement.
pub(crate) fn place(layout: &mut Layout, input: &Input, limits: &Limits) -> Result<(), UserError> {
    match input.transform() {
        None => Ok(()),
        Some(transform) => {
            layout.transform(transform);
            check_reach(layout, input, limits.coordinate_m)
        }
    }
}

/// Checks that a placement moved no element beyond the limit that the file itself obeys.
fn check_reach(layout: &Layout, input: &Input, limit_m: f64) -> Result<(), UserError> {
    match layout.first_beyond(limit_m) {
        None => Ok(()),
        Some(element) => Err(UserError::new(
            "limit",
            format!(
                "{}: its placement moves {element} more than {limit_m:e} m away from the origin",
                shown_path(&input.path)
            ),
            "Correct `scale` and `offset`; raise the limit with `--limit coordinate=N` if this \
             distance is intended",
        )),
    }
}

/// Reads several layouts and merges them.
pub(crate) fn read_all(inputs: &[Input], out: &Output) -> Result<(Layout, f64), UserError> {
    let (layouts, read_ms) = read_each(inputs, out)?;
    let progress = out.progress("merging files");
    let layout = merge(layouts);
    Ok((layout, read_ms + progress.finish()))
}

/// The names of all files, for a report.
pub(crate) fn names(inputs: &[Input]) -> String {
    let names = inputs.iter().map(|input| input.path.to_string_lossy());
    names.collect::<Vec<_>>().join(", ")
}

/// Rejects an output that cannot be written or would replace an input, before any long work.
pub(crate) fn check_output<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    output: &Path,
) -> Result<(), UserError> {
    let reject = |kind, reason: &'static str| {
        Err(UserError::from(SaveError {
            path: output.to_owned(),
            problem: io::Error::new(kind, reason),
        }))
    };
    check_no_stdout(output)?;
    if output.is_dir() {
        return reject(ErrorKind::IsADirectory, "this is a folder");
    }
    let folder = output.parent().filter(|folder| *folder != Path::new(""));
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return reject(ErrorKind::NotFound, "the folder does not exist");
    }
    match inputs.into_iter().any(|input| is_same_file(input, output)) {
        true => Err(same_file_error(output)),
        false => Ok(()),
    }
}

/// Rejects `-` where a command writes files only.
pub(crate) fn check_no_stdout(output: &Path) -> Result<(), UserError> {
    match is_stdout(output) {
        true => Err(usage_error(
            "`-` is standard output, to which this command does not write its files",
            "Give a name, or write `./-` for one that is called `-`",
        )),
        false => Ok(()),
    }
}

/// A path without links, also of a file that does not exist in a folder that does.
pub(crate) fn resolved(path: &Path) -> PathBuf {
    let whole = dunce::canonicalize(path);
    let in_folder = || {
        let folder = path.parent().filter(|folder| *folder != Path::new(""));
        let folder = dunce::canonicalize(folder.unwrap_or(Path::new("."))).ok()?;
        Some(folder.join(path.file_name()?))
    };
    let resolved = whole.ok().or_else(in_folder);
    resolved.unwrap_or_else(|| std::path::absolute(path).unwrap_or_else(|_| path.to_owned()))
}

/// A resolved path as seen from a resolved folder: `a/b.json`, or `../a/b.json` outside of it.
pub(crate) fn relative(path: &Path, folder: &Path) -> String {
    let [own, base]: [Vec<Component<'_>>; 2] = [path, folder].map(|p| p.components().collect());
    let common = own.iter().zip(&base).take_while(|(a, b)| a == b).count();
    let up = base[common..].iter().map(|_| "..".into());
    let down = own[common..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy());
    up.chain(down).collect::<Vec<_>>().join("/")
}

/// Reads a file as it is.
///
/// # Errors
/// When it cannot be read.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, UserError> {
    std::fs::read(path).map_err(|error| {
        let message = format!("{}: cannot read the file: {error}", shown_path(path));
        UserError::new("read", message, "Check the file and its permissions")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Input, String> {
        Input::parse(text.into())
    }

    #[test]
    fn parses_placement_keys() {
        let plain = parse("site.json").unwrap();
        assert_eq!(
            (plain.path.to_str(), plain.transform()),
            (Some("site.json"), None)
        );
        let input = parse("a@b/plan.dxf@scale=0.5,rotate=90,offset=10,-3").unwrap();
        assert_eq!(input.path.to_str(), Some("a@b/plan.dxf"));
        let p = input.transform().unwrap().apply(Point::new(4.0, 2.0));
        assert!(p.distance(Point::new(9.0, -1.0)) < 1e-12, "{p:?}");
        assert_eq!(parse("hall.png@px-per-m=20").unwrap().px_per_m, Some(20.0));
        // Without keys the whole text is the name.
        assert_eq!(parse("me@home").unwrap().path.to_str(), Some("me@home"));
    }

    #[test]
    fn name_of_an_existing_file_is_not_split() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan@scale=2");
        std::fs::write(&path, "").unwrap();
        assert_eq!(parse(path.to_str().unwrap()).unwrap().path, path);
    }

    #[test]
    fn rejects_bad_keys_and_values_with_an_example() {
        for (bad, said) in [
            ("a@size=2", "scale, rotate and offset"),
            ("a@scal=2", "did you mean `scale`?"),
            ("a@2,scale=3", "scale, rotate and offset"),
            ("a@scale=0", "1e-9 to 1e9"),
            ("a@scale=1e10", "1e-9 to 1e9"),
            ("a@offset=1e10,0", "12.5,-3"),
            ("a@scale=1,2", "1e-9 to 1e9"),
            ("a@offset=1", "12.5,-3"),
            ("a@rotate=x", "degrees"),
        ] {
            let error = parse(bad).unwrap_err();
            assert!(error.contains(said), "{bad}: {error}");
        }
    }

    #[test]
    fn relative_paths_lead_from_the_folder_to_the_file() {
        let seen = |path: &str, folder: &str| relative(Path::new(path), Path::new(folder));
        assert_eq!(seen("/site/a/b.json", "/site"), "a/b.json");
        assert_eq!(seen("/site/a/b.json", "/site/c/d"), "../../a/b.json");
        assert_eq!(seen("/b.json", "/"), "b.json");
    }
}
