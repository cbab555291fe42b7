use guideway_spline::{Point, Runs};

/// The control runs of all paths, in two flat buffers.
///
/// A path is a list of runs; a run of n control points (n >= 4) is a uniform cubic B-spline of n - 3
/// segments. Coordinates are metres. They are kept in the precision of the source: a file of `f32`
/// costs 8 bytes a point, and nothing is lost either way.
#[derive(Clone, Debug)]
pub struct Geometry {
    points: Points,
    run_ends: Vec<u32>,
    path_ends: Vec<u32>,
}

#[derive(Clone, Debug)]
enum Points {
    F64(Vec<Point<f64>>),
    F32(Vec<Point<f32>>),
}

impl Points {
    fn len(&self) -> usize {
        match self {
            Self::F64(p) => p.len(),
            Self::F32(p) => p.len(),
        }
    }
}

impl Default for Geometry {
    fn default() -> Self {
        Self {
            points: Points::F64(Vec::new()),
            run_ends: Vec::new(),
            path_ends: Vec::new(),
        }
    }
}

impl Geometry {
    /// Paths of one run each, from flat buffers: path `i` has the points up to `ends[i]`.
    ///
    /// # Panics
    /// When `ends` falls, or does not end at the number of points.
    pub fn from_f32(points: Vec<Point<f32>>, ends: Vec<u32>) -> Self {
        Self::from_points(Points::F32(points), ends)
    }

    /// As [`Self::from_f32`], in `f64`.
    ///
    /// # Panics
    /// As [`Self::from_f32`].
    pub fn from_f64(points: Vec<Point<f64>>, ends: Vec<u32>) -> Self {
        Self::from_points(Points::F64(points), ends)
    }

    fn from_points(points: Points, ends: Vec<u32>) -> Self {
        assert!(ends.is_sorted() && ends.last().map_or(0, |&e| e as usize) == points.len());
        let path_ends = (1..=ends.len() as u32).collect();
        Self {
            points,
            run_ends: ends,
            path_ends,
        }
    }

    /// The same runs as other paths: path `i` has the runs up to `path_ends[i]`.
    ///
    /// # Panics
    /// When `path_ends` falls, or does not end at the number of runs.
    #[must_use]
    pub fn with_path_ends(self, path_ends: Vec<u32>) -> Self {
        let runs = path_ends.last().map_or(0, |&e| e as usize);
        assert!(path_ends.is_sorted() && runs == self.run_count());
        Self { path_ends, ..self }
    }

    /// Number of paths.
    pub fn path_count(&self) -> usize {
        self.path_ends.len()
    }

    /// Number of runs of all paths together.
    pub fn run_count(&self) -> usize {
        self.run_ends.len()
    }

    /// Number of control points of all paths together.
    pub fn point_count(&self) -> usize {
        self.points.len()
    }

    /// Number of cubic segments of all paths together.
    pub fn segment_count(&self) -> usize {
        self.point_count() - 3 * self.run_count()
    }

    /// Appends a path. Buffers of `f32` become `f64` first, so that nothing is lost.
    pub fn push(&mut self, runs: &Runs) {
        if let Points::F32(narrow) = &self.points {
            self.points = Points::F64(narrow.iter().map(|p| p.to_f64()).collect());
        }
        if let Points::F64(points) = &mut self.points {
            for run in runs.iter() {
                points.extend_from_slice(run);
                self.run_ends
                    .push(u32::try_from(points.len()).expect("at most 2^32 control points"));
            }
        }
        self.path_ends.push(self.run_ends.len() as u32);
    }

    /// The runs of one path.
    ///
    /// # Panics
    /// When `path` is not below [`Self::path_count`].
    pub fn runs(&self, path: usize) -> impl ExactSizeIterator<Item = RunPoints<'_>> + Clone {
        let first = if path == 0 {
            0
        } else {
            self.path_ends[path - 1] as usize
        };
        (first..self.path_ends[path] as usize).map(|run| self.run(run))
    }

    fn run(&self, run: usize) -> RunPoints<'_> {
        let start = if run == 0 {
            0
        } else {
            self.run_ends[run - 1] as usize
        };
        let range = start..self.run_ends[run] as usize;
        match &self.points {
            Points::F64(p) => RunPoints::F64(&p[range]),
            Points::F32(p) => RunPoints::F32(&p[range]),
        }
    }

    /// Heap bytes held.
    pub fn heap_bytes(&self) -> usize {
        let points = match &self.points {
            Points::F64(p) => p.capacity() * size_of::<Point<f64>>(),
            Points::F32(p) => p.capacity() * size_of::<Point<f32>>(),
        };
        points + (self.run_ends.capacity() + self.path_ends.capacity()) * size_of::<u32>()
    }
}

/// The control points of one run, in the precision in which they are held.
#[derive(Clone, Copy, Debug)]
pub enum RunPoints<'a> {
    /// Held as `f64`.
    F64(&'a [Point<f64>]),
    /// Held as `f32`.
    F32(&'a [Point<f32>]),
}

impl<'a> RunPoints<'a> {
    /// Number of control points.
    pub fn len(&self) -> usize {
        match self {
            Self::F64(p) => p.len(),
            Self::F32(p) => p.len(),
        }
    }

    /// Whether there are no control points; never so in a layout.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// One control point, in metres.
    ///
    /// # Panics
    /// When `index` is not below [`Self::len`].
    pub fn get(&self, index: usize) -> Point<f64> {
        match self {
            Self::F64(p) => p[index],
            Self::F32(p) => p[index].to_f64(),
        }
    }

    /// The control points in order, in metres.
    pub fn iter(self) -> impl ExactSizeIterator<Item = Point<f64>> + Clone + 'a {
        (0..self.len()).map(move |i| self.get(i))
    }

    /// The cubic segments in order, four control points each.
    pub fn segments(self) -> impl ExactSizeIterator<Item = [Point<f64>; 4]> + Clone + 'a {
        let count = self.len().saturating_sub(3);
        (0..count).map(move |i| {
            [
                self.get(i),
                self.get(i + 1),
                self.get(i + 2),
                self.get(i + 3),
            ]
        })
    }
}
