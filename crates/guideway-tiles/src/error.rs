//! [`TileError`]: the reason why tiles were not made.

use std::io;

use guideway_layout::UserError;
use guideway_scene::RenderError;

/// The reason why tiles were not made.
#[derive(Debug, thiserror::Error)]
pub enum TileError {
    /// The tiles could not be drawn.
    #[error(transparent)]
    Render(#[from] RenderError),
    /// The method keeps no counts of paths, which the shading by density of tiles needs.
    #[error("method `{method}` cannot shade tiles by density")]
    NoCounts {
        /// Name of the method.
        method: &'static str,
    },
    /// Density shading was asked for single tiles.
    #[error("density shading takes its colors from all tiles of a zoom, not from single ones")]
    SingleDensity,
    /// A zoom has more tiles than were asked for.
    #[error("zoom {zoom} has more than {limit} tiles that paths touch")]
    TooMany {
        /// The zoom.
        zoom: u8,
        /// Most tiles.
        limit: usize,
    },
    /// The journal could not be read or written.
    #[error("the file of unfinished tiles failed: {0}")]
    Journal(#[from] io::Error),
    /// A tile could not be encoded.
    #[error("a tile could not be encoded as PNG: {0}")]
    Png(#[from] png::EncodingError),
}

impl From<TileError> for UserError {
    fn from(error: TileError) -> Self {
        let (code, remedy) = match &error {
            TileError::Render(error) => return Self::from(error.clone()),
            TileError::NoCounts { .. } => (
                "unsupported",
                "Use `--method cpu`, or omit `--shade density`",
            ),
            TileError::SingleDensity => (
                "unsupported",
                "Make them all by the command `guideway tiles --shade density`",
            ),
            TileError::TooMany { .. } => ("limit", "Ask for fewer zooms"),
            TileError::Journal(_) => (
                "journal",
                "Free some space on its disk and run the command again: it goes on where it \
                 stopped",
            ),
            TileError::Png(_) => ("png", "Run the command again; if it fails again, report it"),
        };
        Self::new(code, error.to_string(), remedy)
    }
}
