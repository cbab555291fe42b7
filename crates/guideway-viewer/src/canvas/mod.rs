//! The canvas: the part of the window that shows the picture.
//!
//! | part | input | output | file |
//! |---|---|---|---|
//! | [`Canvas`] | pointer, wheel, touch | camera moves, pointer events | `canvas_input`, `pointer_tracker` |
//! | [`Camera`](camera::Camera) | pan, zoom, fit | view, view history | `camera` |
//! | [`CanvasPainter`] | pictures, draw lists, gesture | shapes of egui | `canvas_painter` |
//!
//! Decorations (grid, scale bar, marks, legend) come as draw lists from
//! [`guideway_document::decorations`].

mod camera;
mod canvas_input;
mod canvas_painter;
mod draft;
mod paint_draw_list;
mod paint_findings;
mod paint_gesture;
mod paint_legends;
mod paint_moving;
mod paint_network;
mod paint_snap;
mod paint_tools;
mod paint_typed;
mod pointer_tracker;
mod screen;
mod shape_text;

pub(crate) use canvas_input::{Canvas, CanvasPlace};
pub(crate) use canvas_painter::CanvasPainter;
pub(crate) use paint_findings::severity_color;
#[cfg(test)]
pub(crate) use paint_gesture::{HOVER_COLOR, SELECTION_COLOR};
pub(crate) use paint_legends::{legends, shown_legends};
pub(crate) use paint_network::{CUT_COLOR, JOINED_COLOR, STATION_COLOR};
pub(crate) use paint_tools::change_color;
pub(crate) use screen::POINT_M;
pub(crate) use shape_text::shape_text;
