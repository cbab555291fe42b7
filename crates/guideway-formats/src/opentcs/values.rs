//! Values of a layout as a plant model can hold them, and the tolerances of equal ones.

use guideway_layout::{Direction, Layout, Value};

/// Largest change of a position or curve that is not listed, in meters. Derived: rounding errors of
/// readers, and a hundredth of the resolution of a file.
pub(super) const SAME_M: f64 = 1e-5;

/// Largest relative difference of equal numbers: that of a few operations.
pub(super) const SAME_NUMBER: f64 = 1e-12;

/// A number that is finite.
pub(super) fn number(value: Option<Value<'_>>) -> Option<f64> {
    value?.number().filter(|number| number.is_finite())
}

/// The JSON of a value, if it is of a type.
pub(super) fn json<T: serde::de::DeserializeOwned>(value: Option<Value<'_>>) -> Option<T> {
    match value? {
        Value::Json(text) => serde_json::from_str(text).ok(),
        _ => None,
    }
}

/// A speed of 0 or more, up to the greatest one of openTCS.
pub(super) fn speed_mm_s(value: Option<Value<'_>>) -> Option<i32> {
    let mm_s = number(value)? * 1e3;
    let is_speed = (0.0..=f64::from(i32::MAX)).contains(&mm_s);
    // A slow path is not a closed one.
    is_speed.then(|| (mm_s.round() as i32).max(i32::from(mm_s > 0.0)))
}

/// Tells if a path is driven both ways.
pub(super) fn is_two_way(layout: &Layout, path: usize) -> bool {
    layout.paths.get(path).direction() == Direction::Both
}
