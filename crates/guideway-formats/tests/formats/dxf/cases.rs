//! Drawings as other programs write them: code pages, missing units, damaged ends, external
//! references, clipped blocks, periodic splines, walls.

use guideway_layout::{Code, Layout, Severity};
use guideway_spline::Point;

use super::{LINE, assert_near, drawing, text, vertices};
use crate::common::{codes, ends, read, read_real, shared};
use guideway_formats::{ReadOptions, lif, read_bytes};

/// Reads a drawing in meters with further header variables and sections.
fn with_header(header: &str, entities: &str, sections: &str) -> Layout {
    read(&text(&format!(
        "0 SECTION\n2 HEADER\n{header}\n0 ENDSEC\n\
         0 SECTION\n2 ENTITIES\n{entities}\n0 ENDSEC\n{sections}\n0 EOF"
    )))
}

fn severities(layout: &Layout) -> Vec<(Code, Severity)> {
    let found = layout.diagnostics.iter();
    found.map(|d| (d.code, d.severity)).collect()
}

#[test]
fn layers_are_decoded_by_code_page() {
    for (page, name, expected) in [
        ("ANSI_936", &b"\xBB\xF5\xBC\xDC"[..], "货架"),
        ("ANSI_1250", b"\x8Ccie\xBFka", "Ścieżka"),
        ("ANSI_932", b"\x92\xCA\x98H", "通路"),
        ("dos850", b"W\x84nde", "Wände"),
        ("ANSI_936", b"\\M+5BBF5\\M+5BCDC", "货架"),
        ("ANSI_936", "货架".as_bytes(), "货架"),
        // UTF-8 by chance.
        ("ANSI_936", b"\xC7\xBD", "墙"),
        ("ANSI_1252", "Wände".as_bytes(), "Wände"),
    ] {
        let head = format!(
            "0 SECTION\n2 HEADER\n9 $ACADVER\n1 AC1015\n9 $INSUNITS\n70 6\n9 $DWGCODEPAGE\n\
             3 {page}\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n0 LINE"
        );
        let tail = "10 0\n20 0\n11 1\n21 0\n0 ENDSEC\n0 EOF";
        let layer = [b"8\n", name, b"\n"].concat();
        let bytes = [text(&head).as_bytes(), &layer, text(tail).as_bytes()].concat();
        let layout = read_bytes("test", &bytes, &ReadOptions::default()).unwrap();
        let layer = layout.paths.value(0, "layer").unwrap().to_string();
        assert_eq!(layer, expected, "{page}");
        assert_eq!(codes(&layout), [], "{page}");
    }
}

#[test]
fn a_drawing_without_a_unit_may_hint_at_inches() {
    for (header, meters, hint) in [
        ("9 $LUNITS\n70 4", 0.0254, "inches, because"),
        (
            "9 $LUNITS\n70 3\n9 $MEASUREMENT\n70 1",
            0.0254,
            "inches, because",
        ),
        (
            "9 $MEASUREMENT\n70 0\n9 $LUNITS\n70 2",
            0.001,
            "hints at inches",
        ),
        ("9 $MEASUREMENT\n70 1", 0.001, "read as millimeters"),
        ("9 $LUNITS\n70 4\n9 $INSUNITS\n70 4", 0.001, ""),
    ] {
        let layout = with_header(header, LINE, "");
        assert_near(ends(&layout, "A").1, 3.0 * meters, meters);
        let mut found = layout.diagnostics.iter();
        let is_found = found.any(|d| d.code == Code::AssumedUnit && d.message.contains(hint));
        assert_eq!(is_found, !hint.is_empty(), "{header}");
        let assumed_m = layout.provenance.assumed_unit_m;
        assert_eq!(assumed_m, is_found.then_some(meters), "{header}");
    }
}

