//! Updates the bounds of a [`ClusterIndex`] when rows change or are appended.
//!
//! An edit takes two calls, one on either side of the change, because the hull of a row is lost
//! once the row has changed:
//!
//! ```text
//!   begin_edit(rows)  ->  [PendingEdit]      hulls before
//!   (the rows change)
//!   apply_edit(...)   ->  [AppliedEdit]      hulls after; bounds updated
//! ```

use guideway_spline::{Affine, Bounds};
use rayon::prelude::*;

use super::bounds::{ClusterBounds, MemberHull};
use super::index::ClusterIndex;
use super::order::{CLUSTER_LEN, Members};

/// Most members whose own hulls are compared; of more, a look at the whole cluster costs as little.
const FEW_MEMBERS: u32 = CLUSTER_LEN as u32 / 4;

/// Access to the geometry of the rows of an index.
pub trait RowHulls: Sync {
    /// Box of the control points of some rows, in meters.
    fn hull(&self, rows: &[u32]) -> MemberHull;

    /// Box that holds every point of `bounds` after it was mapped `by` and rounded as rows store
    /// it.
    fn map_bounds(&self, bounds: Bounds<f64>, by: Affine) -> Bounds<f64>;
}

/// A cluster with members that are about to change.
#[derive(Clone, Debug)]
pub struct PendingEdit {
    cluster: u32,
    members: Members,
    /// Hull of those members; `None` if it was not looked up.
    from: Option<MemberHull>,
}

/// A cluster of which members have changed.
#[derive(Clone, Copy, Debug)]
pub struct AppliedEdit {
    /// Its number.
    pub cluster: u32,
    /// True if all of its members were named by the edit.
    pub is_whole: bool,
    /// Bounds before the edit.
    pub before: Option<ClusterBounds>,
    /// Bounds now.
    pub after: Option<ClusterBounds>,
}

impl AppliedEdit {
    /// The boxes, in meters, where the cluster was and is.
    pub fn boxes(&self) -> impl Iterator<Item = Bounds<f64>> {
        let both = self.before.into_iter().chain(self.after);
        both.map(|cluster| cluster.bounds)
    }
}

impl ClusterIndex {
    /// Looks up the hulls of rows that are about to change. All threads share the work.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn begin_edit(&self, rows: &[u32], hulls: &impl RowHulls) -> Vec<PendingEdit> {
        let clusters = self.order.members_by_cluster(rows);
        let pending = clusters.par_iter().map(|&(cluster, members)| PendingEdit {
            cluster,
            members,
            from: self.hull_of_few(cluster, members, hulls),
        });
        pending.collect()
    }

    /// Updates the bounds of clusters whose rows have changed since [`Self::begin_edit`]: by the
    /// map `by`, or in any way. Returns the clusters in the order of `pending`.
    pub fn apply_edit(
        &mut self,
        pending: &[PendingEdit],
        by: Option<Affine>,
        hulls: &impl RowHulls,
    ) -> Vec<AppliedEdit> {
        let applied = pending.par_iter().map(|edit| AppliedEdit {
            cluster: edit.cluster,
            is_whole: self.is_whole(edit),
            before: self.bounds[edit.cluster as usize],
            after: self.updated(edit, by, hulls),
        });
        let applied: Vec<AppliedEdit> = applied.collect();
        for edit in &applied {
            self.bounds[edit.cluster as usize] = edit.after;
        }
        applied
    }

    /// Appends `count` rows, numbered from the last one on, in the last cluster and new ones behind
    /// it. Returns the clusters that received rows.
    pub fn append(&mut self, count: usize, hulls: &impl RowHulls) -> Vec<AppliedEdit> {
        let first = self.order.rows().len() as u32;
        self.order.append(count);
        self.bounds.resize(self.order.cluster_count(), None);
        let rows: Vec<u32> = (first..first + count as u32).collect();
        let clusters = self.order.members_by_cluster(&rows).into_iter();
        let pending = clusters.map(|(cluster, members)| PendingEdit {
            cluster,
            members,
            from: None,
        });
        self.apply_edit(&pending.collect::<Vec<_>>(), None, hulls)
    }

    /// The bounds of a cluster after an edit. Looks at all members only if it has to.
    fn updated(
        &self,
        edit: &PendingEdit,
        by: Option<Affine>,
        hulls: &impl RowHulls,
    ) -> Option<ClusterBounds> {
        let before = self.bounds[edit.cluster as usize];
        let is_whole = self.is_whole(edit);
        let known = match (before, by) {
            (Some(before), Some(by)) if is_whole => {
                before.after_map(by, hulls.map_bounds(before.bounds, by))
            }
            (Some(before), _) if !is_whole => edit.from.and_then(|from| {
                let to = self.hull_of_few(edit.cluster, edit.members, hulls)?;
                before.after_change(from, to)
            }),
            _ => None,
        };
        let all = || hulls.hull(self.rows_of(edit.cluster));
        // If all members are new, the origin must not depend on the old ones: an undone edit has to
        // restore the same coordinates.
        known.or_else(|| match before.filter(|_| !is_whole) {
            Some(before) => all().map(|bounds| before.with_bounds(bounds)),
            None => all().map(ClusterBounds::new),
        })
    }

    fn is_whole(&self, edit: &PendingEdit) -> bool {
        edit.members.count_ones() as usize == self.rows_of(edit.cluster).len()
    }

    /// Hull of some members of a cluster; `None` if they are more than a few.
    fn hull_of_few(
        &self,
        cluster: u32,
        members: Members,
        hulls: &impl RowHulls,
    ) -> Option<MemberHull> {
        let rows = self.rows_of(cluster);
        let few = (members.count_ones() <= FEW_MEMBERS).then(|| {
            let named = (0..rows.len()).filter(|member| members >> member & 1 == 1);
            named.map(|member| rows[member]).collect::<Vec<u32>>()
        });
        few.map(|few| hulls.hull(&few))
    }
}

