//! Losses of the LIF writers: the parts of a layout that LIF does not hold, or holds in another
//! form.

use std::borrow::Cow;
use std::collections::BTreeSet;

use guideway_layout::{Attributes, Direction, Layout, VehicleType};

use super::columns::MemberColumns;
use super::elements::Elements;
use super::network::Network;
use crate::Losses;
use crate::json::Tree;
use crate::lif::members::{EDGE_ID, LAYOUT, META, ORIGIN, ORIGIN_OTHER, OTHER, TYPE_OTHER};
use crate::lif::version::Version;
use crate::trajectory::TRAJECTORY_COLUMN;

/// The speed against the direction of a path.
const REVERSE_SPEED: &str = "maxReverseSpeed";

/// Adds what both ways to save LIF lose.
pub(in crate::lif) fn add_lost(elements: &Elements<'_>, losses: &mut Losses) {
    let layout = elements.layout;
    losses.add_widths(layout);
    losses.add_colors(layout);
    losses.add_ranks(layout);
    let origins = usize::from(layout.geo_origin.is_some());
    losses.add("geo origin", origins, "place on earth of the origin");
    losses.add_blocks(layout);
    losses.add("zones", layout.zones.len(), "zones");
    let is_part = |name: &str| {
        elements.version == Version::V2 && matches!(name, "manufacturer" | "seriesName")
            || elements.is_from_lif && name == OTHER && elements.version == Version::V2
    };
    let types = layout.vehicle_types.iter();
    let lost = types.filter(|t| t.attributes.iter().any(|column| !is_part(&column.name)));
    losses.add(
        "vehicle types",
        lost.count(),
        "vehicle types with properties of their own",
    );

    let named = names_of_elements(layout);
    let is_unused = |t: &&VehicleType| !named.contains(t.id.as_str());
    losses.add(
        "vehicle types",
        layout.vehicle_types.iter().filter(is_unused).count(),
        "vehicle types that no path and no node names",
    );

    let further: &[&str] = if elements.is_from_lif {
        &[OTHER, TYPE_OTHER]
    } else {
        &[]
    };
    let (of_path, of_node) = (&elements.edge_type[0], &elements.node_type);
    let of_curve = [EDGE_ID, TRAJECTORY_COLUMN];
    let held_of_curve: &[&str] = if elements.is_from_lif {
        &of_curve
    } else {
        &of_curve[..1]
    };
    let held = [further, held_of_curve].concat();
    let two_way = &elements.edge_type[1];
    let paths = [&elements.edge, of_path, two_way];
    let table = Table {
        columns: &layout.paths.attributes,
        of: "paths",
    };
    let is_two_way = |path: usize| layout.paths.get(path).direction() == Direction::Both;
    let is_counted = |name: &str, path: usize| {
        !elements.network.is_between_levels(path) && (name != REVERSE_SPEED || is_two_way(path))
    };
    add_columns_of(losses, table, &paths, &held, is_counted);
    let one_way = (0..layout.paths.len()).filter(|&path| !is_two_way(path));
    let speeds = one_way.filter(|&path| layout.paths.value(path, REVERSE_SPEED).is_some());
    losses.add(
        format!("column {REVERSE_SPEED}"),
        speeds.count(),
        "values of paths that are driven one way",
    );
    let of_types = &layout.paths.vehicle_types().attributes;
    add_columns(
        losses,
        of_types,
        "vehicle types on paths",
        &[of_path],
        further,
    );
    let nodes = [&elements.node, of_node];
    add_columns(losses, &layout.nodes.attributes, "nodes", &nodes, further);
    let of_types = &layout.nodes.vehicle_types().attributes;
    add_columns(
        losses,
        of_types,
        "vehicle types at nodes",
        &[of_node],
        further,
    );
    let stations = [&elements.station, &elements.station_position];
    add_columns(
        losses,
        &layout.stations.attributes,
        "stations",
        &stations,
        further,
    );
    for level in &layout.levels {
        let columns = [LAYOUT, ORIGIN].map(|names| elements.row_columns(&level.attributes, names));
        let held = match elements.version {
            Version::V1 => further.to_vec(),
            Version::V2 => [further, &[ORIGIN_OTHER][..further.len().min(1)]].concat(),
        };
        let columns = match elements.version {
            Version::V1 => vec![&columns[0]],
            Version::V2 => columns.iter().collect(),
        };
        add_columns(losses, &level.attributes, "levels", &columns, &held);
    }
    let meta = elements.row_columns(&layout.attributes, META);
    let is_held = |name: &str| further.contains(&name) || meta.has_source(name);
    let columns = layout.attributes.iter();
    let lost = columns.filter(|column| !is_held(&column.name)).count();
    losses.add(
        "layout properties",
        lost,
        "properties of the layout as a whole",
    );
}

/// The vehicle types that paths and nodes name.
fn names_of_elements(layout: &Layout) -> BTreeSet<&str> {
    let (paths, nodes) = (layout.paths.vehicle_types(), layout.nodes.vehicle_types());
    let of_paths = (0..paths.len()).flat_map(|row| paths.of(row));
    let of_nodes = (0..nodes.len()).flat_map(|row| nodes.of(row));
    of_paths.chain(of_nodes).collect()
}

/// Columns of a table; `of` names its rows.
#[derive(Clone, Copy)]
struct Table<'a> {
    columns: &'a Attributes,
    of: &'a str,
}

