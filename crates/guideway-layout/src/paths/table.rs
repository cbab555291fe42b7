//! [`Paths`]: the table of all paths, with one column per property.

use guideway_spline::construct::{parameter_at_length, point_at};
use guideway_spline::{Bounds, Point, Runs, run_length, uniform};

use crate::optional_column::{OptionalColumn, push};
use crate::{
    Attribute, Attributes, Direction, Geometry, NewPath, OwnStyle, RunPoints, SourceSpans,
    TextColumn, TypeEntries, Value, WrittenCurve, WrittenCurves,
};

/// Largest error of the length of a run, in meters: a tenth of a millimeter.
pub(super) const LENGTH_TOLERANCE_M: f64 = 1e-4;
/// Index that means "none" in the columns of nodes and levels.
pub(super) const NONE: u32 = u32::MAX;

/// All paths of a layout, one column per property. A property that no path sets has no column.
#[derive(Clone, Debug, Default)]
pub struct Paths {
    pub(super) ids: TextColumn,
    pub(super) geometry: Geometry,
    pub(super) start_nodes: OptionalColumn<u32>,
    pub(super) end_nodes: OptionalColumn<u32>,
    pub(super) directions: OptionalColumn<Direction>,
    pub(super) levels: OptionalColumn<u32>,
    pub(super) vehicle_types: TypeEntries,
    pub(super) width_m: OptionalColumn<f32>,
    pub(super) color_rgba: OptionalColumn<u32>,
    pub(super) rank: OptionalColumn<i32>,
    pub(super) written_curves: WrittenCurves,
    pub(super) is_hilbert_ordered: bool,
    /// Further columns. A property that differs between the vehicle types of a path is in the
    /// entries of [`Self::vehicle_types`] instead.
    pub attributes: Attributes,
    /// Places of the paths in the text of their file. Several paths may have the same place.
    pub source: SourceSpans,
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
            vehicle_types: TypeEntries::unrestricted(rows),
            ..Self::default()
        }
    }

    /// Appends a path and returns its row.
    pub fn push(&mut self, path: &NewPath<'_>) -> usize {
        self.is_hilbert_ordered = false;
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

    /// Number of paths.
    pub fn len(&self) -> usize {
        self.ids.len()
    }

    /// Returns `true` if there are no paths.
    pub fn is_empty(&self) -> bool {
        self.ids.is_empty()
    }

    /// Returns `true` if the rows follow a Hilbert curve, so that an index need not sort them:
    /// rows near each other are near each other in the plane. A file says so; edits of curves may
    /// make it less true, which costs speed alone.
    pub fn is_hilbert_ordered(&self) -> bool {
        self.is_hilbert_ordered
    }

    /// Identifier of a path.
    pub fn id(&self, path: usize) -> &str {
        self.ids.get(path)
    }

    /// The curves of all paths.
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// The curve of a path as its file wrote it, where the runs do not say it all.
    pub fn written_curve(&self, path: usize) -> Option<&WrittenCurve> {
        self.written_curves.get(path)
    }

    /// The curves as their files wrote them.
    pub fn written_curves(&self) -> &WrittenCurves {
        &self.written_curves
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

    /// The vehicle types that may use each path, with the properties that differ between them.
    pub fn vehicle_types(&self) -> &TypeEntries {
        &self.vehicle_types
    }

    /// Value of a path in a column: that for all of its vehicle types, else that of the first type
    /// that has one.
    pub fn value(&self, path: usize, name: &str) -> Option<Value<'_>> {
        let own = self.attributes.value(path, name);
        own.or_else(|| self.vehicle_types.first_value(path, name))
    }

    /// Returns `true` if a column of this name exists, for all vehicle types or per type.
    pub fn has_column(&self, name: &str) -> bool {
        self.column(name).is_some()
    }

    /// The column of this name that has the values for all vehicle types, else that of the entries.
    pub fn column(&self, name: &str) -> Option<&Attribute> {
        let own = self.attributes.get(name);
        own.or_else(|| self.vehicle_types.attributes.get(name))
    }

    /// Names of all columns: those for all vehicle types, then those per type.
    pub fn column_names(&self) -> impl Iterator<Item = &str> {
        let own = self.attributes.iter().map(|column| column.name.as_str());
        let per_type = self.vehicle_types.attributes.iter();
        let per_type = per_type.map(|column| column.name.as_str());
        own.chain(per_type.filter(|name| self.attributes.get(name).is_none()))
    }

    /// Value of a path in a column for one of its vehicle types.
    pub fn value_for(&self, path: usize, vehicle_type: &str, name: &str) -> Option<Value<'_>> {
        let entry = self.vehicle_types.entry_for(path, vehicle_type);
        let of_type = entry.and_then(|row| self.vehicle_types.attributes.value(row, name));
        of_type.or_else(|| self.attributes.value(path, name))
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

    /// Returns `true` if vehicles may drive along a path: it is no wall, door or lane of humans,
    /// which a layout of Open-RMF holds too.
    pub fn is_driven(&self, path: usize) -> bool {
        let element = self.attributes.value(path, "element");
        !matches!(element, Some(Value::Text("wall" | "door" | "human lane")))
    }

    /// Box of all control points, which contains all curves; `None` if there are no points.
    pub fn hull_bounds(&self) -> Option<Bounds<f64>> {
        self.geometry.bounds()
    }
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
    pub fn runs(
        self,
    ) -> impl DoubleEndedIterator<Item = RunPoints<'a>> + ExactSizeIterator + Clone {
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
        let last = self.runs().next_back()?;
        let start = uniform::start(&first.segments().next()?);
        let end = uniform::end(&last.segments().next_back()?);
        Some((start, end))
    }

    /// Value in a column: see [`Paths::value`].
    pub fn attribute(self, name: &str) -> Option<Value<'a>> {
        self.paths.value(self.row, name)
    }

    /// Length along the curve, in meters, within a tenth of a millimeter per run.
    pub fn length_m(self) -> f64 {
        let runs = self.runs().map(|run| match run {
            RunPoints::F64(points) => run_length(points, LENGTH_TOLERANCE_M),
            RunPoints::F32(points) => run_length(points, LENGTH_TOLERANCE_M),
        });
        runs.sum()
    }

    /// The point of the curve at a distance along it from its start, in meters, within a tenth of a
    /// millimeter; its end for a greater distance. `None` if it has no segments.
    pub fn point_at(self, along_m: f64) -> Option<Point<f64>> {
        let mut runs = Runs::default();
        self.copy_runs(&mut runs);
        let at = parameter_at_length(&runs, along_m.max(0.0), LENGTH_TOLERANCE_M)?;
        point_at(&runs, at)
    }
}

fn some(column: Option<&Vec<u32>>, row: usize) -> Option<u32> {
    column
        .map(|column| column[row])
        .filter(|&index| index != NONE)
}
