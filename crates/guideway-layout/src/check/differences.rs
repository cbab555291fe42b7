//! Differences of two paths on the same curve: the properties in which they do not agree.

use std::hash::{BuildHasher, Hash, Hasher, RandomState};

use super::element::element_name;
use crate::{Attribute, Direction, Layout, Value};

/// Properties whose meaning depends on the direction in which the curve runs.
const DIRECTED: [&str; 5] = [
    "maxReverseSpeed",
    "rotationAtStartNodeAllowed",
    "rotationAtEndNodeAllowed",
    "corridor.leftWidth",
    "corridor.rightWidth",
];

/// Most differences that a text lists.
const MAX_LISTED: usize = 4;
/// Longest value in a text, in characters.
const MAX_CHARS: usize = 30;

/// A path, and whether it runs from the end of the common curve to its start.
#[derive(Clone, Copy, Debug)]
pub(super) struct Along {
    pub(super) row: usize,
    pub(super) reversed: bool,
}

/// Compares the properties of paths.
pub(super) struct Comparison<'a> {
    layout: &'a Layout,
    columns: Vec<Column<'a>>,
    hasher: RandomState,
}

/// A column for all vehicle types, and that of the entries per type.
struct Column<'a> {
    name: &'a str,
    label: String,
    common: Option<&'a Attribute>,
    per_type: Option<&'a Attribute>,
}

impl<'a> Column<'a> {
    /// The value of a path, for the vehicle type of an entry if it has entries.
    fn value(&self, row: usize, entry: Option<usize>) -> Option<Value<'a>> {
        let own = entry.and_then(|entry| self.per_type?.values.get(entry));
        own.or_else(|| self.common?.values.get(row))
    }
}

impl<'a> Comparison<'a> {
    pub(super) fn of(layout: &'a Layout) -> Self {
        let paths = &layout.paths;
        let column = |name: &'a str| Column {
            name,
            label: paths
                .column(name)
                .map_or_else(String::new, Attribute::label),
            common: paths.attributes.get(name),
            per_type: paths.vehicle_types().attributes.get(name),
        };
        Self {
            layout,
            columns: paths.column_names().map(column).collect(),
            hasher: RandomState::new(),
        }
    }

    /// A number that is equal for paths without differences.
    pub(super) fn fingerprint(&self, path: Along) -> u64 {
        let mut hasher = self.hasher.build_hasher();
        let paths = &self.layout.paths;
        let is_both = paths.get(path.row).direction() == Direction::Both;
        (self.ends(path), is_both).hash(&mut hasher);
        let style = paths.own_style(path.row);
        let rank = paths.rank().map(|ranks| ranks[path.row]);
        let width_bits = style.width_m.map(|width_m| (width_m + 0.0).to_bits());
        (width_bits, style.color_rgba, rank).hash(&mut hasher);
        let entries = self.entries(path.row);
        entries.iter().for_each(|(name, _)| name.hash(&mut hasher));
        for column in &self.columns {
            for entry in cells(&entries) {
                let text = column.value(path.row, entry).map(|value| match value {
                    // Equal numbers have equal texts: zero has two signs.
                    Value::Float(number) => (number + 0.0).to_string(),
                    value => value.to_string(),
                });
                let is_directed = text.is_some() && DIRECTED.contains(&column.name);
                (text, is_directed && path.reversed).hash(&mut hasher);
            }
        }
        hasher.finish()
    }

    /// Descriptions of all differences, such as `maxSpeed: 1 and 0.5 m/s`; empty if there are none.
    pub(super) fn differences(&self, a: Along, b: Along) -> Vec<String> {
        let mut found = Vec::new();
        self.add_network(a, b, &mut found);
        let (types_a, types_b) = (self.entries(a.row), self.entries(b.row));
        let names = |types: &[(&str, usize)]| match types.is_empty() {
            true => "all".to_owned(),
            false => types.iter().map(|t| t.0).collect::<Vec<_>>().join(", "),
        };
        if !types_a.iter().map(|t| t.0).eq(types_b.iter().map(|t| t.0)) {
            let pair = [names(&types_a), names(&types_b)];
            found.push(described("vehicle types", pair.map(Some), None));
        }
        for column in &self.columns {
            let unequal = pairs(&types_a, &types_b).find_map(|(name, [entry_a, entry_b])| {
                let values = [column.value(a.row, entry_a), column.value(b.row, entry_b)];
                (!is_equal(values)).then_some((name, values))
            });
            if let Some((name, values)) = unequal {
                let of = match name.filter(|_| column.per_type.is_some()) {
                    Some(name) => format!("{} of {name}", column.name),
                    None => column.name.to_owned(),
                };
                found.push(described(
                    &of,
                    values.map(|v| Some(v?.to_string())),
                    column.unit(),
                ));
            } else if a.reversed != b.reversed
                && DIRECTED.contains(&column.name)
                && cells(&types_a).any(|entry| column.value(a.row, entry).is_some())
            {
                found.push(format!(
                    "{}, as the curves run in opposite directions",
                    column.label
                ));
            }
        }
        self.add_style(a.row, b.row, &mut found);
        found
    }

    /// The nodes of a path: `, from node "a" to node "b"`; empty if it lacks one.
    pub(super) fn ends_text(&self, path: Along) -> String {
        let own = self.layout.paths.get(path.row);
        match (own.start_node(), own.end_node()) {
            (Some(start), Some(end)) => {
                let [start, end] = [start, end].map(|node| self.node_name(node));
                format!(", from {start} to {end}")
            }
            _ => String::new(),
        }
    }

    /// The first few differences in one line: `maxSpeed: 1 and 0.5 m/s; 2 others`.
    pub(super) fn text(differences: &[String]) -> String {
        let listed = &differences[..differences.len().min(MAX_LISTED)];
        match differences.len() - listed.len() {
            0 => listed.join("; "),
            1 => format!("{}; and another property", listed.join("; ")),
            n => format!("{}; and {n} other properties", listed.join("; ")),
        }
    }

    fn add_network(&self, a: Along, b: Along, found: &mut Vec<String>) {
        let name = |node: u32| self.node_name(node);
        let (ends_a, ends_b) = (self.ends(a), self.ends(b));
        for (what, end_a, end_b) in [
            ("start node", ends_a[0], ends_b[0]),
            ("end node", ends_a[1], ends_b[1]),
        ] {
            if end_a != end_b {
                found.push(described(
                    what,
                    [end_a, end_b].map(|end| end.map(name)),
                    None,
                ));
            }
        }
        let both = [a, b].map(|p| self.layout.paths.get(p.row).direction() == Direction::Both);
        if both[0] != both[1] {
            let name = |both| Some(if both { "two-way" } else { "one-way" }.to_owned());
            found.push(described("direction", both.map(name), None));
        }
    }

    fn add_style(&self, a: usize, b: usize, found: &mut Vec<String>) {
        let paths = &self.layout.paths;
        let [own_a, own_b] = [a, b].map(|row| paths.own_style(row));
        if own_a.width_m != own_b.width_m {
            let widths = [own_a, own_b].map(|own| own.width_m.map(|w| w.to_string()));
            found.push(described("width", widths, Some("m")));
        }
        if own_a.color_rgba != own_b.color_rgba {
            let colors = [own_a, own_b].map(|own| own.color_rgba.map(|c| format!("#{c:08X}")));
            found.push(described("color", colors, None));
        }
        let rank = |row: usize| paths.rank().map(|ranks| ranks[row].to_string());
        if rank(a) != rank(b) {
            found.push(described("draw rank", [rank(a), rank(b)], None));
        }
    }

    fn node_name(&self, node: u32) -> String {
        element_name("node", node as usize, self.layout.nodes.id(node))
    }

    /// The nodes at the start and the end of the common curve.
    fn ends(&self, path: Along) -> [Option<u32>; 2] {
        let own = self.layout.paths.get(path.row);
        match path.reversed {
            false => [own.start_node(), own.end_node()],
            true => [own.end_node(), own.start_node()],
        }
    }

    /// The vehicle types of a path in alphabetical order, with their entries.
    fn entries(&self, row: usize) -> Vec<(&'a str, usize)> {
        let types = self.layout.paths.vehicle_types();
        let entries = types
            .entries(row)
            .map(|entry| (types.type_of(entry), entry));
        let mut entries: Vec<_> = entries.collect();
        entries.sort_unstable();
        entries
    }
}

