//! Pairs of paths on the same curve: duplicates in one direction, two-way roads in opposite ones.

use std::collections::HashMap;

use super::differences::{Along, Comparison};
use super::element::{element_name, element_place};
use super::same_curve::{Member, members};
use super::scale::Tolerances;
use crate::{Code, Diagnostics, Direction, Layout, Paths};

/// Reports paths on the same curve, each with an earlier path that it duplicates, else with the
/// first one that it shares the curve with or reverses.
pub(super) fn check(layout: &Layout, tolerances: &Tolerances, found: &mut Diagnostics) {
    let paths = &layout.paths;
    let comparison = Comparison::of(layout);
    let mut pairs = Vec::new();
    let members = members(paths, tolerances.coincidence_m);
    for group in members.chunk_by(|a, b| a.first == b.first) {
        let first = group[0].first;
        let mut curve = CurveUse {
            comparison: &comparison,
            paths,
            is_dot: is_dot(paths, first, tolerances.dot_m),
            directions: Default::default(),
            identical: HashMap::new(),
        };
        let leader = Member {
            first,
            row: first,
            reversed: false,
        };
        for member in std::iter::once(&leader).chain(group) {
            pairs.extend(curve.add(*member));
        }
    }
    pairs.sort_unstable_by_key(|pair| pair.path.row);
    for pair in pairs {
        pair.report(paths, &comparison, found);
    }
}

/// True if a path is a point: vehicles turn or act there, and all its curves look alike.
fn is_dot(paths: &Paths, row: usize, dot_m: f64) -> bool {
    let hull = paths.get(row).hull_bounds();
    hull.is_none_or(|hull| hull.size().x.max(hull.size().y) <= dot_m)
}

/// A path and an earlier one on the same curve.
struct Pair {
    code: Code,
    path: Along,
    earlier: Along,
}

impl Pair {
    fn report(&self, paths: &Paths, comparison: &Comparison<'_>, found: &mut Diagnostics) {
        let row = self.path.row;
        let remedy = match self.code {
            Code::ReversePair => "No action needed if this is a two-way road",
            Code::SameCurve => "No action needed if both paths are meant",
            _ => "Remove one of the two; if both are meant, correct the nodes or properties of one",
        };
        found.push(
            self.code,
            || element_place(crate::Member::Path(row as u32), paths.id(row)),
            || self.message(paths, comparison),
            remedy,
        );
    }

    fn message(&self, paths: &Paths, comparison: &Comparison<'_>) -> String {
        let earlier = self.earlier.row;
        let name = element_name("path", earlier, paths.id(earlier));
        match self.code {
            Code::ReversePair => format!("has the curve of {name} in the opposite direction"),
            Code::SameCurve => {
                let differences = comparison.differences(self.earlier, self.path);
                let differences = Comparison::text(&differences);
                format!("has the curve of {name}; they differ in {differences}")
            }
            _ => {
                let ends = comparison.ends_text(self.path);
                format!("has the curve of {name}{ends}, and agrees in all properties")
            }
        }
    }
}

/// The paths along one curve so far.
struct CurveUse<'a> {
    comparison: &'a Comparison<'a>,
    paths: &'a Paths,
    is_dot: bool,
    /// Per direction of travel along the curve.
    directions: [DirectionUse<'a>; 2],
    /// The first path per fingerprint of its properties.
    identical: HashMap<u64, Along>,
}

impl CurveUse<'_> {
    fn add(&mut self, member: Member) -> Option<Pair> {
        let path = Along {
            row: member.row,
            reversed: member.reversed,
        };
        let own = usize::from(path.reversed);
        let both = self.paths.get(path.row).direction() == Direction::Both;
        let used = if both { &[0, 1][..] } else { &[own][..] };
        let pair = self
            .duplicate(path, used)
            .or_else(|| self.shared(path, used));
        for &direction in used {
            self.directions[direction].add(self.paths, path);
        }
        pair
    }

    /// The earlier path that agrees in all properties.
    fn duplicate(&mut self, path: Along, used: &[usize]) -> Option<Pair> {
        // Paths in one direction that run against each other are a road of two lanes. A point has
        // no direction.
        let direction = if used.len() == 2 || self.is_dot {
            0
        } else {
            used[0] as u64
        };
        let key = self.comparison.fingerprint(path) ^ direction;
        let earlier = *self.identical.entry(key).or_insert(path);
        let is_duplicate =
            earlier.row != path.row && self.comparison.differences(earlier, path).is_empty();
        is_duplicate.then_some(Pair {
            code: Code::DuplicatePath,
            path,
            earlier,
        })
    }

    /// The first path that a common vehicle type may drive along, in the same direction or else in
    /// the opposite one.
    fn shared(&self, path: Along, used: &[usize]) -> Option<Pair> {
        if self.is_dot {
            return None;
        }
        let earlier = |direction: usize| self.directions[direction].earlier(self.paths, path.row);
        let same = used.iter().filter_map(|&direction| earlier(direction));
        let (code, earlier) = match same.min_by_key(|earlier| earlier.row) {
            Some(earlier) => (Code::SameCurve, earlier),
            None => (Code::ReversePair, earlier(1 - usize::from(path.reversed))?),
        };
        Some(Pair {
            code,
            path,
            earlier,
        })
    }
}

/// The first paths in one direction along a curve. Paths without a common vehicle type are no pair.
#[derive(Default)]
struct DirectionUse<'a> {
    first: Option<Along>,
    first_for_all: Option<Along>,
    first_for_type: HashMap<&'a str, Along>,
}

impl<'a> DirectionUse<'a> {
    fn earlier(&self, paths: &Paths, row: usize) -> Option<Along> {
        let types = paths.vehicle_types().of(row);
        if types.len() == 0 {
            return self.first;
        }
        let for_type = types.filter_map(|name| self.first_for_type.get(name).copied());
        for_type
            .chain(self.first_for_all)
            .min_by_key(|earlier| earlier.row)
    }

    fn add(&mut self, paths: &'a Paths, path: Along) {
        self.first.get_or_insert(path);
        let types = paths.vehicle_types().of(path.row);
        if types.len() == 0 {
            self.first_for_all.get_or_insert(path);
        }
        for name in types {
            self.first_for_type.entry(name).or_insert(path);
        }
    }
}
