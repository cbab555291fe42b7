//! Names of picture files: which kind of picture an extension promises, and the default name.

use std::path::{Path, PathBuf};

use guideway::formats::Target;
use guideway::layout::{UserError, shown_path};

use super::error::usage_error;

/// Returns `true` if a file is to hold SVG.
pub(crate) fn is_svg(path: &Path) -> bool {
    has_extension(path, "svg")
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension()
        .is_some_and(|own| own.eq_ignore_ascii_case(extension))
}

/// Rejects a file whose extension promises another kind of picture than PNG or SVG. Devices, such
/// as `/dev/null`, have no extension.
pub(crate) fn check_extension(path: &Path) -> Result<(), UserError> {
    let is_device = path.exists() && !path.is_file();
    if has_extension(path, "png") || is_svg(path) || is_device {
        return Ok(());
    }
    Err(usage_error(
        format!("{}: pictures are PNG or SVG", shown_path(path)),
        format!(
            "Name it {} or .svg; other programs convert these",
            shown_path(&path.with_extension("png"))
        ),
    ))
}

/// The name of a picture of a layout file: `site.png` for `halls/site.lif.json`, in the current
/// folder.
///
/// # Errors
/// When this file exists: only a name that was given may replace one.
pub(crate) fn default_name(layout_file: &Path) -> Result<PathBuf, UserError> {
    let name = layout_file.file_name().unwrap_or_default();
    let name = name.to_string_lossy();
    let known = Target::ALL.iter().flat_map(|target| target.extensions());
    let lower = name.to_lowercase();
    let known = known.filter(|extension| lower.ends_with(**extension));
    let stem = match known.max_by_key(|extension| extension.len()) {
        Some(extension) => &name[..name.len() - extension.len()],
        None => name.rsplit_once('.').map_or(&*name, |(stem, _)| stem),
    };
    let picture = PathBuf::from(match stem {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extension_says_what_a_picture_is() {
        for good in ["a.png", "A.PNG", "b.svg", "/dev/null"] {
            assert!(check_extension(Path::new(good)).is_ok(), "{good}");
        }
        for bad in ["a.jpg", "plan.pdf", "noext", "a.png.bak"] {
            let error = check_extension(Path::new(bad)).unwrap_err();
            assert!(error.message.contains(bad), "{error}");
        }
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
