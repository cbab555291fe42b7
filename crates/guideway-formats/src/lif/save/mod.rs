//! LIF save: splices the edited parts of a layout into the text of its file, so that all other
//! bytes stay.
//!
//! The text is read again, which gives the layout as the file has it. A row that differs from the
//! one of the same object is converted to JSON in both states, and what differs between them is
//! changed in the text.
//!
//! | stage | input | output | file |
//! |---|---|---|---|
//! | pair | both layouts | rows of the same object | `state`, `compare` |
//! | change | rows that differ | splices | `changes`, `edges`, `entries` |
//! | add, remove | rows without a partner | splices of arrays | `arrays`, `places` |

mod arrays;
mod changes;
mod compare;
mod edges;
mod entries;
mod places;
mod state;

use std::io::{self, Write};

use guideway_layout::Layout;

use self::changes::Changes;
use self::places::Places;
use self::state::State;
use super::members::ALIASES;
use super::read::read_again;
use super::version::Version;
use super::write::{Edges, Network, add_between_levels, add_lost};
use crate::json::Splices;
use crate::{Losses, Progress};

/// Saves a layout into the text of its file. Returns the losses; `None`, and nothing is written, if
/// there is no text, or it has no place for a change. The observer sees the text being read.
///
/// # Errors
/// When `out` fails.
pub(super) fn save(
    layout: &Layout,
    out: &mut impl Write,
    version: Version,
    progress: Option<&dyn Progress>,
) -> io::Result<Option<Losses>> {
    let Some(text) = layout.provenance.source_text() else {
        return Ok(None);
    };
    let text = &*text;
    let Some(original) = read_again(layout, text, progress) else {
        return Ok(None);
    };
    let is_empty = layout.levels.is_empty()
        && layout.paths.len() + layout.nodes.len() + layout.stations.len() > 0;
    if is_empty {
        return Ok(None);
    }
    let refused = layout.refused.len().saturating_sub(original.refused.len());
    let mut losses = Losses::of_paths(layout, refused);
    let ignored = &mut Losses::default();
    let (old_network, new_network) = (
        Network::complete(&original, ignored),
        Network::complete(layout, ignored),
    );
    let old = State::new(&original, &old_network, version);
    let new = State::new(layout, &new_network, version);
    add_lost(&new.elements, &mut losses);
    add_between_levels(&new.elements, &mut losses);
    let edges = Edges::collect(layout, &mut losses);
    let mut changes = Changes::new(&old, &new, &edges, version, Splices::new(text, ALIASES));
    changes.collect_edges();
    changes.collect_nodes();
    changes.collect_stations();
    changes.add_losses(&mut losses);
    if changes.needs_places() {
        let places = Places::find(text, original.levels.len());
        if !places.is_some_and(|places| changes.change_levels(&places)) {
            return Ok(None);
        }
    }
    changes.into_splices().write(out)?;
    Ok(Some(losses))
}
