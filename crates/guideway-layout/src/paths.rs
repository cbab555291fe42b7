//! [`Paths`]: the table of all paths, with one column per property, and [`PathRef`], a row of it.

use guideway_spline::{Affine, Bounds, Point, Runs, uniform};

use crate::{
    Attributes, Direction, Geometry, NewPath, OwnStyle, RunPoints, TextColumn, VehicleTypes,
};

/// Index that means "none" in the columns of nodes and levels.
const NONE: u32 = u32::MAX;

/// All paths of a layout, one column per property. A property that no path sets has no column.
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
    /// Further columns of the file.
    pub attributes: Attributes,
}

impl Paths {
    /// Paths from whole columns, without nodes, levels and vehicle types, in the default direction.
    ///
    /// # Panics
    /// When the columns differ in length.
    pub fn from_columns(ids: TextColumn, geometry: Geometry) -> Self {
        assert_eq!(
            ids.len(),
            geometry.path_count(),
            "columns of one table must have the same length"
        );
        let rows = ids.len();
        Self {
            ids,
            geometry,
            vehicle_types: VehicleTypes::unrestricted(rows),
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

    /// Sets the stroke width of every path, in meters; NaN where the rule of the view decides.
    ///
    /// # Panics
    /// When the length is not [`Self::len`], as in the other setters of columns.
    pub fn set_width_m(&mut self, column: Vec<f32>) {
        assert_eq!(column.len(), self.len());
        self.width_m = Some(column);
    }

    /// Sets the color of every path, 0xRRGGBBAA; 0 where the rule of the view decides.
    pub fn set_color_rgba(&mut self, column: Vec<u32>) {
        assert_eq!(column.len(), self.len());
        self.color_rgba = Some(column);
    }

    /// Sets the draw rank of every path: higher ranks cover lower ones, equal ranks paint in file
    /// order.
    pub fn set_rank(&mut self, column: Vec<i32>) {
        assert_eq!(column.len(), self.len());
        self.rank = Some(column);
    }

    /// Sets the level of every path; `u32::MAX` means no level.
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

    /// The curves of all paths.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Maps the curves of some paths: see [`Geometry::transform`].
    pub fn transform(&mut self, paths: impl IntoIterator<Item = usize>, by: Affine) {
        self.geometry.transform(paths, by);
    }

    /// Replaces the curves of some paths: see [`Geometry::replace_all`].
    pub fn replace_curves(&mut self, paths: &[u32], with: &Geometry) {
        self.geometry.replace_all(paths, with);
    }

    /// Sets the style of one path; properties that are `None` follow the rule of the view.
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

    /// Style that a path sets itself.
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

    /// Stroke widths in meters, if any path has one; NaN for the others.
    pub fn width_m(&self) -> Option<&[f32]> {
        self.width_m.as_deref()
    }

    /// Colors 0xRRGGBBAA, if any path has one; 0 for the others.
    pub fn color_rgba(&self) -> Option<&[u32]> {
        self.color_rgba.as_deref()
    }

    /// Draw ranks, if any path has one.
    pub fn rank(&self) -> Option<&[i32]> {
        self.rank.as_deref()
    }

    /// The vehicle types that may use each path.
    pub fn vehicle_types(&self) -> &VehicleTypes {
        &self.vehicle_types
    }

    /// One path with all its properties except attributes.
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

    /// Box of all control points, which contains all curves; `None` if there are no points.
    pub fn hull_bounds(&self) -> Option<Bounds<f64>> {
        self.geometry.hull_bounds(0..self.len())
    }

    /// Heap bytes in use.
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

/// An optional column, created if `is_needed`.
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

/// Appends to an optional column of `rows` rows; creates it for the first value other than `none`.
fn push<T: Clone + PartialEq>(column: &mut Option<Vec<T>>, rows: usize, none: T, value: T) {
    let is_needed = value != none;
    if let Some(column) = column_for(column, rows, none, is_needed) {
        column.push(value);
    }
}

fn bytes_of<T>(column: &Option<Vec<T>>) -> usize {
    column.as_ref().map_or(0, |c| c.capacity() * size_of::<T>())
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

    /// Identifier in the file.
    pub fn id(self) -> &'a str {
        self.paths.ids.get(self.row)
    }

    /// Control runs, in meters.
    pub fn runs(self) -> impl ExactSizeIterator<Item = RunPoints<'a>> + Clone {
        self.paths.geometry.runs(self.row)
    }

    /// Replaces the contents of `runs` by a copy of its control runs.
    pub fn copy_runs(self, runs: &mut Runs) {
        runs.clear();
        for run in self.runs() {
            runs.push(&run.iter().collect::<Vec<_>>());
        }
    }

    /// Row of its first node.
    pub fn start_node(self) -> Option<u32> {
        some(self.paths.start_nodes.as_ref(), self.row)
    }

    /// Row of its last node.
    pub fn end_node(self) -> Option<u32> {
        some(self.paths.end_nodes.as_ref(), self.row)
    }

    /// Directions in which vehicles drive.
    pub fn direction(self) -> Direction {
        let column = self.paths.directions.as_ref();
        column.map_or(Direction::Forward, |column| column[self.row])
    }

    /// Index of its level.
    pub fn level(self) -> Option<u32> {
        some(self.paths.levels.as_ref(), self.row)
    }

    /// Box of its control points, which contains the curve; `None` if it has no points.
    pub fn hull_bounds(self) -> Option<Bounds<f64>> {
        self.runs()
            .filter_map(RunPoints::bounds)
            .reduce(Bounds::union)
    }

    /// Start and end of the curve; `None` if it has no segments.
    pub fn ends(self) -> Option<(Point<f64>, Point<f64>)> {
        let first = self.runs().next()?;
        let last = self.runs().last()?;
        let start = uniform::start(&first.segments().next()?);
        let end = uniform::end(&last.segments().last()?);
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
    fn properties_of_later_paths_leave_earlier_ones_unset() {
        let mut paths = Paths::default();
        paths.push(&NewPath::default());
        paths.push(&NewPath {
            end_node: Some(3),
            direction: Direction::Both,
            level: Some(1),
            ..NewPath::default()
        });
        paths.push(&NewPath::default());
        let indices = |path: PathRef| (path.start_node(), path.end_node(), path.level());
        let (none, some) = ((None, None, None), (None, Some(3), Some(1)));
        assert!(paths.iter().map(indices).eq([none, some, none]));
        let directions = [Direction::Forward, Direction::Both, Direction::Forward];
        assert!(paths.iter().map(PathRef::direction).eq(directions));
    }
}
