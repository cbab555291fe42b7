//! Places: finds stations and nodes by name, and checks vehicle types.

use guideway_layout::{Attributes, Layout, Value, near_names};

use super::RouteError;

/// Names that an error lists.
const MAX_LISTED: usize = 8;

/// A start or a goal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Name as given.
    pub name: String,
    /// Rows of its nodes; vehicles may start or end at any of them.
    pub nodes: Vec<u32>,
}

pub(super) fn find(layout: &Layout, name: &str) -> Result<Place, RouteError> {
    let (stations, nodes) = (&layout.stations, &layout.nodes);
    let is_named = |attributes: &Attributes, row: usize| {
        attributes.value(row, "name") == Some(Value::Text(name))
    };
    let mut rows = 0..stations.len() as u32;
    let station = rows
        .clone()
        .find(|&row| stations.id(row) == name)
        .or_else(|| rows.find(|&row| is_named(&stations.attributes, row as usize)));
    if let Some(station) = station {
        return match stations.nodes(station) {
            [] => Err(RouteError::NoNode {
                name: name.to_owned(),
            }),
            rows => Ok(place(name, rows.to_vec())),
        };
    }
    let rows = 0..nodes.len() as u32;
    let mut found: Vec<u32> = rows.clone().filter(|&row| nodes.id(row) == name).collect();
    if found.is_empty() {
        found = rows
            .filter(|&row| is_named(&nodes.attributes, row as usize))
            .collect();
    }
    match found.len() {
        0 => Err(RouteError::UnknownPlace {
            name: name.to_owned(),
            known: known(layout, name),
        }),
        1 => Ok(place(name, found)),
        count => Err(RouteError::Ambiguous {
            name: name.to_owned(),
            count,
        }),
    }
}

fn place(name: &str, nodes: Vec<u32>) -> Place {
    let name = name.to_owned();
    Place { name, nodes }
}

/// Names near an unknown one, else some known ones.
fn known(layout: &Layout, name: &str) -> String {
    let stations = (0..layout.stations.len() as u32).map(|row| layout.stations.id(row));
    let nodes = (0..layout.nodes.len() as u32).map(|row| layout.nodes.id(row));
    let near = near_names(name, stations.clone().chain(nodes.clone()));
    if !near.is_empty() {
        return format!("near names are {}", near.join(", "));
    }
    let known = listed(
        stations.chain(nodes),
        layout.stations.len() + layout.nodes.len(),
    );
    format!("known are {known}")
}

fn listed<'a>(names: impl Iterator<Item = &'a str>, count: usize) -> String {
    let shown: Vec<&str> = names.take(MAX_LISTED).collect();
    match count.saturating_sub(MAX_LISTED) {
        _ if count == 0 => "none".to_owned(),
        0 => shown.join(", "),
        more => format!("{} and {more} more", shown.join(", ")),
    }
}

/// Rejects a vehicle type that the layout does not have, and a choice that is left open.
pub(super) fn check_type(layout: &Layout, vehicle_type: Option<&str>) -> Result<(), RouteError> {
    let names = layout.paths.vehicle_types().names();
    let is_known = |given: &str| {
        let own = layout.vehicle_types.iter();
        names
            .iter()
            .chain(own.map(|t| &t.id))
            .any(|known| known == given)
    };
    let given = match vehicle_type {
        Some(given) if !is_known(given) => format!("no vehicle type is named \"{given}\""),
        None if !names.is_empty() => "no vehicle type is given".to_owned(),
        _ => return Ok(()),
    };
    Err(RouteError::VehicleType {
        given,
        known: listed(names.iter().map(String::as_str), names.len()),
    })
}
