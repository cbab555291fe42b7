//! A style preset replaces the colors and widths of a scene, and returns the restyled scene.

use std::sync::Arc;

use guideway_layout::OwnStyle;
use guideway_scene::Scene;
use serde::{Deserialize, Serialize};

use crate::plain_scene;

/// Colors and widths of the paths.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum StylePreset {
    /// Those of the layout; a dataset is black.
    #[default]
    Own,
    /// An opaque color per path, and one of four widths.
    Mixed,
    /// As [`StylePreset::Mixed`], with half of the paths translucent.
    Translucent,
}

/// Widths of [`StylePreset::Mixed`]: around 0.1 m, the width of paths without one.
const WIDTHS_M: [f32; 4] = [0.05, 0.1, 0.15, 0.2];
/// Multiplier that spreads successive rows over all colors (Fibonacci hashing, Knuth 6.4: 2^32 /
/// phi).
const NEXT_COLOR: u32 = 0x9e37_79b9;

impl StylePreset {
    /// The scene with the colors and widths of the preset.
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
    fn restyles_every_path_of_the_scene() {
        let scene = Dataset::D1.scene(40);
        assert!(scene.common_color().is_some());
        assert!(Arc::ptr_eq(
            &StylePreset::Own.scene(Arc::clone(&scene)),
            &scene
        ));
        let mixed = StylePreset::Mixed.scene(Arc::clone(&scene));
        assert!(mixed.common_color().is_none() && mixed.is_opaque());
        assert!(!StylePreset::Translucent.scene(scene).is_opaque());
        let widths: std::collections::BTreeSet<_> = (0..40)
            .map(|path| mixed.width_m(path).map(f32::to_bits))
            .collect();
        assert_eq!(widths.len(), WIDTHS_M.len());
    }
}
