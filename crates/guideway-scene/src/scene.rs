use std::fmt;
use std::sync::{Arc, OnceLock};

use guideway_layout::{Hulls, Layout, Level, PathRef};
use guideway_spline::Bounds;
use rayon::prelude::*;

use crate::Rgba;
use crate::color_by::{self, ColorBy, Legend};

/// How a layout is to look.
#[derive(Clone, Debug, Default)]
pub struct SceneOptions {
    /// Color of paths that have none of their own; black unless set.
    pub color: Option<Rgba>,
    /// Color every path by a column instead.
    pub color_by: Option<ColorBy>,
    /// Draw only the level of this name or id.
    pub level: Option<String>,
}

/// What cannot be made into a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SceneError {
    /// There is no such level.
    UnknownLevel {
        /// The level asked for.
        asked: String,
        /// Those that there are.
        known: Vec<String>,
    },
    /// There is no such column to color by.
    UnknownColumn {
        /// The column asked for.
        asked: String,
        /// Those that there are.
        known: Vec<String>,
    },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, asked, known) = match self {
            Self::UnknownLevel { asked, known } => ("level", asked, known),
            Self::UnknownColumn { asked, known } => ("column", asked, known),
        };
        if known.is_empty() {
            write!(f, "there is no {what} `{asked}`: this layout has none")
        } else {
            write!(
                f,
                "there is no {what} `{asked}`; there is: {}",
                known.join(", ")
            )
        }
    }
}

impl std::error::Error for SceneError {}

/// A layout with every path's style resolved. It changes by [`Scene::edit`] alone.
#[derive(Clone, Debug)]
pub struct Scene {
    pub(crate) layout: Arc<Layout>,
    pub(crate) colors: Colors,
    /// Color of paths that have none of their own.
    base: Rgba,
    /// One a path; empty while all are shown.
    pub(crate) states: Vec<PathState>,
    removed_count: usize,
    draw_order: Vec<u32>,
    /// Found when it is first asked for.
    bounds: OnceLock<Option<Bounds<f64>>>,
    legend: Option<Legend>,
}

/// A copy of a scene's layout, made before an edit needs it: see [`Scene::take_copy`].
#[derive(Debug)]
pub struct LayoutCopy {
    of: Arc<Layout>,
    copy: Arc<Layout>,
}

impl LayoutCopy {
    /// A copy of a layout, which takes as long as the layout is large.
    pub fn new(of: Arc<Layout>) -> Self {
        let copy = Arc::new(Layout::clone(&of));
        Self { of, copy }
    }
}

/// Whether a path is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PathState {
    /// It is.
    #[default]
    Shown,
    /// It is not, but belongs to the layout: a report counts it as hidden.
    Hidden,
    /// It is no longer part of the layout, though its row is kept, so that no other row changes.
    Removed,
}

#[derive(Clone, Debug)]
pub(crate) enum Colors {
    One(Rgba),
    Each(Vec<Rgba>),
}

impl Scene {
    /// Resolves the styles of a layout.
    ///
    /// # Errors
    /// When the options name a level or a column that the layout has not.
    pub fn new(layout: Arc<Layout>, options: &SceneOptions) -> Result<Self, SceneError> {
        let states = states(&layout, options.level.as_deref())?;
        let draw_order = draw_order(&layout, &states);
        let base = options.color.unwrap_or(Rgba::BLACK);
        let (colors, legend) = match &options.color_by {
            Some(by) => {
                let (colors, legend) = color_by::resolve(&layout, by, &draw_order)?;
                (Colors::Each(colors), Some(legend))
            }
            None => (own_colors(&layout, base), None),
        };
        Ok(Self {
            layout,
            colors,
            base,
            states,
            removed_count: 0,
            draw_order,
            bounds: OnceLock::new(),
            legend,
        })
    }

    /// The layout that is drawn.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The same, for another scene of it.
    pub fn shared_layout(&self) -> Arc<Layout> {
        Arc::clone(&self.layout)
    }

    /// Whether others hold the layout too, so that the next edit of it takes a copy.
    pub fn is_layout_shared(&self) -> bool {
        Arc::strong_count(&self.layout) > 1
    }

    /// Holds a copy of its layout in place of the one that others hold too. One of another layout, or of this one before an
    /// edit, is dropped.
    pub fn take_copy(&mut self, copy: LayoutCopy) {
        if Arc::ptr_eq(&self.layout, &copy.of) {
            self.layout = copy.copy;
        }
    }

    /// Rows of the paths that are drawn, from the lowest draw rank to the highest. Paths of other levels
    /// are not among them.
    pub fn draw_order(&self) -> &[u32] {
        &self.draw_order
    }

    /// Rows of paths, removed ones among them.
    pub fn row_count(&self) -> usize {
        self.layout.paths.len()
    }

    /// Paths of the layout, refused ones among them and removed ones not.
    pub fn path_count(&self) -> usize {
        self.layout.path_count() - self.removed_count
    }

    /// Paths of the layout that this scene hides.
    pub fn hidden_count(&self) -> usize {
        self.row_count() - self.removed_count - self.draw_order.len()
    }

    /// Whether a path is drawn.
    pub fn state(&self, path: u32) -> PathState {
        self.states.get(path as usize).copied().unwrap_or_default()
    }

    /// Color of a path.
    pub fn color(&self, path: u32) -> Rgba {
        match &self.colors {
            Colors::One(color) => *color,
            Colors::Each(colors) => colors[path as usize],
        }
    }

    /// The color of all drawn paths, if they have one in common; black if there are none.
    pub fn common_color(&self) -> Option<Rgba> {
        let mut colors = self.draw_order.iter().map(|&path| self.color(path));
        let first = colors.next().unwrap_or(Rgba::BLACK);
        let is_common = matches!(self.colors, Colors::One(_)) || colors.all(|c| c == first);
        is_common.then_some(first)
    }

