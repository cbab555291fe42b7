//! The search for a route: the chosen places, and the result of the background task.

use guideway_document::{Document, Element};
use guideway_envelope::EnvelopeSource;
use guideway_spline::Point;

use super::found::{FoundRoute, RoutePlace};
use crate::background::{LatestTask, RepaintHandle};

/// Start or goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Slot {
    From,
    To,
}

/// The subject of a result.
#[derive(Clone, Debug, PartialEq)]
struct RouteKey {
    /// Index of the file, and state of its document.
    file: usize,
    state: u64,
    places: [RoutePlace; 2],
    vehicle_type: Option<String>,
    vehicle: Option<EnvelopeSource>,
}

type Found = Result<FoundRoute, String>;

/// Places, vehicle and result of a search.
#[derive(Default)]
pub(crate) struct RouteSearch {
    places: [Option<RoutePlace>; 2],
    /// The place that the next click chooses.
    picking: Option<Slot>,
    /// `None` until the user chooses one: then it is the first type of the layout.
    pub(crate) vehicle_type: Option<String>,
    /// The part of the route that the vehicle has driven, from 0 to 1.
    pub(crate) driven: f32,
    pub(crate) shows_area: bool,
    latest: LatestTask<RouteKey, Found>,
}

impl RouteSearch {
    /// The next clicks choose start and goal.
    pub(crate) fn pick_again(&mut self) {
        self.picking = Some(Slot::From);
    }

    /// The next click chooses a place.
    pub(crate) fn pick(&mut self, slot: Slot) {
        self.picking = Some(slot);
    }

    pub(crate) fn is_picking(&self) -> bool {
        self.picking.is_some()
    }

    /// The place that the next click chooses.
    pub(crate) fn picking(&self) -> Option<Slot> {
        self.picking
    }

    /// Ends the choice of places.
    pub(crate) fn stop_picking(&mut self) {
        self.picking = None;
    }

    pub(crate) fn place(&self, slot: Slot) -> Option<&RoutePlace> {
        self.places[slot as usize].as_ref()
    }

    /// Takes the place that was clicked. The click after the one of the start chooses the goal.
    pub(crate) fn choose(&mut self, place: RoutePlace) {
        match self.picking {
            Some(Slot::From) => {
                self.places = [Some(place), self.places[1].take()];
                self.picking = Some(Slot::To);
            }
            Some(Slot::To) => {
                self.places[1] = Some(place);
                self.picking = None;
            }
            None => {}
        }
    }

    /// Exchanges start and goal.
    pub(crate) fn turn_around(&mut self) {
        self.places.swap(0, 1);
    }

    pub(crate) fn is_busy(&self) -> bool {
        self.latest.is_busy()
    }

    /// The result for the active file, if it is not out of date.
    pub(crate) fn result(&self, file: usize) -> Option<Result<&FoundRoute, &str>> {
        let (key, found) = self.latest.result().filter(|(key, _)| key.file == file)?;
        let is_present = |slot: Slot| self.place(slot) == Some(&key.places[slot as usize]);
        let is_present = is_present(Slot::From) && is_present(Slot::To);
        is_present.then(|| found.as_ref().map_err(String::as_str))
    }

    /// Searches again after a change; takes a finished result.
    pub(crate) fn update(
        &mut self,
        file: usize,
        document: Option<&Document>,
        vehicle: Option<EnvelopeSource>,
        repaint: &RepaintHandle,
    ) {
        self.latest.take_finished(|error| Err(error.to_string()));
        let (Some(document), [Some(from), Some(to)]) = (document, &self.places) else {
            return;
        };
        let types = document.layout().paths.vehicle_types().names();
        let is_known = |name: &&String| types.contains(name);
        let vehicle_type = self.vehicle_type.as_ref().filter(is_known);
        let key = RouteKey {
            file,
            state: document.state(),
            places: [from.clone(), to.clone()],
            vehicle_type: vehicle_type.or(types.first()).cloned(),
            vehicle: vehicle.filter(|_| self.shows_area),
        };
        if !self.latest.is_due(&key) {
            return;
        }
        let (snapshot, wanted) = (document.snapshot(), key.clone());
        self.latest.start(key, repaint, move || {
            let [from, to] = &wanted.places;
            let vehicle_type = wanted.vehicle_type.as_deref();
            FoundRoute::search(&snapshot, vehicle_type, [from, to], wanted.vehicle)
        });
    }
}

/// The place of a station, of a node, or of the end of a path that is nearer to a point.
pub(crate) fn place_of(
    document: &Document,
    element: Element,
    near_m: Point<f64>,
) -> Option<RoutePlace> {
    let layout = document.layout();
    let named = match element {
        Element::Path(row) => {
            let path = layout.paths.get(row as usize);
            let ends = [path.start_node(), path.end_node()].into_iter().flatten();
            let distance_m = |node: &u32| document.node_position_m(*node).distance(near_m);
            Element::Node(ends.min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)))?)
        }
        other => other,
    };
    let nodes = match named {
        Element::Station(row) => layout.stations.nodes(row).to_vec(),
        Element::Node(row) => vec![row],
        Element::Path(_) => Vec::new(),
    };
    let name = named.id(layout).to_owned();
    Some(RoutePlace { name, nodes })
}
