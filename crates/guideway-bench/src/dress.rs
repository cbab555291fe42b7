use std::sync::Arc;

use guideway_layout::OwnStyle;
use guideway_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::plain_scene;

/// What paths look like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Dress {
    /// As the layout says; a dataset is black.
    #[default]
    Own,
    /// Each path has a color of its own, opaque, and a width.
    Mixed,
    /// The same, half of them translucent.
    Translucent,
}

/// Widths of [`Dress::Mixed`]: around the 0.1 m of paths that have none.
const WIDTHS_M: [f32; 4] = [0.05, 0.1, 0.15, 0.2];
/// A step through colors that does not soon come back (Fibonacci hashing, Knuth 6.4).
const NEXT_COLOR: u32 = 0x9e37_79b9;

impl Dress {
    /// A scene in which paths look so.
    pub fn scene(self, scene: Arc<Scene>) -> Arc<Scene> {
        if self == Self::Own {
            return scene;
        }
        let mut layout = scene.layout().clone();
        drop(scene);
        for path in 0..layout.paths.len() {
            let color = NEXT_COLOR.wrapping_mul(path as u32);
            let is_opaque = self == Self::Mixed || path % 2 == 0;
            let opacity = if is_opaque { 0xff } else { 0x80 };
            layout.paths.set_own_style(
                path,
                OwnStyle {
                    width_m: Some(WIDTHS_M[color as usize % WIDTHS_M.len()]),
                    color_rgba: Some(color & 0xffff_ff00 | opacity),
                },
            );
        }
        plain_scene(layout)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dataset;

    #[test]
    fn paths_are_dressed_as_asked() {
        let scene = Dataset::D1.scene(40);
        assert!(scene.common_color().is_some());
        assert!(Arc::ptr_eq(&Dress::Own.scene(Arc::clone(&scene)), &scene));
        let mixed = Dress::Mixed.scene(Arc::clone(&scene));
        assert!(mixed.common_color().is_none() && mixed.is_opaque());
        assert!(!Dress::Translucent.scene(scene).is_opaque());
        let widths: std::collections::BTreeSet<_> = (0..40)
            .map(|path| mixed.width_m(path).map(f32::to_bits))
            .collect();
        assert_eq!(widths.len(), WIDTHS_M.len());
    }
}
