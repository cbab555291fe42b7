//! The file of a floor plan and its placement, as the text that names both: see
//! [`read_floor_plan`](crate::AppServices::read_floor_plan).

use guideway_spline::{Affine, Point};

/// A file and where it lies on the floor.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PlanPlacement {
    pub(crate) file: String,
    /// Page of a PDF, from 1.
    pub(crate) page: Option<u32>,
    /// The size of the plan.
    pub(crate) size: PlanSize,
    /// Counter-clockwise rotation, in degrees.
    pub(crate) rotate_deg: f64,
    pub(crate) offset_m: Point<f64>,
}

/// The units of drawings by their signs, in meters.
pub(crate) const DRAWING_UNITS: [(&str, f64); 5] = [
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("m", 1.0),
    ("in", 0.0254),
    ("ft", 0.3048),
];

/// The size of a floor plan on the floor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum PlanSize {
    /// Pixels of the image per meter.
    PxPerM(f64),
    /// Factor of the lengths in the file.
    Scale(f64),
}

impl PlanSize {
    /// The size of a plan that is `factor` times as large.
    fn times(self, factor: f64) -> Self {
        match self {
            Self::PxPerM(px_per_m) => Self::PxPerM(px_per_m / factor),
            Self::Scale(scale) => Self::Scale(scale * factor),
        }
    }
}

impl PlanPlacement {
    /// The placement of a text; `None` for a text that the window did not write and does not
    /// understand.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut placement = Self {
            file: text.to_owned(),
            page: None,
            size: PlanSize::Scale(1.0),
            rotate_deg: 0.0,
            offset_m: Point::default(),
        };
        let Some((file, keys)) = text.rsplit_once('@').filter(|(_, keys)| keys.contains('='))
        else {
            return Some(placement);
        };
        placement.file = file.to_owned();
        let mut parts = keys.split(',');
        let number = |text: &str| {
            let number = text.trim().parse::<f64>().ok();
            number.filter(|number| number.is_finite())
        };
        while let Some(part) = parts.next() {
            let (key, value) = part.split_once('=')?;
            match key.trim() {
                "page" => placement.page = Some(value.trim().parse().ok()?),
                "px-per-m" => placement.size = PlanSize::PxPerM(number(value)?),
                "scale" => placement.size = PlanSize::Scale(number(value)?),
                "rotate" => placement.rotate_deg = number(value)?,
                "offset" => placement.offset_m = Point::new(number(value)?, number(parts.next()?)?),
                _ => return None,
            }
        }
        Some(placement)
    }

    /// The text of the placement.
    pub(crate) fn text(&self) -> String {
        let mut keys = Vec::from_iter(self.page.map(|page| format!("page={page}")));
        match self.size {
            PlanSize::PxPerM(px_per_m) => keys.push(format!("px-per-m={}", rounded(px_per_m))),
            PlanSize::Scale(1.0) => {}
            PlanSize::Scale(scale) => keys.push(format!("scale={}", rounded(scale))),
        }
        if self.rotate_deg != 0.0 {
            keys.push(format!("rotate={}", rounded(self.rotate_deg)));
        }
        let Point { x, y } = self.offset_m;
        if x != 0.0 || y != 0.0 || matches!(self.size, PlanSize::PxPerM(_)) {
            keys.push(format!("offset={},{}", rounded(x), rounded(y)));
        }
        match keys.is_empty() {
            true => self.file.clone(),
            false => format!("{}@{}", self.file, keys.join(",")),
        }
    }

    /// Returns `true` if the numbers of a drawing, read in the unit `assumed_m`, are in `unit_m`.
    /// Both are in meters.
    pub(crate) fn is_in_unit(&self, unit_m: f64, assumed_m: f64) -> bool {
        // Texts have rounded scales.
        let is_near = |scale: f64| (scale * assumed_m / unit_m - 1.0).abs() < 1e-4;
        matches!(self.size, PlanSize::Scale(scale) if is_near(scale))
    }

    /// The placement of a drawing, read in the unit `assumed_m`, whose numbers are in `unit_m`.
    pub(crate) fn in_unit(&self, unit_m: f64, assumed_m: f64) -> Self {
        Self {
            size: PlanSize::Scale(unit_m / assumed_m),
            ..self.clone()
        }
    }

    /// The placement after a move.
    pub(crate) fn moved(&self, by_m: Point<f64>) -> Self {
        Self {
            offset_m: self.offset_m + by_m,
            ..self.clone()
        }
    }

    /// The placement after the plan is scaled about a point that stays where it is.
    pub(crate) fn scaled_about(&self, center_m: Point<f64>, factor: f64) -> Self {
        let scale = Affine::scale(factor, factor, center_m);
        Self {
            size: self.size.times(factor),
            offset_m: scale.apply(self.offset_m),
            ..self.clone()
        }
    }

    /// The placement after the plan is turned about a point that stays where it is.
    pub(crate) fn turned_about(&self, center_m: Point<f64>, by_deg: f64) -> Self {
        let turn = Affine::rotation(by_deg.to_radians(), center_m);
        Self {
            // A turn of more than half a circle is one the other way.
            rotate_deg: (self.rotate_deg + by_deg + 180.0).rem_euclid(360.0) - 180.0,
            offset_m: turn.apply(self.offset_m),
            ..self.clone()
        }
    }

    /// The placement by which the points `from` and `to` of the plan are `distance_m` apart, and
    /// `from` stays. `None` where they are the same point, or the distance is no length.
    pub(crate) fn calibrated(
        &self,
        [from_m, to_m]: [Point<f64>; 2],
        distance_m: f64,
    ) -> Option<Self> {
        let factor = distance_m / from_m.distance(to_m);
        (factor.is_finite() && factor > 0.0).then(|| self.scaled_about(from_m, factor))
    }
}

