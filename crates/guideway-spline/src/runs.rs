use crate::Point;

/// The curve of one path: runs of uniform cubic control points, one after the other.
///
/// Runs of one path usually meet end to end, but need not. Each has at least four points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Runs {
    points: Vec<Point<f64>>,
    ends: Vec<usize>,
}

impl Runs {
    /// No runs.
    pub const EMPTY: Self = Self {
        points: Vec::new(),
        ends: Vec::new(),
    };

    /// Appends a run.
    ///
    /// # Panics
    /// When it has fewer than four points.
    pub fn push(&mut self, run: &[Point<f64>]) {
        assert!(
            run.len() >= 4,
            "a run has at least four control points, not {}",
            run.len()
        );
        self.points.extend_from_slice(run);
        self.ends.push(self.points.len());
    }

    /// Appends a straight line, exactly: four control points in line, evenly spaced.
    pub fn push_line(&mut self, start: Point<f64>, end: Point<f64>) {
        let step = end - start;
        self.push(&[start - step, start, end, end + step]);
    }

    /// All runs in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[Point<f64>]> {
        (0..self.ends.len()).map(|i| {
            let start = if i == 0 { 0 } else { self.ends[i - 1] };
            &self.points[start..self.ends[i]]
        })
    }

    /// Number of runs.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are no runs.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// All control points of all runs.
    pub fn points(&self) -> &[Point<f64>] {
        &self.points
    }

    /// Takes all runs out; the buffers stay for the next curve.
    pub fn clear(&mut self) {
        self.points.clear();
        self.ends.clear();
    }
}
