//! The content of a project file: see docs/formats.md.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::display_settings::DisplaySettings;

/// End of the names of project files. `guideway.toml` is the configuration of `check`.
pub(crate) const SUFFIX: &str = ".guideway-project.toml";
/// A shorter end that is understood too.
const SHORT_SUFFIX: &str = ".guideway.toml";
/// Version of the content.
const VERSION: u32 = 1;

/// Returns `true` if a file is a project by its name.
pub(crate) fn is_project(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let name = name.to_lowercase();
    [SUFFIX, SHORT_SUFFIX]
        .iter()
        .any(|suffix| name.ends_with(suffix))
}

/// The content of a project.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", default)]
pub(crate) struct Project {
    /// Version of the content, from 1.
    pub(crate) version: u32,
    /// Index of the file that is edited.
    pub(crate) active: usize,
    /// Identifier of the level that is shown; `None` shows all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) level: Option<String>,
    /// Column that colors the paths; `None` uses the colors of the files.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color_by: Option<String>,
    /// Palette and range of the numbers of that column.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) palette: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color_from: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) color_to: Option<f64>,
    /// Class breaks of these numbers, in place of a range.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(crate) breaks: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) view: Option<ProjectView>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) floor_plan: Option<ProjectPlan>,
    pub(crate) look: DisplaySettings,
    /// The layouts, from the bottom.
    pub(crate) file: Vec<ProjectFile>,
}

/// Center and scale of the view.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct ProjectView {
    pub(crate) center_m: [f64; 2],
    pub(crate) px_per_m: f64,
}

/// A floor plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct ProjectPlan {
    /// File, as seen from the folder of the project.
    pub(crate) path: String,
    /// Placement, as after the `@` of `--floor-plan`.
    #[serde(default)]
    pub(crate) place: String,
    #[serde(default = "yes")]
    pub(crate) is_shown: bool,
    #[serde(default)]
    pub(crate) is_locked: bool,
    #[serde(default = "opaque")]
    pub(crate) opacity: f32,
}

/// A layout.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) struct ProjectFile {
    /// File, as seen from the folder of the project.
    pub(crate) path: String,
    #[serde(default = "yes")]
    pub(crate) is_shown: bool,
}

fn yes() -> bool {
    true
}

fn opaque() -> f32 {
    1.0
}

impl Project {
    /// The project of a text, with all numbers in their ranges.
    ///
    /// # Errors
    /// The reason, for the user.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut project: Self = toml::from_str(text).map_err(|error| {
            let line = error
                .span()
                .map(|at| 1 + text[..at.start].matches('\n').count());
            let line = line.map_or_else(String::new, |line| format!("line {line}: "));
            format!("{line}{}", error.message())
        })?;
        match project.version {
            VERSION => {}
            0 => return Err("`version` is missing: this is no project of Guideway".into()),
            other => {
                return Err(format!(
                    "this project has version {other}, and this Guideway reads version {VERSION}: \
                     update Guideway"
                ));
            }
        }
        project.look = project.look.in_range();
        for end in [&mut project.color_from, &mut project.color_to] {
            *end = end.filter(|number| number.is_finite());
        }
        let is_sound = |view: &ProjectView| {
            let numbers = [view.center_m[0], view.center_m[1], view.px_per_m];
            numbers.iter().all(|number| number.is_finite()) && view.px_per_m > 0.0
        };
        project.view = project.view.filter(is_sound);
        if let Some(plan) = &mut project.floor_plan {
            let is_opacity = (0.0..=1.0).contains(&plan.opacity);
            plan.opacity = if is_opacity { plan.opacity } else { opaque() };
        }
        Ok(project)
    }

    /// The text of the project.
    ///
    /// # Errors
    /// Never for the content of a window.
    pub(crate) fn text(&self) -> Result<String, String> {
        let project = Self {
            version: VERSION,
            ..self.clone()
        };
        toml::to_string(&project).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn project() -> Project {
        let look = DisplaySettings {
            has_labels: false,
            ..DisplaySettings::default()
        };
        Project {
            version: 1,
            active: 1,
            level: Some("Hall".into()),
            color_by: Some("maxSpeed".into()),
            palette: Some("viridis".into()),
            color_from: Some(0.5),
            color_to: None,
            breaks: vec![0.5, 1.0],
            view: Some(ProjectView {
                center_m: [1.5, -2.0],
                px_per_m: 12.0,
            }),
            floor_plan: Some(ProjectPlan {
                path: "plans/hall.png".into(),
                place: "px-per-m=20,offset=0,0".into(),
                is_shown: true,
                is_locked: true,
                opacity: 0.5,
            }),
            look,
            file: ["a.lif.json", "../b.arrow"]
                .map(|path| ProjectFile {
                    path: path.into(),
                    is_shown: path.starts_with('a'),
                })
                .into(),
        }
    }

    #[test]
    fn text_and_project_are_inverse() {
        let text = project().text().unwrap();
        assert_eq!(Project::parse(&text), Ok(project()), "{text}");
        let short = "version = 1\n[[file]]\npath = \"a.lif\"\n";
        let short = Project::parse(short).unwrap();
        assert!(short.file[0].is_shown && short.view.is_none());
    }

    #[test]
    fn odd_texts_are_errors_that_say_where() {
        for (text, said) in [
            ("version = 1\n\n[[file]]\npath = 3\n", "line 4"),
            ("[checks]\n", "`version` is missing"),
            ("version = 9\n", "version 9"),
            ("version = ", "line 1"),
        ] {
            let error = Project::parse(text).unwrap_err();
            assert!(error.contains(said), "{error}");
        }
        let odd = "version = 1\n[view]\ncenter-m = [nan, 0.0]\npx-per-m = -3.0\n\
                   [floor-plan]\npath = \"a\"\nopacity = 7.0\n";
        let project = Project::parse(odd).unwrap();
        assert!(project.view.is_none() && project.floor_plan.unwrap().opacity == 1.0);
    }

    #[test]
    fn projects_are_told_by_their_names() {
        for (name, is) in [
            ("a/hall.guideway-project.toml", true),
            ("HALL.GUIDEWAY-PROJECT.TOML", true),
            ("hall.guideway.toml", true),
            ("guideway.toml", false),
            ("hall.guideway-project.toml/a.lif", false),
        ] {
            assert_eq!(is_project(Path::new(name)), is, "{name}");
        }
    }
}
