//! Size and position of the window on the desktop.

use eframe::egui::{Context, Vec2, ViewportBuilder};
use serde::{Deserialize, Serialize};

/// Least size of the window, in points.
pub(crate) const MIN_SIZE: [f32; 2] = [320.0, 240.0];
/// Greatest size that is remembered, in points: beyond all screens.
const MAX_SIDE: f32 = 16_384.0;

/// Size and position of the window, in points.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub(crate) struct WindowPlace {
    pub(crate) size: [f32; 2],
    /// Upper left corner; `None` where the desktop does not tell it, as Wayland does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) position: Option<[f32; 2]>,
    pub(crate) is_maximized: bool,
}

impl Default for WindowPlace {
    fn default() -> Self {
        Self {
            size: [1280.0, 800.0],
            position: None,
            is_maximized: false,
        }
    }
}

impl WindowPlace {
    pub(super) fn in_range(self) -> Self {
        let is_size = |side: f32, least: f32| (least..=MAX_SIDE).contains(&side);
        let [width, height] = self.size;
        let is_sized = is_size(width, MIN_SIZE[0]) && is_size(height, MIN_SIZE[1]);
        let is_on_desktop = |at: &[f32; 2]| at.iter().all(|side| side.abs() <= MAX_SIDE);
        Self {
            size: if is_sized {
                self.size
            } else {
                Self::default().size
            },
            position: self.position.filter(is_on_desktop),
            ..self
        }
    }

    /// Takes the present place of the window. A maximized window keeps the place that it had
    /// before.
    pub(crate) fn update(&mut self, ctx: &Context) {
        ctx.input(|input| {
            let window = input.viewport();
            let is_maximized = window.maximized.unwrap_or(false);
            let is_covering = is_maximized || window.fullscreen.unwrap_or(false);
            if let Some(inner) = window.inner_rect.filter(|_| !is_covering) {
                self.size = inner.size().into();
            }
            if let Some(outer) = window.outer_rect.filter(|_| !is_covering) {
                self.position = Some(outer.min.into());
            }
            self.is_maximized = is_maximized;
        });
        *self = self.in_range();
    }

    /// A window of this place.
    pub(crate) fn builder(self) -> ViewportBuilder {
        let builder = ViewportBuilder::default()
            .with_inner_size(Vec2::from(self.size))
            .with_maximized(self.is_maximized);
        match self.position {
            Some(position) => builder.with_position(position),
            None => builder,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odd_places_become_the_default() {
        let place = |size, position| {
            let place = WindowPlace {
                size,
                position,
                is_maximized: true,
            };
            let place = place.in_range();
            (place.size, place.position)
        };
        let sound = [900.0, 600.0];
        assert_eq!(place(sound, Some([-8.0, 0.0])), (sound, Some([-8.0, 0.0])));
        let default = WindowPlace::default().size;
        for size in [[0.0, 600.0], [f32::NAN, 600.0], [900.0, 1e9]] {
            assert_eq!(place(size, Some([0.0, f32::INFINITY])), (default, None));
        }
    }
}
