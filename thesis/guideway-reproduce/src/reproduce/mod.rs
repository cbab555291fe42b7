//! Measures every table and figure of chapter 5 of the thesis on the devices of this computer.
//!
//! [`reproduce`] takes a [`Plan`] and returns a [`Run`] with all measurements and their
//! circumstances; [`resume`] measures the missing parts of a run. A part gets time by its weight,
//! and leaves its unused time to the later parts.
//!
//! | module | purpose |
//! |---|---|
//! | `plan` | methods, datasets, sizes and limits of a run |
//! | `measure`, `resume` | measures a plan, or the missing parts of a run |
//! | `parts` | the measurements per table and figure |
//! | `session`, `deadline` | started methods, recent scenes, and the time limit |
//! | `search` | finds the most paths within a frame time |
//! | `run` | the record of a run |
//! | `findings` | judges the claims of the thesis by a run |
//! | `names`, `thesis` | names of methods and stages; numbers of the thesis |

mod deadline;
mod findings;
mod measure;
pub(crate) mod names;
mod parts;
mod plan;
mod resume;
mod run;
mod search;
mod session;
pub(crate) mod thesis;

pub use findings::{Finding, Verdict, findings};
pub use measure::reproduce;
pub use plan::{METHODS, Plan};
pub use resume::{ResumeError, resume};
pub use run::{
    Border, MethodFacts, MostPaths, PartFacts, Picture, Reading, Results, Run, RunSession,
};
pub use search::{Limit, Search, Trial};