#[test]
fn what_a_damaged_drawing_holds_is_read() {
    let head = "0 SECTION\n2 HEADER\n9 $INSUNITS\n70 6\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n";
    let other = LINE.replace("5 A", "5 B");
    let error = [(Code::MissingField, Severity::Error)];
    for end in ["0 ENDSEC", "0 LINE\n5 C\n10 0\n20 0\n11 1\n21 1", ""] {
        let layout = read(&text(&format!("{head}{LINE}{end}")));
        assert!(layout.paths.iter().any(|path| path.id() == "A"), "{end}");
        assert_eq!(severities(&layout), error, "{end}");
    }
    // Texts with line breaks: what follows is read.
    for note in ["1\nwith a decision.\n\n", "1\na\nb\n", "1\na\nb\nc d\n"] {
        let text = [
            &text(&format!("{head}{LINE}0 TEXT")),
            note,
            &text(&format!("{other}0 ENDSEC\n0 EOF")),
        ];
        let layout = read(&text.concat());
        let ids: Vec<_> = layout.paths.iter().map(|path| path.id()).collect();
        assert_eq!(ids, ["A", "B"], "{note:?}");
        let found = severities(&layout);
        assert!(
            found.contains(&(Code::WrongType, Severity::Error)),
            "{note:?} {found:?}"
        );
        let line = layout
            .diagnostics
            .iter()
            .find(|d| d.code == Code::WrongType);
        assert_eq!(line.unwrap().place.line, Some(33), "{note:?}");
    }
    // Nothing but noise is no drawing.
    let noise = format!("{head}{}", "x y\n".repeat(3000));
    assert!(read_bytes("test", noise.as_bytes(), &ReadOptions::default()).is_err());
}

#[test]
fn blanks_around_all_lines_are_no_part_of_values() {
    let plain = text(&format!(
        "0 SECTION\n2 HEADER\n9 $INSUNITS\n70 6\n0 ENDSEC\n0 SECTION\n2 ENTITIES\n\
         {}0 ENDSEC\n0 EOF",
        LINE.replace("8 0", "8 MY WALLS")
    ));
    for (before, after) in [("\t", ""), ("    ", "  "), ("", "  ")] {
        let lines = plain.lines();
        let padded: String = lines
            .map(|line| format!("{before}{line}{after}\n"))
            .collect();
        let layout = read(&padded);
        assert_eq!(severities(&layout), []);
        assert_eq!(layout.paths.get(0).id(), "A");
        let (start, end) = ends(&layout, "A");
        assert_near(start, 1.0, 0.0);
        assert_near(end, 3.0, 1.0);
        let layer = layout.paths.value(0, "layer").unwrap().to_string();
        assert_eq!(layer, "MY WALLS");
    }
}

#[test]
fn an_entity_that_cannot_be_drawn_is_an_error() {
    for broken in [
        "0 LINE\n5 B\n10 0,5\n20 0\n11 1\n21 1",
        "0 LINE\n5 B\n10 0\n20 0",
        "0 LINE\n5 B\n10 nan\n20 0\n11 1\n21 1",
        "0 INSERT\n5 B\n2 NONE\n10 0\n20 0",
        "0 LWPOLYLINE\n5 B\n10 0\n20 0",
        "0 MLINE\n5 B\n11 0\n21 0",
        "0 SOLID\n5 B\n10 0\n20 0",
    ] {
        let layout = drawing("", "", &format!("{LINE}{broken}"));
        assert_eq!(layout.refused.len(), 1, "{broken}");
        assert_eq!(
            layout.diagnostics.count_at_least(Severity::Error),
            1,
            "{broken}"
        );
    }
}

#[test]
fn an_external_reference_names_its_drawing() {
    for flags in [4, 8, 4 | 32] {
        let blocks =
            format!("0 BLOCK\n2 HALL\n70 {flags}\n10 0\n20 0\n1 ..\\plans\\hall.dwg\n0 ENDBLK");
        let insert = format!("{LINE}0 INSERT\n5 B\n2 hall\n10 0\n20 0");
        let layout = drawing("", &blocks, &insert);
        let found = layout.diagnostics.iter().next().unwrap();
        assert_eq!(found.severity, Severity::Error);
        assert!(
            found.message.contains("`..\\plans\\hall.dwg`"),
            "{}",
            found.message
        );
        // One that is bound holds its entities.
        let bound = blocks.replace("0 ENDBLK", &format!("{LINE}0 ENDBLK"));
        assert_eq!(drawing("", &bound, &insert).paths.len(), 2);
    }
}

