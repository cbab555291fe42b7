//! Pairs of paths on the same curve: duplicates in one direction, two-way roads in opposite ones.

use std::collections::HashMap;

use super::element::{element_name, element_place};
use super::options::CheckOptions;
use super::same_curve::{Member, members};
use crate::{Code, Diagnostics, Direction, Layout, Paths};

/// Reports paths on the same curve, each with the first path that it duplicates or reverses.
pub(super) fn check(layout: &Layout, options: &CheckOptions, found: &mut Diagnostics) {
    let paths = &layout.paths;
    let mut pairs = Vec::new();
    let members = members(paths, options.coincidence_tolerance_m);
    for group in members.chunk_by(|a, b| a.first == b.first) {
        let mut curve = CurveUse::default();
        let first = group[0].first;
        let leader = Member {
            first,
            row: first,
            reversed: false,
        };
        for member in std::iter::once(&leader).chain(group) {
            pairs.extend(curve.add(paths, *member));
        }
    }
    pairs.sort_unstable_by_key(|pair| pair.row);
    for pair in pairs {
        pair.report(paths, found);
    }
}

/// A path and an earlier one on the same curve.
struct Pair {
    code: Code,
    row: usize,
    earlier: usize,
}

impl Pair {
    fn report(&self, paths: &Paths, found: &mut Diagnostics) {
        let (direction, remedy) = match self.code {
            Code::ReversePair => ("opposite", "No action needed if this is a two-way road"),
            _ => ("same", "Remove one of the two"),
        };
        found.push(
            self.code,
            || element_place("path", self.row, paths.id(self.row)),
            || {
                let earlier = element_name("path", self.earlier, paths.id(self.earlier));
                format!("has the curve of {earlier} in the {direction} direction")
            },
            remedy,
        );
    }
}

/// The paths along one curve so far, per direction of travel.
#[derive(Default)]
struct CurveUse<'a> {
    directions: [DirectionUse<'a>; 2],
}

impl<'a> CurveUse<'a> {
    fn add(&mut self, paths: &'a Paths, member: Member) -> Option<Pair> {
        let row = member.row;
        let own = usize::from(member.reversed);
        let both = paths.get(row).direction() == Direction::Both;
        let used = if both { &[0, 1][..] } else { &[own][..] };
        let earlier = |direction: usize| self.directions[direction].earlier(paths, row);
        let same = used
            .iter()
            .filter_map(|&direction| earlier(direction))
            .min();
        let pair = match same {
            Some(earlier) => Some((Code::DuplicatePath, earlier)),
            None => earlier(1 - own).map(|earlier| (Code::ReversePair, earlier)),
        };
        for &direction in used {
            self.directions[direction].add(paths, row);
        }
        pair.map(|(code, earlier)| Pair { code, row, earlier })
    }
}

/// The first paths in one direction along a curve. Paths without a common vehicle type are no pair.
#[derive(Default)]
struct DirectionUse<'a> {
    first: Option<usize>,
    first_for_all: Option<usize>,
    first_for_type: HashMap<&'a str, usize>,
}

impl<'a> DirectionUse<'a> {
    fn earlier(&self, paths: &Paths, row: usize) -> Option<usize> {
        let types = paths.vehicle_types().of(row);
        if types.len() == 0 {
            return self.first;
        }
        let for_type = types.filter_map(|name| self.first_for_type.get(name).copied());
        for_type.chain(self.first_for_all).min()
    }

    fn add(&mut self, paths: &'a Paths, row: usize) {
        self.first.get_or_insert(row);
        let types = paths.vehicle_types().of(row);
        if types.len() == 0 {
            self.first_for_all.get_or_insert(row);
        }
        for name in types {
            self.first_for_type.entry(name).or_insert(row);
        }
    }
}
