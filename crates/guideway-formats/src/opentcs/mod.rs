//! Reads and writes plant models of openTCS: XML, millimeters, y up; control points in layout
//! units, y down.
//!
//! Up to version 0.0.3, drawing data is in the properties of `modelLayoutElement`; later versions
//! have elements for it. Up to 6.0.0, a point has a position in the plant and another one in the
//! drawing. They may be meters apart, and the control points belong to the drawing.
//!
//! Values that every new model has (label offsets, symbols, extents) are not stored: a column has
//! the others only, and a writer adds the defaults.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | parse | bytes | XML tree, attributes | `reader` |
//! | drawing | `visualLayout` | scale, layers, legacy shapes | `visual_layout` |
//! | map | points, locations | nodes, stations, columns | `plant_mapper`, `envelope` |
//! | map | paths | paths with curves | `path_mapper` |
//! | map | blocks, vehicles, location types | blocks, attributes | `group_mapper`, `elements` |
//! | complete | layout | names, points of all paths | `plant` |
//! | draw | curves | connection types, control points | `drawn_paths`, `shape`, `fit_cubic` |
//! | write | layout | XML, losses | `write*`, `layers`, `held`, `xml_writer` |

mod context;
mod drawn_paths;
mod elements;
mod envelope;
mod fit_cubic;
mod group_mapper;
mod held;
mod layers;
mod path_mapper;
mod plant;
mod plant_mapper;
mod reader;
mod shape;
mod values;
mod version;
mod visual_layout;
mod write;
mod write_elements;
mod write_paths;
mod write_places;
mod xml_writer;

use guideway_layout::Layout;

pub use self::version::Version;
pub use self::write::write_layout;
pub(crate) use self::write::write_watched;

use self::plant_mapper::PlantMapper;
use crate::ReadError;
use crate::source::Source;
use crate::xml::{self, Xml};

/// Reads a plant model into a layout.
///
/// # Errors
/// When the text is not XML with a `<model>` root or exceeds a limit, or when the caller cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = xml::decode(&source, bytes)?;
    let xml = Xml::parse(&source, &text)?;
    let model = xml.root_with_tag(&source, "model", "<model> of an openTCS plant model")?;
    PlantMapper::new(source, &xml, bytes.len(), model).read(model)
}
