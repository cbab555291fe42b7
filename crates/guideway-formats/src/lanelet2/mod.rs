//! Reads maps of Lanelet2: OSM XML, longitude and latitude or local meters, y up.
//!
//! A way is a list of nodes: a bound, a wall or a marking. A lanelet is a relation of a left and a
//! right way; vehicles drive between them.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | parse | bytes | XML tree, node positions in meters | `osm` |
//! | center | left and right bound | center line | `center` |
//! | map | ways and lanelets | paths with tags as columns | `map_mapper` |

mod center;
mod map_mapper;
mod osm;

use guideway_layout::Layout;

use self::map_mapper::MapMapper;
use crate::ReadError;
use crate::source::Source;
use crate::xml::{self, Xml};

/// Reads a map into a layout.
///
/// # Errors
/// When the text is not XML with an `<osm>` root or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = xml::decode(&source, bytes)?;
    let xml = Xml::parse(&source, &text)?;
    let root = xml.root_with_tag(&source, "osm", "<osm> of a Lanelet2 map")?;
    MapMapper::new(source, &xml, bytes.len()).read(root)
}
