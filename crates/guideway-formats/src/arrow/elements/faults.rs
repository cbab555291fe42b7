//! Findings about elements whose values do not fit.

use guideway_layout::{Code, Diagnostics, Limits, Place};
use guideway_spline::Point;

use crate::arrow::element::Element;
use crate::text::printable;

/// Collects the findings about elements.
pub(super) struct Faults<'a> {
    pub(super) limits: &'a Limits,
    pub(super) diagnostics: &'a mut Diagnostics,
}

impl Faults<'_> {
    /// Adds a finding about an element.
    pub(super) fn report(
        &mut self,
        code: Code,
        kind: Element,
        id: &str,
        message: impl FnOnce() -> String,
        remedy: &str,
    ) {
        let place = || Place::element(format!("{} {:?}", kind.name(), printable(id)));
        self.diagnostics.push(code, place, message, remedy);
    }

    /// Returns the position, or reports why it is none. `remedy` says what happens without it.
    pub(super) fn position(
        &mut self,
        kind: Element,
        id: &str,
        position: [Option<f64>; 2],
        remedy: &str,
    ) -> Option<Point<f64>> {
        let [Some(x), Some(y)] = position else {
            let message = || "x_m or y_m is null".into();
            self.report(Code::MissingField, kind, id, message, remedy);
            return None;
        };
        self.point(kind, id, Point::new(x, y), remedy)
    }

    /// Returns a point within the limits, or reports it.
    pub(super) fn point(
        &mut self,
        kind: Element,
        id: &str,
        point: Point<f64>,
        remedy: &str,
    ) -> Option<Point<f64>> {
        let limit = self.limits.coordinate_m;
        if !point.is_finite() {
            let message = || "a coordinate is not finite".into();
            self.report(Code::NonFinite, kind, id, message, remedy);
            return None;
        }
        if point.x.abs().max(point.y.abs()) > limit {
            let message = || format!("a coordinate exceeds the limit of {limit} m");
            self.report(Code::OutOfRange, kind, id, message, remedy);
            return None;
        }
        Some(point)
    }
}
