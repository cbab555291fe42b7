//! The steps as text: for the help, and for the page `docs/edit-script.md`.

use super::steps::STEPS;

/// The steps for a terminal.
pub fn help() -> String {
    let mut text = "A script is an object with a list of steps. A step that fails leaves the \
                    layout as it was, and nothing is written. Lengths are in meters, speeds in \
                    m/s, angles in degrees.\n\nSteps:\n"
        .to_owned();
    for kind in STEPS {
        text += &format!("\n  {}: {}\n", kind.name, kind.meaning);
        for member in kind.members {
            let mark = if member.is_required { "" } else { "?" };
            let (name, form, meaning) = (member.name, member.form, member.meaning);
            text += &format!("      {name}{mark}: {form}. {meaning}\n");
        }
        text += &format!("      {}\n", kind.example);
    }
    text
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use guideway_document::Document;
    use guideway_formats::ReadOptions;
    use guideway_scene::SceneOptions;

    use super::*;
    use crate::script::Script;
    use crate::script::Touched;
    use crate::script::members::Folder;

    /// The steps in Markdown.
    fn markdown() -> String {
        let mut text = String::new();
        for kind in STEPS {
            text += &format!("### `{}`\n\n{}\n\n", kind.name, kind.meaning);
            text += "| member | form | required | meaning |\n|---|---|---|---|\n";
            for member in kind.members {
                let required = if member.is_required { "yes" } else { "no" };
                let form = member.form.replace('|', "\\|");
                let (name, meaning) = (member.name, member.meaning);
                text += &format!("| `{name}` | {form} | {required} | {meaning} |\n");
            }
            text += &format!("\n```json\n{}\n```\n\n", kind.example);
        }
        text
    }

    #[test]
    fn the_page_has_the_table_of_every_step() {
        let page = include_str!("../../docs/edit-script.md");
        let expected = markdown();
        let is_at_end = page.trim_end().ends_with(expected.trim_end());
        assert!(is_at_end, "the page must end with\n{expected}");
    }

    #[test]
    fn every_example_runs_on_the_example_site() {
        let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
        let layout = Arc::new(crate::open(examples.join("site.lif.json")).unwrap());
        let folder = Folder {
            path: &examples,
            options: &ReadOptions::default(),
        };
        for kind in STEPS {
            let steps = format!("{{\"steps\": [{}]}}", kind.example);
            let script = Script::from_json(steps.as_bytes(), &examples).unwrap();
            let options = SceneOptions::default();
            let mut document = Document::new(Arc::clone(&layout), &options).unwrap();
            let mut touched = Touched::default();
            // An example may need a step before.
            for step in &script.steps {
                let done = step.perform(&mut document, &folder);
                touched = done.unwrap_or_else(|error| panic!("{}: {error:?}", kind.name));
            }
            assert!(!touched.names.is_empty(), "{} touches nothing", kind.name);
            assert!(document.is_changed(), "{} changes nothing", kind.name);
        }
    }
}
