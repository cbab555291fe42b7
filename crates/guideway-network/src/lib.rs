//! Networks of paths: builds them from drawings, finds their faults, and the fastest routes in
//! them.
//!
//! | module | input | output |
//! |---|---|---|
//! | [`build`] | the layout of a drawing, [`BuildOptions`] | a layout whose paths meet at nodes, and a [`BuildReport`] |
//! | [`analyze`] | a layout | findings about parts, dead ends, stations, turns and speeds, per vehicle type |
//! | [`Router`] | a layout, a vehicle type | the fastest [`Route`] between two stations or nodes |
//! | `arcs`, `heading`, `bend` | a layout | driven paths by node; headings; radii |
//!
//! [`build`] needs the feature of its name, which is on by default.

mod analyze;
mod arcs;
mod bend;
#[cfg(feature = "build")]
mod build;
mod heading;
mod route;

pub use analyze::{AnalyzeOptions, analyze, analyze_watched};
#[cfg(feature = "build")]
pub use build::{
    BuildError, BuildOptions, BuildReport, DirectionRule, DrawingSources, LayerRule, LeftNote,
    Network, NoteSource, UnmatchedSource, build,
};
pub use route::{Place, Route, RouteError, RouteOptions, RouteRow, Router};
