//! Build: makes a network, in which paths meet at nodes, from the lines of a drawing.
//!
//! ```text
//!  lines, notes --drawn--> curves --smooth--> curves --weld--> ends at nodes
//!      --junctions, crossings--> cuts --names--> stations --pieces--> pieces --assemble--> layout
//! ```
//!
//! | module | does |
//! |---|---|
//! | `options`, `note_source` | what is joined, cut, named and mapped; reads and writes TOML |
//! | `drawn` | collects the curves that the options select, with level and rule |
//! | `smooth`, `fit` | replaces chains of short lines by curves |
//! | `weld`, `grid`, `clusters` | joins ends that lie within a distance |
//! | `box_index` | finds curves near a point or a curve |
//! | `junctions`, `crossings` | finds where ends meet curves, and curves cross |
//! | `names` | stations and names of nodes from the notes of the drawing |
//! | `pieces` | cuts curves and drops what has vanished or is drawn twice |
//! | `assemble` | the layout: nodes, edges, properties, groups |
//! | `sources` | lists the layers and notes that options can name |
//! | `report`, `error` | what was done and left; why it stopped |

mod assemble;
mod box_index;
mod clusters;
mod crossings;
mod drawn;
mod error;
mod fit;
mod grid;
mod junctions;
mod names;
mod note_source;
mod options;
mod pieces;
mod report;
mod smooth;
mod sources;
mod weld;

use guideway_layout::Layout;

pub use error::BuildError;
pub use note_source::NoteSource;
pub use options::{BuildOptions, DirectionRule, LayerRule};
pub use report::{BuildReport, LeftNote, UnmatchedSource};
pub use sources::DrawingSources;

use box_index::BoxIndex;

/// A network and the account of its making.
#[derive(Clone, Debug)]
pub struct Network {
    /// The paths are edges between nodes.
    pub layout: Layout,
    /// The counts of joined, cut, named and left parts.
    pub report: BuildReport,
}

/// Makes a network from the lines and notes of a drawing.
///
/// Ends within [`BuildOptions::weld_m`] become one node; a chain of lines shorter than that stays a
/// chain. Ends near the middle of a line and, by choice, crossings cut it. Ends of different levels
/// never become one.
///
/// Cost: O(n log n) for n curves and the places where they meet.
///
/// # Errors
/// When ends of different levels meet, a name would be given twice, or the drawing would be cut to
/// more pieces than [`BuildOptions::max_pieces`].
pub fn build(drawing: &Layout, options: &BuildOptions) -> Result<Network, BuildError> {
    options.check()?;
    let mut report = BuildReport::default();
    let mut drawn = drawn::collect(drawing, options, &mut report);
    if let Some(tolerance_m) = options.smooth_m {
        smooth::smooth(&mut drawn, tolerance_m, &mut report);
    }
    let (mut nodes, clusters) = weld::weld(&drawn, options, &mut report)?;
    let index = BoxIndex::of(&drawn);
    let mut cuts = Vec::new();
    if options.split_junctions {
        let nodes = (&mut nodes, &clusters);
        junctions::find(&drawn, &index, options, nodes, &mut cuts, &mut report)?;
    }
    drop(clusters);
    if options.split_crossings {
        crossings::find(&drawn, &index, options, &mut nodes, &mut cuts, &mut report)?;
    }
    let named = names::find(
        drawing,
        &drawn,
        &index,
        options,
        &mut nodes,
        &mut cuts,
        &mut report,
    )?;
    drop(index);
    let pieces = pieces::cut(&drawn, &nodes, cuts, options, &mut report)?;
    let layout = assemble::assemble(
        drawing,
        &drawn,
        &nodes,
        &pieces,
        &named,
        options,
        &mut report,
    )?;
    Ok(Network { layout, report })
}
