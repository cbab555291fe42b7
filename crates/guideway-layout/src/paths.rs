use guideway_spline::{Affine, Bounds, Point, Runs};

use crate::vehicle_types::VehicleTypes;
use crate::{Attributes, Geometry, RunPoints, TextColumn};

const NONE: u32 = u32::MAX;

/// Which way vehicles go along a path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From start to end only.
    #[default]
    Forward,
    /// Both ways.
    Both,
}

/// One path to be appended to [`Paths`].
#[derive(Clone, Copy, Debug)]
pub struct NewPath<'a> {
    /// Identifier, as the file has it. Need not be unique: duplicates are reported, not dropped.
    pub id: &'a str,
    /// The curve, in meters.
    pub runs: &'a Runs,
    /// Row in [`crate::Nodes`] where it begins.
    pub start_node: Option<u32>,
    /// Row in [`crate::Nodes`] where it ends.
    pub end_node: Option<u32>,
    /// Which way vehicles go.
    pub direction: Direction,
    /// Index in [`crate::Layout::levels`].
    pub level: Option<u32>,
    /// Vehicle types that may use it; none means all.
    pub vehicle_types: &'a [&'a str],
}

impl Default for NewPath<'_> {
    fn default() -> Self {
        static EMPTY: Runs = Runs::EMPTY;
        Self {
            id: "",
            runs: &EMPTY,
            start_node: None,
            end_node: None,
            direction: Direction::Forward,
            level: None,
            vehicle_types: &[],
        }
    }
}

/// All paths of a layout, a column an attribute.
#[derive(Clone, Debug, Default)]
pub struct Paths {
    ids: TextColumn,
    geometry: Geometry,
    start_nodes: Option<Vec<u32>>,
    end_nodes: Option<Vec<u32>>,
    directions: Option<Vec<Direction>>,
    levels: Option<Vec<u32>>,
    vehicle_types: VehicleTypes,
    width_m: Option<Vec<f32>>,
    color_rgba: Option<Vec<u32>>,
    rank: Option<Vec<i32>>,
    /// Any further columns of the file.
    pub attributes: Attributes,
}

impl Paths {
    /// Paths from whole columns; nodes, levels and directions are unset.
    ///
    /// # Panics
    /// When the columns differ in length.
    pub fn from_columns(ids: TextColumn, geometry: Geometry) -> Self {
        assert_eq!(
            ids.len(),
            geometry.path_count(),
            "columns of one table have one length"
        );
        let rows = ids.len();
        Self {
            ids,
            geometry,
            vehicle_types: VehicleTypes::all(rows),
            ..Self::default()
        }
    }

    /// Appends a path and returns its row.
    pub fn push(&mut self, path: &NewPath<'_>) -> usize {
        self.ids.push(path.id);
        self.geometry.push(path.runs);
        let row = self.ids.len() - 1;
        let index = |index: Option<u32>| index.unwrap_or(NONE);
        push(&mut self.start_nodes, row, NONE, index(path.start_node));
        push(&mut self.end_nodes, row, NONE, index(path.end_node));
        push(&mut self.levels, row, NONE, index(path.level));
        push(
            &mut self.directions,
            row,
            Direction::Forward,
            path.direction,
        );
        self.vehicle_types.push(path.vehicle_types);
        if let Some(column) = &mut self.width_m {
            column.push(f32::NAN);
        }
        if let Some(column) = &mut self.color_rgba {
            column.push(0);
        }
        if let Some(column) = &mut self.rank {
            column.push(0);
        }
        row
    }

    /// Sets the stroke width of every path, in meters; NaN where the view's rule decides.
    ///
    /// # Panics
    /// When the length is not [`Self::len`]; so for the other column setters.
    pub fn set_width_m(&mut self, column: Vec<f32>) {
        assert_eq!(column.len(), self.len());
        self.width_m = Some(column);
    }

    /// Sets the color of every path, 0xRRGGBBAA; 0 where the view's rule decides.
    pub fn set_color_rgba(&mut self, column: Vec<u32>) {
        assert_eq!(column.len(), self.len());
        self.color_rgba = Some(column);
    }

