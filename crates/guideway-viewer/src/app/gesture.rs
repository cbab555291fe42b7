use eframe::egui::Modifiers;
use guideway_document::decorations::{Handle, handles, round_step};
use guideway_document::{Document, Hit, PathSet, PointRef, SelectMode, SnapOptions};
use guideway_scene::View;
use guideway_spline::{Affine, Bounds, Point};

use super::App;

/// How near the pointer must be to what it means.
pub(crate) const REACH_PX: f64 = 8.0;
/// Where more paths than this are near the pointer, it takes a click to choose one.
pub(crate) const MOST_HOVERED: usize = 3_000;
/// With Shift held, lines and moves go in one of so many directions.
const DIRECTIONS: u32 = 24;

/// What the pointer does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Tool {
    /// Selects paths and moves them.
    #[default]
    Select,
    /// Moves nodes and control points.
    Points,
    /// Draws a path, click by click.
    Draw,
    /// Measures, click by click.
    Measure,
}

/// What the pointer is doing. Positions on the screen are pixels from the picture's upper left corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) enum Gesture {
    #[default]
    None,
    /// Moves the view.
    Pan,
    /// Draws a box to select by.
    Box {
        from_px: Point<f64>,
        to_px: Point<f64>,
    },
    /// Moves the selection, which shows as an outline until it is let go. Held by an end of a path, it goes to nodes.
    Move {
        from_m: Point<f64>,
        by_m: Point<f64>,
        by_end: bool,
    },
    /// Moves a node; the layout follows at once.
    Node {
        node: u32,
        from_m: Point<f64>,
        has_moved: bool,
    },
    /// Moves a control point; the layout follows at once.
    Handle {
        point: PointRef,
        from_m: Point<f64>,
        has_moved: bool,
    },
    /// Points of a path, or of what is measured.
    Points(Vec<Point<f64>>),
}

impl App {
    /// The pointer is here, and no button is held.
    pub(crate) fn hover(&mut self, at_px: Option<Point<f64>>) {
        self.hover = at_px.and_then(|at_px| self.pick(at_px, MOST_HOVERED));
    }

    /// What lies under the pointer. Where the document is another one since, that may be nothing.
    pub(crate) fn hovered(&self) -> Option<&Hit> {
        let rows = self.document()?.scene().row_count();
        self.hover.as_ref().filter(|hit| (hit.path as usize) < rows)
    }

    fn pick(&self, at_px: Point<f64>, most: usize) -> Option<Hit> {
        let view = self.camera.view()?;
        let at_m = view.world_from_pixel(at_px);
        let rule = self.look.line_rule();
        self.document()?
            .pick(rule, view.px_per_m(), at_m, REACH_PX, most)
    }

    /// A button goes down here, and the pointer moves.
    pub(crate) fn begin_drag(&mut self, at_px: Point<f64>) {
        let (Some(view), Some(document)) = (self.camera.view(), self.document()) else {
            self.gesture = Gesture::Pan;
            return;
        };
        let at_m = view.world_from_pixel(at_px);
        let begin_box = Gesture::Box {
            from_px: at_px,
            to_px: at_px,
        };
        self.gesture = match self.tool {
            Tool::Draw | Tool::Measure => return,
            Tool::Select => match self.pick(at_px, usize::MAX) {
                Some(hit) if document.selection().contains(hit.path) => {
                    let end = end_near(document, &hit, REACH_PX / view.px_per_m());
                    Gesture::Move {
                        from_m: end.unwrap_or(hit.point_m),
                        by_m: Point::new(0.0, 0.0),
                        by_end: end.is_some(),
                    }
                }
                _ => begin_box,
            },
            Tool::Points => {
                let handle = nearest_handle(document, &view, at_px);
                let node = document.node_near(at_m, REACH_PX / view.px_per_m());
                match (handle, node) {
                    (Some(handle), _) => Gesture::Handle {
                        point: handle.point,
                        from_m: view.world_from_pixel(handle.at_px),
                        has_moved: false,
                    },
                    (None, Some(node)) => Gesture::Node {
                        node,
                        from_m: document.node_position_m(node),
                        has_moved: false,
                    },
                    (None, None) => begin_box,
                }
            }
        };
        if !matches!(self.gesture, Gesture::Box { .. })
            && let Some(layer) = self.layers.get_mut(self.active)
        {
            layer.expect_edit(&self.wake);
        }
    }

