//! Saves a layout for the window, unless its format loses more than the user accepts.

use std::path::Path;

use guideway::formats::{Loss, WriteError};
use guideway::layout::{Layout, UserError};
use guideway::{SaveError, replace_file};
use guideway_viewer::{LostPart, Saved};

use crate::cli::convert;

/// Why no file replaced the old one.
enum Unsaved {
    TooLossy(Vec<LostPart>),
    Failed(UserError),
}

impl From<SaveError> for Unsaved {
    fn from(error: SaveError) -> Self {
        Self::Failed(error.into())
    }
}

impl From<WriteError> for Unsaved {
    fn from(error: WriteError) -> Self {
        Self::Failed(error.into())
    }
}

/// Writes the file beside its place; it takes the place if `accepts` holds for its losses.
pub(super) fn save(
    layout: &Layout,
    path: &Path,
    accepts: &dyn Fn(&[LostPart]) -> bool,
) -> Result<Saved, UserError> {
    let target = convert::target_to_save(layout, path)?;
    let written = replace_file(path, |file| {
        let losses = convert::write_into(file, target, layout, path)?;
        let losses: Vec<LostPart> = losses.iter().map(lost_part).collect();
        match losses.is_empty() || accepts(&losses) {
            true => Ok(losses),
            false => Err(Unsaved::TooLossy(losses)),
        }
    });
    match written {
        Ok(losses) => Ok(Saved::Written(losses)),
        Err(Unsaved::TooLossy(losses)) => Ok(Saved::TooLossy(losses)),
        Err(Unsaved::Failed(error)) => Err(error),
    }
}

fn lost_part(loss: &Loss) -> LostPart {
    LostPart {
        what: loss.what.clone(),
        count: loss.count,
        detail: loss.detail.clone(),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn file_stays_as_it_was_unless_its_losses_are_accepted() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("site.geojson");
        let site = folder.path().join("site.svg");
        fs::write(&site, "old").unwrap();
        let site_bytes = include_bytes!("../../../examples/site.lif.json");
        let options = guideway::formats::ReadOptions::default();
        let layout = guideway::formats::read_bytes("site", site_bytes, &options).unwrap();
        let asked = std::cell::RefCell::new(Vec::new());
        let refuse = |losses: &[LostPart]| {
            asked.borrow_mut().extend_from_slice(losses);
            false
        };
        let outcome = save(&layout, &site, &refuse).unwrap();
        let Saved::TooLossy(losses) = outcome else {
            panic!("a drawing in SVG has no stations");
        };
        assert_eq!(losses, *asked.borrow());
        assert!(losses.iter().any(|lost| lost.what == "stations"));
        assert_eq!(fs::read_to_string(&site).unwrap(), "old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        let outcome = save(&layout, &site, &|_| true).unwrap();
        assert_eq!(outcome, Saved::Written(losses));
        assert!(fs::read_to_string(&site).unwrap().contains("<svg"));
        // A format that holds everything asks nothing.
        let outcome = save(&layout, &path.with_extension("lif.json"), &refuse);
        assert_eq!(outcome.unwrap(), Saved::Written(Vec::new()));
    }
}