#[test]
fn clipped_blocks_are_found() {
    let block =
        format!("0 SECTION\n2 BLOCKS\n0 BLOCK\n2 RACK\n10 0\n20 0\n{LINE}0 ENDBLK\n0 ENDSEC\n");
    let inserts = "0 INSERT\n5 B1\n2 RACK\n10 0\n20 0\n0 INSERT\n5 B2\n2 RACK\n10 9\n20 0\n";
    let objects = |filter: &str, owner: &str| {
        format!(
            "0 SECTION\n2 OBJECTS\n0 DICTIONARY\n5 D1\n330 {owner}\n3 ACAD_FILTER\n360 D2\n\
             0 DICTIONARY\n5 D2\n102 {{ACAD_REACTORS\n330 F0\n102 }}\n330 D1\n3 SPATIAL\n\
             360 F1\n0 SPATIAL_FILTER\n5 F1\n330 D2\n70 2\n10 0\n20 0\n10 1\n20 1\n\
             {filter}0 ENDSEC\n"
        )
    };
    let found = |objects: &str| {
        let file = format!(
            "0 SECTION\n2 HEADER\n9 $INSUNITS\n70 6\n0 ENDSEC\n{block}0 SECTION\n2 ENTITIES\n\
             {inserts}0 ENDSEC\n{objects}0 EOF"
        );
        let layout = read(&text(&file));
        assert_eq!(layout.paths.len(), 2);
        let found = layout.diagnostics.iter();
        let found = found.filter(|d| d.code == Code::ApproximateShape);
        let found = found.filter(|d| d.severity == Severity::Warning);
        found.map(|d| d.place.element.clone()).collect::<Vec<_>>()
    };
    assert_eq!(found(&objects("71 1\n", "B2")), ["INSERT B2"]);
    assert_eq!(found(&objects("", "B1")), ["INSERT B1"]);
    assert_eq!(found(&objects("71 0\n", "B2")), [""; 0], "switched off");
    assert_eq!(found(&objects("71 1\n", "0")), ["OBJECTS"]);
    assert_eq!(found(""), [""; 0]);
}

#[test]
fn periodic_splines_are_closed_and_smooth() {
    let corners = [(0, 0), (4, 0), (4, 4), (0, 4), (-2, 2)];
    let points: String = corners.map(|(x, y)| format!("10 {x}\n20 {y}\n")).concat();
    let spline = |degree: i32, flags: i32, knots: &[i32]| {
        let knots: String = knots.iter().map(|knot| format!("40 {knot}\n")).collect();
        let entity = format!("0 SPLINE\n5 A\n70 {flags}\n71 {degree}\n{knots}{points}");
        drawing("", "", &entity)
    };
    // n + 1 knots, as Open CASCADE writes them.
    for flags in [2, 3, 11, 1] {
        let layout = spline(3, flags, &[0, 1, 2, 3, 4, 5]);
        let (start, end) = ends(&layout, "A");
        assert!(start.distance(end) < 1e-12);
        // The first cubic has the first four control points: (P0 + 4 P1 + P2) / 6.
        assert_near(start, 20.0 / 6.0, 4.0 / 6.0);
        assert_eq!(vertices(&layout, "A").len(), 6);
        assert!(!codes(&layout).contains(&Code::BadKnots));
    }
    // Unequal knots, in comparison with the same curve unrolled.
    let unrolled = "0 SPLINE\n5 A\n71 3\n40 -4\n40 -2\n40 -1\n40 0\n40 2\n40 3\n40 5\n40 6\n\
                    40 7\n40 9\n40 10\n40 12\n";
    let again = "10 0\n20 0\n10 4\n20 0\n10 4\n20 4\n";
    let expected = drawing("", "", &format!("{unrolled}{points}{again}"));
    let found = spline(3, 2, &[0, 2, 3, 5, 6, 7]);
    for (a, b) in vertices(&found, "A").iter().zip(vertices(&expected, "A")) {
        assert!(a.distance(b) < 1e-12, "{a:?} {b:?}");
    }
    // A first knot that occurs more often than there are points.
    let repeated = "0 SPLINE\n5 A\n70 3\n71 8\n40 0\n40 0\n40 5\n10 4\n20 0\n";
    assert!(codes(&drawing("", "", repeated)).contains(&Code::TooFewPoints));
    // A first knot that occurs twice: n + 2 knots.
    let doubled = spline(3, 3, &[0, 0, 1, 2, 3, 4, 4]);
    assert!(!codes(&doubled).contains(&Code::BadKnots));
    let (start, end) = ends(&doubled, "A");
    assert!(start.distance(end) < 1e-12);
}

