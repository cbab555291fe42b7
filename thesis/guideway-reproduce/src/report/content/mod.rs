//! Builds the sections of the page, with their tables and charts, from a run.
//!
//! | module | purpose |
//! |---|---|
//! | `sections` | all sections in reading order |
//! | `most_paths`, `views`, `growth`, `work`, `about` | sections with measurements |
//! | `section` | a section and its blocks |
//! | `blocks`, `cells` | blocks and cells that several sections use |

mod about;
mod blocks;
mod cells;
mod growth;
mod most_paths;
mod section;
mod sections;
mod views;
mod work;

pub(crate) use section::{Block, Section};
pub(crate) use sections::sections;
