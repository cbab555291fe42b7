//! Wording that findings about paths and about walls share.

/// `overlap with`, or the distance of vehicles to something.
pub(super) fn approach(distance_m: f64) -> String {
    if distance_m == 0.0 {
        "overlap with".to_owned()
    } else {
        format!("come within {distance_m:.2} m of")
    }
}
