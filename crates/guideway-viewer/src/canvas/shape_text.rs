//! The text about length and bends of a path.

use crate::language::say;
use guideway_document::measure::{Bend, tightest_radius_m};
use guideway_document::text_format;
use guideway_layout::PathRef;

/// A path whose tightest bend exceeds this radius counts as straight, in meters.
const STRAIGHT_RADIUS_M: f64 = 1e5;

/// Length and tightest bend of a path with these bends.
pub(crate) fn shape_text(path: PathRef<'_>, bends: &[Bend]) -> String {
    let length = text_format::length(path.length_m());
    match is_bent(bends) {
        true => {
            let radius = text_format::length(tightest_radius_m(bends));
            say!("{length} long, tightest bend {radius}", length, radius)
        }
        false => say!("{length} long, straight", length),
    }
}

/// Returns `true` if a path with these bends is not straight.
pub(super) fn is_bent(bends: &[Bend]) -> bool {
    tightest_radius_m(bends) < STRAIGHT_RADIUS_M
}

#[cfg(test)]
mod tests {
    use guideway_document::measure::bends;

    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn straight_path_has_no_radius() {
        let layout = lanes(1);
        let path = layout.paths.get(0);
        assert_eq!(shape_text(path, &bends(path)), "10 m long, straight");
    }
}