fn add_columns(
    losses: &mut Losses,
    columns: &Attributes,
    of: &str,
    members: &[&MemberColumns<'_>],
    held: &[&str],
) {
    add_columns_of(losses, Table { columns, of }, members, held, |_, _| true);
}

/// Adds the columns of a table that no member holds, and values that change, in the rows that
/// count.
fn add_columns_of(
    losses: &mut Losses,
    Table { columns, of }: Table<'_>,
    members: &[&MemberColumns<'_>],
    held: &[&str],
    is_counted: impl Fn(&str, usize) -> bool,
) {
    let columns = columns.iter();
    for column in columns.filter(|column| !held.contains(&column.name.as_str())) {
        let sources = members.iter().find(|m| m.has_source(&column.name));
        let what = format!("column {}", column.name);
        let is_counted = |row| is_counted(&column.name, row);
        let Some(sources) = sources else {
            let rows = (0..column.values.len()).filter(|&row| is_counted(row));
            let count = rows.filter(|&row| column.values.get(row).is_some()).count();
            losses.add(what, count, format!("values of {of}"));
            continue;
        };
        let [unfit, other_form] = sources.count_changed(column, is_counted);
        let detail = format!("values of {of} that the format cannot hold");
        losses.add(what.as_str(), unfit, detail);
        let detail = format!("values of {of}: held as another member");
        losses.add(what, other_form, detail);
    }
}

/// Adds what a whole new file has in another form: values that 1.0 requires, curves with other
/// knots, meta information.
pub(in crate::lif) fn add_required(elements: &Elements<'_>, losses: &mut Losses) {
    let layout = elements.layout;
    if elements.version == Version::V1 {
        let detail = "paths without a value: written as false, because the format requires one";
        losses.add(
            "column rotationAllowed",
            count_without_rotation(layout),
            detail,
        );
    }
    let is_rewritten = |path: &usize| elements.trajectories.is_rewritten(*path);
    let rewritten = (0..layout.paths.len()).filter(is_rewritten);
    let detail = "curves: written with knots from 0 to 1 and with weights from 1 on, those with \
                  weights of 0 as cubics without weights";
    losses.add("curves", rewritten.count(), detail);
    let [grown, implied] = count_changed_nodes(elements);
    let detail = "nodes: written with entries for the types of their paths";
    losses.add("vehicle types", grown, detail);
    let detail = "nodes: types without properties are read as those of their paths";
    losses.add("vehicle types", implied, detail);
    add_ends_between_levels(elements, losses);
    let detail = "time of the export and version of the format: those of the new file";
    losses.add("layout properties", count_new_meta(elements), detail);
}

/// Adds what a save loses by paths between levels, which the file did not draw before.
pub(in crate::lif) fn add_between_levels(elements: &Elements<'_>, losses: &mut Losses) {
    let paths = 0..elements.layout.paths.len();
    let between = paths.filter(|&path| elements.network.is_between_levels(path));
    Network::add_between_levels(between.count(), losses);
    add_ends_between_levels(elements, losses);
}

fn add_ends_between_levels(elements: &Elements<'_>, losses: &mut Losses) {
    let detail = "nodes of paths between levels: written with entries for the types of these paths";
    losses.add("vehicle types", count_ends_between_levels(elements), detail);
}

/// Counts the nodes with entries of their own that get more, and those whose entries a reader takes
/// for implied: without values, and for the types of their paths.
fn count_changed_nodes(elements: &Elements<'_>) -> [usize; 2] {
    let types = elements.layout.nodes.vehicle_types();
    let has_value =
        |entry| (types.attributes.iter()).any(|column| column.values.get(entry).is_some());
    let (mut grown, mut implied) = (0, 0);
    for node in 0..elements.layout.nodes.len() as u32 {
        let mut own = types.entries(node as usize);
        if own.is_empty() {
            continue;
        }
        let of_paths = elements.network.types_of_node(node).len();
        if elements.node_types(node).len() > own.len() {
            grown += 1;
        } else if of_paths == own.len() && !own.any(has_value) {
            implied += 1;
        }
    }
    [grown, implied]
}

/// Counts the nodes without entries of their own at paths between levels. A reader that does not
/// draw these paths does not know that the entries are theirs.
fn count_ends_between_levels(elements: &Elements<'_>) -> usize {
    let (layout, network) = (elements.layout, elements.network);
    let paths = 0..layout.paths.len();
    let ends = paths
        .filter(|&path| network.is_between_levels(path))
        .flat_map(|path| network.ends(path));
    let ends: BTreeSet<u32> = ends.collect();
    let types = layout.nodes.vehicle_types();
    let is_open = |node: &&u32| {
        (**node as usize) < layout.nodes.len() && types.entries(**node as usize).is_empty()
    };
    ends.iter().filter(is_open).count()
}

/// Counts the paths without a value for `rotationAllowed`.
fn count_without_rotation(layout: &Layout) -> usize {
    let names = ["rotationAllowed", "reachOrientationBeforeEntering"];
    let is_without = |path: &usize| {
        let mut names = names.iter();
        let has_value = |name: &&str| {
            let types = layout.paths.vehicle_types();
            let in_entry = |entry| types.attributes.value(entry, name).is_some();
            let entries = types.entries(*path);
            layout.paths.attributes.value(*path, name).is_some()
                || !entries.is_empty() && entries.clone().all(in_entry)
        };
        !names.any(has_value)
    };
    let may_have = names.iter().any(|name| layout.paths.has_column(name));
    match may_have {
        true => (0..layout.paths.len()).filter(is_without).count(),
        false => layout.paths.len(),
    }
}

/// Counts the members of the meta information that the new file replaces.
fn count_new_meta(elements: &Elements<'_>) -> usize {
    let mut old = Vec::new();
    let columns = elements.row_columns(&elements.layout.attributes, META);
    columns.add_to(&mut old, 0, None);
    let version = Tree::Text(elements.version.stated().into());
    let is_replaced = |(name, value): &&(Cow<'_, str>, Tree<'_>)| {
        name == "exportTimestamp" || name == "lifVersion" && *value != version
    };
    old.iter().filter(is_replaced).count()
}
