//! The pointer tools: select and move, edit points, draw, create, measure.
//!
//! [`Tools`] turns [`PointerEvent`]s and typed texts into [`ToolEffect`]s. It needs no window:
//! input is a view and a document ([`ToolContext`]).
//!
//! | tool | file |
//! |---|---|
//! | select | `select_tool`, `drag` |
//! | nodes and control points | `points_tool`, `drag` |
//! | lines, arcs, curves, measures | `draw_tool`, `typing` |
//! | nodes, stations | `place_tool`, `typing` |
//!
//! `dispatch` gives each event to the selected tool.

mod cursor;
mod dispatch;
mod drag;
mod draw_tool;
mod gesture;
mod hit_test;
mod other_hit;
mod place_tool;
mod pointer_event;
mod points_tool;
mod select_tool;
mod snapping;
mod tool;
mod tool_context;
mod tool_set;
mod typed_text;
mod typing;

pub(crate) use gesture::Gesture;
pub(crate) use hit_test::{HIT_RADIUS_PX, MAX_HOVER_CANDIDATES};
pub(crate) use other_hit::{HoverTarget, OtherHit};
pub(crate) use pointer_event::PointerEvent;
pub(crate) use tool::Tool;
pub(crate) use tool_context::ToolContext;
pub(crate) use tool_set::{ToolEffect, Tools};
pub(crate) use typed_text::{FORMS, TypedText};
pub(crate) use typing::KeyAnswer;
