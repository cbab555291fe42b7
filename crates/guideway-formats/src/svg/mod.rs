//! SVG drawings: user units that become meters by the size of the page, y down.
//!
//! Built on `svgtypes`, which is beneath `usvg`, and not on `usvg`: that computes in single precision, makes
//! arcs into curves that may be a tenth of a unit wrong, leaves out what is not painted without a word, and
//! copies what `use` and markers repeat with no bound but a million elements.

mod account;
mod css;
mod data;
mod page;
mod paths;
mod shapes;
mod style;
mod walk;
mod write;
mod write_page;

pub use self::write::write_layout;
pub use self::write_page::{PathData, Stroke, SvgWriter};

use guideway_layout::{Layout, Place};

use self::css::Sheet;
use self::walk::Walker;
use crate::source::Source;
use crate::xml::{Doctype, Xml};
use crate::{Problem, ReadError, text};

/// Reads a drawing.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let xml = Xml::parse(&source, text, Doctype::Bounded)?;
    let root = xml.root();
    if root.tag_name().name() != "svg" {
        return Err(source.fail(Problem::Structure {
            place: Place::element("the outermost element"),
            expected: "<svg>".into(),
            found: format!("<{}>", text::printable(root.tag_name().name())),
        }));
    }
    let sheet = Sheet::read(root);
    Walker::new(source, &xml, &sheet, bytes.len()).map(root)
}
