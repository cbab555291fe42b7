//! Projects: the files, floor plan and look of a window, remembered in a file that opens them all.
//!
//! | part | owns | file |
//! |---|---|---|
//! | [`Project`] | what a project remembers, as TOML | `content` |
//! | [`relative_to`], [`absolute_from`] | names of files as seen from the project | `relative_paths` |

mod content;
mod relative_paths;

pub(crate) use content::{Project, ProjectFile, ProjectPlan, ProjectView, SUFFIX, is_project};
pub(crate) use relative_paths::{absolute_from, relative_to};
