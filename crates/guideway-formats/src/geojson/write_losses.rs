//! GeoJSON losses: lists the parts of a layout that the file of a whole layout does not hold.

use guideway_layout::{Attributes, Layout, Member, Value};
use serde_json::value::RawValue;

use super::names::is_reserved;
use crate::Losses;
use crate::losses::common_losses;

/// Lists the parts of a layout that GeoJSON does not hold.
pub(super) fn list_losses(layout: &Layout) -> Losses {
    let mut losses = common_losses(layout);
    let paths = &layout.paths;
    let tables = [
        (&paths.attributes, "paths"),
        (&layout.nodes.attributes, "nodes"),
        (&layout.stations.attributes, "stations"),
    ];
    let zones = layout.zones.iter().map(|zone| (&zone.attributes, "zones"));
    for (attributes, of) in tables.into_iter().chain(zones) {
        losses.add_columns(attributes, of, |name| !is_reserved(name));
        add_bad_json(&mut losses, attributes, of);
    }
    let types = [
        (paths.vehicle_types(), "vehicle types of paths"),
        (layout.nodes.vehicle_types(), "vehicle types of nodes"),
    ];
    for (types, of) in types {
        add_bad_json(&mut losses, &types.attributes, of);
    }
    let is_lost = |member: &&Member| match member {
        Member::Path(path) => paths.get(*path as usize).runs().len() == 0,
        Member::Node(_) | Member::Station(_) => false,
    };
    let members = layout.blocks.iter().flat_map(|block| &block.members);
    let detail = "members of blocks: paths without a curve";
    losses.add("blocks", members.filter(is_lost).count(), detail);
    losses
}

/// Adds values of columns of JSON that are none, which are written as text.
fn add_bad_json(losses: &mut Losses, attributes: &Attributes, of: &str) {
    for column in attributes
        .iter()
        .filter(|column| !is_reserved(&column.name))
    {
        let is_bad = |row: &usize| match column.values.get(*row) {
            Some(Value::Json(json)) => serde_json::from_str::<&RawValue>(json).is_err(),
            _ => false,
        };
        let bad = (0..column.values.len()).filter(is_bad).count();
        let detail = format!("values of {of} that are not JSON: written as text");
        losses.add(format!("column {}", column.name), bad, detail);
    }
}
