//! The purposes for which the window asks for a file name.

use std::path::{Path, PathBuf};

use guideway_compose::VectorFormat;

use crate::action::{Action, Export};
use crate::file_purpose::PromptKind;
use crate::language::t;
use crate::project::SUFFIX;
use crate::services::{AppServices, FileFormat, FileQuestion};

impl PromptKind {
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Open => t("Open file"),
            Self::SaveAs => t("Save as (the extension selects the format)"),
            Self::ExportPng => t("Export PNG file"),
            Self::ExportSvg => t("Export SVG file"),
            Self::ExportPdf => t("Export PDF file"),
            Self::SaveProject => t("Save project"),
            Self::FloorPlan => t(
                "Floor plan: an image, a page of a PDF, a map.yaml of ROS, or any layout or \
                 drawing. Empty removes the floor plan.",
            ),
        }
    }

    /// Returns `true` if the file must exist.
    pub(super) fn opens(self) -> bool {
        matches!(self, Self::Open | Self::FloorPlan)
    }

    /// The suggested text, derived from the active file.
    pub(crate) fn suggestion(self, file: Option<&Path>) -> PathBuf {
        let with = |extension| file.map(|file| file.with_extension(extension));
        let suggestion = match self {
            Self::Open | Self::FloorPlan => None,
            Self::SaveAs => file.map(Path::to_owned),
            Self::ExportPng => with("png"),
            Self::ExportSvg => with("svg"),
            Self::ExportPdf => with("pdf"),
            Self::SaveProject => {
                let stem = file.map(|file| file.with_extension("").with_extension(""));
                let stem = stem.unwrap_or_else(|| PathBuf::from("project"));
                Some(stem.with_extension(SUFFIX.trim_start_matches('.')))
            }
        };
        suggestion.unwrap_or_default()
    }

    /// The question for the dialog of the desktop; `suggestion` is the name of a file to write.
    pub(super) fn question(
        self,
        suggestion: &Path,
        active: Option<&Path>,
        services: &dyn AppServices,
    ) -> FileQuestion {
        let place = if self.opens() {
            active
        } else {
            Some(suggestion)
        };
        let folder = place.and_then(Path::parent);
        let folder = folder.filter(|folder| !folder.as_os_str().is_empty());
        let name = suggestion.file_name().unwrap_or_default();
        FileQuestion {
            title: match self {
                Self::FloorPlan => t("Floor plan").to_owned(),
                Self::SaveAs => t("Save as").to_owned(),
                _ => self.title().to_owned(),
            },
            folder: folder.map(Path::to_owned),
            new_name: (!self.opens()).then(|| name.to_string_lossy().into_owned()),
            formats: self.formats(services),
        }
    }

    fn formats(self, services: &dyn AppServices) -> Vec<FileFormat> {
        let format = |name: &str, extensions: &[&str]| FileFormat {
            name: name.to_owned(),
            extensions: extensions.iter().map(|&e| e.to_owned()).collect(),
        };
        match self {
            // Content, not the extension, tells the format.
            Self::Open | Self::FloorPlan => vec![format("All files", &["*"])],
            Self::SaveAs => services.layout_formats(),
            Self::ExportPng => vec![format("PNG", &["png"])],
            Self::ExportSvg => vec![format("SVG", &["svg"])],
            Self::ExportPdf => vec![format("PDF", &["pdf"])],
            Self::SaveProject => {
                vec![format(
                    "Guideway project",
                    &[SUFFIX.trim_start_matches('.')],
                )]
            }
        }
    }

    /// The action of an answer; `None` for an empty file name.
    pub(crate) fn action(self, path: PathBuf, width_px: u32) -> Option<Action> {
        if self == Self::FloorPlan {
            return Some(Action::SetFloorPlan(path.to_string_lossy().into_owned()));
        }
        if path.as_os_str().is_empty() {
            return None;
        }
        Some(match self {
            Self::Open => Action::Open(path),
            Self::SaveAs => Action::SaveAs(path),
            Self::ExportPng => Action::Export(Export::Png { path, width_px }),
            Self::ExportSvg | Self::ExportPdf => Action::Export(Export::Vector {
                path,
                format: match self {
                    Self::ExportPdf => VectorFormat::Pdf,
                    _ => VectorFormat::Svg,
                },
            }),
            Self::SaveProject => Action::SaveProject(path),
            Self::FloorPlan => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggests_a_name_beside_the_active_file() {
        let suggest = |kind: PromptKind| kind.suggestion(Some(Path::new("a/site.lif.json")));
        assert_eq!(suggest(PromptKind::SaveAs), Path::new("a/site.lif.json"));
        assert_eq!(suggest(PromptKind::ExportPng), Path::new("a/site.lif.png"));
        assert_eq!(suggest(PromptKind::Open), Path::new(""));
        let project = Path::new("a/site.guideway-project.toml");
        assert_eq!(suggest(PromptKind::SaveProject), project);
    }

    #[test]
    fn empty_answer_opens_nothing_but_removes_a_floor_plan() {
        assert!(PromptKind::Open.action(PathBuf::new(), 1).is_none());
        let action = PromptKind::FloorPlan.action(PathBuf::new(), 1);
        assert!(matches!(action, Some(Action::SetFloorPlan(text)) if text.is_empty()));
    }
}