    /// Sets the draw rank of every path: higher is drawn over lower, equal ranks in file order.
    pub fn set_rank(&mut self, column: Vec<i32>) {
        assert_eq!(column.len(), self.len());
        self.rank = Some(column);
    }

    /// Sets the level of every path; `u32::MAX` means none.
    pub fn set_levels(&mut self, column: Vec<u32>) {
        assert_eq!(column.len(), self.len());
        self.levels = Some(column);
    }

    /// Number of paths.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Whether there are no paths.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Identifier of a path.
    pub fn id(&self, path: usize) -> &str {
        self.ids.get(path)
    }

    /// The curves.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Maps the curves of some paths: see [`Geometry::transform`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        self.geometry.transform(paths, by);
    }

    /// Gives paths other curves: see [`Geometry::replace_all`].
    pub fn replace_curves(&mut self, paths: &[u32], with: &Geometry) {
        self.geometry.replace_all(paths, with);
    }

    /// Sets what a path brings of its own look; whatever is none, the view's rule decides.
    ///
    /// # Panics
    /// When `path` is not below [`Self::len`].
    pub fn set_own_style(&mut self, path: usize, style: OwnStyle) {
        let rows = self.len();
        let width_m = style.width_m.unwrap_or(f32::NAN);
        if let Some(column) = column_for(&mut self.width_m, rows, f32::NAN, style.width_m.is_some())
        {
            column[path] = width_m;
        }
        let color = style.color_rgba.unwrap_or(0);
        if let Some(column) = column_for(&mut self.color_rgba, rows, 0, color != 0) {
            column[path] = color;
        }
    }

    /// What a path brings of its own look.
    ///
    /// # Panics
    /// When `path` is not below [`Self::len`].
    pub fn own_style(&self, path: usize) -> OwnStyle {
        let width_m = self.width_m.as_ref().map(|column| column[path]);
        let color = self.color_rgba.as_ref().map(|column| column[path]);
        OwnStyle {
            width_m: width_m.filter(|width_m| width_m.is_finite() && *width_m >= 0.0),
            color_rgba: color.filter(|color| *color != 0),
        }
    }

    /// Stroke widths in meters, if the file gives any; NaN where it does not.
    pub fn width_m(&self) -> Option<&[f32]> {
        self.width_m.as_deref()
    }

    /// Colors 0xRRGGBBAA, if the file gives any; 0 where it does not.
    pub fn color_rgba(&self) -> Option<&[u32]> {
        self.color_rgba.as_deref()
    }

    /// Draw ranks, if the file gives any.
    pub fn rank(&self) -> Option<&[i32]> {
        self.rank.as_deref()
    }

    /// Which vehicle types may use which path.
    pub fn vehicle_types(&self) -> &VehicleTypes {
        &self.vehicle_types
    }

    /// Everything known of one path but its attributes.
    ///
    /// # Panics
    /// When `path` is not below [`Self::len`].
    pub fn get(&self, path: usize) -> PathRef<'_> {
        PathRef {
            paths: self,
            row: path,
        }
    }

    /// All paths in file order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = PathRef<'_>> + Clone {
        (0..self.len()).map(|row| self.get(row))
    }

    /// Box of all control points: it holds every curve, for a B-spline lies in its control hull.
    pub fn hull_bounds(&self) -> Option<Bounds<f64>> {
        self.geometry.hull_bounds(0..self.len())
    }

    /// Heap bytes held.
    pub fn heap_bytes(&self) -> usize {
        self.ids.heap_bytes()
            + self.geometry.heap_bytes()
            + bytes_of(&self.start_nodes)
            + bytes_of(&self.end_nodes)
            + bytes_of(&self.directions)
            + bytes_of(&self.levels)
            + bytes_of(&self.width_m)
            + bytes_of(&self.color_rgba)
            + bytes_of(&self.rank)
            + self.vehicle_types.heap_bytes()
            + self.attributes.heap_bytes()
    }
}