    /// The pointer is here with the button held.
    pub(crate) fn drag(&mut self, at_px: Point<f64>, modifiers: Modifiers) {
        let Some(view) = self.camera.view() else {
            return;
        };
        if self.document().is_none() {
            // What was last done to it is still being done: the next movement counts.
            return;
        }
        let at_m = view.world_from_pixel(at_px);
        match &mut self.gesture {
            Gesture::None | Gesture::Pan | Gesture::Points(_) => {}
            Gesture::Box { to_px, .. } => *to_px = at_px,
            &mut Gesture::Move { from_m, by_end, .. } => {
                let to_m = match by_end {
                    true => self.node_at(&view, at_m, modifiers),
                    false => None,
                };
                let by_m = match to_m {
                    Some(to_m) => to_m - from_m,
                    None => self.move_by(&view, at_m - from_m, modifiers),
                };
                self.gesture = Gesture::Move {
                    from_m,
                    by_m,
                    by_end,
                };
            }
            Gesture::Node {
                node, has_moved, ..
            } => {
                let (node, undo_first) = (*node, std::mem::replace(has_moved, true));
                let to_m = self.snapped(&view, at_m, modifiers);
                self.edit_again(undo_first, move |document| document.move_node(node, to_m));
            }
            Gesture::Handle {
                point, has_moved, ..
            } => {
                let (point, undo_first) = (*point, std::mem::replace(has_moved, true));
                let to_m = self.snapped(&view, at_m, modifiers);
                self.edit_again(undo_first, move |document| document.move_point(point, to_m));
            }
        }
    }

    /// The button goes up.
    pub(crate) fn end_drag(&mut self, modifiers: Modifiers) {
        let gesture = std::mem::take(&mut self.gesture);
        let Some(view) = self.camera.view() else {
            return;
        };
        match gesture {
            Gesture::Box { from_px, to_px } => {
                let corners = [from_px, to_px].map(|pixel| view.world_from_pixel(pixel));
                // From the right to the left it takes what it meets, else what is inside: as CAD has it.
                let may_reach_out = to_px.x < from_px.x;
                if let Some(bounds) = Bounds::of_points(corners) {
                    let how = combine(modifiers);
                    self.change(move |document| document.select_in(bounds, may_reach_out, how));
                }
            }
            Gesture::Move { by_m, .. } if by_m.norm() > 0.0 => {
                let by = Affine::translation(by_m);
                self.edit(move |document| document.transform_selection("move", by));
            }
            // A path that is being drawn goes on.
            gesture @ Gesture::Points(_) => self.gesture = gesture,
            _ => {}
        }
    }

    /// A click here.
    pub(crate) fn click(&mut self, at_px: Point<f64>, modifiers: Modifiers) {
        let Some(view) = self.camera.view() else {
            return;
        };
        let at_m = view.world_from_pixel(at_px);
        match self.tool {
            Tool::Select | Tool::Points => {
                let hit = self.pick(at_px, usize::MAX);
                let hit = hit.map(|hit| self.other_of_pair(hit));
                let rows: PathSet = hit.iter().map(|hit| hit.path).collect();
                let how = combine(modifiers);
                self.change(move |document| document.select(rows, how));
            }
            Tool::Draw | Tool::Measure => {
                let place = self.snapped(&view, at_m, modifiers);
                match &mut self.gesture {
                    Gesture::Points(points) => points.push(place),
                    gesture => *gesture = Gesture::Points(vec![place]),
                }
            }
        }
    }

    /// Of two paths that lie on each other, a click takes the one that is drawn last; the next one there, the other.
    fn other_of_pair(&self, hit: Hit) -> Hit {
        let twin = || {
            let document = self.document()?;
            let selected = document.selection();
            let is_only = selected.len() == 1 && selected.contains(hit.path);
            is_only.then(|| document.reverse_path_at(&hit, MOST_HOVERED))?
        };
        Hit {
            path: twin().unwrap_or(hit.path),
            ..hit
        }
    }

    /// A second click at the same place.
    pub(crate) fn double_click(&mut self) {
        match self.tool {
            Tool::Draw => self.finish_path(),
            Tool::Measure => self.gesture = Gesture::None,
            Tool::Select if self.hovered().is_some() => self.set_tool(Tool::Points),
            Tool::Select | Tool::Points => {}
        }
    }

    /// Puts a control point beside the one under the pointer, or takes that one away.
    pub(crate) fn change_points(&mut self, at_px: Point<f64>, inserts: bool) {
        let (Some(view), Some(document)) = (self.camera.view(), self.document()) else {
            return;
        };
        if let Some(handle) = nearest_handle(document, &view, at_px) {
            self.edit(move |document| match inserts {
                true => document.insert_point(handle.point),
                false => document.remove_point(handle.point),
            });
        }
    }

