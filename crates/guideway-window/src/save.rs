//! Saves a layout for the window, unless its format loses more than the user accepts.

use std::path::Path;

use guideway::cli::window::{target_to_save, write_into};
use guideway::formats::{Loss, Target, WriteError};
use guideway::layout::{Layout, UserError, shown_path};
use guideway::{SaveError, replace_file};
use guideway_viewer::{LostPart, Saved};

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
pub(crate) fn save(
    layout: &Layout,
    path: &Path,
    accepts: &dyn Fn(&[LostPart]) -> bool,
) -> Result<Saved, UserError> {
    let target = target_to_save(layout, path)?;
    let written = replace_file(path, |file| {
        let losses = write_into(file, target, layout, path)?;
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

/// Rejects saving a layout over its source if the source may hold more than the layout.
pub(crate) fn check_in_place(layout: &Layout, file: &Path) -> Result<(), UserError> {
    let refused = layout.refused.len();
    let target = target_to_save(layout, file)?;
    let would_lose = match target {
        _ if target.is_drawing() => "is a drawing: saving would keep only the paths".to_owned(),
        // Other XML formats and older versions of openTCS have the same extension.
        Target::OpenTcs6 | Target::OpenTcs7 if Target::of_source(layout) != Some(target) => {
            format!("is no {}", target.name())
        }
        Target::GeoJson
        | Target::Nav2
        | Target::Rmf
        | Target::OpenTcs6
        | Target::OpenTcs7
        | Target::Vda2
        | Target::Vda3
            if refused > 0 =>
        {
            format!("has {refused} refused paths, which saving would drop")
        }
        _ => return Ok(()),
    };
    Err(UserError::new(
        "target-format",
        format!("{} {would_lose}", shown_path(file)),
        "Save the layout under another name",
    ))
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
        let site_bytes = include_bytes!("../../guideway/examples/site.lif.json");
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

    fn read_from(format: &str, version: &str) -> Layout {
        let mut layout = Layout::default();
        layout.provenance.format = format.into();
        layout.provenance.format_version = version.into();
        layout
    }

    #[test]
    fn saves_in_the_format_of_the_source() {
        use Target::{Arrow, GeoJson, Lif1, Lif2, Nav2, OpenTcs6, OpenTcs7, Rmf, Vda2, Vda3};
        for (format, version, name, target) in [
            ("LIF", "1.0", "a.lif.json", Some(Lif1)),
            ("LIF", "2.0", "a.lif.json", Some(Lif2)),
            ("LIF", "2.0", "site.json", Some(Lif2)),
            ("LIF", "2.0", "a.arrow", Some(Arrow)),
            ("GeoJSON", "", "roads.json", Some(GeoJson)),
            ("GeoJSON", "", "roads.lif.json", Some(Lif1)),
            ("GeoJSON", "Nav2 route graph", "graph.geojson", Some(Nav2)),
            ("GeoJSON", "Nav2 route graph", "graph.json", Some(Nav2)),
            ("Open-RMF", "navigation graph", "0.yaml", Some(Rmf)),
            ("Open-RMF", "building", "office.building.yaml", None),
            ("VDA 5050", "2.0", "order.json", Some(Vda2)),
            ("VDA 5050", "3.0", "order.json", Some(Vda3)),
            ("VDA 5050", "3.0", "a.vda5050.json", Some(Vda3)),
            ("openTCS", "6.0.0", "plant.xml", Some(OpenTcs6)),
            ("openTCS", "7.0.0", "plant.xml", Some(OpenTcs7)),
            ("LIF", "1.0", "site.txt", None),
        ] {
            let layout = read_from(format, version);
            let saved = target_to_save(&layout, Path::new(name));
            assert_eq!(saved.ok(), target, "{format} {version} as {name}");
            let in_place = check_in_place(&layout, Path::new(name));
            assert_eq!(in_place.is_ok(), target.is_some(), "{name}");
        }
        for (format, version) in [("openTCS", "0.0.2"), ("OpenDRIVE", "1.6")] {
            let layout = read_from(format, version);
            let saved = target_to_save(&layout, Path::new("map.xml"));
            assert_eq!(saved.ok(), Some(OpenTcs7));
            let rejected = check_in_place(&layout, Path::new("map.xml"));
            assert!(rejected.unwrap_err().message.contains("no openTCS 7.0.0"));
        }
        let drawing = read_from("DXF", "AC1015");
        let rejected = check_in_place(&drawing, Path::new("plan.dxf"));
        assert!(rejected.unwrap_err().message.contains("only the paths"));
        assert_eq!(
            target_to_save(&drawing, Path::new("b.dxf")).ok(),
            Some(Target::Dxf)
        );
    }
}
