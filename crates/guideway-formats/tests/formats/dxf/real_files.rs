//! Reads real DXF files, and the same content as ASCII and as binary.

use crate::common::{assert_counts, count, read, real, real_layouts};
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{CheckOptions, Code, Severity, check};
use guideway_spline::Point;

/// Element counts per file from the list of sources, made by another program.
const REAL: &[(&str, &str)] = &[
    (
        "bjnortier_arrayed-holes.dxf",
        "INSERT 1, LINE in blocks 6, ARC in blocks 3, CIRCLE in blocks 1, INSERT in blocks 1, \
         layers 1",
    ),
    (
        "bjnortier_blocks2.dxf",
        "LINE 1, LWPOLYLINE 1, INSERT 1, MTEXT 1, LINE in blocks 7, INSERT in blocks 2, \
         ARC in blocks 1, layers 2",
    ),
    (
        "bjnortier_circlesellipsesarcs.dxf",
        "ARC 2, CIRCLE 1, ELLIPSE 2, layers 1",
    ),
    (
        "bjnortier_entities.dxf",
        "LINE 29, LWPOLYLINE 29, INSERT 29, MTEXT 29, LINE in blocks 125, SPLINE in blocks 6, \
         LWPOLYLINE in blocks 3, ARC in blocks 22, CIRCLE in blocks 9, INSERT in blocks 2, \
         layers 2",
    ),
    (
        "bjnortier_floorplan.dxf",
        "LINE 624, LWPOLYLINE 124, ARC 20, CIRCLE 9, INSERT 10, HATCH 13, TEXT 89, MTEXT 9, \
         LINE in blocks 1365, LWPOLYLINE in blocks 278, INSERT in blocks 275, ARC in blocks 60, \
         CIRCLE in blocks 23, layers 18",
    ),
    ("bjnortier_issue27a.dxf", "SPLINE 1, layers 1"),
    ("bjnortier_issue27c.dxf", "SPLINE 1, layers 1"),
    ("bjnortier_lines.dxf", "LINE 11, layers 1"),
    ("bjnortier_lwpolylines.dxf", "LWPOLYLINE 2, layers 1"),
    ("bjnortier_polylines.dxf", "POLYLINE 2, VERTEX 16, layers 1"),
    ("bjnortier_splineA.dxf", "SPLINE 1, layers 1"),
    ("bjnortier_splines.dxf", "SPLINE 2, layers 1"),
    ("ezdxf_1_polylines.dxf", "LINE 52, ARC 22, TEXT 9, layers 1"),
    ("ezdxf_3_us_main.dxf", "LINE 10052, TEXT 1, layers 2"),
    (
        "ezdxf_6_closed_loop_with_arcs.dxf",
        "LINE 9, ARC 2, layers 1",
    ),
    ("ezdxf_bin_dxf_r2000.dxf", "TEXT 1, layers 1"),
    (
        "ezdxf_forms.dxf",
        "LWPOLYLINE 33, CIRCLE 5, ELLIPSE 2, layers 1",
    ),
    ("ezdxf_usa.dxf", "LWPOLYLINE 59, layers 1"),
];

/// Element kinds that the test compares.
const COUNTED: &[&str] = &[
    "LINE",
    "LWPOLYLINE",
    "POLYLINE",
    "VERTEX",
    "ARC",
    "CIRCLE",
    "ELLIPSE",
    "SPLINE",
    "INSERT",
    "TEXT",
    "MTEXT",
    "HATCH",
    "LINE in blocks",
    "LWPOLYLINE in blocks",
    "ARC in blocks",
    "CIRCLE in blocks",
    "SPLINE in blocks",
    "INSERT in blocks",
    "layers",
];

#[test]
fn real_files_have_the_expected_counts() {
    let Some(folder) = real_layouts("dxf") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), REAL.len());
    for (file, expected) in REAL {
        let layout = real("dxf", file).unwrap();
        let kinds = COUNTED.iter().filter(|kind| {
            // Inside blocks, the list has only the most common kinds.
            !kind.ends_with("in blocks") || expected.contains(*kind)
        });
        let kinds: Vec<&str> = kinds.copied().collect();
        assert_counts(&layout, &kinds, expected, file);
        assert_eq!(
            layout.diagnostics.count_at_least(Severity::Warning),
            0,
            "{file}"
        );
        assert_eq!(layout.refused.len(), 0, "{file}");
        let drawn = [
            "LINE",
            "LWPOLYLINE",
            "POLYLINE",
            "ARC",
            "CIRCLE",
            "ELLIPSE",
            "SPLINE",
        ];
        let drawn: u64 = drawn.iter().map(|kind| count(&layout, kind)).sum();
        assert!(layout.paths.len() as u64 >= drawn, "{file}");
    }
}

