//! DXF: the real files, text against binary, and where shapes, blocks and styles end up.

use crate::common::{assert_counts, codes, count, ends, read, real, real_layouts};
use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{CheckOptions, Code, Layout, Severity, Value, check};
use guideway_spline::{Point, uniform};

/// Counts as the list of sources of the real layouts has them, made by another program.
const REAL: &[(&str, &str)] = &[
    (
        "bjnortier_arrayed-holes.dxf",
        "INSERT 1, LINE in blocks 6, ARC in blocks 3, CIRCLE in blocks 1, INSERT in blocks 1, layers 1",
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
         LWPOLYLINE in blocks 3, ARC in blocks 22, CIRCLE in blocks 9, INSERT in blocks 2, layers 2",
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

/// A drawing in meters, its sections written as `code value` on lines.
fn drawing(tables: &str, blocks: &str, entities: &str) -> Layout {
    read(&text(&format!(
        "0 SECTION\n2 HEADER\n9 $INSUNITS\n70 6\n0 ENDSEC\n\
         0 SECTION\n2 TABLES\n{tables}\n0 ENDSEC\n\
         0 SECTION\n2 BLOCKS\n{blocks}\n0 ENDSEC\n\
         0 SECTION\n2 ENTITIES\n{entities}\n0 ENDSEC\n0 EOF"
    )))
}

/// Each code and value on a line of its own.
fn text(pairs: &str) -> String {
    let lines = pairs.lines().filter(|line| !line.is_empty());
    let pairs = lines.map(|line| line.split_once(' ').unwrap());
    pairs
        .map(|(code, value)| format!("{code}\n{value}\n"))
        .collect()
}

/// The ends of all segments of a path.
fn vertices(layout: &Layout, id: &str) -> Vec<Point<f64>> {
    let path = layout.paths.iter().find(|p| p.id() == id);
    let path = path.unwrap_or_else(|| panic!("no path {id}"));
    let segments: Vec<_> = path.runs().flat_map(|run| run.segments()).collect();
    let ends = segments.iter().map(uniform::end);
    [uniform::start(&segments[0])]
        .into_iter()
        .chain(ends)
        .collect()
}

fn assert_near(found: Point<f64>, x: f64, y: f64) {
    assert!(
        found.distance(Point::new(x, y)) < 1e-9,
        "{found:?} is not ({x}, {y})"
    );
}

const LINE: &str = "0 LINE\n5 A\n8 0\n10 1\n20 0\n11 3\n21 1\n";

#[test]
fn real_files_have_the_counts_that_others_find() {
    let Some(folder) = real_layouts("dxf") else {
        return;
    };
    assert_eq!(folder.read_dir().unwrap().count(), REAL.len());
    for (file, expected) in REAL {
        let layout = real("dxf", file).unwrap();
        let kinds = COUNTED.iter().filter(|kind| {
            // Of blocks, the list has only the commonest kinds.
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
fn closed_splines_of_real_files_close() {
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
fn outlines_of_real_files_meet() {
    // Each line of the map begins where another ends.
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
    let loose = degree.values().filter(|&&n| n == 1).count();
    assert!(loose * 100 < layout.paths.len(), "{loose} loose ends");
}

/// The same pairs as a binary file, with codes of one byte or of two.
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
fn a_binary_file_is_read_as_the_text_it_came_from() {
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

#[test]
fn units_become_meters() {
    for (code, meters) in [
        (1, 0.0254),
        (2, 0.3048),
        (4, 0.001),
        (5, 0.01),
        (6, 1.0),
        (0, 0.001),
    ] {
        let layout = read(&text(&format!(
            "0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1015\n9 $INSUNITS\n70 {code}\n0 ENDSEC\n\
             0 SECTION\n2 ENTITIES\n0 LINE\n5 A\n10 0\n20 0\n11 1000\n21 0\n0 ENDSEC\n0 EOF"
        )));
        assert_near(ends(&layout, "A").1, 1000.0 * meters, 0.0);
        assert_eq!(
            layout.diagnostics.count(Code::AssumedUnit),
            u64::from(code == 0)
        );
        assert_eq!(layout.provenance.format_version, "2000 (AC1015)");
    }
}

#[test]
fn arcs_go_counter_clockwise_in_their_own_plane() {
    let arc = "0 ARC\n5 A\n10 10\n20 0\n40 2\n50 0\n51 90\n";
    let (start, end) = ends(&drawing("", "", arc), "A");
    assert_near(start, 12.0, 0.0);
    assert_near(end, 10.0, 2.0);
    // An extrusion downwards mirrors x, center and all.
    let (start, end) = ends(
        &drawing("", "", &format!("{arc}210 0\n220 0\n230 -1\n")),
        "A",
    );
    assert_near(start, -12.0, 0.0);
    assert_near(end, -10.0, 2.0);
    // From 350 to 10 degrees it is 20 degrees, through 0.
    let layout = drawing("", "", "0 ARC\n5 A\n10 0\n20 0\n40 1\n50 350\n51 10\n");
    assert!(vertices(&layout, "A").iter().all(|p| p.x > 0.98));
}

#[test]
fn ellipses_are_what_they_say() {
    let ellipse = "0 ELLIPSE\n5 A\n10 1\n20 1\n11 0\n21 4\n40 0.5\n41 0\n42 1.5707963267948966\n";
    let (start, end) = ends(&drawing("", "", ellipse), "A");
    assert_near(start, 1.0, 5.0);
    assert_near(end, -1.0, 1.0);
    let full = drawing("", "", "0 ELLIPSE\n5 A\n10 0\n20 0\n11 4\n21 0\n40 0.5\n");
    for point in vertices(&full, "A") {
        let value = (point.x / 4.0).powi(2) + (point.y / 2.0).powi(2);
        assert!((value - 1.0).abs() < 1e-4);
    }
}

#[test]
fn bulges_are_arcs_and_closed_polylines_close() {
    let polyline = "0 LWPOLYLINE\n5 A\n90 2\n70 1\n10 0\n20 0\n42 1\n10 4\n20 0\n42 0\n";
    let layout = drawing("", "", polyline);
    let all = vertices(&layout, "A");
    assert_near(all[0], 0.0, 0.0);
    assert_near(all[all.len() - 1], 0.0, 0.0);
    // A bulge of 1 is a half circle to the right of the way, which is below.
    assert!(all.iter().all(|p| p.y <= 1e-9));
    let center = Point::new(2.0, 0.0);
    let on_arc = |p: &&Point<f64>| p.y < -1.5 && (p.distance(center) - 2.0).abs() < 1e-4;
    assert!(all.iter().find(on_arc).is_some());
    let old =
        "0 POLYLINE\n5 A\n66 1\n70 1\n0 VERTEX\n10 0\n20 0\n42 1\n0 VERTEX\n10 4\n20 0\n0 SEQEND\n";
    assert_eq!(vertices(&drawing("", "", old), "A"), all);
}

#[test]
fn splines_with_weights_and_through_points() {
    // A quarter of a circle.
    let layout = drawing(
        "",
        "",
        "0 SPLINE\n5 A\n70 12\n71 2\n40 0\n40 0\n40 0\n40 1\n40 1\n40 1\n\
         41 1\n41 0.7071067811865476\n41 1\n10 1\n20 0\n30 0\n10 1\n20 1\n30 0\n10 0\n20 1\n30 0\n",
    );
    assert_eq!(codes(&layout), []);
    for point in vertices(&layout, "A") {
        assert!((point.norm() - 1.0).abs() < 1e-4, "{point:?}");
    }
    let through =
        "0 SPLINE\n5 A\n70 8\n71 3\n11 0\n21 0\n31 0\n11 5\n21 5\n31 0\n11 10\n21 0\n31 0\n";
    let layout = drawing("", "", through);
    assert_eq!(codes(&layout), [Code::ApproximateShape]);
    let all = vertices(&layout, "A");
    assert_eq!(all.len(), 3);
    assert_near(all[1], 5.0, 5.0);
}

#[test]
fn blocks_are_nested_turned_mirrored_and_repeated() {
    let blocks = format!(
        "0 BLOCK\n2 inner\n10 1\n20 0\n{LINE}0 ENDBLK\n\
         0 BLOCK\n2 OUTER\n10 0\n20 0\n0 INSERT\n5 B\n2 INNER\n10 10\n20 0\n41 -1\n0 ENDBLK\n"
    );
    // The line goes from its base point to (2, 1) beyond; mirrored it goes to (-2, 1).
    let layout = drawing("", &blocks, "0 INSERT\n5 C\n2 Outer\n10 100\n20 0\n50 90\n");
    assert_eq!(layout.paths.len(), 1);
    let (start, end) = ends(&layout, "C/B/A");
    assert_near(start, 100.0, 10.0);
    assert_near(end, 99.0, 8.0);

    let array = "0 INSERT\n5 C\n2 inner\n10 0\n20 0\n70 3\n71 2\n44 10\n45 20\n41 2\n42 2\n43 2\n";
    let layout = drawing("", &blocks, array);
    assert_eq!(layout.paths.len(), 6);
    let (start, end) = ends(&layout, "C[2,1]/A");
    assert_near(start, 20.0, 20.0);
    assert_near(end, 24.0, 22.0);
    // Steps are not scaled, but turned with the reference.
    let layout = drawing("", &blocks, &format!("{array}50 90\n"));
    assert_near(ends(&layout, "C[1,0]/A").0, 0.0, 10.0);
}

#[test]
fn a_circle_in_a_stretched_block_is_an_ellipse() {
    let block = "0 BLOCK\n2 B\n10 0\n20 0\n0 CIRCLE\n5 A\n10 0\n20 0\n40 1\n0 ENDBLK\n";
    let layout = drawing(
        "",
        block,
        "0 INSERT\n5 C\n2 B\n10 0\n20 0\n41 1000\n42 500\n",
    );
    for run in layout.paths.get(0).runs() {
        for segment in run.segments() {
            let middle = uniform::point(&segment, 0.3);
            let value = (middle.x / 1000.0).hypot(middle.y / 500.0);
            assert!(
                (value - 1.0).abs() < 1e-4 / 500.0,
                "within the tolerance: {value}"
            );
        }
    }
}

#[test]
fn blocks_within_themselves_are_refused_and_the_rest_is_drawn() {
    let ring =
        format!("0 BLOCK\n2 B\n10 0\n20 0\n{LINE}0 INSERT\n5 D\n2 B\n10 1\n20 1\n0 ENDBLK\n");
    let layout = drawing(
        "",
        &ring,
        &format!("{LINE}0 INSERT\n5 C\n2 B\n10 0\n20 0\n"),
    );
    assert_eq!(layout.paths.len(), 1);
    let refused = layout.refused.iter().next().unwrap();
    assert_eq!((refused.id, refused.code), ("C", Code::Implausible));
}

#[test]
fn blocks_may_be_nested_as_deep_as_the_limit() {
    let depth = 127;
    let level = |i: usize| {
        let inner = i + 1;
        format!("0 BLOCK\n2 {i}\n10 0\n20 0\n0 INSERT\n5 I{i}\n2 {inner}\n10 1\n20 0\n0 ENDBLK\n")
    };
    let chain: String = (0..depth - 1).map(level).collect();
    let last = depth - 1;
    let blocks = format!("{chain}0 BLOCK\n2 {last}\n10 0\n20 0\n{LINE}0 ENDBLK\n");
    let layout = drawing("", &blocks, "0 INSERT\n5 C\n2 0\n10 0\n20 0\n");
    let (start, _) = layout.paths.get(0).ends().unwrap();
    assert_near(start, 1.0 + (depth - 1) as f64, 0.0);
}

#[test]
fn a_small_file_does_not_become_more_than_its_share() {
    // Half circles across the whole plane, which take the most pieces.
    let bend = |i: usize| format!("10 {}\n20 0\n42 1\n", (i % 2) as f64 * 9e8);
    let vertices: String = (0..200_000).map(bend).collect();
    let polyline = format!("0 LWPOLYLINE\n5 A\n{vertices}");
    let layout = drawing("", "", &format!("{polyline}{LINE}"));
    assert_eq!((layout.paths.len(), layout.refused.len()), (0, 2));
    assert_eq!(codes(&layout), [Code::Implausible]);
    // A bulge without end needs no drawing to be seen.
    let bend = |i: usize| format!("10 {i}\n20 0\n42 1e300\n");
    let vertices: String = (0..200_000).map(bend).collect();
    let polyline = format!("0 LWPOLYLINE\n5 B\n{vertices}");
    let layout = drawing("", "", &format!("{polyline}{LINE}"));
    assert_eq!(
        (layout.paths.len(), codes(&layout)),
        (1, vec![Code::OutOfRange])
    );
}

#[test]
fn colors_come_from_the_entity_its_layer_or_its_block() {
    let tables = "0 LAYER\n2 red\n70 0\n62 1\n0 LAYER\n2 green\n70 0\n62 3\n";
    let line = |handle: &str, layer: &str, color: &str| {
        format!("0 LINE\n5 {handle}\n8 {layer}\n{color}10 0\n20 0\n11 1\n21 0\n")
    };
    let blocks = format!(
        "0 BLOCK\n2 B\n10 0\n20 0\n{}{}{}0 ENDBLK\n",
        line("1", "0", ""),
        line("2", "green", ""),
        line("3", "green", "62 0\n")
    );
    let entities = format!(
        "{}{}{}0 INSERT\n5 I\n8 red\n62 5\n2 B\n10 0\n20 5\n",
        line("a", "RED", ""),
        line("b", "red", "420 1193046\n"),
        line("c", "elsewhere", "62 7\n")
    );
    let layout = drawing(tables, &blocks, &entities);
    let colors = layout.paths.color_rgba().unwrap();
    let layers = &layout.paths.attributes.get("layer").unwrap().values;
    let found: Vec<(&str, u32, String)> = layout
        .paths
        .iter()
        .map(|p| {
            (
                p.id(),
                colors[p.row()],
                layers.get(p.row()).unwrap().to_string(),
            )
        })
        .collect();
    let expected = [
        ("a", 0xFF00_00FF, "red"),
        ("b", 0x1234_56FF, "red"),
        ("c", 0, "elsewhere"),
        ("I/1", 0xFF00_00FF, "red"),
        ("I/2", 0x00FF_00FF, "green"),
        ("I/3", 0x0000_FFFF, "green"),
    ];
    assert_eq!(
        found,
        expected.map(|(id, color, layer)| (id, color, layer.to_owned()))
    );
    let kinds = &layout.paths.attributes.get("entity").unwrap().values;
    assert_eq!(kinds.get(0), Some(Value::Text("LINE")));
}

#[test]
fn what_is_switched_off_is_named_and_not_drawn() {
    let tables = "0 LAYER\n2 off\n70 0\n62 -1\n0 LAYER\n2 ice\n70 1\n62 1\n";
    let on = |layer: &str| format!("0 LINE\n5 {layer}\n8 {layer}\n10 0\n20 0\n11 1\n21 0\n");
    let blocks = format!("0 BLOCK\n2 B\n10 0\n20 0\n{}{LINE}0 ENDBLK\n", on("seen"));
    let layout = drawing(
        tables,
        &blocks,
        &format!(
            "{}{}0 LINE\n5 paper\n67 1\n10 0\n20 0\n11 1\n21 0\n0 TEXT\n5 T\n1 hello\n\
             0 INSERT\n5 I\n8 off\n2 B\n10 0\n20 0\n0 INSERT\n5 J\n8 ice\n2 B\n10 0\n20 0\n",
            on("off"),
            on("ice")
        ),
    );
    let drawn: Vec<&str> = layout.paths.iter().map(|p| p.id()).collect();
    assert_eq!(
        drawn,
        ["I/seen"],
        "what a block has on another layer is seen"
    );
    let refused: Vec<&str> = layout.refused.iter().map(|r| r.id).collect();
    assert_eq!(refused, ["off", "ice", "paper", "I/A", "J"]);
    assert_eq!(codes(&layout), [Code::NotDrawn]);
    assert_eq!(layout.diagnostics.count(Code::NotDrawn), 6, "the text too");
}
