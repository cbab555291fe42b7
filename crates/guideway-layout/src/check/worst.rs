//! [`Worst`]: the worst of several defects of one kind on one path, and their number.

use guideway_spline::Point;

/// The worst defect of one kind on one path: a finding describes it and counts the others.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worst {
    /// Size of the worst defect.
    pub(super) value: f64,
    /// Position of the worst defect, in meters.
    pub(super) at: Point<f64>,
    /// Number of defects.
    pub(super) count: usize,
}

impl Worst {
    /// Adds a defect to the ones found so far.
    pub(super) fn add(found: &mut Option<Self>, value: f64, at: Point<f64>) {
        let count = 1 + found.map_or(0, |w| w.count);
        *found = match *found {
            Some(worst) if worst.value >= value => Some(Self { count, ..worst }),
            _ => Some(Self { value, at, count }),
        };
    }

    /// Suffix of the message, such as `, and at 3 other places`; empty for a single defect.
    pub(super) fn others(self) -> String {
        match self.count {
            1 => String::new(),
            2 => ", and at another place".to_owned(),
            n => format!(", and at {} other places", n - 1),
        }
    }
}
