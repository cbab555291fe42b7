use eframe::egui::{FontId, Painter, Pos2, Stroke, Vec2};
use guideway_document::decorations::path_outline;
use guideway_document::measure::{Bend, bends, length_m, tightest_radius_m};
use guideway_document::{drawn_path, text_format};
use guideway_layout::PathRef;
use guideway_scene::View;
use guideway_spline::Point;

use super::canvas::Screen;
use super::paint::{HOVERED, OUTLINE, paint_outline, write_on_paper};
use crate::app::{App, Tool};

/// A path less bent than this is as good as straight.
const STRAIGHT_M: f64 = 1e5;

impl App {
    /// What is being drawn or measured: the points so far and the one at the pointer, the curve that they make, and how
    /// long it is.
    pub(super) fn paint_draft(
        &self,
        painter: &Painter,
        screen: Screen,
        view: &View,
        points_m: &[Point<f64>],
    ) {
        let next = self.pointer_px.map(|at| view.world_from_pixel(at));
        let modifiers = painter.ctx().input(|input| input.modifiers);
        let next = next.map(|at_m| self.snapped(view, at_m, modifiers));
        let all: Vec<Point<f64>> = points_m.iter().copied().chain(next).collect();
        let place = |&at_m| screen.point(view.pixel_from_world(at_m));
        let corners: Vec<Pos2> = all.iter().map(place).collect();
        for at in &corners {
            painter.circle_filled(*at, 3.0, HOVERED);
        }
        let Some(&last) = corners.last() else {
            return;
        };
        let text = if self.tool == Tool::Measure {
            painter.line(corners, Stroke::new(1.5, HOVERED));
            measured(&all)
        } else {
            painter.line(corners, Stroke::new(1.0, HOVERED.gamma_multiply(0.5)));
            drawn_path(&all).map_or_else(String::new, |layout| {
                let path = layout.paths.get(0);
                let outline = path_outline(path, view);
                paint_outline(painter, &outline, Stroke::new(OUTLINE, HOVERED), |pixel| {
                    screen.point(pixel)
                });
                shape_text(path, &bends(path))
            })
        };
        let beside = last + Vec2::new(12.0, -12.0);
        write_on_paper(
            painter,
            &self.look,
            beside,
            &text,
            FontId::proportional(13.0),
        );
    }
}

fn measured(points: &[Point<f64>]) -> String {
    let lengths = points.array_windows().map(|[a, b]| a.distance(*b));
    let (last_m, all_m) = lengths.fold((0.0, 0.0), |(_, all), length| (length, all + length));
    let Some([a, b]) = points.last_chunk() else {
        return String::new();
    };
    let way = *b - *a;
    let angle = way.y.atan2(way.x).to_degrees();
    let last = format!("{} at {angle:.1}°", text_format::length(last_m));
    if points.len() > 2 {
        format!("{last}, {} in all", text_format::length(all_m))
    } else {
        last
    }
}

/// How long a path is, and how tight its bends, which are given.
pub(super) fn shape_text(path: PathRef<'_>, bends: &[Bend]) -> String {
    let length = text_format::length(length_m(path));
    let radius_m = tightest_radius_m(bends);
    match radius_m.is_finite() && radius_m < STRAIGHT_M {
        true => format!(
            "{length} long, tightest bend {}",
            text_format::length(radius_m)
        ),
        false => format!("{length} long, straight"),
    }
}
