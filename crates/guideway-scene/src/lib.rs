//! The scene (what is drawn) and the contract of every render method (how a scene becomes a frame).
//!
//! A [`Scene`] resolves the styles of a layout once: color, width and draw order of every path. It
//! keeps the layout's own control points; a method subtracts the center of the view in `f64` before
//! it rounds to `f32`, which preserves millimeters 10,000 km from the origin without a second copy.
//!
//! A [`Method`] prepares a scene once ([`Prepared`]) and renders any [`View`] of it into a
//! [`Frame`]; its [`Report`] accounts for every path. All methods agree on the picture:
//!
//! - A path covers a point when its distance to the path's center line is at most half the stroke
//!   width.
//! - The color of a point is that of the topmost covering path, composited over the paths below it
//!   while it is translucent. A pixel is the mean over its square, of sRGB values as stored.
//! - Density shading shows the mean number of paths that cover a pixel; near its ends a path counts
//!   half ([`density`]).
//!
//! | files | content |
//! |---|---|
//! | `scene/`, `color`, `color_by`, `ramp`, `breaks`, `style`, `density` | appearance of the paths |
//! | `edit/`, `table` | changes of a scene and their inverses |
//! | `cluster/` | the spatial index of paths, nodes and strokes |
//! | `view`, `frame`, `strip`, `device_picture` | the picture |
//! | `method`, `report`, `error` | the contract of render methods |
//! | `draw_list` | decorations over or below the paths |

mod breaks;
pub mod cluster;
mod color;
mod color_by;
pub mod density;
mod device_picture;
mod draw_list;
mod edit;
mod error;
mod frame;
mod method;
mod ramp;
mod report;
mod scene;
mod strip;
mod style;
mod table;
mod view;

pub use breaks::{ClassBreaks, ClassBreaksError};
pub use color::{ParseColorError, Rgba};
pub use color_by::{ColorBy, Legend, LegendEntry, LegendScale};
pub use device_picture::DevicePicture;
pub use draw_list::{DrawList, Fill, TextLine};
pub use edit::{Edit, EditError, Gesture, GesturePaths, Insertion, NewNode, NewStation, TableEdit};
pub use error::RenderError;
pub use frame::{Frame, FrameSize};
pub use method::{Budget, Cancel, EditOutcome, Method, MethodInfo, Prepared};
pub use ramp::{NumberColors, Palette, round_step};
pub use report::{Clock, Preparation, Report, Stage, Work, elapsed_ms};
pub use scene::{Coloring, LayoutCopy, NoOpaqueColor, PathState, Scene, SceneError, SceneOptions};
pub use strip::Strip;
pub use style::{LineRule, Shading, Style};
pub use table::Table;
pub use view::View;
