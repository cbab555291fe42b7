//! Names of picture files: which kind of picture an extension promises, and the default name.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use guideway::compose::VectorFormat;
use guideway::formats::Target;
use guideway::layout::{UserError, shown_path};

use super::error::usage_error;
use super::output::is_stdout;

/// A format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PictureFormat {
    /// Pixels
    Png,
    /// Curves, with texts as letters
    Svg,
    /// Curves, with texts as outlines
    Pdf,
}

impl PictureFormat {
    /// The format of vector graphics; `None` for pixels.
    pub(crate) fn vector(self) -> Option<VectorFormat> {
        match self {
            Self::Png => None,
            Self::Svg => Some(VectorFormat::Svg),
            Self::Pdf => Some(VectorFormat::Pdf),
        }
    }

    /// The format that the extension of a file promises.
    fn promised(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        let all = Self::value_variants().iter();
        let is_named = |format: &&Self| {
            let name = format.to_possible_value();
            name.is_some_and(|name| name.matches(extension, true))
        };
        all.copied().find(|format| is_named(&format))
    }

    /// The format of an output: that of its extension, or of `--to` where it has none.
    ///
    /// # Errors
    /// When the extension promises another format, or none that pictures are written in. Devices,
    /// such as `/dev/null`, and standard output have no extension.
    pub(crate) fn of_output(path: &Path, to: Option<Self>) -> Result<Self, UserError> {
        let is_nameless = is_stdout(path) || (path.exists() && !path.is_file());
        match (Self::promised(path), to) {
            (Some(promised), Some(to)) if promised != to => Err(usage_error(
                format!("{}: the extension contradicts --to", shown_path(path)),
                "Omit --to, or write another extension",
            )),
            (Some(format), _) | (None, Some(format)) => Ok(format),
            (None, None) if is_nameless => Ok(Self::Png),
            (None, None) => Err(usage_error(
                format!("{}: pictures are PNG, SVG or PDF", shown_path(path)),
                format!(
                    "Name it {}, .svg or .pdf; other programs convert these",
                    shown_path(&path.with_extension("png"))
                ),
            )),
        }
    }
}

/// Color of paths beside those that a picture is about, as RRGGBBAA.
pub(crate) const OTHER_PATHS: u32 = 0xb4b4_b4ff;

/// The name of a picture of a layout file: `site.png` for `halls/site.lif.json`, in the current
/// folder.
///
/// # Errors
/// When this file exists: only a name that was given may replace one.
pub(crate) fn default_name(layout_file: &Path) -> Result<PathBuf, UserError> {
    let name = layout_file.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let picture = PathBuf::from(match stem(&name) {
        "" | "-" => "layout.png".to_owned(),
        stem => format!("{stem}.png"),
    });
    if picture.exists() {
        return Err(usage_error(
            format!("{} exists", shown_path(&picture)),
            format!(
                "Name the picture; `-o {}` replaces it",
                shown_path(&picture)
            ),
        ));
    }
    Ok(picture)
}

/// The name of a layout file without the extension of its format: `site` for `site.lif.json`.
pub(crate) fn stem(name: &str) -> &str {
    let known = Target::ALL.iter().flat_map(|target| target.extensions());
    let lower = name.to_lowercase();
    let known = known.filter(|extension| lower.ends_with(**extension));
    match known.max_by_key(|extension| extension.len()) {
        Some(extension) => &name[..name.len() - extension.len()],
        None => name.rsplit_once('.').map_or(name, |(stem, _)| stem),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extension_says_what_a_picture_is() {
        use PictureFormat::{Pdf, Png, Svg};
        let format = |path: &str, to| PictureFormat::of_output(Path::new(path), to);
        for (good, to, expected) in [
            ("a.png", None, Png),
            ("A.PNG", None, Png),
            ("b.svg", None, Svg),
            ("b.pdf", Some(Pdf), Pdf),
            ("noext", Some(Svg), Svg),
            ("/dev/null", None, Png),
            ("-", None, Png),
            ("-", Some(Svg), Svg),
        ] {
            assert_eq!(format(good, to).unwrap(), expected, "{good}");
        }
        for bad in ["a.jpg", "noext", "a.png.bak"] {
            let error = format(bad, None).unwrap_err();
            assert!(error.message.contains(bad), "{error}");
        }
        assert!(format("a.png", Some(Svg)).is_err());
    }

    #[test]
    fn default_name_is_that_of_the_layout() {
        for (layout, picture) in [
            ("halls/site.lif.json", "site.png"),
            ("plan.DXF", "plan.png"),
            ("office.building.yaml", "office.building.png"),
            ("noext", "noext.png"),
            ("-", "layout.png"),
        ] {
            let name = default_name(Path::new(layout)).unwrap();
            assert_eq!(name, Path::new(picture));
        }
    }
}
