//! Reads roads of ASAM OpenDRIVE: XML, meters, y up.
//!
//! A road has a reference line of lines, arcs, spirals and polynomials, and lanes beside it whose
//! widths are polynomials along it. The center line of every lane becomes a path.
//!
//! | Stage | Input | Output | File |
//! |---|---|---|---|
//! | parse | bytes | XML tree, numbers | `reader` |
//! | plan view | `geometry` elements | reference line | `plan_view`, `geometry`, `arc_length`, `quadrature` |
//! | lanes | `laneSection` elements | center offsets | `lanes`, `polynomial` |
//! | fit | reference line and offset | cubics within the tolerance | `offset_fit` |
//! | map | cubics | paths with attributes | `road`, `section`, `speed` |

mod arc_length;
mod geometry;
mod lanes;
mod offset_fit;
mod plan_view;
mod polynomial;
mod quadrature;
mod reader;
mod road;
mod section;
mod speed;

use guideway_layout::Layout;

use self::road::RoadMapper;
use crate::ReadError;
use crate::source::Source;
use crate::xml::{self, Xml};

/// Reads roads into a layout.
///
/// # Errors
/// When the text is not XML with an `<OpenDRIVE>` root or exceeds a limit, or when the caller
/// cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = xml::decode(&source, bytes)?;
    let xml = Xml::parse(&source, &text)?;
    let root = xml.root_with_tag(&source, "OpenDRIVE", "<OpenDRIVE>")?;
    RoadMapper::new(source, &xml, bytes.len()).read(root)
}
