//! [`Layout`]: the contents of one layout file, and [`Provenance`], its origin.

use std::sync::Arc;

use guideway_spline::Affine;

use crate::{Diagnostics, Level, Nodes, Paths, Refused, Stations};

/// A layout, as read from one file or merged from several.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Origin of the layout.
    pub provenance: Provenance,
    /// The paths that are drawn.
    pub paths: Paths,
    /// Paths of the input that cannot be drawn, each with its reason.
    pub refused: Refused,
    /// Named points where paths begin, end and meet.
    pub nodes: Nodes,
    /// Named places where vehicles load, unload, park or charge.
    pub stations: Stations,
    /// Floors of the building, or the layouts of a file that has several.
    pub levels: Vec<Level>,
    /// Findings about the file, made by its reader.
    pub diagnostics: Diagnostics,
}

impl Layout {
    /// Number of paths in the input: drawn and refused ones.
    pub fn path_count(&self) -> usize {
        self.paths.len() + self.refused.len()
    }

    /// Index of the level with this identifier or name, if any.
    pub fn level_named(&self, name: &str) -> Option<u32> {
        let found = self
            .levels
            .iter()
            .position(|l| l.id == name || l.name.as_deref() == Some(name));
        found.map(|i| i as u32)
    }

    /// Heap bytes in use, approximately: it omits levels, diagnostics and provenance.
    pub fn heap_bytes(&self) -> usize {
        self.paths.heap_bytes()
            + self.refused.heap_bytes()
            + self.nodes.heap_bytes()
            + self.stations.heap_bytes()
    }

    /// Maps curves, nodes and stations. Scales widths by the square root of the area scale. Leaves
    /// attribute columns unchanged, whatever they measure.
    pub fn transform(&mut self, by: Affine) {
        self.paths.transform(0..self.paths.len(), by);
        self.nodes.transform(by);
        self.stations.transform(by);
        if let Some(widths_m) = self.paths.width_m() {
            let scale = by.x.cross(by.y).abs().sqrt() as f32;
            self.paths
                .set_width_m(widths_m.iter().map(|w| w * scale).collect());
        }
    }
}

/// Origin of a layout.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Provenance {
    /// Path of the file, or another name of the source, as given by the caller.
    pub source: String,
    /// Detected format, such as `LIF` or `openTCS`.
    pub format: String,
    /// Version of the format, derived from the structure of the file.
    pub format_version: String,
    /// Numbers of elements in the source, under the names of the format, such as `("edges", 12)`.
    pub counts: Vec<(String, u64)>,
    /// Text of the file, for formats whose writer copies the fields that the layout does not model.
    pub text: Option<Arc<str>>,
}
