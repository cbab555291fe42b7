//! The facts of a selection beside its properties: names, directions, levels, vehicle types.

use guideway_document::PathSet;
use guideway_layout::{Direction, Layout};
use guideway_scene::Table;

use super::field::{MAX_COMPARED, types_of};
use crate::language::t;

/// Facts that selected elements have in common.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Facts {
    /// Name of the element, if there is one.
    pub(super) name: Option<String>,
    /// Names of the nodes that serve the only station, with commas between.
    pub(super) nodes: Option<String>,
    /// Names of the ends of the only path.
    pub(super) ends: Option<[String; 2]>,
    /// Direction of the paths, if they have the same one.
    pub(super) direction: Option<Direction>,
    /// The level, if the elements are on the same one.
    pub(super) level: Option<Option<u32>>,
    /// Vehicle types of the elements, if they have the same ones; none means all.
    pub(super) vehicle_types: Option<Vec<String>>,
    /// All vehicle types of the layout, by name.
    pub(super) all_types: Vec<String>,
}

impl Facts {
    pub(super) fn new(layout: &Layout, of: Table, rows: &PathSet) -> Self {
        let some: Vec<u32> = rows.iter().take(MAX_COMPARED).collect();
        let only = some.first().copied().filter(|_| rows.len() == 1);
        let path = |row: u32| layout.paths.get(row as usize);
        let node = |node: Option<u32>| {
            node.map_or(t("none"), |node| layout.nodes.id(node))
                .to_owned()
        };
        let is_path = of == Table::Paths;
        let types = |row: u32| {
            let entries = of.entries(layout)?;
            Some(types_of(entries, &[row as usize]))
        };
        let all_types = layout.vehicle_type_names().into_iter();
        let all_types = all_types.map(str::to_owned).collect();
        Self {
            name: only.map(|row| of.id(layout, row).to_owned()),
            nodes: only.filter(|_| of == Table::Stations).map(|row| {
                let nodes = layout.stations.nodes(row).iter();
                let names: Vec<&str> = nodes.map(|&node| layout.nodes.id(node)).collect();
                names.join(", ")
            }),
            ends: only.filter(|_| is_path).map(|row| {
                let path = path(row);
                [path.start_node(), path.end_node()].map(node)
            }),
            direction: is_path
                .then(|| same(some.iter().map(|&row| path(row).direction())))
                .flatten(),
            level: same(some.iter().map(|&row| of.level(layout, row))),
            vehicle_types: same(some.iter().map(|&row| types(row))).flatten(),
            all_types,
        }
    }
}

/// The value of all, if it is the same.
fn same<T: PartialEq>(mut values: impl Iterator<Item = T>) -> Option<T> {
    let first = values.next()?;
    values.all(|value| value == first).then_some(first)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tests::services::lanes;

    #[test]
    fn single_path_has_a_name_and_ends() {
        let layout = lanes(2);
        let facts = Facts::new(&layout, Table::Paths, &[1].into_iter().collect());
        assert_eq!(facts.name.as_deref(), Some("lane 1"));
        assert_eq!(facts.ends, Some(["n1 0", "n1 10"].map(str::to_owned)));
        assert_eq!(facts.direction, Some(Direction::Forward));
        assert_eq!(
            (facts.level, facts.vehicle_types),
            (Some(None), Some(vec![]))
        );
    }

    #[test]
    fn several_paths_have_what_they_share() {
        let mut layout = lanes(2);
        layout.paths.vehicle_types_mut().set(1, &["tug"]);
        let facts = Facts::new(&layout, Table::Paths, &[0, 1].into_iter().collect());
        assert_eq!(
            (facts.name, facts.ends, facts.vehicle_types),
            (None, None, None)
        );
        assert_eq!(facts.all_types, ["tug"]);
    }
}
