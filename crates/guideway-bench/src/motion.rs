//! A motion computes the view of each frame from the first view and the frame number.

use guideway_scene::{RenderError, View};
use guideway_spline::Point;
use serde::{Deserialize, Serialize};

/// Change from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// No change.
    #[default]
    Still,
    /// The view moves by whole pixels, as when dragged.
    Pan,
    /// The view zooms in by 2 % per frame, then out again.
    Zoom,
    /// Some paths move; the view stays.
    Edit,
}

/// Frames until a motion reverses, so that the view stays near its start.
const TURN: usize = 32;
/// Steps of [`Motion::Pan`], repeated in this order.
const PAN_PX: [Point<f64>; 4] = [
    Point { x: 5.0, y: 0.0 },
    Point { x: 3.0, y: 0.0 },
    Point { x: 5.0, y: 2.0 },
    Point { x: 0.0, y: 3.0 },
];
/// Scale factor per frame of [`Motion::Zoom`].
const ZOOM: f64 = 1.02;

impl Motion {
    /// The view of frame number `frame`; frame 0 has the view `start`.
    ///
    /// # Errors
    /// When the moved view is out of range ([`View::new`]).
    pub fn view(self, start: &View, frame: usize) -> Result<View, RenderError> {
        let along = frame % (2 * TURN);
        let steps = along.min(2 * TURN - along);
        let (center, scale) = (start.center_m(), start.px_per_m());
        match self {
            Self::Still | Self::Edit => Ok(*start),
            Self::Pan => {
                let all = PAN_PX.iter().cycle().take(steps);
                let shift_px = all.fold(Point::new(0.0, 0.0), |sum, &step| sum + step);
                View::new(start.size(), center + shift_px * (1.0 / scale), scale)
            }
            Self::Zoom => View::new(start.size(), center, scale * ZOOM.powi(steps as i32)),
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_scene::FrameSize;

    use super::*;

    fn start() -> View {
        View::new(FrameSize::new(640, 360).unwrap(), Point::new(3.0, 4.0), 2.0).unwrap()
    }

    #[test]
    fn panning_moves_by_whole_pixels_and_returns() {
        let shift_px = |frame| {
            let view = Motion::Pan.view(&start(), frame).unwrap();
            let shift = (view.center_m() - start().center_m()) * start().px_per_m();
            (shift.x, shift.y)
        };
        let expected = [(0.0, 0.0), (5.0, 0.0), (8.0, 0.0), (13.0, 2.0), (13.0, 5.0)];
        assert_eq!([0, 1, 2, 3, 4].map(shift_px), expected);
        assert_eq!(shift_px(5), (18.0, 5.0));
        assert_eq!(shift_px(2 * TURN), (0.0, 0.0));
        assert_eq!(shift_px(TURN + 1), shift_px(TURN - 1));
        // No view repeats before the reversal, so a cache keyed by view gets no hits.
        for frame in 1..=TURN {
            assert!((0..frame).all(|before| shift_px(before) != shift_px(frame)));
        }
    }

    #[test]
    fn zooming_in_reverses_and_returns() {
        let scale = |frame| Motion::Zoom.view(&start(), frame).unwrap().px_per_m();
        assert!(scale(1) > scale(0) && scale(TURN) > scale(TURN + 1));
        assert_eq!(scale(2 * TURN), 2.0);
    }

    #[test]
    fn still_and_edit_keep_the_view() {
        for motion in [Motion::Still, Motion::Edit] {
            assert_eq!(motion.view(&start(), 7).unwrap(), start());
        }
    }
}
