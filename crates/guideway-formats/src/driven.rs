//! Driven nodes: tells nodes for vehicles from those of walls, doors and the lanes of humans, which
//! a layout of Open-RMF holds too.

use guideway_layout::Layout;

/// Returns for each node whether vehicles may reach it: all but those of walls and doors only. A
/// planner that looks for the nearest node would else start there.
pub(crate) fn driven_nodes(layout: &Layout) -> Vec<bool> {
    let mut is_end = vec![[false; 2]; layout.nodes.len()];
    for path in layout.paths.iter() {
        let is_driven = layout.paths.is_driven(path.row());
        for node in [path.start_node(), path.end_node()].into_iter().flatten() {
            is_end[node as usize][usize::from(is_driven)] = true;
        }
    }
    let ends = is_end.into_iter();
    ends.map(|[of_others, of_driven]| of_driven || !of_others)
        .collect()
}
