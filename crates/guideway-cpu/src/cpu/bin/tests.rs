//! Tile lists against the boxes they come from, and line lists against lists of clusters.

use std::sync::Arc;

use guideway_scene::cluster::ClusterBounds;
use guideway_scene::density::ToneMap;
use guideway_scene::{Budget, Cancel, Shading, Strip, Style};
use guideway_spline::{Bounds, Point};

use super::cull::VisibleClusters;
use crate::cpu::frame::clusters::StyleSummary;
use crate::cpu::frame::state::CpuPrepared;
use crate::cpu::ground::simd::SimdLevel;
use crate::cpu::ground::tile::TILE_PX;
use crate::cpu::testing::*;

#[test]
fn a_cluster_lands_in_exactly_the_tiles_it_overlaps() {
    let scene = scene(wandering(3, 11, 3.0, ORIGIN));
    let (view, style, cancel) = (view(ORIGIN, 1.0), wide_px(2.0), Cancel::default());
    let strip = Strip::whole(&view);
    let summary = StyleSummary::of(&scene);
    let frame = (&strip, &style, &cancel);
    let ctx = summary.frame_context((&scene, None), SimdLevel::default(), frame);
    let mut next = numbers(4);
    let boxes = (0..200).map(|_| {
        let (min, size) = (Point::new(next(), next()) * 150.0, next().abs() * 60.0);
        let max = min + Point::new(size, size / 2.0);
        Some(ClusterBounds::new(Bounds { min, max }))
    });
    let boxes: Vec<_> = boxes.collect();
    let mut visible = VisibleClusters::default();
    visible.cull(&boxes, &ctx);
    let mut found = 0;
    for (cluster, bounds) in (0..).zip(&boxes) {
        let touched = ctx.touched_px(bounds.unwrap().bounds);
        let entry = visible.iter().find(|entry| entry.cluster == cluster);
        for row in 0..157_usize.div_ceil(TILE_PX) {
            for column in 0..203_usize.div_ceil(TILE_PX) {
                let min = Point::new(column as f64, row as f64) * TILE_PX as f64;
                let max = min + Point::new(TILE_PX as f64, TILE_PX as f64);
                // The last tiles reach beyond the picture.
                let max = Point::new(max.x.min(203.0), max.y.min(157.0));
                // Half open: a box that ends on the border of a tile does not reach into it.
                let overlaps = touched.min.x < max.x
                    && touched.min.y < max.y
                    && touched.max.x > min.x
                    && touched.max.y > min.y;
                let is_listed = entry.is_some_and(|entry| {
                    entry.columns().contains(&column) && entry.rows().contains(&row)
                });
                assert_eq!(is_listed, overlaps, "{cluster}: {touched:?} {column} {row}");
                found += usize::from(is_listed);
            }
        }
    }
    assert!(found > 200, "{found}");
}

#[test]
fn line_lists_change_no_bit() {
    let density = Style {
        shading: Shading::Density(ToneMap::Log),
        ..wide_px(1.5)
    };
    let solid = || scene(wandering(500, 30, 2.0, ORIGIN));
    for (scene, style) in [
        (solid(), wide_px(2.5)),
        (solid(), wide_px(0.4)),
        (solid(), density),
        (
            colored(wandering(300, 30, 2.0, ORIGIN), |i| [255, 120][i % 2]),
            wide_px(1.5),
        ),
    ] {
        // From 0.1 mm per pixel on, clusters are too large for cached lines.
        for px_per_m in [2.0, 30.0, 10_000.0] {
            let pictures = [1, usize::MAX].map(|min_tiles| {
                let mut prepared = CpuPrepared::new(Arc::clone(&scene), &Budget::default());
                let prepared = prepared.as_mut().unwrap();
                prepared.list_lines_from(min_tiles);
                let first = draw_with(prepared, &view(ORIGIN, px_per_m), &style).0;
                let moved = view(ORIGIN + Point::new(9.0 / px_per_m, 0.0), px_per_m);
                [first, draw_with(prepared, &moved, &style).0]
            });
            assert!(pictures[0] == pictures[1], "{px_per_m} px per meter");
        }
    }
}