#[cfg(test)]
mod tests {
    use guideway_spline::Point;

    use super::*;
    use crate::cluster::ClusterOrder;

    /// Rows that are points.
    struct Points(Vec<Point<f64>>);

    impl RowHulls for Points {
        fn hull(&self, rows: &[u32]) -> MemberHull {
            Bounds::of_points(rows.iter().map(|&row| self.0[row as usize]))
        }

        fn map_bounds(&self, bounds: Bounds<f64>, by: Affine) -> Bounds<f64> {
            let corners = bounds.corners().map(|p| by.apply(p));
            Bounds::of_points(corners).unwrap().inflated(1e-9)
        }
    }

    fn points(count: usize) -> Points {
        let point = |i: usize| Point::new((i * 7 % 97) as f64, (i * 31 % 89) as f64);
        Points((0..count).map(point).collect())
    }

    fn index(points: &Points) -> ClusterIndex {
        let bounds = Bounds::of_points(points.0.iter().copied());
        let order = ClusterOrder::sorted(points.0.len(), bounds, |row| Some(points.0[row]));
        ClusterIndex::new(order, |rows| points.hull(rows))
    }

    /// Every cluster holds its rows.
    #[track_caller]
    fn check(index: &ClusterIndex, points: &Points) {
        assert_eq!(index.bounds().len(), index.order().cluster_count());
        for (cluster, bounds) in (0..).zip(index.bounds()) {
            for &row in index.rows_of(cluster) {
                let bounds = bounds.unwrap().bounds.inflated(1e-6);
                assert!(bounds.contains(points.0[row as usize]), "{cluster} {row}");
            }
        }
    }

    #[test]
    fn bounds_hold_their_rows_after_every_edit() {
        let mut points = points(500);
        let mut index = index(&points);
        check(&index, &points);
        let all: Vec<u32> = (0..500).collect();
        let some: Vec<u32> = (0..500).step_by(9).collect();
        for (rows, by) in [
            (&some, Affine::translation(Point::new(3.0, -40.0))),
            (&all, Affine::translation(Point::new(-9.0, 5.0))),
            (&all, Affine::rotation(0.1, Point::new(50.0, 20.0))),
            (&some, Affine::rotation(1.5, Point::new(0.0, 0.0))),
        ] {
            let pending = index.begin_edit(rows, &points);
            for &row in rows {
                let point = &mut points.0[row as usize];
                *point = by.apply(*point);
            }
            let applied = index.apply_edit(&pending, Some(by), &points);
            assert_eq!(applied.len(), pending.len());
            assert!(applied.iter().all(|edit| edit.boxes().count() == 2));
            check(&index, &points);
        }
    }

    #[test]
    fn a_translation_of_all_rows_moves_the_origins() {
        let mut points = points(200);
        let mut index = index(&points);
        let before: Vec<_> = index.bounds().iter().flatten().map(|b| b.origin).collect();
        let all: Vec<u32> = (0..200).collect();
        let by = Point::new(2.0, 1.0);
        let pending = index.begin_edit(&all, &points);
        points.0.iter_mut().for_each(|p| *p = *p + by);
        let map = Some(Affine::translation(by));
        let applied = index.apply_edit(&pending, map, &points);
        assert!(applied.iter().all(|edit| edit.is_whole));
        for (bounds, before) in index.bounds().iter().flatten().zip(before) {
            assert_eq!(bounds.origin, before + by);
        }
    }

    #[test]
    fn appended_rows_fill_the_last_cluster_and_new_ones() {
        let mut points = points(100);
        let mut index = index(&points);
        points
            .0
            .extend((0..150).map(|i| Point::new(f64::from(i), 200.0)));
        let applied = index.append(150, &points);
        let clusters: Vec<u32> = applied.iter().map(|edit| edit.cluster).collect();
        assert_eq!(clusters, [1, 2, 3]);
        assert!(applied[0].before.is_some() && applied[1].before.is_none());
        check(&index, &points);
    }
}
