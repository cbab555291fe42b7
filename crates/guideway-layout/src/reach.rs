//! Compares the positions of a layout with a limit.

use guideway_spline::Point;

use crate::Layout;

impl Layout {
    /// The first element with a position, a width or a height that is not finite or farther from 0
    /// than `limit_m` meters, as text: `path A-1`.
    pub fn first_beyond(&self, limit_m: f64) -> Option<String> {
        let is_within = |v: f64| v.abs() <= limit_m;
        let is_near = |p: Point<f64>| is_within(p.x) && is_within(p.y);
        let path = self.paths.geometry().first_beyond(limit_m);
        let path = path.or_else(|| {
            let widths = self.paths.width_m().unwrap_or_default();
            // A path without a width of its own has NaN.
            widths
                .iter()
                .position(|&w| !w.is_nan() && !is_within(w.into()))
        });
        let node = || (0..self.nodes.len() as u32).find(|&n| !is_near(self.nodes.position_m(n)));
        let station = || {
            let far = |&s: &u32| self.stations.position_m(s).is_some_and(|p| !is_near(p));
            (0..self.stations.len() as u32).find(far)
        };
        let zone = || {
            let is_far = |outline: &[Point<f64>]| !outline.iter().all(|&p| is_near(p));
            self.zones.iter().find(|zone| is_far(&zone.outline_m))
        };
        let level = || {
            let is_far = |height: Option<f64>| height.is_some_and(|h| !is_within(h));
            self.levels.iter().find(|level| is_far(level.elevation_m))
        };
        path.map(|row| format!("path {:?}", self.paths.id(row)))
            .or_else(|| node().map(|row| format!("node {:?}", self.nodes.id(row))))
            .or_else(|| station().map(|row| format!("station {:?}", self.stations.id(row))))
            .or_else(|| zone().map(|zone| format!("zone {:?}", zone.id)))
            .or_else(|| level().map(|level| format!("level {:?}", level.id)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Level, NewPath, Zone};

    #[test]
    fn names_the_first_element_beyond_the_limit() {
        for far in [11.0, -11.0, f64::NAN, f64::INFINITY] {
            let mut layout = Layout::default();
            layout.nodes.push("near", Point::new(10.0, -10.0), None);
            // A path without a curve has no position.
            layout.paths.push(&NewPath::default());
            assert_eq!(layout.first_beyond(10.0), None);
            layout.levels.push(Level {
                elevation_m: Some(far),
                ..Level::default()
            });
            assert_eq!(layout.first_beyond(10.0), Some("level \"\"".into()));
            layout.zones.push(Zone {
                id: "Z".into(),
                outline_m: vec![Point::new(0.0, far)],
                ..Zone::default()
            });
            assert_eq!(layout.first_beyond(10.0), Some("zone \"Z\"".into()));
            layout.nodes.push("N", Point::new(far, 0.0), None);
            assert_eq!(layout.first_beyond(10.0), Some("node \"N\"".into()));
        }
    }
}
