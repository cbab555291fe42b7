//! Compares the coverage of each method with the oracle, for lines across the borders of grid
//! cells.
//!
//! The grid of the thesis enters a line in the cells of its bounding box, but the stroke extends
//! beyond them by its radius, and loses coverage there.

use guideway_scene::{Frame, FrameSize, RenderError, View};

use crate::reproduce::deadline::Deadline;
use crate::reproduce::names::ORACLE;
use crate::reproduce::run::{Border, Results};
use crate::reproduce::session::Session;
use guideway_bench::Dataset;

/// One hall, small enough for the slow oracle; its cells are then some 20 pixels wide.
const PATHS: usize = 1_000;
const SIZE_PX: [u32; 2] = [480, 270];
const PX_PER_M: f64 = 20.0;

/// Compares every method's coverage with the oracle's.
pub(crate) fn borders(
    session: &Session<'_>,
    _: Deadline,
    out: &mut Results,
) -> Result<(), RenderError> {
    let scene = session.scene(Dataset::D1, PATHS);
    let size = FrameSize::new(SIZE_PX[0], SIZE_PX[1])?;
    let center = View::fit(size, scene.bounds())?.center_m();
    let view = View::new(size, center, PX_PER_M)?;
    let expected = session.picture(ORACLE, &scene, &view)?;
    for spec in &session.plan.methods {
        if out.borders.iter().any(|border| border.method == *spec) {
            continue;
        }
        session.show_progress(&format!("coverage: {spec} against {ORACLE}"));
        let drawn = session.picture(spec, &scene, &view)?;
        out.borders.push(match (&expected, drawn) {
            (Ok(expected), Ok(drawn)) => compared(spec, expected, &drawn),
            (Err(error), _) => not_compared(spec, format!("{ORACLE}: {error}")),
            (_, Err(error)) => not_compared(spec, error.to_string()),
        });
    }
    Ok(())
}

fn not_compared(spec: &str, why_not: String) -> Border {
    Border {
        method: spec.to_owned(),
        lost: None,
        added: None,
        why_not: Some(why_not),
    }
}

fn compared(spec: &str, expected: &Frame, drawn: &Frame) -> Border {
    let (mut all, mut lost, mut added) = (0.0, 0.0, 0.0);
    for (expected, seen) in expected.pixels().iter().zip(drawn.pixels()) {
        let (expected, seen) = (coverage(expected), coverage(seen));
        all += expected;
        lost += (expected - seen).max(0.0);
        added += (seen - expected).max(0.0);
    }
    if all == 0.0 {
        return not_compared(spec, format!("the picture of {ORACLE} is empty"));
    }
    Border {
        method: spec.to_owned(),
        lost: Some(lost / all),
        added: Some(added / all),
        why_not: None,
    }
}

/// Coverage of a pixel: paths are black on white.
fn coverage(&[red, ..]: &[u8; 4]) -> f64 {
    1.0 - f64::from(red) / 255.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(levels: [u8; 4]) -> Frame {
        let mut frame = Frame::new(FrameSize::new(4, 1).unwrap());
        for (pixel, level) in frame.pixels_mut().iter_mut().zip(levels) {
            *pixel = [level, level, level, 255];
        }
        frame
    }

    #[test]
    fn separates_missing_and_surplus_coverage() {
        let expected = frame([0, 0, 255, 255]);
        let same = compared("a", &expected, &expected);
        assert_eq!((same.lost, same.added), (Some(0.0), Some(0.0)));
        let drawn = compared("a", &expected, &frame([0, 255, 0, 0]));
        assert_eq!((drawn.lost, drawn.added), (Some(0.5), Some(1.0)));
    }

    #[test]
    fn rejects_an_empty_picture_of_the_oracle() {
        let empty = frame([255; 4]);
        assert!(compared("a", &empty, &empty).why_not.is_some());
    }
}