    /// The path that is being drawn is whole.
    pub(crate) fn finish_path(&mut self) {
        if self.tool != Tool::Draw {
            return;
        }
        let Gesture::Points(mut points) = std::mem::take(&mut self.gesture) else {
            return;
        };
        // A double click leaves the last point twice.
        points.dedup();
        let Some(view) = self.camera.view() else {
            return;
        };
        let reach_m = REACH_PX / view.px_per_m();
        self.edit(move |document| {
            let id = format!("drawn {}", document.scene().row_count() + 1);
            document.draw_path(id, &points, reach_m)
        });
    }

    /// Where a click here means, or a point that is dragged here: at a node near by, in a direction with Shift, on the
    /// grid if that is asked for, and just here with Alt.
    pub(crate) fn snapped(
        &self,
        view: &View,
        at_m: Point<f64>,
        modifiers: Modifiers,
    ) -> Point<f64> {
        let Some(document) = self.document() else {
            return at_m;
        };
        if modifiers.alt {
            return at_m;
        }
        let (from_m, moving_node) = match &self.gesture {
            Gesture::Points(points) => (points.last().copied(), None),
            Gesture::Handle { from_m, .. } => (Some(*from_m), None),
            Gesture::Node { node, from_m, .. } => (Some(*from_m), Some(*node)),
            _ => (None, None),
        };
        let snap = SnapOptions {
            node_reach_m: Some(REACH_PX / view.px_per_m()),
            moving_node,
            grid_m: self.snaps_to_grid.then(|| grid_step_m(view)),
            directions: modifiers.shift.then_some(DIRECTIONS),
        };
        document.snap(&snap, at_m, from_m)
    }

    /// Where the node is that is meant here.
    fn node_at(&self, view: &View, at_m: Point<f64>, modifiers: Modifiers) -> Option<Point<f64>> {
        let document = self.document().filter(|_| !modifiers.alt)?;
        let node = document.node_near(at_m, REACH_PX / view.px_per_m())?;
        Some(document.node_position_m(node))
    }

    fn move_by(&self, view: &View, by_m: Point<f64>, modifiers: Modifiers) -> Point<f64> {
        if modifiers.alt {
            return by_m;
        }
        let zero = Point::new(0.0, 0.0);
        let snap = SnapOptions {
            grid_m: self.snaps_to_grid.then(|| grid_step_m(view)),
            directions: modifiers.shift.then_some(DIRECTIONS),
            ..SnapOptions::default()
        };
        self.document()
            .map_or(by_m, |document| document.snap(&snap, by_m, Some(zero)))
    }

    /// Does an edit that takes the place of the one before: a whole drag is one step to undo.
    fn edit_again<E: ToString>(
        &mut self,
        undo_first: bool,
        edit: impl FnOnce(&mut Document) -> Result<(), E> + Send + 'static,
    ) {
        self.edit(move |document| {
            if undo_first {
                document.undo();
            }
            edit(document)
        });
    }
}

/// The end of a path that is taken hold of, if one is near where it was hit.
fn end_near(document: &Document, hit: &Hit, reach_m: f64) -> Option<Point<f64>> {
    let (start, end) = document.layout().paths.get(hit.path as usize).ends()?;
    let distance_m = |end: &Point<f64>| end.distance(hit.point_m);
    let ends = [start, end].into_iter();
    ends.filter(|end| distance_m(end) <= reach_m)
        .min_by(|a, b| distance_m(a).total_cmp(&distance_m(b)))
}

/// Distance between lines of the grid, round and never too near on the screen.
pub(crate) fn grid_step_m(view: &View) -> f64 {
    const LEAST_PX: f64 = 24.0;
    round_step(LEAST_PX / view.px_per_m())
}

fn combine(modifiers: Modifiers) -> SelectMode {
    if modifiers.shift {
        SelectMode::Add
    } else if modifiers.alt || modifiers.command {
        SelectMode::Remove
    } else {
        SelectMode::Replace
    }
}

fn nearest_handle(document: &Document, view: &View, at_px: Point<f64>) -> Option<Handle> {
    let near = handles(document, view).into_iter();
    let near = near.map(|handle| (handle.at_px.distance(at_px), handle));
    let nearest = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
    (nearest.0 <= REACH_PX).then_some(nearest.1)
}
