//! [`Router`]: the network of one vehicle type, with the time along each arc.

use guideway_layout::Layout;

use super::cost::Costs;
use crate::arcs::Arcs;

/// The network of one vehicle type, ready for searches.
pub struct Router<'a> {
    pub(super) layout: &'a Layout,
    pub(super) vehicle_type: Option<&'a str>,
    pub(super) arcs: Arcs,
    pub(super) costs: Costs,
}
