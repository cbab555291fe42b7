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
    /// The curve, in metres.
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
    start_nodes: Vec<u32>,
    end_nodes: Vec<u32>,
    directions: Vec<Direction>,
    levels: Vec<u32>,
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
            start_nodes: vec![NONE; rows],
            end_nodes: vec![NONE; rows],
            directions: vec![Direction::Forward; rows],
            levels: vec![NONE; rows],
            vehicle_types: VehicleTypes::all(rows),
            ..Self::default()
        }
    }

    /// Appends a path and returns its row.
    pub fn push(&mut self, path: &NewPath<'_>) -> usize {
        self.ids.push(path.id);
        self.geometry.push(path.runs);
        self.start_nodes.push(path.start_node.unwrap_or(NONE));
        self.end_nodes.push(path.end_node.unwrap_or(NONE));
        self.directions.push(path.direction);
        self.levels.push(path.level.unwrap_or(NONE));
        self.vehicle_types.push(path.vehicle_types);
        let row = self.ids.len() - 1;
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

    /// Sets the stroke width of every path, in metres; NaN where the view's rule decides.
    ///
    /// # Panics
    /// When the length is not [`Self::len`]; so for the other column setters.
    pub fn set_width_m(&mut self, column: Vec<f32>) {
        assert_eq!(column.len(), self.len());
        self.width_m = Some(column);
    }

    /// Sets the colour of every path, 0xRRGGBBAA; 0 where the view's rule decides.
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
        self.levels = column;
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

    /// Stroke widths in metres, if the file gives any; NaN where it does not.
    pub fn width_m(&self) -> Option<&[f32]> {
        self.width_m.as_deref()
    }

    /// Colours 0xRRGGBBAA, if the file gives any; 0 where it does not.
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
        let row_bytes = 3 * size_of::<u32>() + size_of::<Direction>();
        let styles = self.width_m.as_ref().map_or(0, Vec::capacity)
            + self.color_rgba.as_ref().map_or(0, Vec::capacity)
            + self.rank.as_ref().map_or(0, Vec::capacity);
        self.ids.heap_bytes()
            + self.geometry.heap_bytes()
            + self.levels.capacity() * row_bytes
            + styles * size_of::<u32>()
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

/// What a path brings of its own look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OwnStyle {
    /// Stroke width in metres: zero or more.
    pub width_m: Option<f32>,
    /// Colour 0xRRGGBBAA; not 0, which stands for none in [`Paths::color_rgba`].
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

    /// Control runs, in metres.
    pub fn runs(self) -> impl ExactSizeIterator<Item = RunPoints<'a>> + Clone {
        self.paths.geometry.runs(self.row)
    }

    /// Row of the node where it begins.
    pub fn start_node(self) -> Option<u32> {
        some(self.paths.start_nodes[self.row])
    }

    /// Row of the node where it ends.
    pub fn end_node(self) -> Option<u32> {
        some(self.paths.end_nodes[self.row])
    }

    /// Which way vehicles go.
    pub fn direction(self) -> Direction {
        self.paths.directions[self.row]
    }

    /// Index of its level.
    pub fn level(self) -> Option<u32> {
        some(self.paths.levels[self.row])
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

fn some(index: u32) -> Option<u32> {
    (index != NONE).then_some(index)
}
