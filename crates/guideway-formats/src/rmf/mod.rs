//! Buildings and navigation graphs of Open-RMF: YAML; pixels of a floor plan with y down, or meters, or
//! degrees.
//!
//! Both have levels with vertices and lanes between them. A building is what people draw over floor plans;
//! a navigation graph is what is generated from it, in meters.

mod frame;
mod level;
mod lifts;
mod parameters;
mod site;

use guideway_layout::{Layout, Place};

use self::site::Site;
use crate::source::Source;
use crate::yaml::Yaml;
use crate::{Problem, ReadError, text};

/// Whether a text is YAML with a key on its outermost level that buildings and graphs have.
pub(crate) fn is_rmf(text: &[u8]) -> bool {
    let mut lines = text.split(|&byte| byte == b'\n');
    lines.any(|line| {
        let rest = line.strip_prefix(b"levels:");
        rest.is_some_and(|rest| matches!(rest.first(), None | Some(b' ' | b'\t' | b'\r' | b'#')))
    })
}

/// Reads a building or a navigation graph.
pub(crate) fn read(source: Source<'_>, bytes: &[u8]) -> Result<Layout, ReadError> {
    let text = text::decode_utf8(&source, bytes)?;
    let yaml = Yaml::parse(&source, text)?;
    let levels = yaml.root().and_then(|root| root.get("levels"));
    let Some((root, levels)) = yaml.root().zip(levels.filter(|levels| levels.is_map())) else {
        let found = levels.map_or("nothing", |levels| levels.kind());
        return Err(source.fail(Problem::Structure {
            place: Place::element("levels"),
            expected: "an object with the levels of a building".into(),
            found: found.into(),
        }));
    };
    Site::new(source, bytes.len()).map(&yaml, root, levels)
}
