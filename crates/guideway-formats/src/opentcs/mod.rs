//! Reads plant models of openTCS: XML, millimeters, y up; control points in layout units, y down.
//!
//! Up to version 0.0.3, drawing data is in the properties of `modelLayoutElement`; later versions
//! have elements for it. Up to 6.0.0, a point has a position in the plant and another one in the
//! drawing. They may be meters apart, and the control points belong to the drawing.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | parse | bytes | XML tree, attributes | `reader` |
//! | drawing | `visualLayout` | scale, layers, legacy shapes | `visual_layout` |
//! | map | points, locations, blocks | nodes, stations, columns | `plant_mapper`, `envelope` |
//! | map | paths | paths with curves | `path_mapper` |

mod envelope;
mod path_mapper;
mod plant_mapper;
mod reader;
mod visual_layout;

use guideway_layout::Layout;

use self::plant_mapper::PlantMapper;
use crate::source::Source;
use crate::xml::{Doctype, Xml};
use crate::{ReadError, text};

/// Reads a plant model into a layout.
///
/// # Errors
/// When the text is not XML with a `<model>` root or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let xml = Xml::parse(&source, text, Doctype::Refused)?;
    let model = xml.root_with_tag(&source, "model", "<model> of an openTCS plant model")?;
    PlantMapper::new(source, &xml, bytes.len()).read(model)
}
