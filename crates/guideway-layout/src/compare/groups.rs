//! Differences of levels, vehicle types, blocks, zones and the layout as a whole.

use super::columns::compare_row;
use super::difference::{CompareOptions, Differences};
use super::row_pairs::RowPairs;
use crate::{Attributes, Block, Layout, Level, Member, VehicleType, Zone};

/// Greatest difference of origins that count as equal, in degrees: a tenth of a millimeter.
const ORIGIN_TOLERANCE_DEG: f64 = 1e-9;

/// Pairs of the elements that blocks refer to.
pub(super) struct MemberPairs<'a> {
    pub(super) paths: &'a RowPairs,
    pub(super) nodes: &'a RowPairs,
    pub(super) stations: &'a RowPairs,
}

impl MemberPairs<'_> {
    fn partner(&self, member: Member) -> Option<Member> {
        member.renumbered(
            |row| self.paths.partner(row),
            |row| self.nodes.partner(row),
            |row| self.stations.partner(row),
        )
    }
}

/// Compares the groups of two layouts.
pub(super) fn compare(
    [a, b]: [&Layout; 2],
    members: &MemberPairs<'_>,
    options: &CompareOptions,
    found: &mut Differences,
) {
    compare_levels([&a.levels, &b.levels], options, found);
    let id = |t: &&VehicleType| t.id.clone();
    let types = [compared_types(a, b), compared_types(b, a)];
    for [p, q] in pairs(
        "vehicle types",
        types.each_ref().map(Vec::as_slice),
        id,
        found,
    ) {
        let name = || format!("vehicle type `{}`", p.id);
        compare_row(
            [(&p.attributes, 0), (&q.attributes, 0)],
            name,
            options,
            found,
        );
    }
    for [p, q] in pairs(
        "blocks",
        [&a.blocks, &b.blocks],
        |block: &Block| block.id.clone(),
        found,
    ) {
        let name = || format!("block `{}`", p.id);
        let expected = p.members.iter().map(|&member| members.partner(member));
        let mut expected: Vec<_> = expected.collect();
        let mut actual: Vec<_> = q.members.iter().map(|&member| Some(member)).collect();
        expected.sort_unstable();
        actual.sort_unstable();
        if expected != actual {
            found.add("blocks", || format!("{} has other members", name()));
        }
        compare_row(
            [(&p.attributes, 0), (&q.attributes, 0)],
            name,
            options,
            found,
        );
    }
    for [p, q] in pairs(
        "zones",
        [&a.zones, &b.zones],
        |zone: &Zone| zone.id.clone(),
        found,
    ) {
        let name = || format!("zone `{}`", p.id);
        let corners = p.outline_m.iter().zip(&q.outline_m);
        let are_near = corners
            .into_iter()
            .all(|(p, q)| p.distance(*q) <= options.tolerance_m);
        let level = |layout: &Layout, zone: &Zone| {
            let level = layout.levels.get(zone.level? as usize)?;
            Some(level.id.clone())
        };
        if level(a, p) != level(b, q) {
            found.add("zones", || format!("{} is on another level", name()));
        }
        if p.outline_m.len() != q.outline_m.len() || !are_near {
            found.add("zones", || format!("{} has another outline", name()));
        }
        compare_row(
            [(&p.attributes, 0), (&q.attributes, 0)],
            name,
            options,
            found,
        );
    }
    compare_layouts([a, b], options, found);
}

/// The vehicle types of a layout, without those that have no properties and that another layout
/// names on its paths or nodes only: its table may lack them.
fn compared_types<'a>(layout: &'a Layout, other: &Layout) -> Vec<&'a VehicleType> {
    let named = other.vehicle_type_names();
    let has_row = |id: &str| other.vehicle_types.iter().any(|t| t.id == id);
    let has_values = |t: &VehicleType| {
        let mut columns = t.attributes.iter();
        columns.any(|column| column.values.get(0).is_some())
    };
    let is_compared =
        |t: &&VehicleType| has_values(t) || has_row(&t.id) || !named.contains(t.id.as_str());
    layout.vehicle_types.iter().filter(is_compared).collect()
}

fn compare_levels(levels: [&[Level]; 2], options: &CompareOptions, found: &mut Differences) {
    for [p, q] in pairs("levels", levels, |level: &Level| level.id.clone(), found) {
        let name = || format!("level `{}`", p.id);
        if p.name != q.name || p.elevation_m != q.elevation_m {
            found.add("levels", || {
                format!("{} has another name or elevation", name())
            });
        }
        compare_row(
            [(&p.attributes, 0), (&q.attributes, 0)],
            name,
            options,
            found,
        );
    }
}

fn compare_layouts([a, b]: [&Layout; 2], options: &CompareOptions, found: &mut Differences) {
    let degrees = |layout: &Layout| {
        let origin = layout.geo_origin?;
        Some([origin.longitude_deg, origin.latitude_deg])
    };
    let are_equal = match [a, b].map(degrees) {
        [Some(p), Some(q)] => (0..2).all(|i| (p[i] - q[i]).abs() <= ORIGIN_TOLERANCE_DEG),
        [p, q] => p.is_none() && q.is_none(),
    };
    if !are_equal {
        found.add("geo origin", || {
            format!("{:?} instead of {:?}", b.geo_origin, a.geo_origin)
        });
    }
    let mut own = Differences::default();
    let attributes: [(&Attributes, usize); 2] = [(&a.attributes, 0), (&b.attributes, 0)];
    compare_row(attributes, || "the layout".to_owned(), options, &mut own);
    for difference in own.into_vec() {
        let what = match difference.what.starts_with("new ") {
            true => "new layout properties",
            false => "layout properties",
        };
        found.add(what, || difference.example);
    }
}

/// Pairs of elements with the same identifier; counts the others.
fn pairs<'a, T>(
    what: &str,
    [a, b]: [&'a [T]; 2],
    id: impl Fn(&T) -> String,
    found: &mut Differences,
) -> Vec<[&'a T; 2]> {
    let ids = [a, b].map(|items| items.iter().map(&id).collect::<Vec<_>>());
    let text = |i: usize| {
        let ids = &ids[i];
        move |row: u32| ids[row as usize].as_str()
    };
    let rows = RowPairs::of(a.len(), b.len(), text(0), text(1), |_| true);
    for row in rows.removed() {
        found.add(what, || format!("`{}` is lost", ids[0][row as usize]));
    }
    for &row in rows.added() {
        found.add(&format!("new {what}"), || {
            format!("`{}` is new", ids[1][row as usize])
        });
    }
    let pairs = rows.pairs().map(|(p, q)| {
        if rows.is_by_order() {
            found.add(what, || {
                format!("`{}` has another name", ids[0][p as usize])
            });
        }
        [&a[p as usize], &b[q as usize]]
    });
    pairs.collect()
}
