//! Clips: finds the boundaries that clip references to blocks (XCLIP), in the OBJECTS section.
//!
//! ```text
//! INSERT <-- owner -- dictionary <-- owner -- dictionary ACAD_FILTER <-- owner -- SPATIAL_FILTER
//! SPATIAL_FILTER <-- owner -- dictionary <-- owner -- XRECORD of an inverted boundary
//! ```
//!
//! A boundary is a polygon in the drawing as it was when the block was clipped, however the
//! reference moved since. Two matrices lead from there to the block. An inverted boundary hides its
//! inside. It is in an XRECORD; the SPATIAL_FILTER has then a polygon for programs that know no
//! inverted ones, of which AutoCAD leaves corners out. ezdxf's author found that the two may be
//! exchanged: the inner one is hidden. Source: the DXF reference, and the experiments of ezdxf's
//! author ("Exploring the transformation behavior of SPATIAL_FILTER", `ClippingPath`).

use std::collections::HashMap;

use guideway_spline::Bounds;

use super::affine3::{Affine3, Vector3};
use super::records::{Record, RecordReader};
use crate::Problem;

/// Owners between a boundary and the reference that it clips.
const OWNERS: usize = 3;

/// Numbers of a matrix: three rows of four, of which the last is a translation.
const MATRIX: usize = 12;

/// The boundaries that clip references to blocks.
#[derive(Default)]
pub(super) struct Clips<'b> {
    /// By the handle of the reference.
    boundaries: HashMap<&'b [u8], Boundary>,
    /// Number of boundaries whose reference is not stated.
    pub(super) lost: u64,
}

/// A boundary that clips a reference to a block.
pub(super) enum Boundary {
    /// Its polygon.
    Known {
        /// In the coordinates of the block.
        corners: Vec<Vector3>,
        /// The inside is hidden instead of the outside.
        is_inverted: bool,
    },
    /// The reason why it is not known.
    Unknown(&'static str),
}

/// A SPATIAL_FILTER.
struct Filter<'b> {
    /// The handle of the dictionary that owns it.
    owner: &'b [u8],
    /// The handle of its own dictionary; empty without one.
    dictionary: &'b [u8],
    corners: Vec<Vector3>,
    /// From the coordinates of its corners to those of the block.
    to_block: Option<Affine3>,
}

impl<'b> Clips<'b> {
    /// Reads the OBJECTS section.
    ///
    /// # Errors
    /// When a pair is malformed, or a limit is exceeded.
    pub(super) fn read(
        &mut self,
        records: &mut RecordReader<'b>,
        record: &mut Record<'b>,
    ) -> Result<(), Problem> {
        let mut owners: HashMap<&[u8], &[u8]> = HashMap::new();
        let mut filters: Vec<Filter<'b>> = Vec::new();
        // By the handle of the dictionary of the filter.
        let mut inverted: HashMap<&[u8], Vec<Vector3>> = HashMap::new();
        let wanted = |kind: &[u8], code| match kind {
            b"DICTIONARY" => matches!(code, 5 | 102 | 330),
            b"SPATIAL_FILTER" => matches!(code, 10 | 20 | 40 | 71 | 102 | 330 | 360),
            b"XRECORD" => matches!(code, 10 | 20 | 102 | 330),
            _ => false,
        };
        while records.has_more_in_section() && records.read(record, wanted)? {
            let owner = owner(record).unwrap_or_default();
            match record.kind {
                b"DICTIONARY" => {
                    owners.insert(record.text(5).unwrap_or_default(), owner);
                }
                // Group code 71 switches the boundary off with 0.
                b"SPATIAL_FILTER" if record.int(71) != Some(0) => {
                    filters.push(Filter::of(record, owner));
                }
                b"XRECORD" if !owner.is_empty() => {
                    inverted.extend(keep_inverted(record).then(|| (owner, corners(record))));
                }
                _ => {}
            }
        }
        for filter in filters {
            let mut reference = filter.owner;
            for _ in 1..OWNERS {
                reference = owners.get(reference).copied().unwrap_or_default();
            }
            match reference {
                b"" | b"0" => self.lost += 1,
                reference => {
                    let hidden = inverted.remove(filter.dictionary);
                    self.boundaries.insert(reference, filter.boundary(hidden));
                }
            }
        }
        Ok(())
    }

