use guideway_render::{RenderError, View};
use guideway_spline::Point;
use serde::{Deserialize, Serialize};

/// What changes from frame to frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// Nothing.
    #[default]
    Still,
    /// The view moves sideways, by whole pixels and by parts of one in turn.
    Pan,
    /// The view comes a little nearer each frame, and goes away again.
    Zoom,
    /// Some paths move; the view does not.
    Edit,
}

/// Frames until a motion turns back, so that it never loses sight of where it began.
const TURN: usize = 32;
/// Steps of [`Motion::Pan`], one after the other. The first leaves pixels where they were.
const PAN_PX: [f64; 2] = [5.0, 2.375];
/// Growth of the scale each frame of [`Motion::Zoom`].
const ZOOM: f64 = 1.02;

impl Motion {
    /// What frame number `frame` sees, when frame 0 sees `start`.
    ///
    /// # Errors
    /// When the motion ends where no view may be ([`View::new`]).
    pub fn view(self, start: &View, frame: usize) -> Result<View, RenderError> {
        let along = frame % (2 * TURN);
        let steps = along.min(2 * TURN - along);
        let (center, scale) = (start.center_m(), start.px_per_m());
        match self {
            Self::Still | Self::Edit => Ok(*start),
            Self::Pan => {
                let whole = steps.div_ceil(2) as f64 * PAN_PX[0];
                let shift_px = whole + (steps / 2) as f64 * PAN_PX[1];
                let center = Point::new(center.x + shift_px / scale, center.y);
                View::new(start.size(), center, scale)
            }
            Self::Zoom => View::new(start.size(), center, scale * ZOOM.powi(steps as i32)),
        }
    }
}

#[cfg(test)]
mod tests {
    use guideway_render::FrameSize;

    use super::*;

    fn start() -> View {
        View::new(FrameSize::new(640, 360).unwrap(), Point::new(3.0, 4.0), 2.0).unwrap()
    }

    #[test]
    fn panning_goes_by_whole_and_part_pixels_and_comes_back() {
        let shift_px = |frame| {
            let view = Motion::Pan.view(&start(), frame).unwrap();
            (view.center_m().x - 3.0) * 2.0
        };
        assert_eq!([0, 1, 2, 3].map(shift_px), [0.0, 5.0, 7.375, 12.375]);
        assert_eq!(shift_px(2 * TURN), 0.0);
        assert_eq!(shift_px(TURN + 1), shift_px(TURN - 1));
    }

    #[test]
    fn zooming_comes_nearer_and_goes_away_again() {
        let scale = |frame| Motion::Zoom.view(&start(), frame).unwrap().px_per_m();
        assert!(scale(1) > scale(0) && scale(TURN) > scale(TURN + 1));
        assert_eq!(scale(2 * TURN), 2.0);
    }

    #[test]
    fn what_stands_still_is_seen_from_one_place() {
        for motion in [Motion::Still, Motion::Edit] {
            assert_eq!(motion.view(&start(), 7).unwrap(), start());
        }
    }
}
