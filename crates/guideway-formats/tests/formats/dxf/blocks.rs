//! Checks blocks and their clips, and what entities inherit from INSERTs and layers: colors and
//! visibility.

use super::{LINE, assert_near, drawing};
use crate::common::{codes, ends};
use guideway_layout::{Code, Layout, Value};
use guideway_spline::uniform;

#[test]
fn expands_nested_rotated_mirrored_and_repeated_blocks() {
    let blocks = format!(
        "0 BLOCK\n2 inner\n10 1\n20 0\n{LINE}0 ENDBLK\n\
         0 BLOCK\n2 OUTER\n10 0\n20 0\n0 INSERT\n5 B\n2 INNER\n10 10\n20 0\n41 -1\n0 ENDBLK\n"
    );
    // The line leads from the base point by (2, 1), mirrored by (-2, 1).
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
    // The INSERT rotates the steps of the array but does not scale them.
    let layout = drawing("", &blocks, &format!("{array}50 90\n"));
    assert_near(ends(&layout, "C[1,0]/A").0, 0.0, 10.0);
}

#[test]
fn circle_in_a_stretched_block_is_an_ellipse() {
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
                "{value} is not within the tolerance"
            );
        }
    }
}

#[test]
fn refuses_recursive_blocks_and_draws_the_rest() {
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
fn expands_blocks_up_to_the_depth_limit() {
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
fn resolves_colors_by_entity_layer_and_block() {
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
fn reports_and_skips_hidden_entities() {
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
        "entities of a block on a visible layer are drawn"
    );
    let refused: Vec<&str> = layout.refused.iter().map(|r| r.id).collect();
    assert_eq!(refused, ["off", "ice", "paper", "I/A", "J"]);
    assert_eq!(codes(&layout), [Code::NotDrawn]);
    assert_eq!(
        layout.diagnostics.count(Code::NotDrawn),
        6,
        "five entities and the TEXT"
    );
}

/// A block of two lines, references to it, and a boundary that clips the reference B1, drawn when
/// the reference lay at (5, 5).
fn clipped(inserts: &str, boundary: &str) -> Layout {
    clipped_with(inserts, boundary, "")
}

/// The same, with further objects.
fn clipped_with(inserts: &str, boundary: &str, objects: &str) -> Layout {
    let block = "0 BLOCK\n2 RACK\n10 0\n20 0\n0 LINE\n5 A\n10 0\n20 0\n11 10\n21 0\n\
                 0 LINE\n5 Z\n10 0\n20 3\n11 10\n21 3\n0 TEXT\n5 T\n1 Dock\n10 9\n20 0\n0 ENDBLK\n\
                 0 BLOCK\n2 HALL\n10 0\n20 0\n0 INSERT\n5 B1\n2 RACK\n10 5\n20 5\n0 ENDBLK";
    let rows = |x: f64| {
        format!("40 1\n40 0\n40 0\n40 {x}\n40 0\n40 1\n40 0\n40 {x}\n40 0\n40 0\n40 1\n40 0\n")
    };
    drawing(
        "",
        block,
        &format!(
            "{inserts}0 ENDSEC\n0 SECTION\n2 OBJECTS\n0 DICTIONARY\n5 D1\n330 B1\n0 DICTIONARY\n\
             5 D2\n330 D1\n0 SPATIAL_FILTER\n5 F1\n330 D2\n{boundary}71 1\n72 0\n73 0\n\
             {}{}{objects}",
            rows(-5.0),
            rows(0.0)
        ),
    )
}

#[test]
fn clipped_blocks_are_cut_at_their_boundary() {
    // From (2, -1) to (6, 1) in the block.
    let rectangle = "70 2\n10 7\n20 4\n10 11\n20 6\n";
    let moved = "0 INSERT\n5 B1\n2 RACK\n10 100\n20 50\n50 90\n41 2\n42 2\n43 2\n";
    let layout = clipped(moved, rectangle);
    let (start, end) = ends(&layout, "B1/A");
    assert_near(start, 100.0, 54.0);
    assert_near(end, 100.0, 62.0);
    // The other line is accounted for, and a text beyond the boundary names no station.
    assert_eq!((layout.paths.len(), layout.refused.len()), (1, 1));
    let hidden = layout.refused.get(0);
    assert_eq!((hidden.id, hidden.code), ("B1/Z", Code::NotDrawn));
    assert!(layout.notes.iter().all(|note| note.text != "Dock"));
    assert!(!codes(&layout).contains(&Code::ApproximateShape));
    // The boundary belongs to one reference.
    let other = clipped("0 INSERT\n5 B2\n2 RACK\n10 0\n20 0\n", rectangle);
    assert_eq!((other.paths.len(), other.notes.len()), (2, 2));

    // A polygon with a notch, in a block within a block.
    let notched = "70 5\n10 5\n20 4\n10 15\n20 4\n10 15\n20 9\n10 10\n20 4.5\n10 5\n20 9\n";
    let nested = clipped("0 INSERT\n5 C\n2 HALL\n10 1000\n20 0\n", notched);
    let edge = 5.0 / 4.5 * 0.5;
    for (id, from, to) in [
        ("C/B1/A [1]", 0.0, 5.0 - edge),
        ("C/B1/A [2]", 5.0 + edge, 10.0),
        ("C/B1/Z [1]", 0.0, 5.0 - 7.0 * edge),
        ("C/B1/Z [2]", 5.0 + 7.0 * edge, 10.0),
    ] {
        let (start, end) = ends(&nested, id);
        assert_near(
            start,
            1005.0 + from,
            if id.contains('A') { 5.0 } else { 8.0 },
        );
        assert_near(end, 1005.0 + to, if id.contains('A') { 5.0 } else { 8.0 });
    }
    assert_eq!(nested.paths.len(), 4);
}

#[test]
fn inverted_boundaries_hide_their_inside() {
    let insert = "0 INSERT\n5 B1\n2 RACK\n10 5\n20 5\n";
    // AutoCAD writes this one for programs without inverted boundaries, and leaves corners out.
    let filter = "102 {ACAD_XDICTIONARY\n360 X\n102 }\n70 3\n10 7\n20 6\n10 -9\n20 6\n\
                  10 7\n20 5.9\n";
    let record = |corners: &str| {
        format!(
            "0 DICTIONARY\n5 X\n330 F1\n3 ACAD_XREC_ROUNDTRIP\n360 R\n0 XRECORD\n5 R\n\
             102 {{ACAD_REACTORS\n330 F9\n102 }}\n330 X\n100 AcDbXrecord\n280 1\n\
             102 ACAD_INVERTEDCLIP_ROUNDTRIP\n{corners}\
             102 ACAD_INVERTEDCLIP_ROUNDTRIP_COMPARE\n10 0\n20 0\n10 1\n20 0\n10 1\n20 1\n"
        )
    };
    // From (2, -1) to (6, 1) in the block, as two and as four corners.
    for corners in [
        "10 7\n20 4\n30 0\n10 11\n20 6\n30 0\n",
        "10 7\n20 4\n10 7\n20 6\n10 11\n20 6\n10 11\n20 4\n",
    ] {
        let layout = clipped_with(insert, filter, &record(corners));
        for (id, from, to) in [("B1/A [1]", 0.0, 2.0), ("B1/A [2]", 6.0, 10.0)] {
            let (start, end) = ends(&layout, id);
            assert_near(start, 5.0 + from, 5.0);
            assert_near(end, 5.0 + to, 5.0);
        }
        let (start, end) = ends(&layout, "B1/Z");
        assert_near(start, 5.0, 8.0);
        assert_near(end, 15.0, 8.0);
        assert!(layout.notes.iter().any(|note| note.text == "Dock"));
        assert!(!codes(&layout).contains(&Code::ApproximateShape));
    }
    // The outer polygon, from (-5, -5) to (15, 5) in the block, in place of the inner one.
    let inner = "102 {ACAD_XDICTIONARY\n360 X\n102 }\n70 2\n10 7\n20 4\n10 11\n20 6\n";
    let outer = record("10 0\n20 0\n10 20\n20 10\n");
    let layout = clipped_with(insert, inner, &outer);
    assert_near(ends(&layout, "B1/A [1]").1, 7.0, 5.0);
    assert_near(ends(&layout, "B1/A [2]").0, 11.0, 5.0);
    assert_eq!(layout.paths.len(), 3);
    // Another dictionary of a boundary inverts nothing.
    let plain = record("").replace("INVERTEDCLIP", "OTHER");
    let rectangle = "102 {ACAD_XDICTIONARY\n360 X\n102 }\n10 7\n20 4\n10 11\n20 6\n";
    let (start, end) = ends(&clipped_with(insert, rectangle, &plain), "B1/A");
    assert_near(start, 7.0, 5.0);
    assert_near(end, 11.0, 5.0);
}

#[test]
fn broken_boundaries_are_found() {
    let insert = "0 INSERT\n5 B1\n2 RACK\n10 5\n20 5\n";
    for boundary in ["70 1\n10 7\n20 4\n", "70 2\n10 7\n20 x\n10 11\n20 6\n"] {
        let layout = clipped(insert, boundary);
        assert_eq!(layout.paths.len(), 2, "{boundary}");
        let found = layout.diagnostics.iter();
        let found = found.filter(|d| d.code == Code::ApproximateShape);
        let found: Vec<&str> = found.map(|d| d.message.as_str()).collect();
        assert!(
            found.len() == 1 && found[0].contains("corners"),
            "{found:?}"
        );
    }
}