/// A number without the digits that no floor plan needs: a tenth of a micrometer, a millionth of
/// other units.
fn rounded(number: f64) -> f64 {
    let digits = 1e7;
    match number.abs() < 1e-3 {
        // Small scales keep their digits.
        true => number,
        false => (number * digits).round() / digits,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_placement_are_inverse() {
        for text in [
            "hall.png@px-per-m=20,offset=0,0",
            "hall.png@px-per-m=20.5,rotate=-90,offset=-3,2.25",
            "plan.pdf@page=3,px-per-m=40,offset=0,0",
            "plan.dxf",
            "plan.dxf@scale=0.001",
            "a@b/plan.dxf@scale=0.0254,rotate=3,offset=1,-7",
            "me@work.dxf",
        ] {
            let placement = PlanPlacement::parse(text).unwrap();
            assert_eq!(placement.text(), text);
        }
        let placement = PlanPlacement::parse("a.png@ offset=1, 2 ,px-per-m=4").unwrap();
        assert_eq!(placement.text(), "a.png@px-per-m=4,offset=1,2");
        for text in [
            "a.png@px-per-m=x",
            "a.png@offset=1",
            "a@scale=2,3",
            "a@page=x",
            "a@sheet=3",
            "a@scale=inf",
        ] {
            assert_eq!(PlanPlacement::parse(text), None, "{text}");
        }
    }

    #[test]
    fn calibration_scales_about_the_first_point() {
        let image = PlanPlacement::parse("hall.png@px-per-m=20,offset=4,6").unwrap();
        let (from, to) = (Point::new(2.0, 6.0), Point::new(2.0, 16.0));
        let twice = image.calibrated([from, to], 20.0).unwrap();
        assert_eq!(twice.text(), "hall.png@px-per-m=10,offset=6,6");
        let drawing = PlanPlacement::parse("plan.dxf").unwrap();
        let thousandth = drawing.calibrated([Point::default(), Point::new(3000.0, 4000.0)], 5.0);
        assert_eq!(thousandth.unwrap().text(), "plan.dxf@scale=0.001");
        for (to, distance_m) in [(from, 3.0), (to, 0.0), (to, -1.0), (to, f64::NAN)] {
            assert_eq!(image.calibrated([from, to], distance_m), None);
        }
    }

    #[test]
    fn units_of_drawings_are_scales_of_the_assumed_one() {
        let plan = PlanPlacement::parse("plan.dxf@rotate=3,offset=1,-7").unwrap();
        for assumed_m in [1e-3, 0.0254] {
            for (sign, unit_m) in DRAWING_UNITS {
                let plan = PlanPlacement::parse(&plan.in_unit(unit_m, assumed_m).text()).unwrap();
                let known = DRAWING_UNITS.iter();
                let units: Vec<_> = known
                    .filter(|(_, unit_m)| plan.is_in_unit(*unit_m, assumed_m))
                    .map(|(sign, _)| *sign)
                    .collect();
                assert_eq!(units, [sign], "{}", plan.text());
            }
        }
        assert_eq!(plan.in_unit(1e-3, 1e-3), plan);
        let text = plan.in_unit(1.0, 1e-3).text();
        assert_eq!(text, "plan.dxf@scale=1000,rotate=3,offset=1,-7");
    }

    #[test]
    fn turn_keeps_its_center() {
        let image = PlanPlacement::parse("hall.png@px-per-m=20,offset=4,6").unwrap();
        let turned = image.turned_about(Point::new(4.0, 4.0), 90.0);
        assert_eq!(turned.text(), "hall.png@px-per-m=20,rotate=90,offset=2,4");
        let back = (0..3).fold(turned, |turned, _| {
            turned.turned_about(Point::new(4.0, 4.0), 90.0)
        });
        assert_eq!(back.text(), image.text());
    }
}
