//! [`State`]: a layout prepared for its conversion to objects.

use guideway_layout::Layout;

use crate::lif::version::Version;
use crate::lif::write::{EdgeGroups, Elements, Network};

/// A layout prepared for writing.
pub(super) struct State<'a> {
    pub(super) layout: &'a Layout,
    pub(super) network: &'a Network<'a>,
    pub(super) elements: Elements<'a>,
    pub(super) groups: EdgeGroups<'a>,
}

impl<'a> State<'a> {
    pub(super) fn new(layout: &'a Layout, network: &'a Network<'a>, version: Version) -> Self {
        Self {
            layout,
            network,
            elements: Elements::new(layout, network, version),
            groups: EdgeGroups::of(layout),
        }
    }
}
