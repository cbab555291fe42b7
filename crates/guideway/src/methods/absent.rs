//! Stands in for the methods on graphics devices where a build lacks them, so that every build
//! knows their names and says how to get them.

use super::entry::{Implementation, StartError};

#[cfg(not(feature = "gpu"))]
pub(super) mod gpu {
    use super::{Implementation, absent};

    pub(in crate::methods) const TILES: Implementation = COMPUTE;
    pub(in crate::methods) const GRID: Implementation = COMPUTE;
    pub(in crate::methods) const TREE: Implementation = COMPUTE;
    pub(in crate::methods) const QUADTREE: Implementation = COMPUTE;

    const COMPUTE: Implementation = Implementation {
        options: &[],
        start: |_| Err(absent("gpu")),
    };

    /// `None`: the build cannot see any.
    pub(in crate::methods) fn adapters() -> Option<Vec<String>> {
        None
    }

    /// None: the build has no graphics device.
    pub(in crate::methods) fn limits() -> Vec<(String, String)> {
        Vec::new()
    }

    /// Returns `false`: the build has no graphics device.
    pub(in crate::methods) fn is_in_hardware() -> bool {
        false
    }
}

#[cfg(not(feature = "gl"))]
pub(super) mod tessellation {
    use super::{Implementation, absent};

    pub(in crate::methods) const PER_PATH: Implementation = OPENGL;
    pub(in crate::methods) const COMPACT: Implementation = OPENGL;

    const OPENGL: Implementation = Implementation {
        options: &[],
        start: |_| Err(absent("gl")),
    };
}

fn absent(feature: &str) -> StartError {
    StartError::Unavailable(format!(
        "this build lacks it; build with `--features {feature}`"
    ))
}
