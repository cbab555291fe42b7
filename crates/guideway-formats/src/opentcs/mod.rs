//! Plant models of openTCS: XML, millimeters, y up; control points in layout units, y down.
//!
//! Up to 0.0.3, what is drawn is in the properties of `modelLayoutElement`; later it is in elements of
//! its own. Up to 6.0.0, a point has a position in the plant and another in the drawing; they may be
//! meters apart, and the control points go with the drawing.

mod drawing;
mod envelope;
mod paths;
mod plant;

use guideway_layout::{Layout, Place};

use self::drawing::Drawing;
use self::plant::Plant;
use crate::source::Source;
use crate::xml::{Doctype, Xml};
use crate::{Problem, ReadError, text};

/// Reads a plant model.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let xml = Xml::parse(&source, text, Doctype::Refused)?;
    let model = xml.root();
    if model.tag_name().name() != "model" {
        let tag: String = model.tag_name().name().chars().take(40).collect();
        return Err(source.fail(Problem::Structure {
            place: Place::element("the outermost element"),
            expected: "<model> of an openTCS plant model".into(),
            found: format!("<{tag}>"),
        }));
    }
    let mut plant = Plant::new(source, &xml, bytes.len());
    let drawing = Drawing::read(&mut plant, model);
    plant.map(model, &drawing)
}
