//! Lengths: compares the lengths that a file states with those of the curves.

use guideway_spline::run_length;

use super::element::{element_name, element_place};
use super::scale::Tolerances;
use crate::{Code, Diagnostics, Layout, Member, PathRef, Place, Quantity, Severity};

/// Column of the stated lengths.
const LENGTH: &str = "length";
/// Factor from which on a stated length differs. Measured: up to 1.64 in a public plant model,
/// whose plan is not to scale.
const DIFFERENT: f64 = 2.0;
/// Factor from which on a stated length has probably another unit.
const WRONG: f64 = 9.0;
/// Largest error of the length of a run, as a share of the size of its path.
const LENGTH_TOLERANCE: f64 = 0.01;

/// A stated length that differs from that of its curve.
struct Difference {
    row: usize,
    stated_m: f64,
    length_m: f64,
    /// The greater length over the smaller one.
    factor: f64,
}

/// Reports the stated lengths that differ from those of the curves, once for the whole column.
///
/// A plan need not be to scale, and 0 may stand for an unknown length: only a factor that suggests
/// another unit is a warning.
pub(super) fn check(layout: &Layout, tolerances: &Tolerances, found: &mut Diagnostics) {
    let paths = &layout.paths;
    let column = paths.attributes.iter().find(|column| column.name == LENGTH);
    if column.is_none_or(|column| column.quantity != Some(Quantity::Length)) {
        return;
    }
    let difference = |path: PathRef<'_>| {
        let stated_m = paths.value(path.row(), LENGTH)?.number()?;
        let length_m = length_m(path, tolerances)?;
        let factor = (stated_m / length_m).max(length_m / stated_m);
        (stated_m >= 0.0 && factor >= DIFFERENT).then_some(Difference {
            row: path.row(),
            stated_m,
            length_m,
            factor,
        })
    };
    let (mut worst, mut count): (Option<Difference>, usize) = (None, 0);
    for different in paths.iter().filter_map(difference) {
        count += 1;
        let rank = |difference: &Difference| match difference.stated_m > 0.0 {
            true => difference.factor,
            false => 0.0,
        };
        if worst
            .as_ref()
            .is_none_or(|worst| rank(&different) > rank(worst))
        {
            worst = Some(different);
        }
    }
    let Some(worst) = worst else {
        return;
    };
    let severity = match worst.factor >= WRONG && worst.stated_m > 0.0 {
        true => Severity::Warning,
        false => Severity::Info,
    };
    let id = paths.id(worst.row);
    found.push_as(
        severity,
        Code::Implausible,
        || Place {
            origin: element_place(Member::Path(worst.row as u32), id).origin,
            ..Place::element("column length of paths")
        },
        || {
            let (name, stated_m) = (element_name("path", worst.row, id), worst.stated_m);
            let others = match count - 1 {
                0 => String::new(),
                1 => ", and another length differs".to_owned(),
                n => format!(", and {n} other lengths differ"),
            };
            let length_m = worst.length_m;
            format!("{name} states {stated_m} m; its curve is {length_m:.3} m long{others}")
        },
        "Check the unit of the lengths; nothing to do if the plan is not to scale",
    );
}

/// The length of a path; `None` for a point.
fn length_m(path: PathRef<'_>, tolerances: &Tolerances) -> Option<f64> {
    let size = path.hull_bounds()?.size();
    let size_m = size.x.max(size.y);
    let runs = path.runs();
    let length = |run: crate::RunPoints<'_>| {
        run_length(&run.iter().collect::<Vec<_>>(), LENGTH_TOLERANCE * size_m)
    };
    (size_m > tolerances.gap_m).then(|| runs.map(length).sum())
}
