//! Decorations: everything drawn over or under the paths of a picture, as pure functions.
//!
//! The window, PNG and SVG show the same decorations, because all of them consume the draw lists
//! that these functions return. Every result is bounded by what a screen can show: a view with more
//! paths, nodes or stations than [`MAX_MARKED`] has no marks for them, and [`Marks::left_out`] is
//! set.
//!
//! | file | input | output |
//! |---|---|---|
//! | `style` | | [`DecorationStyle`]: colors and the size of a point |
//! | `grid` | view, style | draw list: grid lines |
//! | `scale_bar` | view, style | draw list: a bar of round length |
//! | `legend` | scene legend, picture size, style | draw list: swatches and labels |
//! | `place_marks` | document, view, options | [`Marks`]: positions of arrows, symbols and labels |
//! | `draw_marks` | marks, style | draw list: arrows, symbols and labels |
//! | `covered_texts` | draw lists on top of each other | those without the texts below others |
//! | `outline` | paths, view | [`Outline`]: center lines of selected paths |
//! | `handles` | document, view | [`Handle`]s: control points of selected paths |
//!
//! `arrows`, `labels`, `line_mask` and `declutter` position marks.

mod arrows;
mod covered_texts;
mod declutter;
mod draw_marks;
mod grid;
mod handles;
mod labels;
mod legend;
mod line_mask;
mod marks;
mod outline;
mod place_marks;
mod scale_bar;
mod style;

pub use covered_texts::hide_covered_texts;
pub use grid::{grid, grid_step_m};
pub use handles::{Handle, handles};
pub use labels::{Label, LabelSize};
pub use legend::{Corner, legend};
pub use marks::{Arrow, MAX_MARKED, MarkOptions, MarkedKinds, Marks};
pub use outline::{Outline, outline, path_outline};
pub use place_marks::marks;
pub use scale_bar::{scale_bar, scale_bar_box};
pub use style::{DecorationStyle, MarkKind};
