//! [`Clusters`]: ends that are one node, by union-find, and short walks between them.

/// Most nodes that a short walk visits. Beyond, the drawing is dense there, and nothing is joined.
const MAX_WALK: usize = 64;

/// Sets of ends. End `2 c` is the start of curve `c`, end `2 c + 1` its end.
pub(super) struct Clusters {
    parents: Vec<u32>,
    sizes: Vec<u32>,
    /// The next end of the same set, in a circle.
    next: Vec<u32>,
    /// Lengths of the curves in meters, or upper bounds of them.
    lengths_m: Vec<f64>,
}

impl Clusters {
    /// Two ends per curve, each a set of its own.
    pub(super) fn new(lengths_m: Vec<f64>) -> Self {
        let ends = 2 * lengths_m.len() as u32;
        Self {
            parents: (0..ends).collect(),
            sizes: vec![1; ends as usize],
            next: (0..ends).collect(),
            lengths_m,
        }
    }

    /// Number of ends.
    pub(super) fn len(&self) -> u32 {
        self.next.len() as u32
    }

    /// The end that stands for the set of an end. Cost: O(log n), by union of smaller sets into
    /// larger ones.
    pub(super) fn root(&self, mut end: u32) -> u32 {
        while self.parents[end as usize] != end {
            end = self.parents[end as usize];
        }
        end
    }

    /// Joins the sets of two ends.
    pub(super) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a) as usize, self.root(b) as usize);
        if a == b {
            return;
        }
        let (large, small) = if self.sizes[a] >= self.sizes[b] {
            (a, b)
        } else {
            (b, a)
        };
        self.parents[small] = large as u32;
        self.sizes[large] += self.sizes[small];
        self.next.swap(large, small);
    }

    /// All ends of the set of an end.
    pub(super) fn members(&self, end: u32) -> impl Iterator<Item = u32> {
        let mut at = Some(end);
        std::iter::from_fn(move || {
            let found = at?;
            let next = self.next[found as usize];
            at = (next != end).then_some(next);
            Some(found)
        })
    }

    /// Returns `true` if curves lead from one set to another one within a length, or if the curves
    /// there are too dense to tell.
    ///
    /// Such ends must not be joined: the curves between them would vanish, and with them a chain
    /// of lines that are shorter than the weld distance.
    pub(super) fn has_walk(&self, from: u32, to: u32, within_m: f64) -> bool {
        let to = self.root(to);
        let mut seen = vec![(self.root(from), 0.0)];
        let mut done = 0;
        while let Some(&(at, walked_m)) = seen.get(done) {
            done += 1;
            for end in self.members(at) {
                let walked_m = walked_m + self.lengths_m[end as usize / 2];
                if walked_m > within_m {
                    continue;
                }
                let other = self.root(end ^ 1);
                if other == to || seen.len() == MAX_WALK {
                    return true;
                }
                if seen.iter().all(|(known, _)| *known != other) {
                    seen.push((other, walked_m));
                }
            }
        }
        false
    }
}
