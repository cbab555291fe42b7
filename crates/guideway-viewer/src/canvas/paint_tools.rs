//! Paints the route with its vehicle, and what is gone, new and changed in a comparison.

use eframe::egui::{Color32, Painter, Pos2, Shape, Stroke};
use guideway_document::decorations::outline;
use guideway_document::{Document, Elements, PathSet};
use guideway_envelope::{ConvexPolygon, EnvelopeSource};
use guideway_scene::View;
use guideway_spline::Point;

use super::paint_gesture::paint_outline;
use super::screen::Screen;
use crate::compare::{ChangeKind, Changed};
use crate::route::FoundRoute;

const ROUTE_COLOR: Color32 = Color32::from_rgb(0, 150, 160);
const VEHICLE_COLOR: Color32 = Color32::from_rgb(0, 110, 120);
const ROUTE_WIDTH: f32 = 5.0;
/// Radius of the marks at start and goal, and at changed nodes, in points.
const MARK_RADIUS: f32 = 7.0;
/// Most marks of changed nodes and stations in a view.
const MAX_MARKS: usize = 2_000;
const AREA_OPACITY: f32 = 0.25;

/// The color of a change, readable on light and dark.
pub(crate) fn change_color(kind: ChangeKind) -> Color32 {
    match kind {
        ChangeKind::Gone => Color32::from_rgb(214, 48, 49),
        ChangeKind::New => Color32::from_rgb(20, 150, 70),
        ChangeKind::Changed => Color32::from_rgb(200, 120, 0),
    }
}

/// A view on the screen.
#[derive(Clone, Copy)]
pub(super) struct ToolPainter<'a> {
    pub(super) painter: &'a Painter,
    pub(super) screen: Screen,
    pub(super) view: &'a View,
}

impl ToolPainter<'_> {
    fn point(self, at_m: Point<f64>) -> Pos2 {
        self.screen.point(self.view.pixel_from_world(at_m))
    }

    fn outline(self, document: &Document, paths: &PathSet, stroke: Stroke) {
        let lines = outline(document, paths, self.view);
        paint_outline(self.painter, &lines, stroke, |px| self.screen.point(px));
    }

    fn polygon(self, polygon: &ConvexPolygon, at_m: Point<f64>, fill: Color32, stroke: Stroke) {
        let points = polygon.points().iter();
        let points = points.map(|&corner| self.point(at_m + corner)).collect();
        self.painter
            .add(Shape::convex_polygon(points, fill, stroke));
    }

    /// Paints the swept area of a route. Its parts overlap, so they are opaque.
    pub(super) fn route_area(self, route: &FoundRoute, background: Color32) {
        let fill = background.lerp_to_gamma(ROUTE_COLOR, AREA_OPACITY);
        let origin = Point::new(0.0, 0.0);
        for polygon in &route.area {
            self.polygon(polygon, origin, fill, Stroke::NONE);
        }
    }

    /// Paints a route, and the vehicle after a part of the way.
    pub(super) fn route(
        self,
        document: &Document,
        route: &FoundRoute,
        driven: f32,
        vehicle: Option<EnvelopeSource>,
    ) {
        let stroke = Stroke::new(ROUTE_WIDTH, ROUTE_COLOR.gamma_multiply(0.7));
        self.outline(document, &route.paths, stroke);
        let length_m = route.track.length_m();
        for (along_m, is_filled) in [(0.0, false), (length_m, true)] {
            if let Some((at_m, _)) = route.track.pose(along_m) {
                let fill = if is_filled {
                    ROUTE_COLOR
                } else {
                    Color32::WHITE
                };
                let stroke = Stroke::new(2.5, ROUTE_COLOR);
                let at = self.point(at_m);
                self.painter.circle(at, MARK_RADIUS, fill, stroke);
            }
        }
        let pose = route.track.pose(f64::from(driven) * length_m);
        if let (Some((at_m, heading)), Some(EnvelopeSource::Vehicle(body))) = (pose, vehicle) {
            let fill = VEHICLE_COLOR.gamma_multiply(0.5);
            let stroke = Stroke::new(1.5, VEHICLE_COLOR);
            self.polygon(&body.at_heading(heading), at_m, fill, stroke);
            let front = Point::new(heading.cos(), heading.sin()) * body.front_m;
            let line = [self.point(at_m), self.point(at_m + front)];
            self.painter.line_segment(line, stroke);
        }
    }

    /// Paints the changes from one document to another.
    pub(super) fn changes(self, other: &Document, active: &Document, changed: &Changed) {
        for (document, elements, kind) in [
            (other, &changed.gone, ChangeKind::Gone),
            (active, &changed.changed, ChangeKind::Changed),
            (active, &changed.new, ChangeKind::New),
        ] {
            let stroke = Stroke::new(3.0, change_color(kind));
            self.outline(document, &elements.paths, stroke);
            for at_m in places(document, elements, self.view) {
                let at = self.point(at_m);
                self.painter.circle_stroke(at, MARK_RADIUS, stroke);
            }
        }
    }
}

/// Positions of nodes and stations in a view.
fn places(document: &Document, elements: &Elements, view: &View) -> Vec<Point<f64>> {
    let bounds = view.world_bounds();
    let nodes = elements.nodes.iter();
    let nodes = nodes.map(|node| document.node_position_m(node));
    let stations = elements.stations.iter();
    let stations = stations.filter_map(|station| document.station_position_m(station));
    let visible = nodes.chain(stations).filter(|at_m| bounds.contains(*at_m));
    visible.take(MAX_MARKS).collect()
}
