//! A scene case pairs a stable name with the function that sketches the scene.

use crate::sketch::{Drawing, Sketch};

/// One scene of the suite.
pub struct SceneCase {
    /// Stable name: `topic/case`.
    pub name: String,
    sketch: Box<dyn Fn() -> Sketch + Send + Sync>,
}

impl SceneCase {
    /// Layout, style and view of the scene.
    pub fn build(&self) -> Drawing {
        self.sketch().build()
    }

    /// The sketch of the scene, for variations.
    pub fn sketch(&self) -> Sketch {
        (self.sketch)()
    }
}

/// A scene case from its name and sketch.
pub(super) fn case(
    name: impl Into<String>,
    sketch: impl Fn() -> Sketch + Send + Sync + 'static,
) -> SceneCase {
    SceneCase {
        name: name.into(),
        sketch: Box::new(sketch),
    }
}
