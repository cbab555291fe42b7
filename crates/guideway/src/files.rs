//! The shortest calls: open, check and save a layout with default options.

use std::io::Write;
use std::path::{Path, PathBuf};

use guideway_formats::{
    Losses, ReadError, ReadOptions, Target, WriteError, WriteProblem, read_file,
};
use guideway_layout::{CheckOptions, Diagnostics, Layout, UserError, shown_path};
use guideway_network::AnalyzeOptions;

/// Reads a layout file with the default limits. The content decides the format.
///
/// # Errors
/// See [`read_file`], which also takes limits and reports progress.
pub fn open(path: impl AsRef<Path>) -> Result<Layout, ReadError> {
    read_file(path.as_ref(), &ReadOptions::default())
}

/// All findings about a layout: of its reader, its geometry and its network.
pub fn check(layout: &Layout) -> Diagnostics {
    let mut found = guideway_layout::check(layout, &CheckOptions::default());
    found.append(guideway_network::analyze(
        layout,
        &AnalyzeOptions::default(),
    ));
    found.append(layout.diagnostics.clone());
    found
}

/// Saves a layout in the format that the extension names: see [`Target::for_file`]. The file
/// appears whole or not at all. Returns what the format cannot hold.
///
/// # Errors
/// When no format has the extension, or the file cannot be written.
pub fn save(layout: &Layout, path: impl AsRef<Path>) -> Result<Losses, SaveAsError> {
    let path = path.as_ref();
    let target = Target::for_file(layout, path).ok_or_else(|| SaveAsError::extension(path))?;
    Ok(target.write_file(layout, path)?)
}

/// Writes a layout to a stream in a format. Returns what the format cannot hold.
///
/// ```
/// use guideway::formats::Target;
///
/// let layout = guideway::open("examples/site.lif.json")?;
/// let mut drawing = Vec::new();
/// let losses = guideway::write(&layout, Target::Svg, &mut drawing)?;
/// assert!(drawing.starts_with(b"<svg") && losses.iter().len() > 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// See [`Target::write`].
pub fn write(layout: &Layout, target: Target, mut out: impl Write) -> Result<Losses, WriteProblem> {
    target.write(layout, &mut out)
}

/// Why [`save`] failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveAsError {
    /// No format has the extension of the file.
    #[error(
        "{}: no format has this extension; known are {}",
        shown_path(path),
        known_extensions()
    )]
    Extension {
        /// The file.
        path: PathBuf,
    },
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl SaveAsError {
    /// No format has the extension of `path`.
    pub fn extension(path: &Path) -> Self {
        Self::Extension {
            path: path.to_owned(),
        }
    }
}

impl From<SaveAsError> for UserError {
    fn from(error: SaveAsError) -> Self {
        match error {
            SaveAsError::Extension { .. } => {
                Self::new("target-format", error.to_string(), "Rename the file")
            }
            SaveAsError::Write(error) => error.into(),
        }
    }
}

fn known_extensions() -> String {
    let extensions = Target::ALL.iter().flat_map(|target| target.extensions());
    extensions.copied().collect::<Vec<_>>().join(", ")
}