    /// The boundary that clips the reference with this handle, if any.
    pub(super) fn of(&self, handle: &[u8]) -> Option<&Boundary> {
        self.boundaries.get(handle)
    }
}

impl<'b> Filter<'b> {
    fn of(record: &Record<'b>, owner: &'b [u8]) -> Self {
        // Before the matrices comes the distance of a plane in front, if there is one.
        let numbers = record.all(40).filter_map(|pair| record.real_of(pair));
        let numbers: Vec<f64> = numbers.collect();
        let matrices = numbers.last_chunk::<{ 2 * MATRIX }>();
        let to_block = matrices.and_then(|matrices| {
            let (to_block, to_boundary) = matrices.split_at(MATRIX);
            Some(matrix(to_block).after(&matrix(to_boundary).inverse()?))
        });
        Self {
            owner,
            dictionary: record.text(360).unwrap_or_default().trim_ascii(),
            corners: corners(record),
            to_block,
        }
    }

    /// The boundary; that of the corners `hidden`, where they are stated.
    fn boundary(self, hidden: Option<Vec<Vector3>>) -> Boundary {
        let is_inverted = hidden.is_some();
        // The outer polygon may stand in the place of the hidden one.
        let hidden = hidden.filter(|hidden| !is_around(hidden, &self.corners));
        let mut corners = hidden.unwrap_or(self.corners);
        if let [min, max] = corners[..] {
            corners = vec![
                min,
                Vector3::new(max.x, min.y, 0.0),
                max,
                Vector3::new(min.x, max.y, 0.0),
            ];
        }
        match self.to_block {
            _ if corners.len() < 3 => Boundary::Unknown("its corners are not stated"),
            Some(to_block) => Boundary::Known {
                corners: corners.into_iter().map(|p| to_block.point(p)).collect(),
                is_inverted,
            },
            None => Boundary::Unknown("its place in the block is not stated"),
        }
    }
}

/// The corners of a record, or an empty list where a number is malformed.
fn corners(record: &Record<'_>) -> Vec<Vector3> {
    let corners = record.vectors(10);
    match record.bad_code.get() {
        Some(_) => Vec::new(),
        None => corners,
    }
}

/// Returns `true` if the box of the corners `outer` is larger than that of the corners `inner`, and
/// has it inside.
fn is_around(outer: &[Vector3], inner: &[Vector3]) -> bool {
    let bounds = |corners: &[Vector3]| Bounds::of_points(corners.iter().map(|corner| corner.xy()));
    let Some((outer, inner)) = bounds(outer).zip(bounds(inner)) else {
        return false;
    };
    outer != inner && outer.contains(inner.min) && outer.contains(inner.max)
}

/// Keeps the pairs of an XRECORD that are the corners of an inverted boundary. Returns `true` if it
/// has such a boundary.
fn keep_inverted(record: &mut Record<'_>) -> bool {
    let mut is_in_boundary = false;
    record.pairs.retain(|pair| {
        if pair.code == 102 {
            is_in_boundary = pair.text() == b"ACAD_INVERTEDCLIP_ROUNDTRIP";
        }
        is_in_boundary
    });
    !record.pairs.is_empty()
}

/// The map of a matrix as DXF writes it: per coordinate of the image three factors and an offset.
fn matrix(numbers: &[f64]) -> Affine3 {
    let column = |i: usize| {
        let of = |row: usize| numbers.get(4 * row + i).copied().unwrap_or_default();
        Vector3::new(of(0), of(1), of(2))
    };
    Affine3 {
        x: column(0),
        y: column(1),
        z: column(2),
        origin: column(3),
    }
}

/// The handle of the owner of a record: the group code 330 outside of the lists in braces.
fn owner<'b>(record: &Record<'b>) -> Option<&'b [u8]> {
    let mut is_in_list = false;
    for pair in &record.pairs {
        match pair.code {
            102 => is_in_list = pair.text().starts_with(b"{"),
            330 if !is_in_list => return Some(pair.text().trim_ascii()),
            _ => {}
        }
    }
    None
}
