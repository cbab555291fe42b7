//! Paints the network that a drawing would become: joined ends, cuts, stations, notes left out.

use std::collections::HashSet;

use eframe::egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, Vec2};
use guideway_document::text_format::single_line;
use guideway_scene::View;
use guideway_spline::Point;

use super::screen::Screen;
use crate::network_draft::Drafted;

pub(crate) const JOINED_COLOR: Color32 = Color32::from_rgb(200, 120, 0);
pub(crate) const CUT_COLOR: Color32 = Color32::from_rgb(30, 120, 255);
pub(crate) const STATION_COLOR: Color32 = Color32::from_rgb(20, 150, 70);
const LEFT_COLOR: Color32 = Color32::from_gray(128);
/// Half the size of a mark, in points.
const RADIUS: f32 = 5.0;
/// Side of a square that gets one mark of a kind, in points.
const CELL: f32 = 8.0;
/// Stations in a view up to which their names are shown.
const MAX_NAMED: usize = 60;
const NAME_CHARS: usize = 30;
/// Most stations in a view.
const MAX_STATIONS: usize = 2_000;

/// Paints the marks; `ink` is the color of names.
pub(super) fn paint_network(
    painter: &Painter,
    screen: Screen,
    view: &View,
    drafted: &Drafted,
    ink: Color32,
) {
    let bounds = view.world_bounds();
    let point = |at_m: Point<f64>| screen.point(view.pixel_from_world(at_m));
    let spread = |places: &mut dyn Iterator<Item = Point<f64>>| -> Vec<Pos2> {
        let mut taken = HashSet::new();
        let visible = places.filter(|at_m| bounds.contains(*at_m)).map(point);
        let is_free = |at: &Pos2| taken.insert(((at.x / CELL) as i32, (at.y / CELL) as i32));
        visible.filter(is_free).collect()
    };
    let report = &drafted.report;
    let stroke = |color| Stroke::new(1.8, color);
    for at in spread(&mut report.left_notes.iter().map(|note| note.position_m)) {
        painter.circle_stroke(at, 0.6 * RADIUS, stroke(LEFT_COLOR));
    }
    for at in spread(&mut report.cuts_m.iter().copied()) {
        for turn in [1.0, -1.0] {
            let arm = Vec2::new(0.8 * RADIUS, 0.8 * turn * RADIUS);
            painter.line_segment([at - arm, at + arm], stroke(CUT_COLOR));
        }
    }
    for at in spread(&mut report.gaps_m.iter().copied()) {
        painter.circle_stroke(at, RADIUS, stroke(JOINED_COLOR));
    }
    let stations = &drafted.layout.stations;
    let visible = (0..stations.len() as u32).filter_map(|row| {
        let at_m = drafted.layout.station_position_m(row)?;
        bounds.contains(at_m).then(|| (row, point(at_m)))
    });
    let visible: Vec<(u32, Pos2)> = visible.take(MAX_STATIONS).collect();
    for &(row, at) in &visible {
        let corners = [
            (0.0, -1.0),
            (1.0, 0.0),
            (0.0, 1.0),
            (-1.0, 0.0),
            (0.0, -1.0),
        ];
        let corner = |(x, y): (f32, f32)| at + 1.3 * RADIUS * Vec2::new(x, y);
        painter.line(corners.map(corner).to_vec(), stroke(STATION_COLOR));
        if visible.len() <= MAX_NAMED {
            let name = single_line(stations.id(row), NAME_CHARS);
            let (at, font) = (at + Vec2::new(8.0, -8.0), FontId::proportional(12.0));
            painter.text(at, Align2::LEFT_BOTTOM, name, font, ink);
        }
    }
}
