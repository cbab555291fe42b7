//! Origin of the lines of a window: flattened now, or cached.

/// Lines of a window.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineSource {
    /// Flattened for the window only, behind this many cached lines, which are not drawn.
    Window(u32),
    /// Flattened for the whole LOD, to be cached.
    Lod,
    /// This many cached lines.
    Cached(u32),
    /// Cached lines, and the dirty clusters whose lines are flattened again (counts).
    Refreshed(u32, u32),
}

impl LineSource {
    /// Index of the first new line.
    pub(crate) fn first_new(self) -> u32 {
        match self {
            Self::Window(first) => first,
            Self::Lod | Self::Cached(_) | Self::Refreshed(..) => self.cached(),
        }
    }

    /// Number of cached lines to draw.
    pub(crate) fn cached(self) -> u32 {
        match self {
            Self::Window(_) | Self::Lod => 0,
            Self::Cached(lines) | Self::Refreshed(lines, _) => lines,
        }
    }
}
