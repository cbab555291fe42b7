//! Packs the control points of some paths for the device, in Hilbert order of the paths.
//!
//! Input: a scene. Output: local `f32` points, segments and keys, and the place of each path.

use guideway_grid::per_pixel::LocalScene;
use guideway_scene::Scene;
use guideway_spline::hilbert;

/// A drawn path of the scene.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// Place of the center of its hull along Hilbert's curve.
    key: u32,
    path: u32,
    /// From 1 on, the highest on top.
    rank: u32,
}

/// The first segment that is not yet packed.
#[derive(Clone, Copy, Debug, Default)]
struct Cursor {
    /// Index in Hilbert order.
    row: usize,
    run: usize,
    segment: usize,
}

/// Packed segments.
#[derive(Default)]
pub(super) struct Packed {
    pub(super) points_m: Vec<[f32; 2]>,
    /// Index of the first of the four control points, and the rank of the path.
    pub(super) segments: Vec<[u32; 2]>,
    /// Ascending keys.
    pub(super) keys: Vec<u32>,
}

/// Place of the control points of a path on the device: all runs one after the other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Place {
    /// The path is not drawn.
    #[default]
    Nowhere,
    /// Chunk and first control point.
    At(u32, u32),
    /// The path lies in several chunks.
    Split,
}

/// Packs a scene, some segments per call.
pub(super) struct Packer<'a> {
    scene: &'a Scene,
    local: &'a LocalScene,
    rows: Vec<Row>,
    cursor: Cursor,
    chunk: u32,
    /// One per row of the scene.
    pub(super) places: Vec<Place>,
}

impl<'a> Packer<'a> {
    /// Sorts the drawn paths of a scene along Hilbert's curve.
    pub(super) fn new(scene: &'a Scene, local: &'a LocalScene) -> Self {
        let (paths, bounds) = (&scene.layout().paths, scene.bounds());
        let ranked = scene.draw_order().iter().zip(1..);
        let mut rows: Vec<_> = ranked
            .map(|(&path, rank)| {
                let hull = paths.get(path as usize).hull_bounds();
                let key = hull.zip(bounds);
                let key = key.map_or(0, |(hull, all)| hilbert(hull.center(), all));
                Row { key, path, rank }
            })
            .collect();
        rows.sort_unstable_by_key(|row| (row.key, row.path));
        Self {
            scene,
            local,
            rows,
            cursor: Cursor::default(),
            chunk: 0,
            places: vec![Place::Nowhere; scene.row_count()],
        }
    }

    /// Packs the next `max_segments` segments at most, for the next chunk; nothing after the last.
    pub(super) fn pack(&mut self, max_segments: u32) -> Packed {
        let mut packed = Packed::default();
        let paths = &self.scene.layout().paths;
        let max_segments = max_segments as usize;
        while let Some(&row) = self.rows.get(self.cursor.row) {
            let mut runs = paths.get(row.path as usize).runs();
            let Some(run) = runs.nth(self.cursor.run) else {
                self.cursor = Cursor {
                    row: self.cursor.row + 1,
                    ..Cursor::default()
                };
                continue;
            };
            let rest = run.len() - 3 - self.cursor.segment;
            let taken = rest.min(max_segments - packed.segments.len());
            if taken == 0 {
                break;
            }
            let first = packed.points_m.len() as u32;
            let place = &mut self.places[row.path as usize];
            *place = match *place {
                Place::Nowhere if taken == rest => Place::At(self.chunk, first),
                Place::At(chunk, start) if taken == rest && chunk == self.chunk => {
                    Place::At(chunk, start)
                }
                _ => Place::Split,
            };
            let points = self.cursor.segment..self.cursor.segment + taken + 3;
            let local = points.map(|point| self.local.local_from_world(run.get(point)));
            packed.points_m.extend(local);
            let segments = (first..first + taken as u32).map(|point| [point, row.rank]);
            packed.segments.extend(segments);
            packed.keys.resize(packed.segments.len(), row.key);
            self.cursor = if taken == rest {
                Cursor {
                    run: self.cursor.run + 1,
                    segment: 0,
                    ..self.cursor
                }
            } else {
                Cursor {
                    segment: self.cursor.segment + taken,
                    ..self.cursor
                }
            };
        }
        self.chunk += 1;
        packed
    }
}
