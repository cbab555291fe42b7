//! Groups pairs into records: group code 0 starts a record, which holds all pairs up to the next 0.

use std::cell::Cell;

use guideway_layout::Limits;

use super::affine3::Vector3;
use crate::Problem;
use crate::pair_reader::{Pair, PairReader, StrayLines};

/// Upper bound of pairs per curve point. Derived: three coordinates, a weight, a bulge, two widths.
const PAIRS_PER_POINT: usize = 7;

/// A record: an entity, a layer, or a section header with its direct pairs.
#[derive(Default)]
pub(super) struct Record<'b> {
    pub(super) kind: &'b [u8],
    pub(super) line: Option<u32>,
    pub(super) pairs: Vec<Pair<'b>>,
    /// The first requested group code whose value is not a number.
    pub(super) bad_code: Cell<Option<i32>>,
}

impl<'b> Record<'b> {
    /// All pairs with a code, in file order.
    pub(super) fn all(&self, code: i32) -> impl Iterator<Item = &Pair<'b>> {
        self.pairs.iter().filter(move |pair| pair.code == code)
    }

    /// The text of the first pair with a code.
    pub(super) fn text(&self, code: i32) -> Option<&'b [u8]> {
        self.all(code).next().map(Pair::text)
    }

    /// The number of the first pair with a code.
    pub(super) fn real(&self, code: i32) -> Option<f64> {
        self.all(code).next().and_then(|pair| self.real_of(pair))
    }

    /// The number of a pair. Sets [`Self::bad_code`] if the value is not a number.
    pub(super) fn real_of(&self, pair: &Pair<'b>) -> Option<f64> {
        self.note_bad(pair, pair.real())
    }

    /// The integer of the first pair with a code.
    pub(super) fn int(&self, code: i32) -> Option<i64> {
        let pair = self.all(code).next()?;
        self.note_bad(pair, pair.int())
    }

    fn note_bad<T>(&self, pair: &Pair<'_>, number: Option<T>) -> Option<T> {
        if number.is_none() && self.bad_code.get().is_none() {
            self.bad_code.set(Some(pair.code));
        }
        number
    }

    /// The vector whose x has this code. The codes of y and z are 10 and 20 above it; both default
    /// to 0.
    pub(super) fn vector(&self, code: i32) -> Option<Vector3> {
        let x = self.real(code)?;
        let [y, z] = [code + 10, code + 20].map(|code| self.real(code).unwrap_or(0.0));
        Some(Vector3 { x, y, z })
    }

    /// All vectors whose x has this code, in file order.
    pub(super) fn vectors(&self, code: i32) -> Vec<Vector3> {
        let mut all: Vec<Vector3> = Vec::new();
        for pair in &self.pairs {
            let axis = pair.code - code;
            if !matches!(axis, 0 | 10 | 20) {
                continue;
            }
            let Some(number) = self.real_of(pair) else {
                continue;
            };
            match (axis, all.last_mut()) {
                (0, _) => all.push(Vector3 {
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

/// Reads records in sequence. A copy continues from the same record.
#[derive(Clone, Copy)]
pub(super) struct RecordReader<'b> {
    pairs: PairReader<'b>,
    /// The code-0 pair of the next record, once read.
    next: Option<Pair<'b>>,
    elements: u64,
    max_elements: u64,
    max_pairs: usize,
}

impl<'b> RecordReader<'b> {
    pub(super) fn new(bytes: &'b [u8], limits: &Limits) -> Self {
        Self {
            pairs: PairReader::new(bytes),
            next: None,
            elements: 0,
            max_elements: limits.elements,
            max_pairs: limits.curve_points.saturating_mul(PAIRS_PER_POINT),
        }
    }

    pub(super) fn is_binary(&self) -> bool {
        self.pairs.is_binary()
    }

    /// The stray lines so far.
    pub(super) fn stray(&self) -> Option<StrayLines> {
        self.pairs.stray()
    }

    /// Number of bytes read.
    pub(super) fn position(&self) -> usize {
        self.pairs.position()
    }

    /// Reads the next record into `record`; false if the file ends first. Stores only the pairs for
    /// which `wanted(kind, code)` holds.
    ///
    /// # Errors
    /// When a pair is malformed, or when elements or group codes exceed their limit.
    pub(super) fn read(
        &mut self,
        record: &mut Record<'b>,
        wanted: impl Fn(&[u8], i32) -> bool,
    ) -> Result<bool, Problem> {
        record.pairs.clear();
        record.bad_code.set(None);
        // Skips comments before the record.
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
                if record.pairs.len() == self.max_pairs {
                    return Err(limit("group codes of one element", self.max_pairs as u64));
                }
                record.pairs.push(pair);
            }
        }
        Ok(true)
    }

    /// The kind of the next record.
    pub(super) fn peek(&self) -> Option<&'b [u8]> {
        self.next.map(|pair| pair.text())
    }

    /// Tells if the current section has another record.
    pub(super) fn has_more_in_section(&self) -> bool {
        !matches!(self.peek(), None | Some(b"ENDSEC" | b"EOF" | b"SECTION"))
    }

    fn count(&mut self) -> Result<(), Problem> {
        self.elements += 1;
        if self.elements <= self.max_elements {
            return Ok(());
        }
        Err(limit("elements in the file", self.max_elements))
    }
}

fn limit(what: &'static str, limit: u64) -> Problem {
    Problem::LimitReached {
        what,
        limit,
        actual: limit.saturating_add(1),
    }
}
