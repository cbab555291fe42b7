//! Files that are read: one, or several as one layout, each put where it belongs.

use std::ffi::OsString;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use clap::builder::{OsStringValueParser, TypedValueParser};
use guideway::SaveError;
use guideway::formats::{ReadOptions, read_file};
use guideway::layout::{Layout, merge};
use guideway::spline::{Affine, Point};

use super::{Failure, Output, values};

/// What a file can be given after its name, for the help of every command that reads several.
pub(crate) const PLACEMENT_HELP: &str = "Several files become one layout. Each can be scaled about the \
    origin, then turned counter-clockwise by degrees, then moved by meters:\n  \
    FILE@scale=0.001,rotate=90,offset=12.5,-3";

/// A file, and how it is put among others.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Input {
    pub(crate) path: PathBuf,
    pub(crate) scale: Option<f64>,
    pub(crate) rotate_deg: Option<f64>,
    pub(crate) offset_m: Option<Point<f64>>,
    /// Of an image: pixels a meter.
    pub(crate) px_per_m: Option<f64>,
}

impl Input {
    /// Reads `FILE@key=value,key=value` from an argument.
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
        // A file may well have such a name.
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
            "scale" => self.scale = Some(values::positive(value)?),
            "rotate" => self.rotate_deg = Some(values::degrees(value)?),
            "offset" => self.offset_m = Some(values::point(value)?),
            "px-per-m" => self.px_per_m = Some(values::positive(value)?),
            _ => return Err("there is scale, rotate and offset; px-per-m of images".into()),
        }
        Ok(())
    }

    /// Where it is put; none if it stays where it is.
    fn placed(&self) -> Option<Affine> {
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
        let turned = Affine::scale(scale, scale, origin).then(Affine::rotation(angle_rad, origin));
        Some(turned.then(Affine::translation(offset_m.unwrap_or_default())))
    }
}

/// The keys with their values; a value may have commas.
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

/// Reads a layout, showing how far it is. Returns it with the time that it took, in milliseconds.
pub(crate) fn read(path: &Path, out: &Output) -> Result<(Layout, f64), Failure> {
    let activity = out.activity(format!("reading {}", path.display()));
    let options = ReadOptions {
        progress: Some(&activity),
        ..ReadOptions::default()
    };
    let layout = read_file(path, &options)?;
    Ok((layout, activity.finish()))
}

/// Reads several layouts and puts each where it belongs. The times of all together are in milliseconds.
pub(crate) fn read_each(inputs: &[Input], out: &Output) -> Result<(Vec<Layout>, f64), Failure> {
    let (mut layouts, mut all_ms) = (Vec::new(), 0.0);
    for input in inputs {
        if input.px_per_m.is_some() {
            return Err(Failure::arguments(
                format!("{}: px-per-m is for images", input.path.display()),
                "Scale a layout with scale, such as `plan.dxf@scale=0.001`",
            ));
        }
        let (mut layout, ms) = read(&input.path, out)?;
        if let Some(by) = input.placed() {
            layout.transform(by);
        }
        layouts.push(layout);
        all_ms += ms;
    }
    Ok((layouts, all_ms))
}

/// Reads several layouts as one.
pub(crate) fn read_all(inputs: &[Input], out: &Output) -> Result<(Layout, f64), Failure> {
    let (layouts, read_ms) = read_each(inputs, out)?;
    let activity = out.activity("putting files together");
    let layout = merge(layouts);
    Ok((layout, read_ms + activity.finish()))
}

/// The names of all, for a report.
pub(crate) fn names(inputs: &[Input]) -> String {
    let names = inputs.iter().map(|input| input.path.to_string_lossy());
    names.collect::<Vec<_>>().join(", ")
}

/// Refuses an output that cannot be written or would replace an input, before any long work is done.
pub(crate) fn check_output<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    output: &Path,
) -> Result<(), Failure> {
    let refuse = |kind, why: &'static str| {
        Err(Failure::from(SaveError {
            path: output.to_owned(),
            problem: io::Error::new(kind, why),
        }))
    };
    if output.is_dir() {
        return refuse(ErrorKind::IsADirectory, "this is a folder");
    }
    let folder = output.parent().filter(|folder| *folder != Path::new(""));
    if folder.is_some_and(|folder| !folder.is_dir()) {
        return refuse(ErrorKind::NotFound, "there is no such folder");
    }
    // An output that is not there yet has no canonical path, and cannot be an input.
    let Ok(there) = output.canonicalize() else {
        return Ok(());
    };
    let mut inputs = inputs.into_iter().map(Path::canonicalize);
    match inputs.any(|input| input.is_ok_and(|input| input == there)) {
        true => Err(Failure::same_file(output)),
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Input, String> {
        Input::parse(text.into())
    }

    #[test]
    fn a_file_is_put_where_its_keys_say() {
        let plain = parse("site.json").unwrap();
        assert_eq!(
            (plain.path.to_str(), plain.placed()),
            (Some("site.json"), None)
        );
        let input = parse("a@b/plan.dxf@scale=0.5,rotate=90,offset=10,-3").unwrap();
        assert_eq!(input.path.to_str(), Some("a@b/plan.dxf"));
        let p = input.placed().unwrap().apply(Point::new(4.0, 2.0));
        assert!(p.distance(Point::new(9.0, -1.0)) < 1e-12, "{p:?}");
        assert_eq!(parse("hall.png@px-per-m=20").unwrap().px_per_m, Some(20.0));
        // No keys, so it is a name.
        assert_eq!(parse("me@home").unwrap().path.to_str(), Some("me@home"));
    }

    #[test]
    fn a_file_that_is_there_is_never_cut() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan@scale=2");
        std::fs::write(&path, "").unwrap();
        assert_eq!(parse(path.to_str().unwrap()).unwrap().path, path);
    }

    #[test]
    fn bad_keys_and_values_are_refused_with_what_there_is() {
        for (bad, said) in [
            ("a@size=2", "scale, rotate and offset"),
            ("a@2,scale=3", "scale, rotate and offset"),
            ("a@scale=0", "above 0"),
            ("a@scale=1,2", "above 0"),
            ("a@offset=1", "12.5,-3"),
            ("a@rotate=x", "degrees"),
        ] {
            let error = parse(bad).unwrap_err();
            assert!(error.contains(said), "{bad}: {error}");
        }
    }
}
