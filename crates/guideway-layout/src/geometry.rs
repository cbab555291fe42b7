use std::ops::Range;

use guideway_spline::{Affine, Point, Runs};

use crate::RunPoints;

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
                self.run_ends.push(index(points.len()));
            }
        }
        self.path_ends.push(self.run_ends.len() as u32);
    }

    /// The runs of one path.
    ///
    /// # Panics
    /// When `path` is not below [`Self::path_count`].
    pub fn runs(&self, path: usize) -> impl ExactSizeIterator<Item = RunPoints<'_>> + Clone {
        self.runs_of(path).map(|run| self.run(run))
    }

    fn run(&self, run: usize) -> RunPoints<'_> {
        let range = self.points_of(run);
        match &self.points {
            Points::F64(p) => RunPoints::F64(&p[range]),
            Points::F32(p) => RunPoints::F32(&p[range]),
        }
    }

    fn runs_of(&self, path: usize) -> Range<usize> {
        range(&self.path_ends, path)
    }

    fn points_of(&self, run: usize) -> Range<usize> {
        range(&self.run_ends, run)
    }

    /// Maps the curve of a path, in the precision in which it is held.
    ///
    /// # Panics
    /// When `path` is not below [`Self::path_count`].
    pub fn transform(&mut self, path: usize, by: Affine) {
        let range = self.points_of_runs(&self.runs_of(path));
        match &mut self.points {
            Points::F64(points) => points[range].iter_mut().for_each(|p| *p = by.apply(*p)),
            Points::F32(points) => points[range]
                .iter_mut()
                .for_each(|p| *p = by.apply(p.to_f64()).to_f32()),
        }
    }

    fn points_of_runs(&self, runs: &Range<usize>) -> Range<usize> {
        let end_of = |runs: usize| {
            runs.checked_sub(1)
                .map_or(0, |run| self.run_ends[run] as usize)
        };
        end_of(runs.start)..end_of(runs.end)
    }

    /// Some paths, in this order.
    ///
    /// # Panics
    /// When one is not below [`Self::path_count`].
    #[must_use]
    pub fn select(&self, paths: impl IntoIterator<Item = usize>) -> Self {
        let mut some = self.none_of_its_kind();
        paths.into_iter().for_each(|path| some.append(self, path));
        some
    }

    /// No paths, in the precision held here.
    fn none_of_its_kind(&self) -> Self {
        Self {
            points: match &self.points {
                Points::F64(_) => Points::F64(Vec::new()),
                Points::F32(_) => Points::F32(Vec::new()),
            },
            ..Self::default()
        }
    }

    /// Appends a path of another geometry, in the precision held here.
    fn append(&mut self, other: &Self, path: usize) {
        let runs = other.runs_of(path);
        let range = other.points_of_runs(&runs);
        let base = self.points.len();
        match (&mut self.points, &other.points) {
            (Points::F64(to), Points::F64(from)) => to.extend_from_slice(&from[range.clone()]),
            (Points::F32(to), Points::F32(from)) => to.extend_from_slice(&from[range.clone()]),
            (Points::F64(to), Points::F32(from)) => {
                to.extend(from[range.clone()].iter().map(|p| p.to_f64()));
            }
            (Points::F32(to), Points::F64(from)) => {
                to.extend(from[range.clone()].iter().map(|p| p.to_f32()));
            }
        }
        let ends = other.run_ends[runs]
            .iter()
            .map(|&end| end as usize - range.start + base);
        self.run_ends.extend(ends.map(index));
        self.path_ends.push(self.run_ends.len() as u32);
    }

    /// Gives paths the curves of another geometry, one after the other, in the precision held here. It costs no
    /// more than their points if the numbers of points are those of before, else as much as all paths at most.
    ///
    /// # Panics
    /// When there are more `paths` than curves, one is not there, or there would be more than 2^32 control points.
    pub fn replace_all(&mut self, paths: &[u32], with: &Self) {
        let has_same_lens = |(&path, from): (&u32, usize)| {
            let old = self.runs(path as usize).map(|run| run.len());
            old.eq(with.runs(from).map(|run| run.len()))
        };
        // Each one of another length moves all that lies behind it.
        if paths.len() == 1 || paths.iter().zip(0..).all(has_same_lens) {
            for (&path, from) in paths.iter().zip(0..) {
                self.replace(path as usize, with, from);
            }
            return;
        }
        let mut sources: Vec<Option<usize>> = vec![None; self.path_count()];
        for (&path, from) in paths.iter().zip(0..) {
            sources[path as usize] = Some(from);
        }
        let mut all = self.none_of_its_kind();
        for (path, source) in sources.into_iter().enumerate() {
            match source {
                Some(from) => all.append(with, from),
                None => all.append(self, path),
            }
        }
        *self = all;
    }

    /// Gives a path the curve of a path of another geometry, in the precision held here. It costs no more
    /// than its points if the numbers of points are those of before, else as much as all paths behind it.
    ///
    /// # Panics
    /// When either path is not there, or there would be more than 2^32 control points.
    fn replace(&mut self, path: usize, with: &Self, from: usize) {
        let runs = self.runs_of(path);
        let range = self.points_of_runs(&runs);
        let new_points = || with.runs(from).flat_map(RunPoints::iter);
        let new_lens = with.runs(from).map(|run| run.len());
        let is_alike = new_lens
            .clone()
            .eq(runs.clone().map(|run| self.points_of(run).len()));
        if is_alike {
            match &mut self.points {
                Points::F64(points) => set(&mut points[range], new_points()),
                Points::F32(points) => set(&mut points[range], new_points().map(Point::to_f32)),
            }
            return;
        }
        let old_len = self.points.len();
        match &mut self.points {
            Points::F64(points) => drop(points.splice(range.clone(), new_points())),
            Points::F32(points) => {
                drop(points.splice(range.clone(), new_points().map(Point::to_f32)));
            }
        }
        let new_len = self.points.len();
        let mut end = range.start;
        let new_ends: Vec<u32> = new_lens
            .map(|len| {
                end += len;
                index(end)
            })
            .collect();
        for end in &mut self.run_ends[runs.end..] {
            *end = index(*end as usize + new_len - old_len);
        }
        let new_runs = new_ends.len();
        for end in &mut self.path_ends[path..] {
            *end = index(*end as usize + new_runs - runs.len());
        }
        self.run_ends.splice(runs, new_ends);
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

/// What lies between two ends of a list that begins at 0.
fn range(ends: &[u32], at: usize) -> Range<usize> {
    let start = if at == 0 { 0 } else { ends[at - 1] as usize };
    start..ends[at] as usize
}

fn index(at: usize) -> u32 {
    u32::try_from(at).expect("at most 2^32 control points")
}

fn set<T>(old: &mut [T], new: impl Iterator<Item = T>) {
    old.iter_mut().zip(new).for_each(|(old, new)| *old = new);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(from: usize, count: usize) -> Vec<Point<f64>> {
        (from..from + count)
            .map(|i| Point::new(i as f64, 0.5))
            .collect()
    }

    /// Paths of one run of 4, of runs of 5 and 4, and of one of 6.
    fn three() -> Geometry {
        Geometry::from_f64(points(0, 19), vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4])
    }

    fn shape(geometry: &Geometry) -> Vec<Vec<Vec<f64>>> {
        let run = |run: RunPoints<'_>| run.iter().map(|p| p.x).collect();
        (0..geometry.path_count())
            .map(|path| geometry.runs(path).map(run).collect())
            .collect()
    }

    #[test]
    fn a_path_takes_another_curve_and_the_others_stay() {
        let other = Geometry::from_f64(points(100, 13), vec![5, 9, 13]).with_path_ends(vec![2, 3]);
        for (path, from) in [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1)] {
            let mut geometry = three();
            geometry.replace(path, &other, from);
            let mut expected = shape(&three());
            expected[path] = shape(&other)[from].clone();
            assert_eq!(shape(&geometry), expected, "{path} takes {from}");
            // And back.
            geometry.replace(path, &three(), path);
            assert_eq!(shape(&geometry), shape(&three()));
        }
    }

    #[test]
    fn many_paths_take_other_curves_as_one_after_the_other() {
        let other = Geometry::from_f64(points(100, 13), vec![5, 9, 13]).with_path_ends(vec![2, 3]);
        let narrow = points(0, 19).iter().map(|p| p.to_f32()).collect();
        let narrow = Geometry::from_f32(narrow, vec![4, 9, 13, 19]).with_path_ends(vec![1, 3, 4]);
        for paths in [[2, 0], [1, 0], [1, 1]] {
            for mut geometry in [three(), narrow.clone()] {
                let mut one_by_one = geometry.clone();
                for (&path, from) in paths.iter().zip(0..) {
                    one_by_one.replace(path as usize, &other, from);
                }
                geometry.replace_all(&paths, &other);
                assert_eq!(shape(&geometry), shape(&one_by_one), "{paths:?}");
            }
        }
    }

    #[test]
    fn chosen_paths_are_copied_as_they_are() {
        let some = three().select([2, 1]);
        let all = shape(&three());
        assert_eq!(shape(&some), [all[2].clone(), all[1].clone()]);
    }

    #[test]
    fn a_map_moves_one_path_in_either_precision() {
        let by = Affine::translation(Point::new(10.0, 0.0));
        let narrow = points(0, 8).iter().map(|p| p.to_f32()).collect();
        for mut geometry in [
            Geometry::from_f64(points(0, 8), vec![4, 8]),
            Geometry::from_f32(narrow, vec![4, 8]),
        ] {
            geometry.transform(1, by);
            let x = [[0.0, 1.0, 2.0, 3.0], [14.0, 15.0, 16.0, 17.0]];
            assert_eq!(shape(&geometry), x.map(|run| vec![run.to_vec()]));
        }
    }
}
