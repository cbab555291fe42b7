//! Maps of Lanelet2: OSM XML, longitude and latitude or local meters, y up.
//!
//! A lanelet is a relation of a left and a right bound, and vehicles go between them. Bounds, walls and
//! markings are ways, which are lists of nodes.

mod center;
mod map;
mod osm;

use guideway_layout::{Layout, Place};

use self::map::Mapper;
use crate::source::Source;
use crate::xml::{Doctype, Xml};
use crate::{Problem, ReadError, text};

/// Reads a map.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let xml = Xml::parse(&source, text, Doctype::Refused)?;
    let root = xml.root();
    if root.tag_name().name() != "osm" {
        return Err(source.fail(Problem::Structure {
            place: Place::element("the outermost element"),
            expected: "<osm> of a Lanelet2 map".into(),
            found: format!("<{}>", text::printable(root.tag_name().name())),
        }));
    }
    Mapper::new(source, &xml, bytes.len()).map(root)
}
