//! Paints a pin at the place of each finding, colored by its severity.

use std::collections::HashSet;

use eframe::egui::{Align2, Color32, FontId, Painter, Stroke, Vec2};
use guideway_layout::Severity;
use guideway_scene::View;

use super::screen::Screen;
use crate::editing::{Findings, MarkedSeverities};

/// Most pins in a view.
const MAX_PINS: usize = 500;
/// Side of a square that gets one pin, in points: a pin and its rim.
const CELL: f32 = 16.0;
/// From the place of a finding to the center of the head of its pin.
const HEAD_OFFSET: Vec2 = Vec2::new(0.0, -16.0);
const HEAD_RADIUS: f32 = 6.5;
/// Opacity of findings that predate the last change.
const OLD_OPACITY: f32 = 0.4;

/// The color of findings, readable on light and dark.
pub(crate) fn severity_color(severity: Severity) -> Color32 {
    match severity {
        Severity::Error => Color32::from_rgb(214, 48, 49),
        Severity::Warning => Color32::from_rgb(200, 120, 0),
        Severity::Info => Color32::from_rgb(70, 130, 190),
    }
}

/// Paints the pins of the marked findings; faint ones if the findings are old.
pub(super) fn paint_findings(
    painter: &Painter,
    screen: Screen,
    view: &View,
    findings: &Findings,
    marked: MarkedSeverities,
    is_old: bool,
) {
    let visible = view.world_bounds();
    let mut taken = HashSet::new();
    let mut pins = Vec::new();
    for mark in &findings.marks {
        if !marked.has(mark.severity) || !visible.contains(mark.at_m) {
            continue;
        }
        let at = screen.point(view.pixel_from_world(mark.at_m));
        let cell = ((at.x / CELL) as i32, (at.y / CELL) as i32);
        if taken.insert(cell) {
            pins.push((at, mark.severity));
        }
        if pins.len() == MAX_PINS {
            break;
        }
    }
    let opacity = if is_old { OLD_OPACITY } else { 1.0 };
    // The most severe ones are painted last.
    for (at, severity) in pins.into_iter().rev() {
        let color = severity_color(severity).gamma_multiply(opacity);
        let rim = Color32::WHITE.gamma_multiply(opacity);
        let head = at + HEAD_OFFSET;
        painter.line_segment([at, head], Stroke::new(2.0, color));
        painter.circle(head, HEAD_RADIUS, color, Stroke::new(1.0, rim));
        let sign = if severity == Severity::Info { "i" } else { "!" };
        let font = FontId::proportional(2.0 * HEAD_RADIUS - 2.0);
        painter.text(head, Align2::CENTER_CENTER, sign, font, rim);
    }
}
