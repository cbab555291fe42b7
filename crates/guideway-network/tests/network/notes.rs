//! Notes that the DXF reader keeps: texts, points, placed blocks and their attributes.

use guideway_formats::{ReadOptions, read_bytes};
use guideway_layout::{Layout, NoteKind};
use guideway_network::{BuildOptions, DrawingSources};

use crate::sketch::{add_text, drawing, network, split};

/// Reads a drawing in meters, whose group codes and values are separated by `|`.
fn read(blocks: &str, entities: &str) -> Layout {
    let file = format!(
        "0|SECTION|2|HEADER|9|$INSUNITS|70|6|0|ENDSEC|0|SECTION|2|TABLES|0|TABLE|2|LAYER|\
         0|LAYER|2|FROZEN|70|1|0|ENDTAB|0|ENDSEC|0|SECTION|2|BLOCKS|{blocks}0|ENDSEC|\
         0|SECTION|2|ENTITIES|{entities}0|ENDSEC|0|EOF|"
    );
    let bytes = file.replace('|', "\n").into_bytes();
    read_bytes("plan.dxf", &bytes, &ReadOptions::default()).unwrap()
}

const DOCK: &str = "0|BLOCK|2|Dock|10|1|20|0|0|POINT|8|0|10|1|20|2|0|ENDBLK|";

#[test]
fn texts_and_points_are_notes_at_their_places() {
    let layout = read(
        "",
        "0|TEXT|8|S|10|1|20|2|1|%%uA-1|0|TEXT|8|S|10|0|20|0|11|5|21|6|72|1|1|B|\
         0|MTEXT|8|S|10|3|20|4|1|{\\fArial;C}\\P2|0|POINT|8|P|10|7|20|8|\
         0|TEXT|8|FROZEN|10|1|20|2|1|hidden|0|TEXT|8|S|10|x|20|2|1|broken|",
    );
    let found: Vec<_> = layout
        .notes
        .iter()
        .map(|n| (n.kind, n.text.as_str(), n.layer.as_str(), n.position_m.x))
        .collect();
    let expected = [
        (NoteKind::Text, "A-1", "S", 1.0),
        (NoteKind::Text, "B", "S", 5.0),
        (NoteKind::Text, "C 2", "S", 3.0),
        (NoteKind::Point, "", "P", 7.0),
    ];
    assert_eq!(found, expected);
    // They are no paths, neither drawn nor refused.
    assert_eq!(layout.path_count(), 0);
}

#[test]
fn blocks_have_the_text_of_their_first_attribute() {
    let layout = read(
        DOCK,
        "0|INSERT|8|D|2|DOCK|66|1|10|10|20|20|0|ATTRIB|8|D|10|10|20|21|1|D-07|2|ID|\
         0|ATTRIB|8|D|10|10|20|22|1|other|2|KIND|0|SEQEND|0|INSERT|8|D|2|DOCK|10|30|20|20|",
    );
    let blocks: Vec<_> = layout
        .notes
        .iter()
        .filter(|n| n.kind == NoteKind::Block)
        .map(|n| {
            (
                n.block.as_str(),
                n.text.as_str(),
                n.position_m.x,
                n.position_m.y,
            )
        })
        .collect();
    assert_eq!(
        blocks,
        [("Dock", "D-07", 10.0, 20.0), ("Dock", "", 30.0, 20.0)]
    );
    // The point of the block is on the layer of its INSERT, 2 m above the base point.
    let point = layout.notes.iter().find(|n| n.kind == NoteKind::Point);
    let point = point.unwrap();
    assert_eq!((point.layer.as_str(), point.position_m.y), ("D", 22.0));
}

#[test]
fn circles_mark_stations_and_are_no_edges() {
    let layout = read(
        "",
        "0|LINE|8|T|10|0|20|0|11|9|21|0|0|CIRCLE|8|C|10|9|20|0.2|40|0.5|\
         0|TEXT|8|N|10|9|20|0.8|1|PARK|",
    );
    let options = BuildOptions {
        stations: vec!["circle:C".parse().unwrap()],
        ..BuildOptions::default()
    };
    let made = network(&layout, &options);
    let stations = &made.layout.stations;
    assert_eq!((made.layout.paths.len(), made.report.circles), (1, 1));
    assert_eq!((stations.len(), stations.id(0)), (1, "PARK"));
    let at = stations.position_m(0).unwrap();
    assert!(
        (at.x - 9.0).abs() < 1e-6 && (at.y - 0.2).abs() < 1e-6,
        "{at:?}"
    );
}

#[test]
fn outlines_of_areas_are_no_edges() {
    let corners = "10|8|20|0|11|9|21|0|12|9|22|1|";
    let square = "92|2|72|0|73|1|93|3|10|1|20|0|10|2|20|0|10|2|20|1|97|0|";
    let layout = read(
        "",
        &format!(
            "0|LINE|8|T|10|0|20|0|11|9|21|0|0|SOLID|8|T|{corners}0|TRACE|8|T|{corners}\
             0|3DFACE|8|T|{corners}0|HATCH|8|T|10|0|20|0|91|1|{square}"
        ),
    );
    assert_eq!(layout.paths.len(), 5);
    let made = network(&layout, &BuildOptions::default());
    assert_eq!((made.layout.paths.len(), made.report.paths_left), (1, 4));
}

#[test]
fn sources_list_layers_and_notes_by_name() {
    let layout = read(
        DOCK,
        "0|LINE|8|T|10|0|20|0|11|9|21|0|0|LINE|8|A|10|0|20|0|11|9|21|0|\
         0|CIRCLE|8|C|10|9|20|0.2|40|0.5|0|TEXT|8|S|10|1|20|2|1|A-1|0|TEXT|8|S|10|2|20|2|1|A-2|\
         0|INSERT|8|D|2|DOCK|10|30|20|20|",
    );
    let sources = DrawingSources::of(&layout);
    let layers: Vec<(&str, u64)> = sources.layers.iter().map(|(n, c)| (&**n, *c)).collect();
    assert_eq!(layers, [("A", 1), ("C", 1), ("T", 1)]);
    let notes = sources.notes.iter();
    let notes: Vec<String> = notes.map(|(source, n)| format!("{source} {n}")).collect();
    assert_eq!(
        notes,
        ["text:S 2", "block:Dock 1", "point:D 1", "circle:C 1"]
    );
}

#[test]
fn source_without_notes_is_told_with_what_there_is() {
    let mut layout = drawing(&[[0.0, 0.0, 10.0, 0.0]]);
    add_text(&mut layout, "END", 9.5, 0.5);
    let layer = layout.notes[0].layer.clone();
    let mut options = split();
    options.stations = vec![
        "text:nowhere".parse().unwrap(),
        "block:DOCK".parse().unwrap(),
    ];
    let report = network(&layout, &options).report;
    let found = &report.unmatched_sources;
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].present, [layer.as_str()]);
    let lines = report.lines(&options);
    let told = |line: &str| lines.iter().any(|own| own == line);
    assert!(
        told(&format!(
            "no note fits text:nowhere: the drawing has them in {layer}"
        )),
        "{lines:?}"
    );
    assert!(
        told("no note fits block:DOCK: the drawing has no block"),
        "{lines:?}"
    );
    options.stations = vec![format!("text:{layer}").parse().unwrap()];
    let report = network(&layout, &options).report;
    assert!(report.unmatched_sources.is_empty());
}
