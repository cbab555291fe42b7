//! Control points of some of the paths, as the device reads them.

use std::ops::Range;

use guideway_scene::Scene;

use crate::cut::Cutter;
use crate::local::{Local, Met};
use crate::options::GridOptions;
use crate::params::GridParams;

/// What an atomic addition, or the sampling of a line, takes at most: so many distance tests.
const TESTS_AN_ENTRY: u64 = 10;

/// How far a scene has been packed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Cursor {
    /// Place in the draw order.
    path: usize,
    run: usize,
    segment: usize,
}

/// Segments for the device.
#[derive(Default)]
pub(super) struct Packed {
    pub(super) points_m: Vec<[f32; 2]>,
    /// The first of the four control points of each segment.
    pub(super) first_points: Vec<u32>,
    /// Segments to submit at a time.
    pub(super) slices: Vec<Range<u32>>,
    /// Most rows of cells that one line meets.
    pub(super) most_rows: u32,
}

impl Packed {
    pub(super) fn segments(&self) -> u32 {
        self.first_points.len() as u32
    }
}

/// What is packed.
pub(super) struct Packer<'a> {
    pub(super) scene: &'a Scene,
    pub(super) local: &'a Local,
    pub(super) grid: &'a GridParams,
    pub(super) options: &'a GridOptions,
    /// Most work, in distance tests, and most segments to submit at a time.
    pub(super) most_work: u64,
    pub(super) most_items: u32,
}

impl Packer<'_> {
    /// Packs at most so many segments from `cursor` on, and says where the rest begins.
    pub(super) fn pack(&self, mut cursor: Cursor, most_segments: u32) -> (Packed, Cursor) {
        let mut packed = Packed::default();
        let mut cutter = Cutter::new(self.most_work, self.most_items);
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
            let taken = rest.min((most_segments - packed.segments()) as usize);
            if taken == 0 {
                break;
            }
            let first = packed.points_m.len();
            let points = cursor.segment..cursor.segment + taken + 3;
            let local = points.map(|point| self.local.local_from_world(run.get(point)));
            packed.points_m.extend(local);
            for segment in packed.points_m[first..].array_windows() {
                let met = Met::by(segment, self.grid, self.options);
                cutter.push(1, TESTS_AN_ENTRY * met.entries);
                packed.most_rows = packed.most_rows.max(met.rows);
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
        packed.slices = cutter.finish();
        (packed, cursor)
    }
}
