//! Fixed-point strokes against the distance of every sample.

use std::ops::Range;

use super::caps::FixedCapTable;
use super::capsule::{Borders, Ends, FixedCapsule};
use crate::cpu::ground::fixed_steps::STEPS;
use crate::cpu::ground::samples::{ROWS, SOLID};
use crate::cpu::ground::tile::{LANES, TILE_PX};

/// Numbers from 0 to 1, the same in every run.
fn numbers() -> impl FnMut() -> f32 {
    let mut state = 11_u64;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 40) as f32 / (1 << 24) as f32
    }
}

/// A line between two points, in steps.
fn ends(a: [i16; 2], b: [i16; 2]) -> Ends {
    let [a, b] = if b[1] < a[1] { [b, a] } else { [a, b] };
    Ends {
        x: [[a[0]; LANES], [b[0]; LANES]],
        y: [[a[1]; LANES], [b[1]; LANES]],
    }
}

fn caps(radius_px: f32) -> FixedCapTable {
    let mut caps = FixedCapTable::default();
    caps.resize(radius_px);
    caps
}

/// The samples that a line covers in each row of the tile.
fn rows(ends: &Ends, caps: &FixedCapTable) -> Vec<Range<u32>> {
    let borders = Borders::new(ends, caps.radius);
    let stroke = FixedCapsule::new(ends, &borders, 0, caps);
    let of_pixels = (0..TILE_PX).map(|row| stroke.spans(row, caps));
    of_pixels
        .flat_map(|spans| (0..LANES).map(move |i| spans.first[i]..spans.end[i]))
        .collect()
}

fn distance_px(p: [f32; 2], a: [i16; 2], b: [i16; 2]) -> f32 {
    let [a, b] = [a, b].map(|p| p.map(|v| f32::from(v) / STEPS as f32));
    let [p, along] = [p, b].map(|p| [p[0] - a[0], p[1] - a[1]]);
    let square = along[0] * along[0] + along[1] * along[1];
    let t = (p[0] * along[0] + p[1] * along[1]) / square.max(1e-20);
    let t = t.clamp(0.0, 1.0);
    (p[0] - t * along[0]).hypot(p[1] - t * along[1])
}

/// Compares with the distance of every sample; returns the distance of the farthest wrong one, in
/// pixels.
fn farthest_wrong_px(a: [i16; 2], b: [i16; 2], radius_px: f32) -> f32 {
    let mut farthest = 0.0_f32;
    for (row, span) in rows(&ends(a, b), &caps(radius_px)).into_iter().enumerate() {
        for column in 0..(TILE_PX * SOLID) as u32 {
            let shift = if row % 2 == 0 { 0.25 } else { 0.75 };
            let x = (column as f32 + shift) / SOLID as f32;
            let y = (row as f32 + 0.5) / ROWS as f32;
            let beyond = distance_px([x, y], a, b) - radius_px;
            if span.contains(&column) != (beyond < 0.0) {
                farthest = farthest.max(beyond.abs());
            }
        }
    }
    farthest
}

/// Derived: ends, half chords and borders are rounded to steps, slopes to 2^-14 of a step per step.
const TOLERANCE_PX: f32 = 2.5 / STEPS as f32;

#[test]
fn spans_match_the_distance_of_every_sample() {
    let mut next = numbers();
    let mut drawn = 0;
    for i in 0..300 {
        let mut point = || [0, 1].map(|_| ((next() * 56.0 - 12.0) * STEPS as f32) as i16);
        let (a, b) = (point(), point());
        let radius_px = [0.05, 0.3, 0.75, 1.5, 4.0, 8.0][i % 6];
        if Borders::new(&ends(a, b), radius_px).level != 0 {
            continue;
        }
        let wrong_px = farthest_wrong_px(a, b, radius_px);
        assert!(
            wrong_px < TOLERANCE_PX,
            "{a:?} {b:?} {radius_px}: {wrong_px}"
        );
        drawn += 1;
    }
    assert!(drawn > 250);
}

#[test]
fn upright_zero_length_and_short_level_lines_match_too() {
    for (a, b) in [
        ([300, 400], [300, 900]),
        ([300, 400], [300, 400]),
        ([300, 400], [700, 400]),
        ([700, 401], [300, 400]),
        ([-9000, 300], [9000, 1400]),
    ] {
        for radius_px in [0.1, 0.75, 3.0] {
            let wrong_px = farthest_wrong_px(a, b, radius_px);
            assert!(
                wrong_px < TOLERANCE_PX,
                "{a:?} {b:?} {radius_px}: {wrong_px}"
            );
        }
    }
}

#[test]
fn the_comparison_detects_a_wrong_radius() {
    let (a, b) = ([300, 400], [1500, 1200]);
    let spans = rows(&ends(a, b), &caps(1.5));
    assert_ne!(spans, rows(&ends(a, b), &caps(1.6)));
    // Two steps more than the tolerance.
    let off_px = TOLERANCE_PX + 2.0 / STEPS as f32;
    let wider = rows(&ends(a, b), &caps(1.5 + off_px));
    assert!(spans.iter().zip(&wider).any(|(a, b)| a.len() < b.len()));
}

#[test]
fn marks_long_level_lines() {
    let level = |a, b| Borders::new(&ends(a, b), 48.0).level;
    assert_eq!(level([0, 0], [600, 2]), 0xffff);
    assert_eq!(level([0, 0], [600, 4]), 0);
    assert_eq!(level([0, 0], [500, 0]), 0);
}

#[test]
fn a_line_moved_by_whole_pixels_covers_the_same_samples() {
    let mut next = numbers();
    for _ in 0..100 {
        let mut point = || [0, 1].map(|_| ((next() * 24.0 - 4.0) * STEPS as f32) as i16);
        let (a, b) = (point(), point());
        let caps = caps(0.75);
        let here = rows(&ends(a, b), &caps);
        let [down_px, right_px] = [3, 5];
        let moved = |p: [i16; 2]| {
            [
                p[0] + right_px * STEPS as i16,
                p[1] + down_px * STEPS as i16,
            ]
        };
        let there = rows(&ends(moved(a), moved(b)), &caps);
        for row in 0..(TILE_PX - down_px as usize) * ROWS {
            for column in 0..(TILE_PX - right_px as usize) * SOLID {
                let is_here = here[row].contains(&(column as u32));
                let column = column + right_px as usize * SOLID;
                let is_there = there[row + down_px as usize * ROWS].contains(&(column as u32));
                assert_eq!(is_here, is_there, "{a:?} {b:?} {row} {column}");
            }
        }
    }
}

#[test]
fn pixels_of_a_row_hold_all_covered_samples() {
    let mut next = numbers();
    for _ in 0..200 {
        let mut point = || [0, 1].map(|_| ((next() * 120.0 - 40.0) * STEPS as f32) as i16);
        let (ends, caps) = (ends(point(), point()), caps(1.5));
        let borders = Borders::new(&ends, caps.radius);
        if ends.x[0][0].abs_diff(ends.x[1][0]) < 12 * STEPS as u16 || borders.level != 0 {
            continue;
        }
        let stroke = FixedCapsule::new(&ends, &borders, 0, &caps);
        for row in 0..TILE_PX {
            let pixels = stroke.pixels(row, caps.reach);
            let spans = stroke.spans(row, &caps);
            for i in 0..LANES {
                for sample in spans.first[i]..spans.end[i] {
                    assert!(
                        pixels >> (sample as usize / SOLID) & 1 == 1,
                        "{row} {sample}"
                    );
                }
            }
        }
    }
}
