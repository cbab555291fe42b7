//! `guideway route`: the fastest way between two stations or nodes, as a list, GeoJSON or file; and
//! the same way over a picture.
//!
//! | module | purpose |
//! |---|---|
//! | `run` | arguments, the list |
//! | `geojson` | the paths as GeoJSON, with lengths and times |
//! | `ends` | start, goal and vehicle type in one argument, for `render --route` |

mod ends;
mod geojson;
mod run;

pub(crate) use ends::{FoundRoute, RouteEnds};
pub(crate) use run::{Args, run};
