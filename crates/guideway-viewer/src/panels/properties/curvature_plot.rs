//! The plot of curvature over the length of a path, with axes and numbers.

use crate::language::{say, t};
use eframe::egui::{Align2, FontId, Pos2, Rect, Sense, Shape, Stroke, Ui, Vec2};
use guideway_document::measure::Bend;
use guideway_document::text_format;

const HEIGHT: f32 = 90.0;
/// Space for the numbers on the left and below, in points.
const LEFT: f32 = 46.0;
const BELOW: f32 = 14.0;
const TEXT_POINTS: f32 = 10.0;
/// A path that bends less than this is straight, in 1/m.
const MIN_CURVATURE: f64 = 1e-6;

/// Plots the bends of a path; the pointer reads a value.
pub(super) fn show(ui: &mut Ui, bends: &[Bend], length_m: f64) {
    if bends.is_empty() || length_m <= 0.0 {
        return;
    }
    let size = Vec2::new(ui.available_width(), HEIGHT);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    let top = rect.min + Vec2::new(LEFT, TEXT_POINTS / 2.0);
    let plot = Rect::from_min_max(top, rect.max - Vec2::new(4.0, BELOW));
    let curvatures = bends.iter().map(|bend| bend.curvature.abs());
    let most = curvatures.fold(MIN_CURVATURE, f64::max);
    let point = |bend: &Bend| {
        let x = (bend.along_m / length_m) as f32;
        let y = (0.5 - 0.5 * bend.curvature / most) as f32;
        plot.min + Vec2::new(x * plot.width(), y * plot.height())
    };
    let color = ui.visuals().text_color();
    let weak = ui.visuals().weak_text_color();
    let painter = ui.painter_at(rect);
    let axis = Stroke::new(1.0, weak.gamma_multiply(0.5));
    painter.vline(plot.left(), plot.y_range(), axis);
    painter.hline(plot.x_range(), plot.bottom(), axis);
    painter.hline(plot.x_range(), plot.center().y, axis);
    let text = |at: Pos2, align: Align2, text: String| {
        painter.text(at, align, text, FontId::proportional(TEXT_POINTS), weak);
    };
    for (y, curvature) in [
        (plot.top(), most),
        (plot.center().y, 0.0),
        (plot.bottom(), -most),
    ] {
        let at = Pos2::new(plot.left() - 3.0, y);
        text(at, Align2::RIGHT_CENTER, curvature_text(curvature, most));
    }
    for part in [0.0, 0.5, 1.0] {
        let at = Pos2::new(plot.left() + part * plot.width(), plot.bottom() + 1.0);
        let align =
            [Align2::LEFT_TOP, Align2::CENTER_TOP, Align2::RIGHT_TOP][(part * 2.0) as usize];
        let along_m = f64::from(part) * length_m;
        text(at, align, text_format::length(along_m));
    }
    let curve = bends.iter().map(point).collect();
    painter.add(Shape::line(curve, Stroke::new(1.5, color)));
    let pointed = response.hover_pos().and_then(|at| {
        let x = f64::from((at.x - plot.left()) / plot.width());
        nearest(bends, x * length_m)
    });
    if let Some(bend) = pointed {
        painter.circle_filled(point(bend), 3.0, color);
        response.on_hover_text_at_pointer(reading(bend));
    }
}

/// The bend nearest to a place along the path.
fn nearest(bends: &[Bend], along_m: f64) -> Option<&Bend> {
    let after = bends.partition_point(|bend| bend.along_m < along_m);
    let near = bends.get(after.saturating_sub(1)..bends.len().min(after + 1))?;
    let distance_m = |bend: &&Bend| (bend.along_m - along_m).abs();
    near.iter()
        .min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)))
}

/// `0.5 /m`; a straight path has no numbers but zero.
fn curvature_text(curvature: f64, most: f64) -> String {
    match most <= MIN_CURVATURE {
        true if curvature == 0.0 => "0 /m".to_owned(),
        true => String::new(),
        false => format!("{:.2} /m", curvature + 0.0),
    }
}

/// `at 3.2 m: 0.50 /m, radius 2 m to the left`.
fn reading(bend: &Bend) -> String {
    let along = text_format::length(bend.along_m);
    if bend.curvature.abs() <= MIN_CURVATURE {
        return say!("at {along}: straight", along);
    }
    let side = if bend.curvature > 0.0 {
        t("left")
    } else {
        t("right")
    };
    let radius = text_format::length(1.0 / bend.curvature.abs());
    say!(
        "at {along}: {curvature} /m, radius {radius} to the {side}",
        along,
        curvature = format!("{:.3}", bend.curvature),
        radius,
        side
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bend(along_m: f64, curvature: f64) -> Bend {
        Bend { along_m, curvature }
    }

    #[test]
    fn reading_says_place_radius_and_side() {
        assert_eq!(
            reading(&bend(3.25, -0.5)),
            "at 3.25 m: -0.500 /m, radius 2 m to the right"
        );
        assert_eq!(reading(&bend(1.0, 0.0)), "at 1 m: straight");
        assert_eq!(curvature_text(0.5, 0.5), "0.50 /m");
        assert_eq!(curvature_text(MIN_CURVATURE, MIN_CURVATURE), "");
    }

    #[test]
    fn pointer_reads_the_nearest_bend() {
        let bends = [bend(1.0, 0.1), bend(2.0, 0.2), bend(3.0, 0.3)];
        let read = |along_m| nearest(&bends, along_m).map(|bend| bend.along_m);
        assert_eq!(
            [-1.0, 1.4, 2.6, 9.0].map(read),
            [Some(1.0), Some(1.0), Some(3.0), Some(3.0)]
        );
        assert_eq!(nearest(&[], 1.0), None);
    }
}
