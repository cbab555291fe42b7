//! Uploads a scene to the device, and applies edits in place.
//!
//! | file | purpose |
//! |---|---|
//! | `path_parts` | cuts paths into strokes |
//! | `concatenated` | memory of long lists |
//! | `cluster`, `pack` | groups neighboring strokes to clusters; quantizes their points |
//! | `draw_ranks`, `facts` | draw ranks of paths; scene properties that each frame needs |
//! | `point_buffer`, `scene_buffers` | the buffers of a scene, as many as binding limits require |
//! | `exact_points` | exact points of near clusters, uploaded on demand |
//! | `path_strokes`, `hidden_strokes` | finds the strokes of a path, and those of hidden paths |
//! | `uploaded_scene` | the scene and all of the above |
//! | `near_upload` | uploads exact points of near clusters |
//! | `shown_gesture`, `gesture` | shows the paths of a gesture by mapping their clusters |
//! | `edit`, `edit_patches`, `edit_effect` | applies an edit; what that means for cached frames |
//! | `recolor` | other colors for all paths |
//! | `rewrite`, `states`, `style_changes` | new curves, states and styles, by all threads |

pub(crate) mod cluster;
mod concatenated;
pub(crate) mod draw_ranks;
pub(crate) mod edit;
pub(crate) mod edit_effect;
mod edit_patches;
pub(crate) mod exact_points;
pub(crate) mod facts;
pub(crate) mod gesture;
pub(crate) mod hidden_strokes;
pub(crate) mod near_upload;
pub(crate) mod pack;
pub(crate) mod path_parts;
pub(crate) mod path_strokes;
pub(crate) mod point_buffer;
pub(crate) mod recolor;
mod rewrite;
pub(crate) mod scene_buffers;
pub(crate) mod shown_gesture;
mod states;
mod style_changes;
pub(crate) mod uploaded_scene;
