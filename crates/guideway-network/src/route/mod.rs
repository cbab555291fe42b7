//! Route: the fastest way between two stations or nodes, for one vehicle type.
//!
//! | module | does |
//! |---|---|
//! | `options`, `error` | assumed speeds; why there is no route |
//! | `cost` | time along each arc, headings at its ends |
//! | `places` | finds stations and nodes by name |
//! | `router` | the network of one vehicle type |
//! | `search` | A* over arcs, with the time of turns |
//! | `rows` | the result: rows with lengths and times, and the layout of the route |

mod cost;
mod error;
mod options;
mod places;
mod router;
mod rows;
mod search;

use guideway_layout::Layout;

pub use error::RouteError;
pub use options::RouteOptions;
pub use places::Place;
pub use router::Router;
pub use rows::{Route, RouteRow};

use crate::arcs::Arcs;
use cost::Costs;

impl<'a> Router<'a> {
    /// Prepares the network of a vehicle type, or of the paths that are open to all.
    ///
    /// Cost: linear in the number of paths and their curves.
    ///
    /// # Errors
    /// When paths name vehicle types and this is none of them, or `None`.
    pub fn new(
        layout: &'a Layout,
        vehicle_type: Option<&'a str>,
        options: &RouteOptions,
    ) -> Result<Self, RouteError> {
        places::check_type(layout, vehicle_type)?;
        let arcs = Arcs::of(layout, vehicle_type);
        let costs = Costs::of(layout, vehicle_type, &arcs, options);
        Ok(Self {
            layout,
            vehicle_type,
            arcs,
            costs,
        })
    }

    /// The station or node of a name: a station first, then a node, by identifier, then by the
    /// attribute `name`.
    ///
    /// # Errors
    /// When there is none, or several nodes of different levels have the name.
    pub fn place(&self, name: &str) -> Result<Place, RouteError> {
        places::find(self.layout, name)
    }

    /// The fastest way from one place to another one. Vehicles start with any heading.
    ///
    /// Time is length over speed, plus the time of turns in place. Turns that rotation rules forbid
    /// are not taken.
    ///
    /// # Errors
    /// When there is no way; the error says what is in the way.
    pub fn route(&self, from: &Place, to: &Place) -> Result<Route, RouteError> {
        let goals = &to.nodes;
        if from.nodes.iter().any(|node| goals.contains(node)) {
            return Ok(Route::default());
        }
        match self.search(from, to, false) {
            Ok(found) => Ok(self.rows(&found)),
            Err(reached) => {
                let detour = self.search(from, to, true).ok();
                Err(self.no_way(
                    from,
                    to,
                    reached,
                    detour.as_ref().map(|found| &found.arcs[..]),
                ))
            }
        }
    }
}