/// A column that may not be there: made if it has to hold something.
fn column_for<T: Clone>(
    column: &mut Option<Vec<T>>,
    rows: usize,
    none: T,
    is_needed: bool,
) -> Option<&mut Vec<T>> {
    if is_needed {
        column.get_or_insert_with(|| vec![none; rows]);
    }
    column.as_mut()
}

/// Appends to a column of so many rows that may not be there.
fn push<T: Clone + PartialEq>(column: &mut Option<Vec<T>>, rows: usize, none: T, value: T) {
    let is_needed = value != none;
    if let Some(column) = column_for(column, rows, none, is_needed) {
        column.push(value);
    }
}

fn bytes_of<T>(column: &Option<Vec<T>>) -> usize {
    column.as_ref().map_or(0, |c| c.capacity() * size_of::<T>())
}

/// What a path brings of its own look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OwnStyle {
    /// Stroke width in meters: zero or more.
    pub width_m: Option<f32>,
    /// Color 0xRRGGBBAA; not 0, which stands for none in [`Paths::color_rgba`].
    pub color_rgba: Option<u32>,
}

/// One path of a [`Paths`] table.
#[derive(Clone, Copy, Debug)]
pub struct PathRef<'a> {
    paths: &'a Paths,
    row: usize,
}

impl<'a> PathRef<'a> {
    /// Row in the table.
    pub fn row(self) -> usize {
        self.row
    }

    /// Identifier, as the file has it.
    pub fn id(self) -> &'a str {
        self.paths.ids.get(self.row)
    }

    /// Control runs, in meters.
    pub fn runs(self) -> impl ExactSizeIterator<Item = RunPoints<'a>> + Clone {
        self.paths.geometry.runs(self.row)
    }

    /// Puts a copy of its control runs in place of those that are there.
    pub fn copy_runs(self, runs: &mut Runs) {
        runs.clear();
        for run in self.runs() {
            runs.push(&run.iter().collect::<Vec<_>>());
        }
    }

    /// Row of the node where it begins.
    pub fn start_node(self) -> Option<u32> {
        some(self.paths.start_nodes.as_ref(), self.row)
    }

    /// Row of the node where it ends.
    pub fn end_node(self) -> Option<u32> {
        some(self.paths.end_nodes.as_ref(), self.row)
    }

    /// Which way vehicles go.
    pub fn direction(self) -> Direction {
        let column = self.paths.directions.as_ref();
        column.map_or(Direction::Forward, |column| column[self.row])
    }

    /// Index of its level.
    pub fn level(self) -> Option<u32> {
        some(self.paths.levels.as_ref(), self.row)
    }

    /// Box of its control points, which holds the curve.
    pub fn hull_bounds(self) -> Option<Bounds<f64>> {
        self.runs()
            .filter_map(RunPoints::bounds)
            .reduce(Bounds::union)
    }

    /// Where the curve begins and ends.
    pub fn ends(self) -> Option<(Point<f64>, Point<f64>)> {
        let first = self.runs().next()?;
        let last = self.runs().last()?;
        let start = guideway_spline::uniform::start(&first.segments().next()?);
        let end = guideway_spline::uniform::end(&last.segments().last()?);
        Some((start, end))
    }
}

fn some(column: Option<&Vec<u32>>, row: usize) -> Option<u32> {
    column
        .map(|column| column[row])
        .filter(|&index| index != NONE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_only_later_paths_have_is_not_given_to_those_before() {
        let mut paths = Paths::default();
        paths.push(&NewPath::default());
        paths.push(&NewPath {
            end_node: Some(3),
            direction: Direction::Both,
            level: Some(1),
            ..NewPath::default()
        });
        paths.push(&NewPath::default());
        let told = |path: PathRef| (path.start_node(), path.end_node(), path.level());
        let (none, some) = ((None, None, None), (None, Some(3), Some(1)));
        assert!(paths.iter().map(told).eq([none, some, none]));
        let directions = [Direction::Forward, Direction::Both, Direction::Forward];
        assert!(paths.iter().map(PathRef::direction).eq(directions));
    }
}