    /// Whether nothing shows through any path.
    pub fn is_opaque(&self) -> bool {
        match &self.colors {
            Colors::One(color) => color.is_opaque(),
            Colors::Each(colors) => colors.iter().all(|c| c.is_opaque()),
        }
    }

    /// Width of a path in meters, if it has one of its own.
    pub fn width_m(&self, path: u32) -> Option<f32> {
        let width_m = *self.layout.paths.width_m()?.get(path as usize)?;
        (width_m.is_finite() && width_m >= 0.0).then_some(width_m)
    }

    /// Box that holds all drawn paths, in meters; none if there are none. Found when it is first asked for
    /// after a change.
    pub fn bounds(&self) -> Option<Bounds<f64>> {
        *self
            .bounds
            .get_or_init(|| bounds(&self.layout, self.hulls(), &self.draw_order))
    }

    /// Where the control points of each path lie. Found when it is first asked for after curves have changed.
    pub fn hulls(&self) -> &Hulls {
        self.layout.paths.geometry().hulls()
    }

    /// What the colors mean, if they were chosen by a column.
    pub fn legend(&self) -> Option<&Legend> {
        self.legend.as_ref()
    }

    /// Color of a path without a column that decides.
    pub(crate) fn own_color(&self, path: u32) -> Rgba {
        let own = self.layout.paths.own_style(path as usize).color_rgba;
        own.map_or(self.base, Rgba::from_u32)
    }

    /// After curves have changed.
    pub(crate) fn forget_bounds(&mut self) {
        self.bounds = OnceLock::new();
    }

    /// After rows or states have changed.
    pub(crate) fn order_anew(&mut self) {
        let is_removed = |state: &&PathState| **state == PathState::Removed;
        self.removed_count = self.states.iter().filter(is_removed).count();
        self.draw_order = draw_order(&self.layout, &self.states);
        self.forget_bounds();
    }
}

/// Paths of other levels than the one asked for are hidden.
fn states(layout: &Layout, level: Option<&str>) -> Result<Vec<PathState>, SceneError> {
    let Some(asked) = level else {
        return Ok(Vec::new());
    };
    let only = layout.level_named(asked);
    if only.is_none() {
        return Err(SceneError::UnknownLevel {
            asked: asked.to_owned(),
            known: layout.levels.iter().map(level_label).collect(),
        });
    }
    let state = |path: PathRef<'_>| match path.level() == only {
        true => PathState::Shown,
        false => PathState::Hidden,
    };
    Ok(layout.paths.iter().map(state).collect())
}

fn draw_order(layout: &Layout, states: &[PathState]) -> Vec<u32> {
    let rows = 0..layout.paths.len() as u32;
    let mut order: Vec<u32> = rows.into_par_iter().collect();
    if !states.is_empty() {
        order.retain(|&path| states[path as usize] == PathState::Shown);
    }
    if let Some(rank) = layout.paths.rank() {
        order.sort_by_key(|&path| rank[path as usize]);
    }
    order
}

/// A level as it may be asked for: by its id or its name.
fn level_label(level: &Level) -> String {
    match &level.name {
        Some(name) if *name != level.id => format!("{} ({name})", level.id),
        _ => level.id.clone(),
    }
}

fn own_colors(layout: &Layout, base: Rgba) -> Colors {
    match layout.paths.color_rgba() {
        None => Colors::One(base),
        Some(own) => {
            let color = |&c: &u32| if c == 0 { base } else { Rgba::from_u32(c) };
            Colors::Each(own.iter().map(color).collect())
        }
    }
}

/// The box of the curves themselves: that of their control points is up to three times as large. Only
/// a path, and then a segment, whose hull reaches out of the box so far is looked at closely: first those that reach farthest.
fn bounds(layout: &Layout, hulls: &Hulls, drawn: &[u32]) -> Option<Bounds<f64>> {
    /// Paths whose hulls are looked at as one first.
    const FEW: usize = 64;
    const SIDES: [fn(Bounds<f64>) -> f64; 4] =
        [|b| -b.min.x, |b| -b.min.y, |b| b.max.x, |b| b.max.y];
    let reaches_out = |hull: Option<Bounds<f64>>, all: Option<Bounds<f64>>| match (hull, all) {
        (Some(hull), Some(all)) => !(all.contains(hull.min) && all.contains(hull.max)),
        (hull, _) => hull.is_some(),
    };
    let hull = |paths: &[u32]| hulls.of(paths.iter().map(|&path| path as usize));
    let few = drawn
        .par_chunks(FEW)
        .filter_map(|few| Some((hull(few)?, few)));
    let few: Vec<(Bounds<f64>, &[u32])> = few.collect();
    let with = |mut all: Option<Bounds<f64>>, &(bounds, few): &(Bounds<f64>, &[u32])| {
        if !reaches_out(Some(bounds), all) {
            return all;
        }
        for &path in few {
            if !reaches_out(hull(&[path]), all) {
                continue;
            }
            let runs = layout.paths.get(path as usize).runs();
            for segment in runs.flat_map(|run| run.segments()) {
                if reaches_out(Bounds::of_points(segment), all) {
                    let tight = Bounds::of_segment(&segment);
                    all = Some(all.map_or(tight, |all| all.union(tight)));
                }
            }
        }
        all
    };
    let farthest = SIDES.iter().filter_map(|side| {
        let reach = |few: &(Bounds<f64>, _)| side(few.0);
        few.iter().max_by(|a, b| reach(a).total_cmp(&reach(b)))
    });
    let first = farthest.fold(None, with);
    let parts = few.par_iter().fold(|| first, with);
    parts.flatten().reduce_with(Bounds::union)
}
