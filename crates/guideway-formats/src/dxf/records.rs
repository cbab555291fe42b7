//! Pairs as records: a group code 0 with all pairs up to the next one.

use std::cell::Cell;

use guideway_layout::Limits;

use super::pairs::{Pair, Pairs};
use super::space::Vector;
use crate::Problem;

/// Most pairs that a record has for each point of a curve: three coordinates, a weight, a bulge, two widths.
const PAIRS_A_POINT: usize = 7;

/// A record: an entity, a layer, a section with what is directly in it.
#[derive(Default)]
pub(super) struct Record<'b> {
    pub(super) kind: &'b [u8],
    pub(super) line: Option<u32>,
    pub(super) pairs: Vec<Pair<'b>>,
    /// The first group code whose value is not the number that was asked for.
    pub(super) bad: Cell<Option<i32>>,
}

impl<'b> Record<'b> {
    pub(super) fn all(&self, code: i32) -> impl Iterator<Item = &Pair<'b>> {
        self.pairs.iter().filter(move |pair| pair.code == code)
    }

    pub(super) fn text(&self, code: i32) -> Option<&'b [u8]> {
        self.all(code).next().map(Pair::text)
    }

    /// The number of a code, if it is there and is one.
    pub(super) fn real(&self, code: i32) -> Option<f64> {
        self.all(code).next().and_then(|pair| self.real_of(pair))
    }

    /// The number of a pair. Says so if it is none.
    pub(super) fn real_of(&self, pair: &Pair<'b>) -> Option<f64> {
        self.noted(pair, pair.real())
    }

    /// The whole number of a code, if it is there and is one.
    pub(super) fn whole(&self, code: i32) -> Option<i64> {
        let pair = self.all(code).next()?;
        self.noted(pair, pair.whole())
    }

    fn noted<T>(&self, pair: &Pair<'_>, number: Option<T>) -> Option<T> {
        if number.is_none() && self.bad.get().is_none() {
            self.bad.set(Some(pair.code));
        }
        number
    }

    /// The vector whose x has a code; y and z have those 10 and 20 above it, and are zero if absent.
    pub(super) fn vector(&self, code: i32) -> Option<Vector> {
        let x = self.real(code)?;
        let [y, z] = [code + 10, code + 20].map(|code| self.real(code).unwrap_or(0.0));
        Some(Vector { x, y, z })
    }

    /// All vectors whose x has a code, in their order.
    pub(super) fn vectors(&self, code: i32) -> Vec<Vector> {
        let mut all: Vec<Vector> = Vec::new();
        for pair in &self.pairs {
            let axis = pair.code - code;
            if !matches!(axis, 0 | 10 | 20) {
                continue;
            }
            let Some(number) = self.real_of(pair) else {
                continue;
            };
            match (axis, all.last_mut()) {
                (0, _) => all.push(Vector {
                    x: number,
                    y: 0.0,
                    z: 0.0,
                }),
                (10, Some(last)) => last.y = number,
                (_, Some(last)) => last.z = number,
                (_, None) => {}
            }
        }
        all
    }
}

/// Reads records one after the other. A copy goes on from the same place.
#[derive(Clone, Copy)]
pub(super) struct Records<'b> {
    pairs: Pairs<'b>,
    /// The pair that begins the next record, once it was met.
    next: Option<Pair<'b>>,
    elements: u64,
    most_elements: u64,
    most_pairs: usize,
}

impl<'b> Records<'b> {
    pub(super) fn new(bytes: &'b [u8], limits: &Limits) -> Self {
        Self {
            pairs: Pairs::new(bytes),
            next: None,
            elements: 0,
            most_elements: limits.elements,
            most_pairs: limits.curve_points.saturating_mul(PAIRS_A_POINT),
        }
    }

    pub(super) fn is_binary(&self) -> bool {
        self.pairs.is_binary()
    }

    /// Number of bytes before what was not read yet.
    pub(super) fn position(&self) -> usize {
        self.pairs.position()
    }

    /// Reads the next record; false if the file ends before it begins. Of its pairs those are kept whose
    /// code is `wanted` of a record of its kind.
    pub(super) fn read(
        &mut self,
        record: &mut Record<'b>,
        wanted: impl Fn(&[u8], i32) -> bool,
    ) -> Result<bool, Problem> {
        record.pairs.clear();
        record.bad.set(None);
        // Comments may come first.
        while self.next.is_none() {
            match self.pairs.next()? {
                Some(pair) if pair.code == 0 => self.next = Some(pair),
                Some(_) => {}
                None => return Ok(false),
            }
        }
        let Some(first) = self.next.take() else {
            return Ok(false);
        };
        self.count()?;
        record.kind = first.text();
        record.line = first.line;
        if record.kind == b"EOF" {
            return Ok(true);
        }
        while let Some(pair) = self.pairs.next()? {
            if pair.code == 0 {
                self.next = Some(pair);
                break;
            }
            if wanted(record.kind, pair.code) {
                if record.pairs.len() == self.most_pairs {
                    return Err(limit("group codes of one element", self.most_pairs as u64));
                }
                record.pairs.push(pair);
            }
        }
        Ok(true)
    }

    /// The kind of the record that follows.
    pub(super) fn peek(&self) -> Option<&'b [u8]> {
        self.next.map(|pair| pair.text())
    }

    fn count(&mut self) -> Result<(), Problem> {
        self.elements += 1;
        if self.elements <= self.most_elements {
            return Ok(());
        }
        Err(limit("elements in the file", self.most_elements))
    }
}

fn limit(what: &'static str, limit: u64) -> Problem {
    Problem::LimitReached {
        what,
        limit,
        actual: limit.saturating_add(1),
    }
}