#[test]
fn weights_of_zero_are_evaluated() {
    let spline = |weight: f64| {
        let points = "10 0\n20 0\n10 5\n20 10\n10 10\n20 0";
        let knots = "40 0\n40 0\n40 0\n40 1\n40 1\n40 1";
        let weights = format!("41 1\n41 {weight:?}\n41 1");
        let entity = format!("0 SPLINE\n5 A\n70 4\n71 2\n{knots}\n{weights}\n{points}");
        drawing("", "", &entity)
    };
    let straight = spline(0.0);
    assert!(
        vertices(&straight, "A")
            .iter()
            .all(|point| point.y.abs() < 1e-12)
    );
    assert_eq!(codes(&straight), []);
    assert_eq!(codes(&spline(-0.5)), [Code::BadWeight]);
}

#[test]
fn end_weights_of_zero_are_evaluated() {
    let knots = "40 0\n40 0\n40 0\n40 0\n40 1\n40 1\n40 1\n40 1";
    let points = "10 0\n20 0\n10 1\n20 5\n10 9\n20 5\n10 10\n20 0";
    let weights = "41 0\n41 1\n41 1\n41 0";
    let entity = format!("0 SPLINE\n5 A\n70 12\n71 3\n{knots}\n{weights}\n{points}");
    let layout = drawing("", "", &entity);
    // u (1 - u) cancels: a straight line between the inner points.
    assert_eq!(
        ends(&layout, "A"),
        (Point::new(1.0, 5.0), Point::new(9.0, 5.0))
    );
    let all = vertices(&layout, "A");
    assert!(all.iter().all(|point| (point.y - 5.0).abs() < 1e-12));
    assert_eq!(codes(&layout), [Code::BadWeight]);
    // LIF 1.0 has weights from 1 on: it gets the line.
    let mut out = Vec::new();
    let options = lif::WriteOptions {
        version: lif::Version::V1,
        exported: std::time::SystemTime::UNIX_EPOCH,
    };
    let losses = lif::write_layout(&layout, &mut out, &options).unwrap();
    let text = String::from_utf8(out).unwrap();
    assert!(!text.contains("weight"), "{text}");
    assert!(losses.iter().any(|loss| loss.what == "curves"));
    assert_eq!(
        ends(&read(&text), "A"),
        (Point::new(1.0, 5.0), Point::new(9.0, 5.0))
    );
}

