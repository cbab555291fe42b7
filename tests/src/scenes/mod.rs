//! Scenes of one behavior each, named `topic/case`.

mod crowds;
mod frames;
mod lines;
mod order;
mod places;
mod shapes;
mod tiles;
mod translucency;
mod widths;

use crate::sketch::{Drawing, Sketch};

pub use crowds::{long_curves, short_paths, site};

/// One scene of the suite.
pub struct SceneCase {
    /// Stable name: `topic/case`.
    pub name: String,
    sketch: Box<dyn Fn() -> Sketch + Send + Sync>,
}

impl SceneCase {
    /// Everything that a method needs for it.
    pub fn build(&self) -> Drawing {
        self.sketch().build()
    }

    /// Its description, to be varied.
    pub fn sketch(&self) -> Sketch {
        (self.sketch)()
    }
}

/// Every scene of the suite.
pub fn all() -> Vec<SceneCase> {
    [
        lines::cases(),
        shapes::cases(),
        widths::cases(),
        tiles::cases(),
        order::cases(),
        translucency::cases(),
        places::cases(),
        frames::cases(),
        crowds::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn case(name: impl Into<String>, sketch: impl Fn() -> Sketch + Send + Sync + 'static) -> SceneCase {
    SceneCase {
        name: name.into(),
        sketch: Box::new(sketch),
    }
}
