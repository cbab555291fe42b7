//! Packs the control points of some paths for the device.
//!
//! Input: paths in draw order. Output: local `f32` points, and ranges of segments per submission.

use std::ops::Range;

use guideway_scene::Scene;

use crate::local::{CellBound, LocalScene};
use crate::options::GridOptions;
use crate::params::GridParams;
use crate::split::WorkSplitter;

/// Upper bound of the time of an atomic addition or of sampling a line, in distance tests.
const TESTS_PER_ENTRY: u64 = 10;

/// The first segment that is not yet packed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Cursor {
    /// Index in the draw order.
    path: usize,
    run: usize,
    segment: usize,
}

/// Packed segments.
#[derive(Default)]
pub(super) struct Packed {
    pub(super) points_m: Vec<[f32; 2]>,
    /// Index of the first of the four control points of each segment.
    pub(super) first_points: Vec<u32>,
    /// Ranges of segments, one per submission.
    pub(super) slices: Vec<Range<u32>>,
    /// Most rows of cells that one line overlaps.
    pub(super) max_rows: u32,
}

impl Packed {
    pub(super) fn segments(&self) -> u32 {
        self.first_points.len() as u32
    }
}

/// Packs a scene, some segments per call.
pub(super) struct Packer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) local: &'a LocalScene,
    pub(super) grid: &'a GridParams,
    pub(super) options: &'a GridOptions,
    /// Most work per submission, in distance tests.
    pub(super) max_work: u64,
    /// Most segments per submission.
    pub(super) max_items: u32,
}

impl Packer<'_> {
    /// Packs at most `max_segments` segments from `cursor` on. Returns them and the next cursor.
    pub(super) fn pack(&self, mut cursor: Cursor, max_segments: u32) -> (Packed, Cursor) {
        let mut packed = Packed::default();
        let mut splitter = WorkSplitter::new(self.max_work, self.max_items);
        let paths = &self.scene.layout().paths;
        while let Some(&path) = self.scene.draw_order().get(cursor.path) {
            let mut runs = paths.get(path as usize).runs();
            let Some(run) = runs.nth(cursor.run) else {
                cursor = Cursor {
                    path: cursor.path + 1,
                    ..Cursor::default()
                };
                continue;
            };
            let rest = run.len() - 3 - cursor.segment;
            let taken = rest.min((max_segments - packed.segments()) as usize);
            if taken == 0 {
                break;
            }
            let first = packed.points_m.len();
            let points = cursor.segment..cursor.segment + taken + 3;
            let local = points.map(|point| self.local.local_from_world(run.get(point)));
            packed.points_m.extend(local);
            for segment in packed.points_m[first..].array_windows() {
                let bound = CellBound::of_segment(segment, self.grid, self.options);
                splitter.push(1, TESTS_PER_ENTRY * bound.entries);
                packed.max_rows = packed.max_rows.max(bound.rows);
            }
            packed
                .first_points
                .extend(first as u32..(first + taken) as u32);
            cursor = if taken == rest {
                Cursor {
                    run: cursor.run + 1,
                    segment: 0,
                    ..cursor
                }
            } else {
                Cursor {
                    segment: cursor.segment + taken,
                    ..cursor
                }
            };
        }
        packed.slices = splitter.finish();
        (packed, cursor)
    }
}