#[test]
fn multilines_and_areas_are_outlines() {
    let vertex = |x: f64, y: f64, miter: (f64, f64)| {
        format!(
            "11 {x:?}\n21 {y:?}\n12 1\n22 0\n13 {:?}\n23 {:?}\n74 2\n41 0\n41 0\n75 0\n74 2\n\
             41 -0.5\n41 0\n75 0\n",
            miter.0, miter.1
        )
    };
    let wall = [vertex(0.0, 0.0, (0.0, 1.0)), vertex(10.0, 0.0, (-1.0, 1.0))].concat();
    let layout = drawing(
        "",
        "",
        &format!("0 MLINE\n5 W\n8 WALLS\n71 1\n72 2\n73 2\n{wall}"),
    );
    assert_eq!(
        ends(&layout, "W [1]"),
        (Point::new(0.0, 0.0), Point::new(10.0, 0.0))
    );
    assert_eq!(
        ends(&layout, "W [2]"),
        (Point::new(0.0, -0.5), Point::new(10.5, -0.5))
    );
    let layer = layout.paths.value(1, "layer").unwrap().to_string();
    assert_eq!(layer, "WALLS");
    let closed = drawing("", "", &format!("0 MLINE\n5 W\n71 3\n{wall}"));
    let (start, end) = ends(&closed, "W [2]");
    assert_eq!(start, end);

    // A SOLID lists its third and fourth corner in the other order than a face.
    let corners = "10 0\n20 0\n11 2\n21 0\n12 0\n22 1\n13 2\n23 1\n";
    let solid = drawing("", "", &format!("0 SOLID\n5 S\n{corners}"));
    let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0), (0.0, 0.0)];
    let square = square.map(|(x, y)| Point::new(x, y));
    assert_eq!(vertices(&solid, "S"), square);
    let trace = drawing(
        "",
        "",
        &format!("0 TRACE\n5 S\n{corners}210 0\n220 0\n230 -1\n"),
    );
    assert_eq!(vertices(&trace, "S"), square.map(|p| Point::new(-p.x, p.y)));
    let corners = "10 0\n20 0\n11 2\n21 0\n12 2\n22 1\n13 0\n23 1\n";
    let face = drawing("", "", &format!("0 3DFACE\n5 S\n{corners}"));
    assert_eq!(vertices(&face, "S"), square);
    let open = drawing("", "", &format!("0 3DFACE\n5 S\n{corners}70 5\n"));
    assert_eq!(open.paths.len(), 2, "edges 2 and 4");
    assert_eq!(ends(&open, "S [1]"), (square[1], square[2]));
    // A triangle repeats its third corner; its last edge has the flag of the fourth.
    let triangle = "10 0\n20 0\n11 2\n21 0\n12 2\n22 1\n13 2\n23 1\n";
    let triangle = drawing("", "", &format!("0 3DFACE\n5 S\n{triangle}70 8\n"));
    assert_eq!(triangle.paths.len(), 2);
}

#[test]
fn carets_escape_control_characters_in_names_and_texts() {
    let tables = "0 TABLE\n2 LAYER\n0 LAYER\n2 A^ B\n70 0\n62 1\n0 ENDTAB";
    let block = "0 BLOCK\n2 R^IK\n10 0\n20 0\n0 LINE\n5 A\n8 A^ B\n10 0\n20 0\n11 1\n21 0\n\
                 0 ENDBLK";
    let split = "0 MTEXT\n5 M\n10 0\n20 9\n3 Halle^\n1 J7 \\S1^ 2;\n";
    let entities = "0 INSERT\n5 I\n2 r\\U+0009k\n66 1\n10 0\n20 0\n\
                    0 ATTRIB\n5 T\n1 A^ 1\n10 0\n20 0\n0 SEQEND\n\
                    0 TEXT\n5 N\n1 Tor^I1^MA^B\n10 5\n20 5\n";
    let layout = drawing(tables, block, &format!("{entities}{split}"));
    let layer = layout.paths.value(0, "layer").unwrap().to_string();
    assert_eq!(layer, "A^B");
    let notes: Vec<_> = layout.notes.iter().map(|n| (&*n.text, &*n.block)).collect();
    let expected = [("A^1", "R\tK"), ("Tor 1 A^B", ""), ("Halle 7 1/2", "")];
    assert_eq!(notes, expected);
}

#[test]
fn public_cases_are_read() {
    let Some(folder) = shared("cases/dxf") else {
        return;
    };
    for (file, paths, errors) in [
        ("d16_gbk_layer", 2, 0),
        ("d17_cif_layer", 2, 0),
        ("d18_mif_layer", 1, 0),
        ("d19_utf8_but_936", 1, 0),
        ("d19c_cp1250_layer", 1, 0),
        ("d22b_no_eof", 2, 1),
        ("d22d_ctrlz", 2, 0),
        ("d23_stray_blank_in_text", 3, 1),
        ("d27_unitless_english", 1, 0),
        ("d33_decimal_comma", 1, 1),
        ("d35_inserts", 14, 2),
        ("d36_xref", 1, 1),
        ("d46_mline_walls", 6, 0),
        ("d53_weights", 4, 0),
    ] {
        let layout = read_real(&folder.join(format!("{file}.dxf")));
        let found = layout.diagnostics.count_at_least(Severity::Error);
        assert_eq!((layout.paths.len(), found), (paths, errors), "{file}");
    }
}
