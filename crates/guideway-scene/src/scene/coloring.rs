//! [`Coloring`]: the color of each path of a layout, and what the colors mean.

use guideway_layout::Layout;

use super::draw_order::{draw_order, states};
use super::error::SceneError;
use super::level::visible_level;
use super::options::SceneOptions;
use super::path_state::PathState;
use crate::color::Rgba;
use crate::color_by::{self, Legend};

/// Color of walls and doors: a contrast of 3:1 on white paper, and 5:1 on dark one.
const STRUCTURE: Rgba = Rgba::opaque(144, 144, 144);

/// The colors of all paths of a layout. A scene has one, and can take another one at any time: see
/// [`Scene::recolor`](crate::Scene::recolor).
#[derive(Clone, Debug)]
pub struct Coloring {
    pub(crate) colors: Colors,
    /// Color of paths without a color of their own.
    pub(crate) base: Rgba,
    pub(crate) legend: Option<Legend>,
    /// True if paths that no vehicle drives are drawn below all others.
    pub(crate) structure_below: bool,
}

/// One color for all paths, or one for each row.
#[derive(Clone, Debug)]
pub(crate) enum Colors {
    One(Rgba),
    Each(Vec<Rgba>),
}

impl Coloring {
    /// The colors of a scene with these options.
    ///
    /// # Errors
    /// When the options name a level or a column that the layout does not have.
    pub fn new(layout: &Layout, options: &SceneOptions) -> Result<Self, SceneError> {
        let level = visible_level(layout, options.level.as_deref())?;
        Self::of(layout, options, &states(layout, level))
    }

    /// As [`Self::new`], with the states of the paths; without any, all are shown.
    pub(super) fn of(
        layout: &Layout,
        options: &SceneOptions,
        states: &[PathState],
    ) -> Result<Self, SceneError> {
        let base = options.color.unwrap_or(Rgba::BLACK);
        let Some(by) = &options.color_by else {
            let mut colors = own_colors(layout, base);
            let structure_below = options.has_gray_structure && colors.gray_structure(layout);
            return Ok(Self {
                colors,
                base,
                legend: None,
                structure_below,
            });
        };
        let of_colors = match options.has_common_colors {
            true => &[],
            false => states,
        };
        let rows = draw_order(layout, of_colors, false);
        let resolved = color_by::resolve(layout, by, &options.numbers, &rows);
        let (colors, legend) = resolved.map_err(|unknown| SceneError::UnknownColumn {
            asked: by.column.clone(),
            known: unknown.known,
        })?;
        Ok(Self {
            colors: Colors::Each(colors),
            base,
            legend: Some(legend),
            structure_below: false,
        })
    }

    /// Returns `true` if each of `paths` paths has a color.
    pub(super) fn suits(&self, paths: usize) -> bool {
        match &self.colors {
            Colors::One(_) => true,
            Colors::Each(colors) => colors.len() == paths,
        }
    }

    /// The color of a path, by row.
    pub(super) fn color(&self, path: u32) -> Rgba {
        match &self.colors {
            Colors::One(color) => *color,
            Colors::Each(colors) => colors[path as usize],
        }
    }

    /// Returns `true` if a path of the layout is a wall or a door that is drawn below all others.
    pub(super) fn is_below_ways(&self, layout: &Layout, path: u32) -> bool {
        self.structure_below && !layout.paths.is_driven(path as usize)
    }

    /// Color of a path when no column decides it: walls and doors are gray where they are drawn
    /// below.
    pub(crate) fn own_color(&self, layout: &Layout, path: u32) -> Rgba {
        if self.is_below_ways(layout, path) {
            return STRUCTURE;
        }
        let own = layout.paths.own_style(path as usize).color_rgba;
        own.map_or(self.base, Rgba::from_u32)
    }
}

impl Colors {
    /// Makes paths gray that no vehicle drives. Returns `true` if there are any beside others.
    fn gray_structure(&mut self, layout: &Layout) -> bool {
        let is_structure = |row: &usize| !layout.paths.is_driven(*row);
        let rows: Vec<usize> = match layout.paths.column("element") {
            Some(_) => (0..layout.paths.len()).filter(is_structure).collect(),
            None => Vec::new(),
        };
        if rows.is_empty() || rows.len() == layout.paths.len() {
            return false;
        }
        let mut each = match std::mem::replace(self, Self::One(STRUCTURE)) {
            Self::One(color) => vec![color; layout.paths.len()],
            Self::Each(colors) => colors,
        };
        rows.into_iter().for_each(|row| each[row] = STRUCTURE);
        *self = Self::Each(each);
        true
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
