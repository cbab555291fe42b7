//! The pointer tools: select and move, edit points, draw, measure.
//!
//! [`Tools`] turns [`PointerEvent`]s into [`ToolEffect`]s. It needs no window: input is a view and
//! a document ([`ToolContext`]).

mod cursor;
mod gesture;
mod hit_test;
mod other_hit;
mod pointer_event;
mod snapping;
mod tool;
mod tool_context;
mod tool_set;

pub(crate) use gesture::Gesture;
pub(crate) use hit_test::{HIT_RADIUS_PX, MAX_HOVER_CANDIDATES};
pub(crate) use other_hit::OtherHit;
pub(crate) use pointer_event::PointerEvent;
pub(crate) use tool::Tool;
pub(crate) use tool_context::ToolContext;
pub(crate) use tool_set::{ToolEffect, Tools};