impl Column<'_> {
    fn unit(&self) -> Option<&'static str> {
        let column = self.common.or(self.per_type)?;
        column.quantity.map(crate::Quantity::unit)
    }
}

/// The entries of a path, or one cell for all types.
fn cells(entries: &[(&str, usize)]) -> impl Iterator<Item = Option<usize>> {
    let for_all = entries.is_empty().then_some(None);
    for_all
        .into_iter()
        .chain(entries.iter().map(|entry| Some(entry.1)))
}

/// The entries of two paths for each vehicle type that both admit.
fn pairs<'t>(
    a: &[(&'t str, usize)],
    b: &[(&'t str, usize)],
) -> impl Iterator<Item = (Option<&'t str>, [Option<usize>; 2])> {
    let entry = |of: &[(&'t str, usize)], name: &str| {
        let found = of.binary_search_by_key(&name, |entry| entry.0);
        found.ok().map(|index| of[index].1)
    };
    let names = if a.is_empty() { b } else { a };
    let names = names.iter().map(|entry| entry.0);
    let pair = |name| (Some(name), [entry(a, name), entry(b, name)]);
    let admits = |(_, [entry_a, entry_b]): &(_, [Option<usize>; 2])| {
        (a.is_empty() || entry_a.is_some()) && (b.is_empty() || entry_b.is_some())
    };
    let for_all = (a.is_empty() && b.is_empty()).then_some((None, [None, None]));
    let of_types: Vec<_> = names.map(pair).filter(admits).collect();
    for_all.into_iter().chain(of_types)
}

fn is_equal([a, b]: [Option<Value<'_>>; 2]) -> bool {
    match (a, b) {
        (Some(Value::Float(a)), Some(Value::Float(b))) => a == b || a.to_bits() == b.to_bits(),
        _ => a == b,
    }
}

/// `name: a and b unit`, with `none` for a missing value.
fn described(name: &str, values: [Option<String>; 2], unit: Option<&str>) -> String {
    let [a, b] = values.map(|value| value.map_or_else(|| "none".to_owned(), |v| shortened(&v)));
    match unit {
        Some(unit) => format!("{name}: {a} and {b} {unit}"),
        None => format!("{name}: {a} and {b}"),
    }
}

fn shortened(text: &str) -> String {
    match text.char_indices().nth(MAX_CHARS) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text.to_owned(),
    }
}
