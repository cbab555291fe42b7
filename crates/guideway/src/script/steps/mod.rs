//! The kinds of steps. A new kind is a [`StepKind`] in a file and an entry in [`STEPS`].

mod copies;
mod create;
mod delete;
mod groups;
mod moves;
mod paths;
mod properties;
mod shapes;
mod values;

use super::step::StepKind;

/// All kinds of steps, in the order of the help.
pub(super) const STEPS: &[&StepKind] = &[
    &properties::SET,
    &properties::RENAME,
    &properties::SET_VEHICLE_TYPES,
    &properties::SET_LEVEL,
    &paths::REVERSE,
    &paths::ONE_WAY,
    &paths::TWO_WAY,
    &create::NODE,
    &create::EDGE,
    &create::ARC,
    &create::SPLINE,
    &create::STATION,
    &delete::DELETE,
    &groups::CREATE_LEVEL,
    &groups::CHANGE_LEVEL,
    &groups::DELETE_LEVEL,
    &groups::CREATE_TYPE,
    &groups::CHANGE_TYPE,
    &groups::DELETE_TYPE,
    &moves::MOVE,
    &moves::TURN,
    &moves::MIRROR,
    &moves::SCALE,
    &moves::MOVE_NODE,
    &shapes::ALIGN,
    &shapes::DISTRIBUTE,
    &shapes::SPLIT,
    &shapes::SPLIT_CROSSINGS,
    &shapes::JOIN,
    &shapes::WELD,
    &shapes::STRAIGHTEN,
    &shapes::FILLET,
    &copies::COPY,
    &copies::PASTE,
];