#[test]
fn closed_splines_of_real_files_are_closed() {
    for file in ["bjnortier_issue27a.dxf", "bjnortier_issue27c.dxf"] {
        let Some(layout) = real("dxf", file) else {
            return;
        };
        let (start, end) = layout.paths.get(0).ends().unwrap();
        assert!(start.distance(end) < 1e-6, "{file}: {start:?} {end:?}");
        let found = check(&layout, &CheckOptions::default());
        assert_eq!(found.count(Code::BrokenPath), 0, "{file}");
    }
}

#[test]
fn outlines_of_real_files_are_connected() {
    // Every line of the map starts at the end of another one.
    let Some(layout) = real("dxf", "ezdxf_3_us_main.dxf") else {
        return;
    };
    let key = |p: Point<f64>| ((p.x * 1e9).round() as i64, (p.y * 1e9).round() as i64);
    let mut degree = std::collections::HashMap::new();
    for path in layout.paths.iter() {
        let (start, end) = path.ends().unwrap();
        *degree.entry(key(start)).or_insert(0) += 1;
        *degree.entry(key(end)).or_insert(0) += 1;
    }
    let open_ends = degree.values().filter(|&&n| n == 1).count();
    assert!(
        open_ends * 100 < layout.paths.len(),
        "{open_ends} open ends"
    );
}

/// Converts ASCII to binary DXF, with group codes of one byte or of two (`wide`).
fn binary(text: &str, wide: bool) -> Vec<u8> {
    let mut bytes = b"AutoCAD Binary DXF\r\n\x1a\0".to_vec();
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    for pair in lines.chunks_exact(2) {
        let code: i16 = pair[0].parse().unwrap();
        match (wide, u8::try_from(code)) {
            (false, Ok(code)) if code < 255 => bytes.push(code),
            (false, _) => {
                bytes.push(255);
                bytes.extend(code.to_le_bytes());
            }
            (true, _) => bytes.extend(code.to_le_bytes()),
        }
        match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
                bytes.extend(pair[1].parse::<f64>().unwrap().to_le_bytes());
            }
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                bytes.extend(pair[1].parse::<i16>().unwrap().to_le_bytes());
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => {
                bytes.extend((pair[1].parse::<i64>().unwrap() as i32).to_le_bytes());
            }
            160..=169 => bytes.extend(pair[1].parse::<i64>().unwrap().to_le_bytes()),
            290..=299 => bytes.push(pair[1].parse().unwrap()),
            310..=319 | 1004 => bytes.extend([2, 7, 7]),
            _ => {
                bytes.extend(pair[1].as_bytes());
                bytes.push(0);
            }
        }
    }
    bytes
}

#[test]
fn binary_and_ascii_give_the_same_layout() {
    let Some(folder) = real_layouts("dxf") else {
        return;
    };
    for (file, _) in REAL.iter().filter(|(file, _)| !file.contains("bin_dxf")) {
        let Ok(text) = String::from_utf8(std::fs::read(folder.join(file)).unwrap()) else {
            continue;
        };
        let from_text = read(&text);
        for wide in [true, false] {
            let bytes = binary(&text, wide);
            let from_binary = read_bytes("binary", &bytes, &ReadOptions::default()).unwrap();
            assert!(from_binary.provenance.format_version.ends_with("binary"));
            assert_eq!(
                from_text.provenance.counts, from_binary.provenance.counts,
                "{file}"
            );
            assert_eq!(from_text.paths.len(), from_binary.paths.len());
            for (a, b) in from_text.paths.iter().zip(from_binary.paths.iter()) {
                assert_eq!(a.id(), b.id(), "{file}");
                let (a, b) = (
                    a.runs().flat_map(|r| r.iter()),
                    b.runs().flat_map(|r| r.iter()),
                );
                assert!(a.eq(b), "{file}");
            }
        }
    }
}
