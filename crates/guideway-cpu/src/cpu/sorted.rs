use guideway_layout::Hulls;
use guideway_spline::{Bounds, hilbert};
use rayon::prelude::*;

/// Highest bits of a key that say which drawer it is put in.
const DRAWER_BITS: u32 = 16;
/// A drawer of more keys than this is sorted by several threads: where most of a layout lies in a small part of its box.
const LARGE: usize = 1 << 12;

/// All rows, sorted so that near ones are near each other.
pub(super) fn sorted_rows(hulls: &Hulls) -> Vec<u32> {
    let Some(all) = hulls.all() else {
        return (0..hulls.len() as u32).collect();
    };
    let place = |hull: Bounds<f64>| u64::from(hilbert(hull.center(), all));
    let rows = (0..hulls.len()).into_par_iter();
    let keys = rows.map(|row| {
        let place = hulls.of([row]).map_or(u64::from(u32::MAX), place);
        place << 32 | row as u64
    });
    let mut keys = in_drawers(&keys.collect::<Vec<u64>>());
    let drawers = keys.par_chunk_by_mut(|a, b| drawer(*a) == drawer(*b));
    drawers.for_each(|keys| match keys.len() {
        ..LARGE => keys.sort_unstable(),
        LARGE.. => keys.par_sort_unstable(),
    });
    keys.par_iter().map(|&key| key as u32).collect()
}

fn drawer(key: u64) -> usize {
    (key >> (u64::BITS - DRAWER_BITS)) as usize
}

/// Keys in the order of their drawers.
fn in_drawers(keys: &[u64]) -> Vec<u64> {
    let mut places = vec![0_usize; 1 << DRAWER_BITS];
    keys.iter().for_each(|&key| places[drawer(key)] += 1);
    let mut end = 0;
    for place in &mut places {
        end += std::mem::replace(place, end);
    }
    let mut ordered = vec![0; keys.len()];
    for &key in keys {
        let place = &mut places[drawer(key)];
        ordered[*place] = key;
        *place += 1;
    }
    ordered
}

#[cfg(test)]
mod tests {
    use guideway_layout::Geometry;
    use guideway_spline::Point;

    use super::*;

    /// Paths of no size at some places.
    fn paths_at(places: impl Iterator<Item = [f64; 2]>) -> Geometry {
        let points: Vec<_> = places.flat_map(|[x, y]| [Point::new(x, y); 4]).collect();
        let ends = (4..=points.len() as u32).step_by(4).collect();
        Geometry::from_f64(points, ends)
    }

    #[test]
    fn each_row_is_there_once_and_rows_follow_the_curve() {
        let at = |i: u32| f64::from(i.wrapping_mul(2_654_435_761) >> 16);
        let places = || (0..9_000).map(|i| [at(i), at(i + 77)]);
        let far = std::iter::once([1e7, 1e7]);
        // They lie in many drawers, and then all but one in one.
        for geometry in [paths_at(places()), paths_at(places().chain(far))] {
            let hulls = geometry.hulls();
            let all = hulls.all().unwrap();
            let place = |row: u32| hilbert(hulls.of([row as usize]).unwrap().center(), all);
            let rows = sorted_rows(hulls);
            let keys: Vec<_> = rows.iter().map(|&row| (place(row), row)).collect();
            assert!(keys.is_sorted_by(|a, b| a < b));
            assert_eq!(keys.len(), hulls.len());
        }
        assert!(sorted_rows(Geometry::default().hulls()).is_empty());
    }
}
