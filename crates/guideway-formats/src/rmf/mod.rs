//! Buildings and navigation graphs of Open-RMF: YAML; pixels of a floor plan with y down,
//! meters, or degrees.
//!
//! Both have levels with vertices, and lanes between them. People draw a building over floor plans;
//! Open-RMF generates a navigation graph from it, in meters.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | parse | text | YAML tree, levels | `level` |
//! | scale | measurements, fiducials | a frame per level: file units to meters | `frame` |
//! | map | vertices, lanes, walls, doors | nodes, paths, blocks | `site`, `level_mapper`, `edges` |
//! | map | parameters, lifts | columns, stations | `parameters`, `lifts`; `reader`, `site_mapper` |
//! | map | site of the site editor (JSON) | nodes, paths, stations | `site_file` |
//! | write | layout | navigation graph, losses | `write`, `graph_*`, `yaml_text` |

mod edges;
mod frame;
mod graph_columns;
mod graph_losses;
mod graph_plan;
mod level;
mod level_mapper;
mod lifts;
mod parameters;
mod reader;
mod site;
mod site_file;
mod site_mapper;
mod write;
mod yaml_text;

use guideway_layout::{Layout, Place};

pub(crate) use self::site::NAVIGATION_GRAPH;
pub use self::write::write_navigation_graph;

use self::site_file::SiteFileMapper;
use self::site_mapper::SiteMapper;
use crate::source::Source;
use crate::yaml::Yaml;
use crate::{Problem, ReadError, text};

/// Reads a building, a navigation graph or a site into a layout.
///
/// # Errors
/// When the text is not YAML with an object `levels` or exceeds a limit, or when the caller
/// cancels.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let yaml = Yaml::parse(&source, text)?;
    if let Some(root) = yaml.root().filter(|root| site_file::is_site(*root)) {
        return SiteFileMapper::new(source, bytes.len(), root).read();
    }
    let levels = yaml.root().and_then(|root| root.get("levels"));
    let Some((root, levels)) = yaml.root().zip(levels.filter(|levels| levels.is_map())) else {
        let found = levels.map_or("nothing", |levels| levels.kind());
        return Err(source.fail(Problem::Structure {
            place: Place::element("levels"),
            expected: "an object with the levels of a building".into(),
            found: found.into(),
        }));
    };
    SiteMapper::new(source, bytes.len()).read(&yaml, root, levels)
}
