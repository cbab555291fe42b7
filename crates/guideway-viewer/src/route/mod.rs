//! The route between two places of the active file: searched in the background, drawn over the
//! layout, with a vehicle on it.
//!
//! | part | input | output | file |
//! |---|---|---|---|
//! | [`RouteSearch`] | clicked places, vehicle type | the route, or why there is none | `search` |
//! | [`FoundRoute`] | snapshot, two places | rows, curve, swept area | `found` |
//! | [`Track`] | curves of a route | position and heading along it | `track` |

mod found;
mod search;
mod track;

pub(crate) use found::FoundRoute;
pub(crate) use search::{RouteSearch, Slot, place_of};
