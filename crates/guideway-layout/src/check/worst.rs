use guideway_spline::Point;

/// The worst of many findings of one kind on one path: a report names it and counts the rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worst {
    /// How bad the worst one is.
    pub(super) value: f64,
    /// Where it is.
    pub(super) at: Point<f64>,
    /// How many there are.
    pub(super) places: usize,
}

impl Worst {
    /// Adds one more to those found so far.
    pub(super) fn add(found: &mut Option<Self>, value: f64, at: Point<f64>) {
        let places = 1 + found.map_or(0, |w| w.places);
        *found = match *found {
            Some(worst) if worst.value >= value => Some(Self { places, ..worst }),
            _ => Some(Self { value, at, places }),
        };
    }

    /// `, and at 3 other places`, or nothing.
    pub(super) fn others(self) -> String {
        match self.places {
            1 => String::new(),
            2 => ", and at another place".to_owned(),
            n => format!(", and at {} other places", n - 1),
        }
    }
}
