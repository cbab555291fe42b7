//! Roads of ASAM OpenDRIVE: XML, meters, y up.
//!
//! A road has a reference line of lines, arcs, spirals and polynomials, and lanes beside it whose widths are
//! polynomials along it. The center line of every lane is a path.

mod fit;
mod lanes;
mod plan;
mod polynomial;
mod reference;
mod road;

use guideway_layout::{Layout, Place};

use self::road::Mapper;
use crate::source::Source;
use crate::xml::{Doctype, Xml};
use crate::{Problem, ReadError, text};

/// Reads roads.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let xml = Xml::parse(&source, text, Doctype::Refused)?;
    let root = xml.root();
    if root.tag_name().name() != "OpenDRIVE" {
        return Err(source.fail(Problem::Structure {
            place: Place::element("the outermost element"),
            expected: "<OpenDRIVE>".into(),
            found: format!("<{}>", text::printable(root.tag_name().name())),
        }));
    }
    Mapper::new(source, &xml, bytes.len()).map(root)
}
