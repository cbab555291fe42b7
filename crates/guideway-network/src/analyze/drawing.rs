//! Drawings: paths without nodes, whose ends may meet head on.

use std::collections::HashMap;

use guideway_layout::{
    Code, Diagnostics, Direction, DisplayPosition, Layout, Member, Place, Severity, element_place,
};

/// Ends within one cell of this size meet.
const CELL_M: f64 = 1e-3;

/// Ends at one place.
#[derive(Default)]
struct Ends {
    leading_in: u32,
    leading_out: u32,
    first: usize,
}

/// Reports that a drawing is no network, and where lines meet that were drawn toward each other.
pub(super) fn check(layout: &Layout, found: &mut Diagnostics) {
    let is_drawing = matches!(layout.provenance.format.as_str(), "DXF" | "SVG");
    if !is_drawing || layout.paths.is_empty() {
        return;
    }
    let mut places: HashMap<_, Ends> = HashMap::with_capacity(layout.paths.len());
    let cell = |v: f64| (v / CELL_M).round() as i64;
    for path in layout.paths.iter() {
        let Some((start, end)) = path.ends() else {
            continue;
        };
        let is_two_way = path.direction() == Direction::Both;
        for (at, is_end) in [(start, false), (end, true)] {
            let ends = places
                .entry((cell(at.x), cell(at.y)))
                .or_insert_with(|| Ends {
                    first: path.row(),
                    ..Ends::default()
                });
            ends.leading_in += u32::from(is_end || is_two_way);
            ends.leading_out += u32::from(!is_end || is_two_way);
        }
    }
    found.push(
        Code::NoNodes,
        || Place::element("drawing"),
        || {
            format!(
                "its {} paths have no nodes: no vehicle can drive from one to the next, and each \
                 is driven in the direction in which it was drawn",
                layout.paths.len()
            )
        },
        "Make a network of it by `guideway network`",
    );
    let head_on = places
        .into_iter()
        .filter(|(_, e)| e.leading_in >= 2 && e.leading_out == 0);
    let mut head_on: Vec<_> = head_on.collect();
    head_on.sort_unstable_by_key(|((x, y), ends)| (ends.first, *x, *y));
    for ((x, y), ends) in head_on {
        let at = [x, y].map(|v| v as f64 * CELL_M);
        found.push_as(
            Severity::Info,
            Code::HeadOn,
            || element_place(Member::Path(ends.first as u32), layout.paths.id(ends.first)),
            || {
                let at = DisplayPosition(guideway_spline::Point::new(at[0], at[1]));
                format!(
                    "{} paths are drawn toward each other and meet at {at}",
                    ends.leading_in
                )
            },
            "Reverse one of them; `guideway network` makes lines two-way unless a rule says \
             otherwise",
        );
    }
}
