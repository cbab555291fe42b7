use std::collections::HashMap;

use super::CheckOptions;
use super::groups::{Member, members};
use super::place::{name, place};
use crate::{Code, Diagnostics, Direction, Layout, Paths};

/// Paths that lie on each other.
pub(super) fn check(layout: &Layout, options: &CheckOptions, found: &mut Diagnostics) {
    let paths = &layout.paths;
    let mut pairs = Vec::new();
    for group in members(paths, options.coincidence_tolerance_m).chunk_by(|a, b| a.first == b.first)
    {
        let mut drawn = Drawn::default();
        let first = group[0].first;
        let leader = Member {
            first,
            row: first,
            reversed: false,
        };
        for member in std::iter::once(&leader).chain(group) {
            pairs.extend(drawn.add(paths, *member));
        }
    }
    pairs.sort_unstable_by_key(|pair| pair.row);
    for pair in pairs {
        pair.report(paths, found);
    }
}

/// A path and the earlier one that it lies on.
struct Pair {
    code: Code,
    row: usize,
    earlier: usize,
}

impl Pair {
    fn report(&self, paths: &Paths, found: &mut Diagnostics) {
        let (direction, remedy) = match self.code {
            Code::ReversePair => ("opposite", "Nothing, if a two-way road is meant"),
            _ => ("same", "Take one of the two out"),
        };
        found.push(
            self.code,
            || place("path", self.row, paths.id(self.row)),
            || {
                let earlier = name("path", self.earlier, paths.id(self.earlier));
                format!("has the curve of {earlier} in the {direction} direction")
            },
            remedy,
        );
    }
}

/// What is already drawn along one curve, for each of the two ways to follow it.
#[derive(Default)]
struct Drawn<'a> {
    ways: [Way<'a>; 2],
}

impl<'a> Drawn<'a> {
    fn add(&mut self, paths: &'a Paths, member: Member) -> Option<Pair> {
        let row = member.row;
        let own = usize::from(member.reversed);
        let both = paths.get(row).direction() == Direction::Both;
        let used = if both { &[0, 1][..] } else { &[own][..] };
        let earlier = |way: usize| self.ways[way].earlier(paths, row);
        let same = used.iter().filter_map(|&way| earlier(way)).min();
        let pair = match same {
            Some(earlier) => Some((Code::DuplicatePath, earlier)),
            None => earlier(1 - own).map(|earlier| (Code::ReversePair, earlier)),
        };
        for &way in used {
            self.ways[way].add(paths, row);
        }
        pair.map(|(code, earlier)| Pair { code, row, earlier })
    }
}

/// The first paths one way along a curve. Paths for different vehicle types do not meet.
#[derive(Default)]
struct Way<'a> {
    first: Option<usize>,
    first_for_all: Option<usize>,
    first_for_type: HashMap<&'a str, usize>,
}

impl<'a> Way<'a> {
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
